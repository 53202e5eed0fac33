"""Studies: many runs of one model, and what they say together.

    cases      one run in memory: values in, a row of figures out
    sweeps     many cases: designs, processes, clusters, the table
    fits       parameters from measured records

Contract: a study knows models only through `simulate.Model` and `run.run`; no stage of the pipeline knows a study.
"""

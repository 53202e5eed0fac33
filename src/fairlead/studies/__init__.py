"""Studies: many runs of one model, and what they say together.

    cases           one run in memory: values in, a row of figures out
    differences     derivatives of what runs compute: noise floor, step, error
    sweeps          many cases: designs, processes, clusters, the table
    pictures        of sweeps
    fits            parameters from measured records
    sensitivities   derivatives of figures to parameters
    modes           a model linearised in its zones

Contract: a study knows models only through `simulate.Model` and `run.run`; no stage of the pipeline knows a study.
"""

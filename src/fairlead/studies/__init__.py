"""Studies: many runs of one model, and what they say together.

    differences     derivatives of what runs compute: noise floor, step, error
    sweeps          many cases: designs, processes, clusters, the table
    pictures        of sweeps
    fits            parameters from measured records
    sensitivities   derivatives of figures to parameters
    modes           a model linearised in its zones

Contract: a study knows models only through `simulate.Model`, `run.run` and `cases.Cases`; no stage of the pipeline
knows a study.
"""

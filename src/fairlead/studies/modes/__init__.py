"""Modes: a model linearised at an instant, its zones frozen as asked.

    pattern      which zone every part is in, asked by name, and in words
    linear       M y' = J y at an instant: states and the matrix that is left of both
    spectrum     eigenvalues: frequency, damping, participation by component
    signals      what acts (a force at a node, a signal) and what is looked at
    response     from one to the other over frequency
    squeal       patterns of a few contacts, the least damped first
    table        all of it as it is handed back, and as lines of text
    modes        what is asked
    told         as a record and as CSV
    picture      eigenvalues and responses drawn

Contract: the run that leads to the instant is one of the model as it is; zones change only in what is linearised there.
Mistakes of what is asked raise ModelError, all at once.
"""

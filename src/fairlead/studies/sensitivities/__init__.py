"""Sensitivities: derivatives of the figures of a case to the parameters of its model.

    parameters    which numbers of a model can be varied, with value and unit
    runs          figures and zone changes over the parameters, each point run once
    switches      the first zone change in which two runs differ
    derivative    one figure over one parameter: its derivative, or why it has none
    table         all derivatives, also as lines of text
    sensitivity   what is asked, and the runs
    told          the table as a record and as CSV

Contract: a derivative is told with its error, and refused where the figure jumps or has a corner; then the sentence
names the zone change behind it. Mistakes of what is asked raise ModelError, all at once, before anything runs.
"""

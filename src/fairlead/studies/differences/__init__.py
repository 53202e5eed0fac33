"""Differences: derivatives of what a run computes, by steps that follow from the noise floor of the engine.

Owner of the noise floor, the choice of a step and the difference itself (`steps.py`). Contract: it knows a study as a
function of parameters z to numbers and nothing else. NaN is a run that has no such number; no step is built on it.
"""

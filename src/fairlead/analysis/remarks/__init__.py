"""What a user should know of a scene or a run that is no mistake.

Given the flat model, or the record of a run.
Does  one file for each kind of remark; remarks.py gathers those of a model.
Says  sentences with the component, the value and a way out.
"""

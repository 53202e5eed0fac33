"""What `run.json` holds of a run: events, steps, extremes, limits, counts, energy, creep.

Given the result of a run, or rows as they are recorded.
Does  one file for each entry; names.py, limits.py and profile.py check what a netlist asks to be recorded;
      reported.py reads all of it back as the sentences that a user is told.
Says  plain dictionaries that JSON holds; ModelError for names that no signal has.
"""

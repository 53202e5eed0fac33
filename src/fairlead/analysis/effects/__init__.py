"""What each effect that a scene can switch off does to its outputs.

Given a scene, and a function that runs it.
Does  switches.py finds what can be switched, weights.py their order, sameness.py those that change no equation;
      effects.py runs them, changes.py compares outputs.
Says  a row for each switch (effect_row.py), by the size of its change.
"""

"""Cases in memory: (model, values, wanted figures) -> a row.

Owner of what a figure is (`figures.py`, `values_of.py`), what a row holds (`row.py`), and what a case is known by
(`identity.py`). Contract: `Cases.row(values)` never raises for what happens in a run; it writes no file.
"""

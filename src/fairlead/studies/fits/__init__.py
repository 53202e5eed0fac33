"""Fits: parameters of models from measured records.

Owner of what a record is (`measured.py`), what is asked (`fit_file.py`), residuals (`problem.py`, `features.py`), the
search (`search.py`), what is known of the parameters (`known.py`), laws beside each other (`laws.py`) and the report
(`report.py`, `page.py`). Contract: a fit changes no model and raises ModelError
with every mistake before anything runs.
"""

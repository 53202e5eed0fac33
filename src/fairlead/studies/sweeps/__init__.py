"""Sweeps: many cases of a model by processes or a cluster, in one table.

Owner of designs (`ranges.py`, `distributions.py`, `sampling.py`, `design.py`, `plan.py`), of who computes (`farm.py`,
`cluster.py`, `parcel.py`), of the table (`table.py`), and of the order of all this (`sweep.py`). Contract: a row that
was computed is in the table after a kill at any moment, but for the last seconds; a table is whole whenever it is read.
"""

"""Cases in memory: (model, values, wanted figures) -> a row. See docs/studies.md.

from fairlead.cases import Cases

cases = Cases(fairlead.load("belt"), {"peak": "peak(block.x)"})
for force in ("8 N", "10 N", "12 N"):
    print(cases.row({"pad.normal_force": force}).figures["peak"])

Owner of what a figure is (`figures.py`, `values_of.py`), what a row holds (`row.py`), and what a case is known by
(`identity.py`). Contract: `Cases.row(values)` never raises for what happens in a run; it writes no file.
"""

from fairlead.cases.cases import Cases
from fairlead.cases.row import Row

__all__ = ["Cases", "Row"]

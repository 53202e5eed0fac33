"""Cases in memory: (model, values, wanted figures) -> a row. See docs/studies.md.

from fairlead.cases import Cases

cases = Cases(fairlead.load("belt"), {"peak": "peak(block.x)"})
for force in ("8 N", "10 N", "12 N"):
    print(cases.row({"pad.normal_force": force}).figures["peak"])

The public name of `studies.cases`, at the top so that it stays where users import it from when rooms move. It imports
`studies` for that reason, and nothing in the package imports it.
"""

from fairlead.studies.cases.cases import Cases
from fairlead.studies.cases.row import Row

__all__ = ["Cases", "Row"]

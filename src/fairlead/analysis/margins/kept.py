"""What a run that has ended is judged by, kept with it: statics, and whether its lines ruck."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fairlead.flatten.flat_model import FlatModel
    from fairlead.results import Result


def compare_with_statics(flat: FlatModel, result: Result) -> None:
    """Put into run.json how far a line on a route is from its quasi-static tensions, and whether it rucks."""
    if not result.run.get("routes"):
        return
    from fairlead.analysis.margins.quasi_static import against_statics
    from fairlead.analysis.margins.ruck import verdicts
    from fairlead.results import run_file

    result.run["against_statics"] = against_statics(flat, result)
    result.run["ruck"] = verdicts(result)
    run_file.amend(result.folder, result.run)

"""fairlead: system models in which dry friction sticks and slips at many places at once.

import fairlead

model = fairlead.load("belt")
result = model.run()
result["block.x"]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fairlead.errors import FairleadError, ModelError, RunError, RunInterrupted, RunWarning, SteppingError, UsageError
from fairlead.model import Model
from fairlead.simulate import describe_type, json_schema, load, run

if TYPE_CHECKING:
    from fairlead.result import Result
    from fairlead.studies.modes.modes import modes
    from fairlead.studies.sensitivities.sensitivity import sensitivity

__all__ = ["FairleadError", "Model", "ModelError", "Result", "RunError", "RunInterrupted", "RunWarning",
           "SteppingError", "UsageError", "describe_type", "json_schema", "load", "modes", "run",
           "sensitivity"]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name == "Result":
        from fairlead.result import Result

        return Result
    if name == "modes":
        from fairlead.studies.modes.modes import modes

        return modes
    if name == "sensitivity":
        from fairlead.studies.sensitivities.sensitivity import sensitivity

        return sensitivity
    raise AttributeError(f"module 'fairlead' has no attribute {name!r}")

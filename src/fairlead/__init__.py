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


ELSEWHERE = {"sweep": "fairlead.cases.Cases", "Cases": "fairlead.cases.Cases", "fit": "the command fairlead fit",
             "statics": "model.statics()", "check": "model.check()", "start": "model.start()",
             "plot": "result.plot(...)", "report": "the command fairlead report", "open": "fairlead.Result.open(...)",
             "simulate": "fairlead.run(...)", "contract": "fairlead.testing.contract",
             "Component": "fairlead.component.Component", "describe": "fairlead.describe_type(...)"}  # fmt: skip
"""What others look for in the package, and where it is."""


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
    from fairlead.errors import did_you_mean

    meant = f"Did you mean {ELSEWHERE[name]}?" if name in ELSEWHERE else did_you_mean(name, __all__)
    raise AttributeError(f"module 'fairlead' has no attribute {name!r}. {meant}".rstrip())

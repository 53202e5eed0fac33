"""fairlead: system models in which dry friction sticks and slips at many places at once.

import fairlead

model = fairlead.load("belt")
result = model.run()
result["block.x"]
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # as type checkers read it; `typing` itself takes a hundredth of a second
if TYPE_CHECKING:
    from typing import Any

    from fairlead.errors import (
        FairleadError,
        ModelError,
        RunError,
        RunInterrupted,
        RunWarning,
        SteppingError,
        UsageError,
    )
    from fairlead.model import Model
    from fairlead.result import Result
    from fairlead.simulate import describe_type, json_schema, load, run
    from fairlead.studies.modes.modes import modes
    from fairlead.studies.sensitivities.sensitivity import sensitivity

__all__ = ["FairleadError", "Model", "ModelError", "Result", "RunError", "RunInterrupted", "RunWarning",
           "SteppingError", "UsageError", "describe_type", "json_schema", "load", "modes", "run",
           "sensitivity"]  # fmt: skip

HOMES = {"Model": "model", "Result": "result", "modes": "studies.modes.modes",
         "sensitivity": "studies.sensitivities.sensitivity",
         **dict.fromkeys(("describe_type", "json_schema", "load", "run"), "simulate")}  # fmt: skip
"""Modules of the names above; the others are in `errors`. Each is read in when one of its names is asked for: until the
command has begun, Ctrl-C would be answered by Python, with a traceback."""

MODULES = ("errors", "model", "simulate")
"""There without an import of their own, as in `fairlead.errors.RunWarning`."""
ELSEWHERE = {"sweep": "fairlead.cases.Cases", "Cases": "fairlead.cases.Cases", "fit": "the command fairlead fit",
             "statics": "model.statics()", "check": "model.check()", "start": "model.start()",
             "plot": "result.plot(...)", "report": "the command fairlead report", "open": "fairlead.Result.open(...)",
             "simulate": "fairlead.run(...)", "contract": "fairlead.testing.contract",
             "Component": "fairlead.component.Component", "describe": "fairlead.describe_type(...)"}  # fmt: skip
"""What others look for in the package, and where it is."""


def __getattr__(name: str) -> Any:
    if name in __all__ or name in MODULES:
        module = f"fairlead.{name if name in MODULES else HOMES.get(name, 'errors')}"
        __import__(module)
        globals()[name] = found = sys.modules[module] if name in MODULES else getattr(sys.modules[module], name)
        return found
    from fairlead.errors import did_you_mean

    meant = f"Did you mean {ELSEWHERE[name]}?" if name in ELSEWHERE else did_you_mean(name, __all__)
    raise AttributeError(f"module 'fairlead' has no attribute {name!r}. {meant}".rstrip())


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

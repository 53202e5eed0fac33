"""fairlead: system models in which dry friction sticks and slips at many places at once.

import fairlead

model = fairlead.load("belt")
result = model.run()
result["block.x"]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fairlead.simulate import Model, describe_type, json_schema, load

if TYPE_CHECKING:
    from fairlead.results import Result

__all__ = ["Model", "Result", "describe_type", "json_schema", "load"]


def __getattr__(name: str) -> Any:
    if name == "Result":
        from fairlead.results import Result

        return Result
    raise AttributeError(f"module 'fairlead' has no attribute {name!r}")

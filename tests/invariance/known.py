"""What depends on something that should not matter, with the reason. A scene leaves the list when it passes.

No entry is right: each is a decision of the engine that hangs on the last digit of a sum. Find it by
`python -m tests.invariance --first-difference "route 4"`.
"""

from __future__ import annotations

INSTANCES, NETLIST = "instances and unknowns in another order", "netlist in another order"

GRAZES = "a contact comes to rest with its load at its limit: whether it is held for a moment hangs on a last digit"

KNOWN: dict[str, dict[str, str]] = {
    INSTANCES: {"network 39": GRAZES, "guidance_route_electric": GRAZES},
    NETLIST: {"network 39": GRAZES},
}  # fmt: skip
"""The name of a change (see trials.py) -> the name of a scene -> why it differs."""

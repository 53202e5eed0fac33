"""What depends on something that should not matter, with the reason. A scene leaves the list when it passes.

No entry is right: each is a decision of the engine that hangs on the last digit of a sum. Find it by
`python -m tests.invariance --first-difference "route 4"`.
"""

from __future__ import annotations

INSTANCES, NETLIST = "instances and unknowns in another order", "netlist in another order"

GRAZES = "a contact comes to rest with its load at its limit: whether it is held for a moment hangs on a last digit"
TIED = (
    "two contacts in a circle bring a body to rest at once; the one whose slip ends first, by a last digit, is caught, "
    "and the other goes on at its sliding friction without moving (tried as held, networks do not settle)"
)

KNOWN: dict[str, dict[str, str]] = {
    INSTANCES: {"network 39": GRAZES, "network 18": TIED},
    NETLIST: {"network 39": GRAZES, "network 18": TIED},
}  # fmt: skip
"""The name of a change (see trials.py) -> the name of a scene -> why it differs."""

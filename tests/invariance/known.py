"""What still depends on something that should not matter, with the reason. A scene leaves the list when it passes.

Nothing here is right: each entry is a decision of the engine that hangs on the last digit of a sum. Find it by
`python -m tests.invariance --first-difference "route 4"`.
"""

from __future__ import annotations

LEAST_INDEX = (
    "stepping: contacts in a circle that no pattern of zones suits; the pass that takes the violator of least index "
    "ends in another pattern"
)
RESTART = "the step after a switch follows from y'', of which stiff laws leave few digits; halfway, they decide"
LINE = "a line of equal elements: in which step neighbours reach their limits; what decides has not been found"

INSTANCES, NETLIST = "instances and unknowns in another order", "netlist in another order"
BOTH = {
    "network 18": LEAST_INDEX, "route 4": RESTART, "route 6": LINE, "guidance_route_ideal": LINE, "slack_start": LINE,
}  # fmt: skip

KNOWN: dict[str, dict[str, str]] = {
    INSTANCES: {**BOTH, "weak_clamp": LINE, "route 14": LINE},
    NETLIST: {**BOTH, "capstan": LINE, "route 13": LINE},
}
"""The name of a change (see trials.py) -> the name of a scene -> why it differs."""

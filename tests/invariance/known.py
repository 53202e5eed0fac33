"""What still depends on something that should not matter, with the reason. A scene leaves the list when it passes.

Nothing here is right: each entry is a decision of the engine that hangs on the last digit of a sum.
"""

from __future__ import annotations

SWITCH_INSIDE = (
    "stepping: in which step a switch falls, and which steps are taken again, follows from the last digits; signals "
    "then agree to its error in time and not to a tenth of the accuracy"
)
BREAK_AWAY = "a contact that breaks away stops again at once where the sign of a slip of 1e-20 m/s is that of rounding"
RESTART = "three steps more after switches at one instant; which decision that is has not been found"

LINE = (
    "a line of equal elements: neighbours reach their limits within a rounding of each other; whether that is all "
    "has not been looked into"
)

INSTANCES, NETLIST = "instances and unknowns in another order", "netlist in another order"
STEPPING = {
    INSTANCES: (2, 7, 16, 18, 22, 30, 31, 39, 43, 45, 48, 51, 60),
    NETLIST: (2, 7, 13, 16, 18, 20, 22, 30, 31, 34, 39, 45, 48, 51),
}
LINES = {
    INSTANCES: (1, 4, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 19, 20, 21, 27, 29),
    NETLIST: (4, 6, 7, 8, 9, 13, 14, 15, 16, 17, 20, 27, 29),
}
BUNDLED = ("guidance_route", "guidance_route_electric", "guidance_route_ideal", "long_route")

KNOWN: dict[str, dict[str, str]] = {
    change: {
        **{f"network {seed}": SWITCH_INSIDE for seed in STEPPING[change]},
        **{f"route {seed}": LINE for seed in LINES[change]},
        **dict.fromkeys(BUNDLED, LINE),
        "network 4": BREAK_AWAY,
        "network 11": RESTART,
    }
    for change in (INSTANCES, NETLIST)
}
"""The name of a change (see trials.py) -> the name of a scene -> why it differs."""

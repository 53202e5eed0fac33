"""Lines on routes, started and stopped the hard way."""

from __future__ import annotations

import math

from tests.hard.play import Play, scene
from tests.hard.registry import case


@case(
    {"within 0.1 s": {"fall": 0.1}, "within 1 ms": {"fall": 1e-3}, "at once": {"fall": 1e-9}},
    treatments=("hold", "binding"),
    cost="fair",
    budget=120.0,
)
def emergency_stop_of_a_running_route(play: Play, fall: float) -> None:
    """An array hauled round a bend at 0.3 m/s is stopped within 0.1 s, 1 ms and at once.

    Oracle: before the stop the capstan's tension; after it the pull falls by no more than the water hammer of the line,
    v sqrt(EA m'), and its reflection; on the mean it lies between 800 N exp(-mu pi/2) and exp(+mu pi/2), nodes stand.
    """
    result = play.run(scene("emergency_stop"), fall=f"{fall!r} s")
    force = -result["haul.force"]
    running = force[(result.t > 1.0) & (result.t < 1.99)].mean()
    mu, hold = 0.35, 800.0
    most = hold * math.exp(mu * math.pi / 2)
    play.near("pull while it runs", running, most, 0.02 * most)
    hammer = 0.3 * math.sqrt(508e3 * 5.8)
    after = result.t > 2.0 + fall + 1e-6
    play.check(running - force[after].min() <= 2 * hammer, f"the pull falls by {running - force[after].min():.0f} N")
    late = result.t > 3.0
    pull = force[late].mean()
    low, high = hold / math.exp(mu * math.pi / 2), most
    play.check(
        0.97 * low <= pull <= 1.03 * high, f"stopped, it is pulled with {pull:.0f} N, beyond {low:.0f} to {high:.0f} N"
    )
    # Outside the bend the line rings on with hardly any damping, 0.15 m/s at 5 Hz and more; on the mean it stands.
    drift = max(abs(result[name][late].mean()) for name in result.match("line.hose_node[*].v"))
    play.check(drift < 1e-2, f"a node still moves at {drift:.2g} m/s on the mean")


@case(engines=("rodas", "stepping"), treatments=("hold",), cost="slow", budget=240.0)
def core_that_goes_slack(play: Play) -> None:
    """The bundled model slack_start: at the start the core of a line is pulled with less than it takes, and goes slack.

    Oracle: a core cannot push: its tension is never below zero.
    """
    result = play.run(scene("../slack_start"), run__stop="3 s")
    least = min(result[name].min() for name in result.match("line.core[*].tension"))
    play.check(least > -1e-3, f"a core pushes with {-least:.2g} N")
    slack = max(result[name].max() for name in result.match("line.core[*].slack"))
    play.check(slack > 0, "no core was slack")

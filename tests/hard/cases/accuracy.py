"""One scene at every accuracy."""

from __future__ import annotations

from tests.hard.play import Play, scene
from tests.hard.registry import case
from tests.reference.belt import StickSlipBelt

LADDER = {f"1e-{k}": {"accuracy": 10.0**-k} for k in range(2, 11)}


@case(LADDER, treatments=("hold",))
def stick_slip_at_accuracy(play: Play, accuracy: float) -> None:
    """Ten cycles of stick-slip on a belt at accuracies from 1e-2 to 1e-10.

    Oracle: closed form; the tenth break-away is late or early by no more than 3 accuracies of a period for each.
    """
    exact = StickSlipBelt()
    result = play.run(scene("belt_cycles"), run__accuracy=accuracy, run__stop=8.5)
    found = [event.t for event in result.events if event.zone_from == "held" and event.t > 0.1]
    play.check(len(found) == 10, f"{len(found)} break-aways, must be 10")
    play.near("tenth break-away", found[9], exact.breakaways(10)[9], 30 * accuracy * exact.period + 1e-9)

"""Oil that is stopped, and oil that drives stick-slip."""

from __future__ import annotations

import numpy as np

from tests.hard.play import Play, scene
from tests.hard.registry import NO_FRICTION, case
from tests.reference.belt import StickSlipBelt

BULK = 1e9  # Pa


@case(budget=60.0, treatments=("hold", "binding"))
def cylinder_that_sticks_and_slips(play: Play) -> None:
    """A cylinder fed with constant flow pushes 100 kg over a rough guide: the oil is the spring of a limit cycle.

    Oracle: the block on a spring of stiffness bulk modulus x area^2/volume, drawn at flow/area: period of the cycle in
    closed form to 1 % (the volume grows by 0.6 % on the way, the bores damp), and the same from cycle to cycle.
    """
    result = play.run(scene("cylinder_limit_cycle"))
    area = np.pi * 0.04**2 / 4
    volume = 1e-2 + area * 0.125  # in the middle of the way
    exact = StickSlipBelt(100.0, BULK * area**2 / volume, 0.01, 1000.0, 600.0)
    found = np.array(
        [e.t for e in result.events if e.component == "guide" and e.zone_to in ("forward", "break_forward")]
    )
    found = found[found > 0.1]
    play.check(len(found) >= 6, f"{len(found)} break-aways in 5 s, must be 6 or more")
    periods = np.diff(found)
    play.near("period", periods, exact.period, 0.01 * exact.period)
    play.near("period beside its mean", periods, periods.mean(), 0.01 * exact.period)


@case({"valve without lag": {"dynamics": "off"}, "valve of 60 Hz": {"dynamics": "on"}}, treatments=NO_FRICTION)
def valve_closed_in_one_sample(play: Play, dynamics: str) -> None:
    """A hydraulic motor runs when its valve is shut at 1 s: 1 kg m^2 are stopped by two trapped columns of oil.

    Oracle: swings with w = D sqrt(2 bulk/(V J)) for ever; the load's pressure reaches speed x J w/D. With the valve's
    own dynamics, which close within 10 ms of a swing of 226 ms, the same within 5 %.
    """
    result = play.run(scene("valve_shut"), effects__valve_dynamics=dynamics)
    displacement, inertia, volume = 125e-6 / (2 * np.pi), 1.025, 1e-3
    rate = displacement * np.sqrt(2 * BULK / (volume * inertia))
    running = result.at("drive.speed", 1.0, side="left")
    after = result.t > 1.05
    share = 1e-3 if dynamics == "off" else 0.05
    peak = np.abs(result["drive.load_pressure"][after]).max()
    want = running * inertia * rate / displacement
    play.near("peak of pressure", peak, want, max(share, 2e-3) * want)
    play.near("swing of the speed", np.abs(result["drive.speed"][after]).max(), running, max(share, 2e-3) * running)
    signs = np.flatnonzero(np.diff(np.sign(result["drive.speed"][after])))
    half = np.diff(result["drive.speed"][after][signs] * 0 + result.t[after][signs])
    play.near("half a swing", half.mean(), np.pi / rate, 0.01 * np.pi / rate)

"""One function for each tool: a case -> positions (times, bodies). Each raises Unable where it cannot state the case.

Each is given what it does best:

- scipy: `solve_ivp` with a terminal event per contact, restarted at each event and at each time where something is not
  smooth; DOP853, Radau where springs are stiff; rtol 1e-10.
- PathSim: one ODE block, the largest guard as an event; RKDP87 at 1e-10.
- MuJoCo: a slide joint per body, tendons as springs and contacts with `frictionloss`, as hard as the step allows;
  steps of 0.1 ms, loads read in the middle of each; the better of its integrators `implicitfast` and `RK4`.
- fairlead: the netlist of the hard case on `rodas`, exact hold.
"""

from __future__ import annotations

import tempfile
import textwrap
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np

from tests.hard.peers.cases import SOON, PeerCase
from tests.hard.peers.dry import Dry, Reals, Zones

RTOL, ATOL = 1e-10, 1e-12
CPU = 20.0
"""Seconds of CPU time that a tool may take for a case."""
STALLS = 1000
"""Events in one instant after which a tool has stopped getting on."""
STEP = 1e-4
"""Of MuJoCo [s]; its default is 2 ms."""
IMPEDANCE = 0.99999


class Unable(RuntimeError):
    """The tool has no means to state the case."""


def fairlead(case: PeerCase) -> Reals:
    """By its netlist."""
    from fairlead import load

    with tempfile.TemporaryDirectory(prefix="fairlead-peers-") as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        path = Path(folder) / "case.yaml"
        path.write_text("schema: 1\nname: case\n" + textwrap.dedent(case.netlist), encoding="utf-8")
        result = load(str(path)).run(out=None, engine="rodas")
        return np.array([np.asarray(result.at(name, case.times)) for name in case.signals]).T


def scipy(case: PeerCase) -> Reals:
    """`solve_ivp` with events."""
    from scipy.integrate import solve_ivp

    dry, stop, ends = case.dry, float(case.times[-1]), time.process_time() + CPU
    t, y, zones = _begun(dry)
    found, stalls = np.zeros((len(case.times), dry.bodies)), 0
    while t < stop:
        until = min([at for at in dry.breaks if at > t] + [stop])

        def rates(t: float, state: Reals, zones=zones) -> Reals:
            _in_time(ends, t)
            return dry.rates(t, state, zones)

        got = solve_ivp(rates, (t, until), y, "Radau" if case.stiff else "DOP853", rtol=RTOL, atol=ATOL,
                        events=[_event(dry, zones, k) for k in range(len(zones))], dense_output=True)  # fmt: skip
        if got.status < 0:
            raise RuntimeError(f"stopped at {got.t[-1]:.6g} s: {got.message}")
        now = float(got.t[-1])
        inside = (case.times >= t) & (case.times <= now)
        if inside.any():
            found[inside] = got.sol(case.times[inside])[: dry.bodies].T
        stalls = stalls + 1 if now - t < 1e-12 else 0
        if stalls > STALLS:
            raise RuntimeError(f"events without end at {now:.6g} s")
        values = dry.guards(now, got.y[:, -1], zones)
        fired = np.flatnonzero(values >= -1e-9) if got.status == 1 else None
        t, (y, zones) = now, dry.settled(now, got.y[:, -1], zones, fired)
    return found


def _event(dry: Dry, zones: Zones, k: int) -> Callable[[float, Reals], float]:
    """The guard of one contact, as `solve_ivp` takes it."""

    def guard(t: float, y: Reals) -> float:
        return float(dry.guards(t, y, zones)[k])

    guard.terminal, guard.direction = True, 1.0
    return guard


def pathsim(case: PeerCase) -> Reals:
    """One ODE block, one event."""
    from pathsim import Simulation
    from pathsim.blocks import ODE
    from pathsim.events import ZeroCrossingUp
    from pathsim.solvers import RKDP87

    dry, ends, close = case.dry, time.process_time() + CPU, 1e-9
    _, y, zones = _begun(dry)
    held, until = {"zones": zones}, 0.0

    def before(t: float) -> float:
        return min(t, until - 2 * SOON)  # the end of a piece shows nothing of a jump there, or its event has no end

    def rates(y: Reals, _u: Reals, t: float) -> Reals:
        _in_time(ends, t)
        return dry.rates(before(t), y, held["zones"])

    def largest(t: float) -> float:
        return float(dry.guards(before(t), block.engine.state, held["zones"]).max())

    def switch(t: float) -> None:
        values = dry.guards(t, block.engine.state, held["zones"])
        fired = np.flatnonzero(values >= min(-close, values.max() - close))
        block.engine.state, held["zones"] = dry.settled(t, block.engine.state, held["zones"], fired)

    block = ODE(rates, y)
    simulation = Simulation(
        [block], [], [ZeroCrossingUp(largest, switch, tolerance=close)], dt=1e-5, dt_min=1e-14, dt_max=1e-2, log=False,
        Solver=RKDP87, tolerance_lte_rel=RTOL, tolerance_lte_abs=ATOL,
    )  # fmt: skip
    found = np.zeros((len(case.times), dry.bodies))
    for k, at in enumerate(case.times):
        for until in [*[b for b in dry.breaks if simulation.time < b <= at], at]:
            if until - simulation.time > 1e-12:
                simulation.run(until - simulation.time, reset=False, adaptive=True)
            if until in dry.breaks:
                block.engine.state, held["zones"] = dry.settled(until, block.engine.state, held["zones"])
            elif largest(until) >= 0.0:
                switch(until)  # a guard that is zero at the end of a step does not cross it
        found[k] = block.engine.state[: dry.bodies]
    return found


def mujoco(case: PeerCase) -> Reals:
    """The better of two integrators."""
    dry = case.dry
    if any(not np.array_equal(dry.stiction(t), dry.sliding(t)) for t in case.times):
        raise Unable("a joint has one dry friction force: no stiction above sliding friction")
    return min((_stepped(case, integrator) for integrator in ("implicitfast", "RK4")), key=case.error)


def _stepped(case: PeerCase, integrator: str) -> Reals:
    """Fixed steps; a contact is a tendon with `frictionloss`, of speeds relative to the belt."""
    import mujoco as mj

    dry, n = case.dry, case.dry.bodies
    model = mj.MjModel.from_xml_string(_model(dry, integrator))
    data, ends = mj.MjData(model), time.process_time() + CPU
    belt, carried, now = dry.belt(0.0), 0.0, 0.0
    data.qvel[:] = dry.speed - belt
    found = np.zeros((len(case.times), n))
    for k, at in enumerate(case.times):
        steps = max(int(np.ceil((at - now) / STEP - 1e-6)), 0)
        for i in range(steps):
            h = (at - now) / steps
            t = now + (i + 0.5) * h
            model.opt.timestep = h
            data.qvel[:] += belt - dry.belt(t)
            belt = dry.belt(t)
            model.tendon_frictionloss[: len(dry.slip)] = dry.sliding(t)
            data.qfrc_applied[:] = dry.load(t)
            mj.mj_step(model, data)
            carried += belt * h
        now = float(at)
        _in_time(ends, now)
        found[k] = data.qpos + carried
    return found


def _model(dry: Dry, integrator: str) -> str:
    """The case as MuJoCo reads it."""
    bodies = "".join(
        f'<body pos="0 {i} 0"><joint name="j{i}"/><inertial pos="0 0 0" mass="{m!r}" diaginertia="1 1 1"/></body>'
        for i, m in enumerate(dry.mass.tolist())
    )

    def fixed(shares: dict[int, float], settings: str) -> str:
        joints = "".join(f'<joint joint="j{i}" coef="{share!r}"/>' for i, share in shares.items() if share)
        return f"<fixed {settings}>{joints}</fixed>"

    hard = f'solreffriction="{2 * STEP!r} 1" solimpfriction="{IMPEDANCE} {IMPEDANCE} 1e-6" frictionloss="1"'
    tendons = "".join(fixed(dict(enumerate(rows)), hard) for rows in dry.slip.tolist())
    tendons += "".join(
        fixed({i: 1.0, j: -1.0}, f'stiffness="{k!r}" damping="{d!r}" springlength="0"') for i, j, k, d in dry.springs
    )
    return f"""<mujoco><option timestep="{STEP!r}" integrator="{integrator}" gravity="0 0 0" solver="Newton"
        tolerance="1e-14" iterations="100"><flag contact="disable"/></option>
        <default><joint type="slide" axis="1 0 0"/></default>
        <worldbody>{bodies}</worldbody><tendon>{tendons}</tendon></mujoco>"""


def _begun(dry: Dry) -> tuple[float, Reals, Zones]:
    y = np.concatenate([np.zeros(dry.bodies), dry.speed])
    return 0.0, *dry.settled(0.0, y, np.zeros(len(dry.slip), np.int64))


def _in_time(ends: float, t: float) -> None:
    if time.process_time() > ends:
        raise TimeoutError(f"used up {CPU:g} s of CPU time, came to {t:.3g} s")


TOOLS: dict[str, Callable[[PeerCase], Reals]] = {
    "fairlead": fairlead, "scipy": scipy, "PathSim": pathsim, "MuJoCo": mujoco,
}  # fmt: skip

"""MuJoCo through the chain: a slide joint per block with dry friction (`frictionloss`), fixed tendons as springs.

What it approximates: the friction of a joint is a soft constraint. Its force stays within +-frictionloss, but a
joint that should hold gives way at a speed that falls with the impedance `solimp` and with the time constant
`solref`, here as hard as the step allows: 2 steps and 0.99999. No events are located; the cost of a step does
not depend on how many joints switch. Integrators: semi-implicit Euler and RK4 take springs and dampers
explicitly, so their step is bounded by both; `implicitfast` takes the dampers implicitly, its step is bounded by
the springs alone, but it is less exact. Steps run in C (`rollout`), the motion of the pulled end is an input
prepared beforehand.

The belt it cannot do: a joint has one friction force, stiction equals Coulomb friction.
"""

import numpy as np
from peer_cases import Belt, Chain
from peers import Case, Limit, Peer, Unable, sample_times

BELT = "a joint has one dry friction force: no stiction above Coulomb friction"
IMPEDANCE = 0.99999
INTEGRATORS = ("Euler", "implicitfast", "RK4")
PIECE = 1000  # steps between two looks at the clock; all their states are kept
TEXT = """
<mujoco>
  <option timestep="{step:.17g}" integrator="{integrator}" gravity="0 0 0" solver="Newton" tolerance="{tolerance:g}"
          iterations="100"><flag contact="disable"/></option>
  <size memory="256M"/>
  <default><joint type="slide" axis="1 0 0" frictionloss="0" solreffriction="{twice:.17g} 1"
                  solimpfriction="{impedance} {impedance} 1e-6"/></default>
  <worldbody>{bodies}</worldbody>
  <tendon>{tendons}</tendon>
  <actuator><general joint="j{last}" gainprm="1" biastype="affine" biasprm="0 {pull:.17g} {damp:.17g}"/></actuator>
</mujoco>
"""
BODY = (
    '<body pos="0 {i} 0"><joint name="j{i}" frictionloss="{limit:.17g}"/>'
    '<inertial pos="0 0 0" mass="{mass:.17g}" diaginertia="1 1 1"/></body>'
)
TENDON = (
    '<fixed stiffness="{stiffness:.17g}" damping="{damping:.17g}" springlength="0">'
    '<joint joint="j{i}" coef="-1"/><joint joint="j{j}" coef="1"/></fixed>'
)


def steps(case: Chain, integrator: str) -> list[float]:
    """Steps [s] to try: the longest stable one that divides the sampling interval, and halves of it."""
    damper = case.damping_time * case.spring
    springs, dampers = np.sqrt(case.mass / case.spring), 0.5 * case.mass / damper
    most = 0.7 * springs if integrator == "implicitfast" else min(0.7 * springs, 0.9 * dampers)
    interval = sample_times(case)[1]
    fewest = int(np.ceil(interval / most))
    return [interval / (fewest * 2**k) for k in range(6)]


def mujoco(case: Case, integrator: str, step: float, limit: float = 120.0) -> Peer:
    """One run at a fixed step, which must divide the sampling interval. Raises Unable for the belt."""
    import mujoco as mj
    from mujoco.rollout import rollout

    if isinstance(case, Belt):
        raise Unable(BELT)
    times = sample_times(case)
    every = round((times[1] - times[0]) / step)
    bound = Limit(limit)
    model = mj.MjModel.from_xml_string(text(case, integrator, step))
    data = mj.MjData(model)
    states = np.zeros((times.size, 2 * case.blocks))
    now = np.zeros(mj.mj_stateSize(model, mj.mjtState.mjSTATE_FULLPHYSICS))
    mj.mj_getState(model, data, now, mj.mjtState.mjSTATE_FULLPHYSICS)
    for k in range(times.size - 1):
        # The pulled end is read in the middle of each step, where a step of order one loses least.
        middle = times[k] + (np.arange(every) + 0.5) * step
        position, speed = case.pull(middle)
        drive = (case.pull_stiffness * position + case.pull_damping * speed)[:, None]
        for begin in range(0, every, PIECE):
            found, _ = rollout(model, data, now, drive[begin : begin + PIECE])
            now = found[0, -1]
            bound.check(times[k] + min(begin + PIECE, every) * step)
        states[k + 1, 0::2], states[k + 1, 1::2] = now[1 : 1 + case.blocks], now[1 + case.blocks : 1 + 2 * case.blocks]
    if not np.isfinite(states).all():
        raise RuntimeError("not stable at this step")
    return Peer(times, states, {"steps": every * (times.size - 1)})


def text(case: Chain, integrator: str, step: float) -> str:
    """The model as MuJoCo reads it."""
    blocks = range(case.blocks)
    return TEXT.format(
        integrator=integrator, step=step, twice=2.0 * step, impedance=IMPEDANCE, tolerance=1e-12, last=case.blocks - 1,
        pull=-case.pull_stiffness, damp=-case.pull_damping,
        bodies="".join(BODY.format(i=i, limit=case.limit[i], mass=case.mass) for i in blocks),
        tendons="".join(
            TENDON.format(i=i, j=i + 1, stiffness=case.spring, damping=case.damping_time * case.spring)
            for i in blocks[:-1]
        ),
    )  # fmt: skip

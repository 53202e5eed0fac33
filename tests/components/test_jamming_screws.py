"""A screw that locks itself jams while a load is let down that has more inertia than its shaft can follow."""

import math

import pytest

RADIUS, LEAD, WHEEL, HALF_ANGLE, MU, MOMENT = 0.015, 0.012, 0.06, 0.35, 0.15, 1.05  # SI, rad
SLOPE, RUBS = LEAD / (2 * math.pi * RADIUS), MU / math.cos(HALF_ANGLE)
LOWERS = (RUBS - SLOPE) / (1 + RUBS * SLOPE)  # torque over radius times load, to let it down
LIMIT = MOMENT / WHEEL**2 * RADIUS**2 * SLOPE * LOWERS  # moment at the worm that follows; docstring of LeadScrew
THREAD = f"radius: {RADIUS}, lead: {LEAD}, half_angle: {HALF_ANGLE}, curve: {MU}"
SCREWS = {
    "Worm": f"""
          screw: {{type: Worm, wheel_radius: {WHEEL}, {THREAD}}}
          load: {{type: Inertia, moment: {MOMENT}}}
          weight: {{type: TorqueSource, torque: -98}}
        connections: [[motor.shaft, rotor.shaft, screw.worm], [screw.wheel, load.shaft, weight.shaft]]
    """,
    "LeadScrew": f"""
          screw: {{type: LeadScrew, {THREAD}}}
          load: {{type: Mass, mass: {MOMENT / WHEEL**2}}}
          weight: {{type: ForceSource, force: {-98 / WHEEL}}}
        connections: [[motor.shaft, rotor.shaft, screw.screw], [screw.nut, load.flange, weight.flange]]
    """,
}


@pytest.mark.parametrize("kind", SCREWS)
@pytest.mark.parametrize(("share", "status"), [(0.95, "failed"), (1.05, "finished")])
def test_a_load_is_let_down_by_a_shaft_that_follows_it_and_jams_another(scene, kind, share, status):
    """rotor d(speed)/dt = torque - lowering torque, whose load falls with the acceleration it gives way to."""
    text = f"""
        components:
          motor: {{type: TorqueSource, torque: {{ramp: {{to: -1, over: 1 s}}}}}}
          rotor: {{type: Inertia, moment: {share * LIMIT}}}{SCREWS[kind].rstrip()}
        run: {{stop: 1 s}}
    """
    result = scene(text).run(out=None, check=False)
    assert result.status == status
    starts = 98 / WHEEL * RADIUS * LOWERS  # s: of a torque of 1 N*m in 1 s
    if status == "failed":
        assert result.t[-1] == pytest.approx(starts, rel=1e-3)
        assert "zones did not settle" in result.run["sentence"]
    else:
        assert result.at("rotor.speed", starts - 0.01) == pytest.approx(0, abs=1e-9)
        assert result["rotor.speed"][-1] < -1


def test_an_elastic_shaft_and_an_inertia_of_the_wheel_below_the_limit_cure_it(simulate):
    result = simulate(f"""
        components:
          motor: {{type: TorqueSource, torque: {{ramp: {{to: -1, over: 1 s}}}}}}
          rotor: {{type: Inertia, moment: {LIMIT / 10}}}
          screw: {{type: Worm, wheel_radius: {WHEEL}, {THREAD}}}
          wheel: {{type: Inertia, moment: {MOMENT / 20}}}
          shaft: {{type: TorsionSpring, stiffness: 5 kN*m/rad, damping: 5 N*m*s/rad}}
          load: {{type: Inertia, moment: {MOMENT}}}
          weight: {{type: TorqueSource, torque: -98}}
        connections:
          - [motor.shaft, rotor.shaft, screw.worm]
          - [screw.wheel, wheel.shaft, shaft.a]
          - [shaft.b, load.shaft, weight.shaft]
        run: {{stop: 1 s}}
    """)
    assert result["rotor.speed"][-1] < -1

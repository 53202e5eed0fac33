"""A screw that locks itself, while a load is let down that has more inertia than its shaft can follow.

Where the load is light, its weight presses the flanks all the way down. A heavy one does not come after the shaft: as
soon as the shaft turns, friction falls with the pressing force and the shaft turns faster, until the other flanks push
the load down. Screws with a stiff spring behind them say so, the more the stiffer it is. And where the shaft does not
turn fast enough to push, no motion of rigid parts exists: it jams.
"""

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


STARTS = 98 / WHEEL * RADIUS * LOWERS  # s: of a torque of 1 N*m in 1 s
PUSHES = RADIUS * (SLOPE + RUBS) / (1 - RUBS * SLOPE)  # torque over axial force, to push it down

RAMP = """
        components:
          motor: {{type: TorqueSource, torque: {{ramp: {{to: -1, over: 1 s}}}}}}
          rotor: {{type: Inertia, moment: {moment}}}{screw}
        run: {{stop: 1 s}}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("kind", SCREWS)
@pytest.mark.parametrize("share", [0.5, 0.95])
def test_a_heavy_load_is_pushed_down_as_soon_as_the_shaft_turns(simulate, kind, share, engine):
    """moment d(speed)/dt = torque - what pushes the mass, less its weight, through the friction of the flanks."""
    text = RAMP.format(moment=share * LIMIT, screw=SCREWS[kind].rstrip())
    result = simulate(text, **{"run.engine": engine})
    assert result.at("rotor.speed", STARTS - 0.01) == pytest.approx(0, abs=1e-9)
    lead, mass, weight = LEAD / (2 * math.pi), MOMENT / WHEEL**2, 98 / WHEEL
    pushed = ((1 - STARTS**2) / 2 + PUSHES * weight * (1 - STARTS)) / (share * LIMIT + PUSHES * mass * lead)
    assert result["rotor.speed"][-1] == pytest.approx(-pushed, rel=2e-3)


@pytest.mark.parametrize("kind", SCREWS)
def test_a_light_load_follows_the_shaft(simulate, kind):
    result = simulate(RAMP.format(moment=1.05 * LIMIT, screw=SCREWS[kind].rstrip()))
    assert result.at("rotor.speed", STARTS - 0.01) == pytest.approx(0, abs=1e-9)
    assert result["rotor.speed"][-1] < -1


@pytest.mark.parametrize("share", [0.5, 0.95, 1.05])
def test_it_is_the_limit_of_screws_with_ever_stiffer_springs_behind_them(simulate, share):
    rigid = simulate(RAMP.format(moment=share * LIMIT, screw=SCREWS["Worm"].rstrip()))["rotor.speed"][-1]
    gaps = []
    for stiffness, damping in ((5e4, 50), (5e5, 50), (5e6, 500)):
        result = simulate(f"""
            components:
              motor: {{type: TorqueSource, torque: {{ramp: {{to: -1, over: 1 s}}}}}}
              rotor: {{type: Inertia, moment: {share * LIMIT}}}
              screw: {{type: Worm, wheel_radius: {WHEEL}, {THREAD}}}
              wheel: {{type: Inertia, moment: {MOMENT / 1e4}}}
              shaft: {{type: TorsionSpring, stiffness: {stiffness} N*m/rad, damping: {damping} N*m*s/rad}}
              load: {{type: Inertia, moment: {MOMENT}}}
              weight: {{type: TorqueSource, torque: -98}}
            connections:
              - [motor.shaft, rotor.shaft, screw.worm]
              - [screw.wheel, wheel.shaft, shaft.a]
              - [shaft.b, load.shaft, weight.shaft]
            run: {{stop: 1 s}}
        """)
        gaps.append(abs(result["rotor.speed"][-1] / rigid - 1))
    assert gaps[0] > gaps[1] > gaps[2]
    assert gaps[-1] < 0.03


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

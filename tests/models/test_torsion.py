"""Torsion of a line with the same friction as along it (physics 5.8 and 8 item 30)."""

import math
from importlib.resources import files

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError
from tests.reference.rod_anchor import FrictionAnchor

COUPLE, GRIP = 10.0, 0.35 * 500 * 0.0425  # N m; N m per m held by friction
ANCHOR = FrictionAnchor(stiffness=150.0, grip=GRIP)  # the same closed form, in torque and angle


@pytest.mark.parametrize("planar", ["off", "on"])
def test_30_the_end_of_an_anchored_line_turns_by_the_square_of_the_couple(bundled, planar):
    result = bundled("torsion", {"effects.planar_slip": planar})
    assert result["line.twist[80].angle"].max() == pytest.approx(ANCHOR.end_travel(COUPLE), rel=0.01)


def test_half_of_the_twist_stays_when_the_couple_is_taken_off(bundled):
    twist = bundled("torsion")["line.twist[80].angle"]
    assert twist[-1] / twist.max() == pytest.approx(0.5, abs=0.02)  # half an element of 27, and creep


def test_torque_falls_along_a_straight_line_and_reaches_as_far_as_the_closed_form_says(bundled):
    result = bundled("torsion")
    k = int(np.searchsorted(result.t, 4.0))
    torque = np.array([result[f"line.torsion[{i}].torque"][k] for i in range(80)])[::-1]
    middle = (np.arange(80) + 0.5) * 0.05
    np.testing.assert_allclose(torque, ANCHOR.tension(COUPLE, middle), atol=0.05 * GRIP)
    assert 0.05 * np.sum(torque > 0.2) == pytest.approx(ANCHOR.slipped_length(COUPLE), abs=0.1)


def test_energy_closes_in_turning_too(bundled):
    assert bundled("torsion").run["energy"]["closure"] < 1e-6


@pytest.mark.slow
def test_a_cycle_of_the_couple_turns_what_masing_says_into_heat(tmp_path):
    """From one peak of T_0 to the next the couple does the work (2/3) T_0^3/(GJ q); contacts that creep add 3 %."""
    text = (files("fairlead.models") / "torsion.yaml").read_text(encoding="utf-8")
    once = '{t: [0 s, 4 s, 8 s], y: [0 N, "{couple} N", 0 N]}'
    assert once in text
    scene = tmp_path / "cycle.yaml"
    scene.write_text(text.replace(once, "{t: [0 s, 4 s, 12 s, 20 s], y: [0 N, 10 N, -10 N, 10 N]}"), encoding="utf-8")
    result = fairlead.load(scene, set={"run.stop": "20 s", "friction.method": "hold"}).run(out=tmp_path / "run")
    assert result.status == "finished"
    cycle = result.t >= 4.0
    work = np.trapezoid(result["hand.force"][cycle], result["line.twist[80].angle"][cycle])
    assert work == pytest.approx(ANCHOR.loop_energy(COUPLE), rel=0.01)  # inertia of the line at this pace: 0.4 %


ROUTE = """
components:
  line: {type: Cable, length: 20 m, element: 0.25 m, start: -2 m, mass: 5.8 kg/m, stiffness: 500 kN, diameter: 85 mm,
         tension: 500 N, torsion: {stiffness: 150 N*m^2, inertia: 6e-3 kg*m, coupling: COUPLING}}
  route:
    type: Route
    stations:
      - {type: Winch, radius: 0.65 m, lay: 0.02 rad/m}
      - {type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.35}
      - {type: Bend, start: 5 m, angle: 90 deg, radius: 1 m, friction: 0.35}
  drive: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
  tow: {type: ForceSource, force: 500 N}
connections:
  - [line.path, route.path]
  - [drive.flange, route.winch.rim]
  - [tow.flange, line.outboard]
effects: {planar_slip: PLANAR}
run: {stop: 20 s}
record: {every: 50 ms}
"""


def wound(simulate, planar, coupling="0 m"):
    return simulate(ROUTE.replace("PLANAR", planar).replace("COUPLING", coupling))


def torque_at(result, place):
    """Torque of the line [N m] at a place of the route at the end."""
    nodes = np.array([result[name][-1] for name in result.match("line.node[*].x")])
    torque = np.array([result[name][-1] for name in result.match("line.torsion[*].torque")])
    return np.interp(place, (nodes[1:] + nodes[:-1]) / 2, torque)


@pytest.mark.slow
def test_with_one_friction_for_both_twist_of_the_drum_leaves_a_line_that_moves(simulate):
    """The turning slip is small beside the sliding at 0.3 m/s, so friction hardly resists: mu N r^2/v per node."""
    drag = 0.35 * 500 * math.exp(0.35 * math.pi) * math.pi * 0.0425**2 / 0.3  # N m s, both bends, from above
    assert abs(torque_at(wound(simulate, "on"), 1.0)) < drag * 0.02 * 0.3 * 1.5


def test_with_a_friction_of_its_own_twist_is_held_back_in_the_bends_and_accumulates(simulate):
    """The drum has wound 5.85 m; between it and bend A the line is turned as if the bend were a clamp."""
    held = torque_at(wound(simulate, "off"), 1.0)
    free = torque_at(wound(simulate, "on"), 1.0)
    assert held > 30 * abs(free)
    assert held > 1.0


@pytest.mark.slow
def test_a_rope_that_wants_to_unlay_turns_a_free_end(simulate):
    """Torque k T turns the line outboard of the bends until the spring balances it: nothing is left in the end."""
    result = wound(simulate, "on", coupling="1 mm")
    assert abs(torque_at(result, 10.0)) < 0.05  # of 0.5 N m: the end is a free swivel, and still swings a little
    swing = np.linspace(17.0, 20.0, 301)
    ends = [result.at(name, swing).mean() for name in ("line.twist[80].angle", "line.twist[60].angle")]
    twist = (ends[0] - ends[1]) / 5.0  # per metre
    assert twist == pytest.approx(-1e-3 * 500 / 150, rel=0.05)


def test_on_the_whole_route_twist_goes_through_a_bend_to_the_belts_and_a_rope_unlays_outboard(bundled):
    """Sliding leaves a bend little to hold a turning line; belts do not slide, and do hold it. Outboard is free."""
    route = bundled("guidance_route_torsion")
    before, behind, outboard = (torque_at(route, place) for place in (1.0, 4.5, 12.0))
    assert before == pytest.approx(behind, rel=0.02)
    assert before > 20 * abs(outboard)
    swing = np.linspace(12.0, 15.0, 301)
    last = len(route.match("line.twist[*].angle")) - 1
    ends = [route.at(f"line.twist[{k}].angle", swing).mean() for k in (last, last - 19)]
    assert (ends[0] - ends[1]) / (19 * 0.25) == pytest.approx(-1e-3 * 300 / 150, rel=0.02)


@pytest.mark.slow
def test_on_the_whole_route_a_bend_with_a_friction_of_its_own_for_turning_holds_what_the_drum_winds_in(bundled):
    route = bundled("guidance_route_torsion", {"effects.planar_slip": "off"})
    assert torque_at(route, 1.0) > 20 * abs(torque_at(route, 4.5))


def test_a_nap_is_refused_where_a_line_slips_in_two_directions_at_once(scene):
    text = ROUTE.replace("friction: 0.35", "friction: {coulomb: 0.4, backward: [[0, 0.3], [1, 0.3]]}")
    with pytest.raises(ModelError, match="backward points are given, and a line that turns slips in two directions"):
        scene(text.replace("PLANAR", "on").replace("COUPLING", "0 m")).check()
    scene(text.replace("PLANAR", "off").replace("COUPLING", "0 m")).check()

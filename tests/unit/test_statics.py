"""Statics of a line on its route, against closed forms worked out here by hand (physics sections 4, 7b and 8)."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.analysis.remarks.statics_record import record
from fairlead.analysis.statics.shares import shares
from fairlead.cli import app
from fairlead.errors import UsageError

ROPE = "{type: Cable, mass: 1 kg/m, stiffness: 200 kN, length: 30 m, element: 0.25 m, start: 0 m, tension: 100 N%s}"
HAND, LOAD = "{type: MotionSource, velocity: %s}", "{type: ForceSource, force: 100 N}"


def scene_of(*stations, speed="-0.2 m/s", rope=", weight: 20 N/m", more=""):
    listed = "\n".join(f"      - {station}" for station in stations)
    return f"""
components:
  rope: {ROPE % rope}
  route:
    type: Route
    stations:
{listed}
  haul: {HAND % speed}
  load: {LOAD}
connections:
  - [rope.path, route.path]
  - [haul.flange, rope.inboard]
  - [load.flange, rope.outboard]
run: {{stop: 4 s}}
{more}"""


def one(model, speed=None):
    (found,) = model.statics(speed)
    return found


def passage(state, name):
    (found,) = [each for each in state.passages if each.name == name]
    return found


def share_of(state, name):
    return next(share for share, each in zip(shares(state).shares, state.passages, strict=True) if each.name == name)


@pytest.mark.slow
@pytest.mark.parametrize("mu", [0.0, 0.2, 0.35, 0.6])
def test_the_guidance_route_is_a_product_of_capstans_both_ways(mu):
    found = one(fairlead.load("guidance_route_ideal", set={"mu": str(mu)}))
    assert [state.speed for state in found.moving] == [0.5, -0.5]
    for state in found.moving:
        way = math.copysign(1, state.speed)
        length = 12 + 12.25 - 10  # m: the line ends at 12 m; belts run 0.25 m in the first second, 0.5 m/s for 24 s
        sea = 150 + length * 0.5 * 1025 * 0.003 * math.pi * 0.085 * (4 - state.speed) ** 2
        before, after = 200 * math.exp(way * mu * math.pi / 2), sea * math.exp(-way * mu * math.pi / 3)
        places = [state.tension(place) for place in (1.0, 4.2, 7.2, 9.7)]
        np.testing.assert_allclose(places, [200, before, after, sea], rtol=1e-9)
        (deployer,) = [drive for drive in state.drives if drive.name == "deployer"]
        assert deployer.force == pytest.approx(before - after)
        assert deployer.capacity == pytest.approx(2 * 0.6 * 1500 * 1.5)
        assert deployer.power == pytest.approx((before - after) * state.speed)


def test_side_wall_load_is_the_tension_over_the_radius_where_it_is_greatest(scene):
    found = one(scene(scene_of("{type: Bend, start: 3 m, angle: 90 deg, radius: 2 m, friction: 0.3}")))
    (state,) = found.moving
    assert passage(state, "bend").side_wall == pytest.approx(100 * math.exp(0.3 * math.pi / 2) / 2)


def test_a_guide_and_a_slope_add_the_friction_of_the_weight_and_its_fall(scene):
    found = one(scene(scene_of("{type: Guide, start: 3 m, length: 4 m, friction: 0.3, slope: 10 deg}")))
    (state,) = found.moving
    slope, weight = math.radians(10), 20 * 4
    want = 100 + 0.3 * weight * math.cos(slope) + weight * math.sin(slope)  # hauled up against friction and weight
    assert passage(state, "guide").inboard == pytest.approx(want)


def test_a_curved_tube_that_the_line_lies_in_solves_the_linear_equation(scene):
    tube = "{type: Tube, start: 3 m, length: 2 m, radius: 4 m, friction: 0.3, squeezes: 5 N/m}"
    (state,) = one(scene(scene_of(tube))).moving
    theta, pressed = 2 / 4, (20 + 5) * 4  # dT/dtheta = mu (T + pressed R)
    want = (100 + pressed) * math.exp(0.3 * theta) - pressed
    assert passage(state, "tube").inboard == pytest.approx(want)


def test_compression_in_a_tube_grows_along_its_outer_wall(scene):
    text = scene_of("{type: Tube, start: 3 m, length: 2 m, radius: 1 m, friction: 0.3}", speed="0.2 m/s", rope="")
    text = text.replace("force: 100 N", "force: -100 N").replace("tension: 100 N", "compression: carried")
    (state,) = one(scene(text)).moving
    assert passage(state, "tube").inboard == pytest.approx(-100 * math.exp(0.3 * 2))


def test_a_line_that_runs_fast_presses_less_by_its_mass_times_speed_squared(scene):
    """What is kept of the tension, T - m v^2, grows by exp(mu theta)."""
    bend, fast = "{type: Bend, start: 3 m, angle: 90 deg, radius: 2 m, friction: 0.3}", "effects: {centrifugal: on}"
    (state,) = one(scene(scene_of(bend, speed="-4 m/s", more=fast))).moving
    want = 16 + (100 - 16) * math.exp(0.3 * math.pi / 2)
    assert passage(state, "bend").inboard == pytest.approx(want)
    assert passage(state, "bend").side_wall == pytest.approx((want - 16) / 2)


def test_without_friction_on_the_devices_they_change_nothing(scene):
    bend = "{type: Bend, start: 3 m, angle: 90 deg, radius: 2 m, friction: 0.3}"
    (state,) = one(scene(scene_of(bend, more="effects: {device_friction: off}"))).moving
    assert passage(state, "bend").inboard == pytest.approx(100)


def test_a_free_wheel_takes_what_its_bearing_takes(scene):
    bearing = "{friction: 0.1, radius: 0.05 m}"
    wheel = f"{{type: Pulley, start: 3 m, angle: 90 deg, radius: 0.5 m, friction: 0.5, bearing: {bearing}}}"
    (state,) = one(scene(scene_of(wheel))).moving
    tight = passage(state, "pulley").inboard
    load = (tight + 100) / 2 * 2 * math.sin(math.pi / 4)
    assert (tight - 100) * 0.5 == pytest.approx(0.1 * 0.05 * load)


def test_without_friction_of_its_bearing_a_free_wheel_takes_nothing(scene):
    wheel = "{type: Pulley, start: 3 m, angle: 90 deg, radius: 0.5 m, friction: 0.5}"
    (state,) = one(scene(scene_of(wheel))).moving
    assert passage(state, "pulley").inboard == pytest.approx(100)


def test_the_friction_of_a_curve_is_that_of_the_speed_and_at_rest_that_from_rest(scene):
    curve = "{curve: stribeck, stiction: 0.5, coulomb: 0.2, velocity: 0.1 m/s}"
    found = one(scene(scene_of(f"{{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: {curve}}}")))
    mu = 0.2 + 0.3 * math.exp(-4)
    assert passage(found.moving[0], "bend").inboard == pytest.approx(100 * math.exp(mu))
    (bend,) = [each for each in found.standing.passages if each.name == "bend"]
    assert bend.inboard == pytest.approx((100 * math.exp(-0.5), 100 * math.exp(0.5)))


def test_the_cones_of_two_bends_multiply_and_a_clamp_adds_what_it_carries():
    found = one(fairlead.load("guidance_route_ideal", set={"mu": "0.6", "clamp": "20 N/m"}))
    (bend,) = [each for each in found.standing.passages if each.name == "bend_a"]
    (deployer,) = [each for each in found.standing.passages if each.name == "deployer"]
    low, high = 200 * math.exp(-0.3 * math.pi), 200 * math.exp(0.3 * math.pi)
    sea = 150 + 14.5 * 0.5 * 1025 * 0.003 * math.pi * 0.085 * 16
    outer = sea * math.exp(-0.2 * math.pi), sea * math.exp(0.2 * math.pi)
    clamp = 2 * 0.6 * 20 * 1.5
    assert deployer.inboard == pytest.approx((max(low, outer[0] - clamp), min(high, outer[1] + clamp)))
    assert bend.inboard == pytest.approx((200, 200))


def test_a_pull_beyond_the_cone_says_how_much_is_missing(scene):
    text = scene_of("{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}", rope="")
    text = text.replace(HAND % "-0.2 m/s", "{type: ForceSource, force: -150 N}")
    found = one(scene(text))
    assert not found.moving
    assert not found.standing.holds
    assert found.standing.missing == pytest.approx(150 - 100 * math.exp(0.3))


def test_drag_that_is_lumped_and_drag_along_the_line_pull_alike(scene):
    def tension(form, length="30 m"):
        sea = f"{{type: Sea, start: 20 m, speed: 4 m/s, tail: 50 N, drogue: 0.01 m^2{form}}}"
        text = scene_of(sea).replace("  - [load.flange, rope.outboard]\n", "").replace(f"  load: {LOAD}\n", "")
        text = text.replace("length: 30 m", f"length: {length}")
        (state,) = one(scene(text), 0.5).moving[:1]
        return state.tension(10.0)

    flow, line = 4 - 0.5, 10.0
    want = 50 + (0.5 * 1025 * 0.003 * math.pi * 0.02 * line + 0.5 * 1025 * 0.01) * flow**2
    assert tension("") == pytest.approx(want)
    assert tension(", form: lumped") == pytest.approx(want)
    assert tension(", form: lumped, beyond: 10 m", "20 m") == pytest.approx(want)
    assert tension(", form: lumped, beyond: 7 m", "23 m") == pytest.approx(want)
    assert tension(", form: lumped, beyond: 10 m", "15 m") == pytest.approx(want)  # it hangs down to the water
    bare = want - 0.5 * 1025 * 0.003 * math.pi * 0.02 * line * flow**2
    assert tension(", form: lumped", "15 m") == pytest.approx(bare)  # there is no line in the water
    assert tension(", form: rigid") == pytest.approx(want)


def test_a_drum_with_layers_tells_its_torque_at_the_layer_the_line_leaves(scene):
    drum = "{type: Winch, radius: 0.5 m, layers: on, width: 0.5 m, line_diameter: 0.1 m, moment: 10 kg*m^2}"
    text = scene_of(drum, "{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}", rope="")
    text = text.replace("start: 0 m", "start: -20 m")
    text = text.replace(HAND % "-0.2 m/s", "{type: TorqueSource, torque: -60 N*m}")
    text = text.replace("[haul.flange, rope.inboard]", "[haul.shaft, route.winch.shaft]")
    (state, _) = one(scene(text), 0.2).moving
    radius = 0.55 + 0.1 * math.sqrt(3) / 2  # 17.3 m lie in the first layer of 5 wraps, the rest in the second
    assert passage(state, "bend").inboard == pytest.approx(60 / radius)
    (winch,) = [drive for drive in state.drives if drive.name == "winch"]
    assert winch.force * winch.lever == pytest.approx(-60)


def test_between_two_drives_the_tension_is_told_to_be_open(scene):
    belts = "{type: Deployer, start: 6 m, length: 2 m, friction: 0.5, clamp: 500 N/m}"
    text = scene_of("{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}", belts, rope="")
    text = text.replace("  load:", "  belt: {type: MotionSource, velocity: -0.2 m/s}\n  load:")
    text = text.replace("connections:\n", "connections:\n  - [belt.flange, route.deployer.belt]\n")
    (state,) = one(scene(text)).moving
    assert "two drives hold the line, at its inboard end and at deployer" in state.remarks[0]
    assert passage(state, "bend").inboard == pytest.approx(100)
    assert passage(state, "deployer").outboard == pytest.approx(100)


def test_a_tensioner_between_two_drives_sets_the_tension_there(scene):
    """The loop of a dancer takes two parts of line, so each has half the force; the bend adds its capstan."""
    bend = "{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}"
    loop = "{type: Tensioner, start: 8 m, force: 300 N}"
    belts = "{type: Deployer, start: 10 m, length: 2 m, friction: 0.5, clamp: 500 N/m}"
    text = scene_of(bend, loop, belts, rope="")
    text = text.replace("  load:", "  belt: {type: MotionSource, velocity: -0.2 m/s}\n  load:")
    text = text.replace("connections:\n", "connections:\n  - [belt.flange, route.deployer.belt]\n")
    (state,) = one(scene(text)).moving
    assert state.remarks == ()
    assert passage(state, "bend").outboard == pytest.approx(150)
    assert passage(state, "bend").inboard == pytest.approx(150 * math.exp(0.3))
    assert passage(state, "deployer").inboard == pytest.approx(150)


def at_rest_with_a_tensioner(loop, clamp):
    """A hand, a bend, a tensioner and belts that hold; 100 N pull outboard."""
    bend = "{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}"
    belts = f"{{type: Deployer, start: 10 m, length: 2 m, friction: 0.5, clamp: {clamp}}}"
    text = scene_of(bend, f"{{type: Tensioner, start: 8 m, {loop}}}", belts, rope="")
    text = text.replace("  load:", "  belt: {type: MotionSource, velocity: -0.2 m/s}\n  load:")
    return text.replace("connections:\n", "connections:\n  - [belt.flange, route.deployer.belt]\n")


@pytest.mark.parametrize(
    ("loop", "clamp", "least", "most", "where"),
    [
        ("force: 300 N", "500 N/m", 150, 150, "between its stops, at 150 N"),
        ("force: 300 N, stiffness: 100 N/m, stroke: 2 m", "500 N/m", 50, 150, "between its stops, at 50 ... 150 N"),
        ("force: 300 N, stiffness: 400 N/m", "500 N/m", 0, 150, "between its stops, at 0 ... 150 N"),
        ("force: 300 N, stiffness: 100 N/m, stroke: 2 m", "10 N/m", 80, 120, "between its stops"),
        ("force: 100 N", "10 N/m", 80, 120, "at its inner stop"),
        ("force: 500 N, stiffness: 100 N/m", "10 N/m", 80, 120, "at its outer stop"),
    ],
)
def test_a_line_that_stands_has_the_tensions_that_the_carriage_of_a_tensioner_can_be_at(
    scene, loop, clamp, least, most, where
):
    """T = (force - stiffness y)/2 between the stops; belts of 2 m hold 2 mu q length more or less than 100 N."""
    found = one(scene(at_rest_with_a_tensioner(loop, clamp)))
    (note,) = found.notes
    assert where in note
    bend = passage(found.standing, "bend")
    assert bend.outboard == pytest.approx((max(least, 0), most))
    assert bend.inboard == pytest.approx((least * math.exp(-0.3), most * math.exp(0.3)))
    assert passage(found.standing, "deployer").inboard == pytest.approx((least, most))


def test_a_tensioner_before_a_known_end_leaves_what_friction_can_hold(scene):
    """Nothing holds outboard of it: 100 N pull there, and its carriage is at a stop if it has to be."""
    bend = "{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}"
    found = one(scene(scene_of(bend, "{type: Tensioner, start: 8 m, force: 300 N}", rope="")))
    assert passage(found.standing, "bend").outboard == pytest.approx((100, 100))
    assert not found.notes


def test_a_start_in_which_a_rope_would_have_to_push_is_told(scene):
    """Pushed in at its outboard end, it would have to speed up itself and a drum of 40 kg that pulls with 10 N."""
    drum = "{type: Winch, radius: 0.5 m, moment: 10 kg*m^2}"
    text = scene_of(drum, speed="{ramp: {to: -1 m/s, over: 1 s}}", rope="").replace("start: 0 m", "start: -20 m")
    text = text.replace("haul.flange, rope.inboard", "haul.flange, rope.outboard")
    text = text.replace("load.flange, rope.outboard", "load.flange, route.winch.rim")
    text = text.replace("force: 100", "force: -10")
    missing = 40 * 1 + 30 * 1 - 10
    told = " ".join(record(one(scene(text)))["remarks"])
    assert f"the line goes slack at 10 m, {missing:.4g} N are missing there" in told


def test_a_line_that_lies_on_the_drum_altogether_has_nothing_to_solve(scene):
    bend = "{type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}"
    text = scene_of("{type: Winch, radius: 0.5 m}", bend).replace("start: 0 m", "start: -40 m")
    text = text.replace("haul.flange, rope.inboard", "haul.flange, route.winch.rim")
    found = one(scene(text))
    assert all(not state.passages for state in found.moving)
    assert record(found)["remarks"] == []


@pytest.mark.slow
def test_a_drive_under_control_is_found_through_valve_gear_and_signals(tmp_path):
    """The deployer follows the reference of its controller, the winch keeps its tension by torque."""
    parts = "parts/array_route.yaml, parts/electrohydraulic_drives.yaml"
    text = f"schema: 1\nname: eh\ninclude: [{parts}]\nrun: {{stop: 50 s}}\n"
    (tmp_path / "parts").mkdir()
    folder = fairlead.load("guidance_route_ideal").netlist.path.parent / "parts"
    for part in folder.glob("*.yaml"):
        (tmp_path / "parts" / part.name).write_text(part.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "eh.yaml").write_text(text, encoding="utf-8")
    found, ideal = one(fairlead.load(tmp_path / "eh.yaml")), one(fairlead.load("guidance_route_ideal"))
    for mine, theirs in zip(found.moving, ideal.moving, strict=True):
        assert (mine.speed, mine.way) == (pytest.approx(theirs.speed), pytest.approx(theirs.way))
        assert [each.inboard for each in mine.passages] == pytest.approx([each.inboard for each in theirs.passages])


def test_to_speed_up_the_line_takes_its_mass_times_the_acceleration(scene):
    text = scene_of("{type: Straight, length: 3 m}", speed="{ramp: {to: -0.3 m/s, over: 2 s}}", rope="")
    (start,) = one(scene(text)).starts
    (hand, _) = start.drives
    assert hand.force == pytest.approx(-(100 + 30 * 0.15))


def test_a_free_wheel_takes_what_its_inertia_takes_while_the_speed_changes(scene):
    wheel = "{type: Pulley, start: 3 m, angle: 90 deg, radius: 0.5 m, friction: 0.5, moment: 4 kg*m^2}"
    (start,) = one(scene(scene_of(wheel, speed="{ramp: {to: -0.3 m/s, over: 2 s}}", rope=""))).starts
    assert start.drives[0].force == pytest.approx(-(100 + 30 * 0.15 + 4 / 0.5**2 * 0.15))


def test_the_torque_of_a_winch_speeds_up_its_drum_and_what_lies_on_it(scene):
    drum = "{type: Winch, radius: 0.5 m, moment: 10 kg*m^2}"
    text = scene_of(drum, speed="{ramp: {to: -0.3 m/s, over: 2 s}}", rope="").replace("start: 0 m", "start: -20 m")
    (start,) = one(scene(text.replace("haul.flange, rope.inboard", "haul.flange, route.winch.rim"))).starts
    winch = start.drives[0]
    assert winch.force == pytest.approx(-(100 + 10 * 0.15))
    assert winch.torque == pytest.approx(-(100 + 30 * 0.15) * 0.5 - 10 * 0.15 / 0.5)


def test_hose_and_core_share_a_slipping_bend_as_the_closed_form_says():
    """Physics 7a: T_hose behind the bend from equal lengths of hose and core between the connectors."""
    settings = {"mu": "0.6", "line.bulkhead_friction": "0.5"}
    (state,) = one(fairlead.load("single_bend", set=settings)).moving
    layers = shares(state)
    hose, core, theta = 8e3, 5e5, math.pi / 2
    inner, outer = 4.5 - (1.5 - 0.15) - 1.5, 16.5 - 0.15 - (3 + theta)  # m: straight on both sides of the bend
    along = np.linspace(0, theta, 20001)

    def excess(low):  # of the length of the hose over that of the core, for a core tension 800 - low outboard
        core_tension, total = (800 - low) * np.exp(0.5 * along), 800 * np.exp(0.6 * along)
        strain = (total - core_tension) / hose - core_tension / core
        return strain[0] * outer + strain[-1] * inner + np.trapezoid(strain, along)

    low = -100.0
    for _ in range(3):  # linear in what is sought
        low -= excess(low) / (excess(low + 1) - excess(low))
    behind = 800 * math.exp(0.6 * theta) - (800 - low) * math.exp(0.5 * theta)
    bend = share_of(state, "bend")
    assert bend.slips
    assert layers.lowest == pytest.approx(low, rel=2e-3)  # the trapezoids of 33 points
    assert bend.hose[0] == pytest.approx(behind, rel=2e-3)


def test_below_the_threshold_of_slip_hose_and_core_share_by_stiffness():
    threshold = 0.5 * 500 / 508  # mu_bulkhead T_core/(T_core + T_hose), from rest
    for mu, slips in ((threshold * 0.999, False), (threshold * 1.001, True)):
        (state,) = one(fairlead.load("single_bend", set={"mu": str(mu)})).moving
        bend = share_of(state, "bend")
        assert bend.slips is slips
        if not slips:
            np.testing.assert_allclose(bend.hose, passage(state, "bend").tension * 8 / 508)


def test_drag_on_the_hose_is_shared_with_the_core_at_the_ends_only():
    """The core's tension in the water is the mean of the total, so that both stay as long as each other."""
    state = one(fairlead.load("guidance_route_ideal")).moving[0]
    sea, end = state.tension(9.5), 150.0
    free, wet = 10 - (8 + math.pi / 3), 14.25
    mean = (sea * free + (sea + end) / 2 * wet) / (free + wet)
    layers = shares(state)
    assert layers.shares[-1].core == pytest.approx(mean * 500 / 508, rel=1e-6)
    assert layers.lowest == pytest.approx(end - mean * 500 / 508, rel=1e-6)


def test_a_scene_without_a_route_says_so():
    with pytest.raises(UsageError, match="belt has no line on a route"):
        fairlead.load("belt").statics()
    answer = CliRunner().invoke(app, ["statics", "belt"])
    assert answer.exit_code == 2
    assert "docs/routes.md" in answer.output


ROUTES = ["capstan", "slack_start", "crustacean", "long_deployment", "friction_anchor", "torsion"]


@pytest.mark.parametrize("model", ROUTES)
def test_every_bundled_route_is_solved_and_shown(model):
    answer = CliRunner().invoke(app, ["statics", model])
    assert answer.exit_code == 0, answer.output
    assert "standing still" in answer.output


@pytest.mark.slow
def test_json_has_the_numbers_of_the_table():
    answer = CliRunner().invoke(app, ["statics", "guidance_route_ideal", "--json"])
    (told,) = json.loads(answer.output)
    (out, back) = told["states"]
    assert [row["station"] for row in out["stations"]] == ["winch", "bend_a", "deployer", "bend_b", "sea", "tail"]
    assert out["stations"][1]["outboard"] == pytest.approx(200 * math.exp(0.35 * math.pi / 2))
    assert back["stations"][1]["outboard"] == pytest.approx(200 * math.exp(-0.35 * math.pi / 2))
    assert {row["drive"] for row in told["drives"]} == {"winch", "deployer"}


@pytest.mark.parametrize("speed", ["0", "3 kg", "fast"])
def test_a_speed_that_is_none_is_a_usage_error(speed):
    answer = CliRunner().invoke(app, ["statics", "capstan", "--speed", speed])
    assert answer.exit_code == 2
    assert "--speed" in answer.output


@pytest.mark.slow
def test_the_table_of_a_weak_clamp_says_what_check_says():
    answer = CliRunner().invoke(app, ["statics", "weak_clamp"])
    assert "its belts hold 270 N" in answer.output


def test_the_torque_of_a_winch_that_a_given_force_turns_is_that_force_times_its_radius():
    """Speeding up the drum takes a part of it: the line feels less, the shaft gives all the same."""
    model = fairlead.load("guidance_route_ideal")
    (found,) = model.statics()
    drives = [drive for state in (*found.moving, *found.starts) for drive in state.drives]
    torques = [drive.torque for drive in drives if drive.name == "winch"]
    assert len(torques) > 1
    assert torques == pytest.approx([-200 * 0.65] * len(torques), rel=1e-9)


@pytest.mark.parametrize("to", [0.3, -0.3])
def test_a_drive_that_stops_a_line_is_helped_by_its_friction_when_hauling_and_not_when_paying_out(scene, to):
    """T_in = (T_out + m a) e^(-+mu phi) + m' a: as the line leaves the bend outboard friction holds it back there."""
    text = f"""
    components:
      rope: {{type: Cable, length: 20 m, element: 0.2 m, start: -8 m, tension: 500 N, mass: 1.2 kg/m,
             stiffness: 800 kN}}
      route:
        type: Route
        stations:
          - {{type: Winch, radius: 0.5 m, moment: 1 kg*m^2}}
          - {{type: Straight, length: 2 m}}
          - {{type: Bend, angle: 90 deg, radius: 1.2 m, friction: 0.4}}
      drive: {{type: MotionSource, velocity: {{trapezoid: {{to: {to} m/s, rise: 1 s, stay: 2 s, fall: 0.2 s}}}}}}
      load: {{type: ForceSource, force: 500 N}}
    connections: [[rope.path, route.path], [drive.flange, route.winch.rim], [load.flange, rope.outboard]]
    run: {{stop: 4 s}}
    """
    starts = one(scene(text)).starts
    stops = [state for state in starts if state.acceleration * to < 0]
    assert stops
    for state in stops:
        (winch,) = [drive for drive in state.drives if drive.name == "winch"]
        factor = math.exp(-0.4 * math.pi / 2 * math.copysign(1.0, to))
        assert abs(winch.force) == pytest.approx(500 * factor, rel=0.12)  # of its own mass the line adds up to 45 N

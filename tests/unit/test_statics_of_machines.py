"""Statics of what moves a line: drums whose layers change, wheels that slip, what is not counted, loads that change."""

from __future__ import annotations

import math

import pytest

from fairlead.analysis.margins.quasi_static import against_statics

ROPE = "{type: Cable, mass: 0.8 kg/m, stiffness: 500 kN, length: %s m, element: 0.2 m, start: %s m, tension: 300 N}"


def table(model):
    (found,) = model.statics()
    return found


LAYERED = f"""
components:
  rope: {ROPE % (36, -32)}
  route:
    type: Route
    stations:
      - {{type: Winch, radius: 0.1 m, layers: on, width: 62 mm, line_diameter: 20 mm, moment: 1 kg*m^2}}
      - {{type: Sea, start: 3 m, speed: 5 m/s, drag_coefficient: 0.05}}
  d: {{type: SpeedSource, speed: {{ramp: {{to: 1.3 rad/s, over: 1 s}}}}}}
  load: {{type: ForceSource, force: 100 N}}
connections: [[rope.path, route.path], [d.shaft, route.winch.shaft], [load.flange, rope.outboard]]
run: {{stop: 100 s, accuracy: 1e-4}}
"""


@pytest.mark.parametrize(
    "speed",
    [
        "{table: {t: [0, 10, 20, 100], y: [0, 1, 1.3, 1.3], kind: cubic}}",
        "{sine: {amplitude: 1 rad/s, frequency: 0.01 Hz}}",
        "{step: {to: 1 rad/s, at: 1 s}}",
        "1.3 rad/s",
        "{table: {t: [0, 10, 20, 100], y: [0, 1, 1.3, 1.3]}}",
    ],
)
def test_layers_turn_any_speed_into_that_of_the_line(scene, speed):
    """The way is the length of what came off: by the angle that quad gives, whatever form the speed has."""
    from scipy.integrate import quad

    model = scene(LAYERED.replace("{ramp: {to: 1.3 rad/s, over: 1 s}}", speed))
    found = table(model)
    drum = model.flat.assembly.instances["d"].values.speed
    corners = [t for t in drum.borders if 0 < t < 40]
    angle = quad(drum, 0, 40, points=corners or None, limit=200)[0]
    assert found.schedule.way(40.0) == pytest.approx(paid_out(angle)[0], rel=2e-3)


def paid_out(angle):
    """32 m lie in layers of three wraps; each lies sqrt(3)/2 of 20 mm above the one below. Steps, without crossover."""
    rise, left = 0.02 * math.sqrt(3) / 2, 32.0
    radii = [0.11 + k * rise for k in range(40)]
    layer = 0
    while left > 6 * math.pi * radii[layer]:
        left -= 6 * math.pi * radii[layer]
        layer += 1
    way = 0.0
    while layer >= 0 and angle * radii[layer] > left:
        way, angle = way + left, angle - left / radii[layer]
        layer -= 1
        left = 6 * math.pi * radii[layer]
    return way + angle * radii[layer], radii[layer]


def test_a_drum_that_turns_steadily_pays_out_ever_slower(scene):
    model = scene(LAYERED)
    state = max((one for one in table(model).moving if one.speed > 0), key=lambda one: one.way)
    way, radius = paid_out(1.3 * 99.5)
    assert state.way == pytest.approx(way, rel=1e-3)
    assert state.speed == pytest.approx(1.3 * radius, rel=1e-9)
    assert not model.check()  # it had found that 34 m of 32 m would be paid out
    (winch,) = [one for one in state.drives if one.name == "winch"]
    in_water = state.way - 32 + 36 - 3
    drag = 0.5 * 1025 * 0.05 * math.pi * 0.02 * in_water * (5 - state.speed) ** 2
    assert -winch.force == pytest.approx(100 + drag, rel=1e-2)
    assert winch.lever == pytest.approx(radius, rel=1e-9)


def emptied():
    """Of each layer that is paid out at 1.3 rad/s: its number, its radius, and the way when its last wrap comes off."""
    rise, radii, left = 0.02 * math.sqrt(3) / 2, [], 32.0
    while left > 0:
        radii.append(0.11 + len(radii) * rise)
        left -= 6 * math.pi * radii[-1]
    way, angle = 0.0, 1.3 * 99.5
    for k in reversed(range(len(radii))):
        length = 6 * math.pi * radii[k] + (left if k == len(radii) - 1 else 0.0)
        length, angle = min(length, angle * radii[k]), angle - length / radii[k]
        way += length
        yield k + 1, radii[k], way
        if angle <= 0:
            return


def test_of_layers_the_fastest_is_told_and_those_in_which_force_or_torque_is_larger(scene):
    """What a current pulls grows with the line in it, and the radius falls: both are largest in other layers."""

    def pulls(radius, way):
        return 100 + 0.5 * 1025 * 0.05 * math.pi * 0.02 * (way - 32 + 36 - 3) * (5 - 1.3 * radius) ** 2

    layers = list(emptied())
    force = max(layers, key=lambda one: pulls(*one[1:]))[0]
    torque = max(layers, key=lambda one: pulls(*one[1:]) * one[1])[0]
    found = [one for one in table(scene(LAYERED)).record["states"] if one["speed"] > 0]
    assert {one["layer"] for one in found} == {layers[0][0], force, torque}
    assert found[0]["layer"] == layers[0][0]
    assert found[0]["speed"] == pytest.approx(1.3 * layers[0][1], rel=1e-9)
    assert found[0]["state"] == f"paying out, layer {layers[0][0]}"


def test_of_layers_in_which_nothing_but_the_speed_changes_the_fastest_alone_is_told(scene):
    found = table(scene(LAYERED.replace("drag_coefficient: 0.05", "drag_coefficient: 0")))
    (state,) = [one for one in found.moving if one.speed > 0]
    (number, radius, _), *_ = emptied()
    assert (state.route.layer(state.way), state.speed) == (number, pytest.approx(1.3 * radius, rel=1e-9))
    rows = found.drives().to_pandas()
    assert {f"layer {number}" in row for row in rows["state"] if row.startswith("paying out")} == {True}


@pytest.mark.slow
def test_the_run_pays_out_as_statics_says(scene):
    model = scene(LAYERED)
    state = max((one for one in table(model).moving if one.speed > 0), key=lambda one: one.way)
    result = model.run(out=None)
    assert result["rope.node[0].x"][-1] + 32 == pytest.approx(state.way, rel=1e-3)
    assert result["route.winch.layers.radius_now"][-1] == pytest.approx(state.speed / 1.3, rel=1e-6)


def on_a_wheel(station, more, joined, load="300 N"):
    return f"""
components:
  rope: {ROPE % (12, 0)}
  route:
    type: Route
    stations: [{station}]
  load: {{type: ForceSource, force: {load}}}
{more}
connections:
  - [rope.path, route.path]
  - [load.flange, rope.outboard]
{joined}
run: {{stop: 8 s}}
"""


HAUL = "  haul: {type: MotionSource, velocity: {ramp: {to: -0.2 m/s, over: 1 s}}}"
HAULED = "  - [haul.flange, rope.inboard]"
WHEEL = "{name: w, type: Pulley, start: 4 m, angle: 180 deg, radius: 0.5 m, friction: 0.4, moment: 1 kg*m^2}"


@pytest.mark.parametrize("load", [345, 360])
def test_a_wheel_that_is_driven_beyond_its_grip_is_told(scene, load):
    """A capstan of half a turn holds exp(0.4 pi) = 3.51 times the 100 N behind it."""
    more = "  d: {type: SpeedSource, speed: -0.4 rad/s}\n  tail: {type: ForceSource, force: -100 N}"
    text = on_a_wheel(WHEEL, more, "  - [d.shaft, route.w.shaft]\n  - [tail.flange, rope.inboard]", f"{load} N")
    told = [remark for state in table(scene(text)).moving for remark in state.remarks]
    if load < 100 * math.exp(0.4 * math.pi):
        assert not told
    else:
        assert told == [f"w: {load} N on one side and 100 N on the other are more than it grips, 351.4 N"]


@pytest.mark.parametrize("brake", ["ShaftFriction, sliding: 30 N*m", "RotationalDamper, damping: 1 N*m*s/rad"])
def test_what_rubs_on_the_shaft_of_a_wheel_is_said_not_to_be_counted(scene, brake):
    more = f"{HAUL}\n  h: {{type: Housing}}\n  br: {{type: {brake}}}"
    text = on_a_wheel(WHEEL, more, f"{HAULED}\n  - [br.b, route.w.shaft]\n  - [br.a, h.shaft]")
    (told,) = table(scene(text)).remarks
    assert told.startswith("w: br")
    assert told.endswith("acts there, and is not counted")


def test_of_a_load_that_changes_the_hardest_pull_is_told_and_when(scene):
    load = "{table: {t: [0, 3, 4], y: [300, 300, 600]}}"
    bend = "{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: 0.3}"
    found = table(scene(on_a_wheel(bend, HAUL, HAULED, load)))
    (state,) = [one for one in found.moving if one.speed < 0]
    assert state.passages[0].inboard == pytest.approx(600 * math.exp(0.3 * math.pi / 2), rel=1e-9)
    assert any("changes while it moves; it is hardest at 4" in remark for remark in found.notes)


JOINED = f"""
components:
  one: {ROPE % (6, 0)}
  two: {ROPE % (6, 6)}
  first: {{type: Route, stations: [{{type: Bend, start: 1 m, angle: 90 deg, radius: 1 m, friction: 0.3}}]}}
  second: {{type: Route, stations: [{{type: Bend, start: 8 m, angle: 90 deg, radius: 1 m, friction: 0.3}}]}}
  haul: {{type: MotionSource, velocity: {{ramp: {{to: -0.2 m/s, over: 1 s}}}}}}
  load: {{type: ForceSource, force: 300 N}}
connections:
  - [one.path, first.path]
  - [two.path, second.path]
  - [haul.flange, one.inboard]
  - [one.outboard, two.inboard]
  - [load.flange, two.outboard]
run: {{stop: 4 s}}
record: {{signals: ["*.tension", "*.x"], every: 10 ms}}
"""
GRIP = math.exp(0.3 * math.pi / 2)


@pytest.mark.parametrize("hauled_at", ["one.inboard", "two.outboard"])
def test_lines_that_are_joined_pull_at_each_other_by_the_capstans_of_both(scene, hauled_at):
    """300 N pull at one end and a hand at the other: behind both bends they are 300 N times the capstan of each."""
    text = JOINED
    if hauled_at == "two.outboard":  # the other way round, outboard
        text = text.replace("haul.flange, one.inboard", "load.flange, one.inboard").replace("force: 300", "force: -300")
        text = text.replace("[load.flange, two.outboard]", "[haul.flange, two.outboard]").replace("to: -0.2", "to: 0.2")
    one, two = scene(text).statics()
    assert not one.remarks
    assert not two.remarks
    first, second = ([state] for state in (one.moving[0], two.moving[0]))
    assert (len(one.moving), len(two.moving)) == (1, 1)
    ends = [(each.passages[0].inboard, each.passages[-1].outboard) for (each,) in (first, second)]
    wanted = [(300 * GRIP**2, 300 * GRIP), (300 * GRIP, 300)]
    assert ends == [pytest.approx(pair) for pair in (wanted if hauled_at == "one.inboard" else
                                                     [pair[::-1] for pair in wanted[::-1]])]  # fmt: skip
    cone = (one if hauled_at == "one.inboard" else two).standing
    ranges = [cone.passages[0].inboard, cone.passages[-1].outboard]
    assert pytest.approx((300 / GRIP**2, 300 * GRIP**2)) in ranges
    assert pytest.approx((300 / GRIP, 300 * GRIP)) in ranges
    assert any("two is joined to it" in note for note in one.notes)
    assert any("one is joined to it" in note for note in two.notes)


def test_a_run_of_joined_lines_is_as_their_statics_says(scene):
    model = scene(JOINED.replace("stop: 4 s", "stop: 9 s"))
    result = model.run(out=None)
    late = result.t > 2.5
    assert result["one.line[0].tension"][late].mean() == pytest.approx(300 * GRIP**2, rel=0.03)
    assert result["two.line[0].tension"][late].mean() == pytest.approx(300 * GRIP, rel=0.03)
    against = against_statics(model.flat, result)
    assert against["difference"] < 0.03, against["reason"]


def test_between_lines_that_both_hold_the_joint_is_open_and_named(scene):
    text = JOINED.replace("{type: ForceSource, force: 300 N}", "{type: MotionSource, velocity: -0.2 m/s}")
    for found in scene(text).statics():
        assert any("two drives hold the line" in remark for state in found.moving for remark in state.remarks)
        assert any("is joined to it" in note for note in found.notes)


@pytest.mark.parametrize("amplitude", [1.0, -1.0])
def test_of_a_speed_that_swings_the_moment_that_needs_most_is_told(scene, amplitude):
    """a = A R omega cos(omega t): as hauling begins it pulls with its capstan and both inertias, 100 kg m^2 at most."""
    text = f"""
components:
  rope: {ROPE % (14, -4)}
  route:
    type: Route
    stations:
      - {{type: Winch, radius: 0.3 m, moment: 100 kg*m^2}}
      - {{type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.3}}
  d: {{type: SpeedSource, speed: {{sine: {{amplitude: {amplitude} rad/s, frequency: 0.25 Hz}}}}}}
  load: {{type: ForceSource, force: 300 N}}
connections: [[rope.path, route.path], [d.shaft, route.winch.shaft], [load.flange, rope.outboard]]
run: {{stop: 8 s}}
"""
    found = table(scene(text))
    rate = 0.3 * math.pi / 2
    told = {math.copysign(1, one.acceleration): one for one in found.starts}
    for sense in (1, -1):
        assert told[sense].acceleration == pytest.approx(sense * rate, rel=1e-4)
    (winch,) = [one for one in told[-1].drives if one.name == "winch"]
    grip = math.exp(0.3 * math.pi / 2)
    assert -winch.force == pytest.approx(300 * grip, rel=0.02)  # and the line's own mass times the acceleration
    assert -winch.force > 300 * grip
    assert -winch.own == pytest.approx((100 / 0.3**2 + 0.8 * 6) * rate, rel=0.01)


@pytest.mark.parametrize(("speed", "told"), [(-0.05, 0), (-3.0, 1)])
def test_a_drum_must_take_what_is_hauled_on_to_it_and_no_more(scene, speed, told):
    """Two layers of three wraps take 4.47 m: 2 m lie there, and 0.1 r turns or all that 10 s give come on."""
    text = f"""
components:
  rope: {ROPE % (30, -2)}
  route:
    type: Route
    stations:
      - {{type: Winch, radius: 0.1 m, layers: on, width: 62 mm, line_diameter: 20 mm, height: 45 mm, moment: 1 kg*m^2}}
      - {{type: Straight, start: 2 m, length: 40 m}}
  d: {{type: SpeedSource, speed: {{ramp: {{to: {speed} rad/s, over: 1 s}}}}}}
  load: {{type: ForceSource, force: 100 N}}
connections: [[rope.path, route.path], [d.shaft, route.winch.shaft], [load.flange, rope.outboard]]
run: {{stop: 10 s}}
"""
    remarks = [str(one) for one in scene(text).check()]
    assert len(remarks) == told
    if told:
        assert "lie on it by 10 s, and its flanges take 4.473 m" in remarks[0]


def test_belts_that_are_open_all_the_time_drive_nothing(scene):
    """The line passes between them: hauled by the winch, with the capstan of the bend behind them."""
    text = f"""
components:
  rope: {ROPE % (14, -2)}
  route:
    type: Route
    stations:
      - {{type: Winch, radius: 0.3 m, moment: 1 kg*m^2}}
      - {{type: Bend, start: 1 m, angle: 90 deg, radius: 1 m, friction: 0.3}}
      - {{name: belts, type: Deployer, start: 4 m, length: 2 m, friction: 0.6}}
  d: {{type: SpeedSource, speed: {{ramp: {{to: -1 rad/s, over: 1 s}}}}}}
  rest: {{type: MotionSource, velocity: 0 m/s}}
  load: {{type: ForceSource, force: 300 N}}
connections:
  - [rope.path, route.path]
  - [d.shaft, route.winch.shaft]
  - [rest.flange, route.belts.belt]
  - [load.flange, rope.outboard]
run: {{stop: 5 s}}
"""
    model = scene(text)
    found = table(model)
    (state,) = [one for one in found.moving if one.speed < 0]
    (winch,) = [one for one in state.drives if one.name == "winch"]
    assert -winch.force == pytest.approx(300 * math.exp(0.3 * math.pi / 2), rel=1e-9)
    assert not state.remarks
    assert not model.check()
    against = against_statics(model.flat, model.run(out=None))
    assert against["difference"] < 0.03

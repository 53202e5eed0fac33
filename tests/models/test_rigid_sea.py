"""Line far out in the sea that moves as one body: the forces of the line, without its waves and their cost."""

import numpy as np
import pytest

from fairlead.analysis.effects.switches import switches
from fairlead.analysis.statics.laid_route import laid_routes
from fairlead.integrate import parts
from tests.models.part_and_whole import on_the_grid
from tests.reference.hanging_line import drag_per_length

START, SHIP, TAIL = 4.0, 3.0, 300.0  # m, m/s, N
SCENE = """
    components:
      line: {{type: {line}, length: {length} m, element: 0.25 m, start: {start} m, tension: 300 N}}
      route:
        type: Route
        stations:
          - {{name: gauge, type: Tensiometer, start: 0.75 m}}
          - {{name: bend, type: Bend, start: 2 m, angle: 60 deg, radius: 1 m, friction: {friction}}}
          - {{name: sea, type: Sea, start: {sea} m, speed: {ship} m/s, tail: {tail} N, form: {form}}}
      haul: {{type: MotionSource, velocity: {speed}}}
    connections:
      - [line.path, route.path]
      - [haul.flange, line.inboard]
    friction: {{method: hold}}
    run: {{stop: {stop} s, accuracy: 1e-5}}
    record: {{every: 50 ms, signals: [{wanted}, haul.force, route.gauge.tension, energy.*]}}
"""
RATIO = 5  # of damping: nothing rings for long
NODES = '"line.node[*].x", "line.line[*].tension"'
LAYERS = '"line.hose_node[*].x", "line.core_node[*].x", "line.hose[*].tension", "line.core[*].tension"'
ROPE = f"Cable, mass: 2 kg/m, stiffness: 100 kN, damping_ratio: {RATIO}, diameter: 85 mm"
LIGHTLY_DAMPED = ROPE.replace(f"ratio: {RATIO}", "ratio: 0.5")
ARRAY = ("ArrayModule, modules: 2, hose: {mass: 1.6 kg/m, stiffness: 8 kN}, core: {mass: 4.2 kg/m, stiffness: 500 kN},"
         " bulkhead_friction: 0.5")  # fmt: skip
THERE_AND_BACK = "{table: {t: [0 s, 1 s, 4 s, 5 s, 8 s, 9 s], y: [0, 0.6, 0.6, -0.6, -0.6, 0]}}"


def text(form="rigid, margin: 2 m", line=ROPE, speed=THERE_AND_BACK, stop=9, length=40, start=-6, friction=0.3):
    """A line through a bend into the sea, hauled at its inboard end."""
    return SCENE.format(
        form=form, line=line, speed=speed, stop=stop, length=length, start=start, friction=friction, sea=START,
        ship=SHIP, tail=TAIL, wanted=LAYERS if "Array" in line else NODES,
    )  # fmt: skip


def drag(flow):
    """Drag per length of the lines above [N/m]."""
    return drag_per_length(1025, 0.003, 0.085, flow)


def where_the_sea_begins(result, k):
    """Tension [N] at a place of the route at row k, between the middles of elements, outside all devices."""
    x = np.array([result[f"line.node[{i}].x"][k] for i in range(len(result.match("line.node[*].x")))])
    tension = [result[f"line.line[{i}].tension"][k] for i in range(len(x) - 1)]
    return np.interp(START - 0.3, (x[1:] + x[:-1]) / 2, tension), x[-1] - START


@pytest.mark.parametrize("speed", [0.4, -0.4])
def test_in_steady_tow_the_tension_where_the_sea_begins_is_tail_and_drag_of_all_line_out_there(simulate, speed):
    haul = f"{{ramp: {{to: {speed} m/s, over: 2 s}}}}"
    found = {}
    for form in ("rigid, margin: 2 m", "distributed"):
        result = simulate(text(form, speed=haul, stop=12))
        rows = np.flatnonzero(np.isclose(result.t % 0.5, 0, atol=1e-9) & (result.t > 9))
        means = np.array([where_the_sea_begins(result, k) for k in rows])
        want = TAIL + drag(SHIP - speed) * means[:, 1]
        np.testing.assert_allclose(means[:, 0], want, rtol=1e-3)  # nodes that are let go of ripple
        found[form[:5]] = means[:, 0].mean()
    assert found["rigid"] == pytest.approx(found["distr"], rel=5e-4)


@pytest.mark.slow
def test_at_rest_it_is_equal_to_the_last_digits(simulate):
    result = simulate(text(line=ROPE.replace("mass: 2", "mass: 0.2"), speed="0 m/s", friction=0, stop=12))
    tension, beyond = where_the_sea_begins(result, -1)
    stretched = 4 * 110 / 100e3  # the 4 m that are not rigid, from 300 N to what they bear
    assert tension == pytest.approx(TAIL + drag(SHIP) * (beyond - stretched), rel=1e-5)


@pytest.mark.slow
def test_a_change_of_speed_takes_the_drag_and_the_mass_of_all_the_line(simulate):
    """T = tail + drag + m' L a at the haul; the acceleration is raised so slowly that nothing rings."""
    t = np.linspace(0, 6, 61)
    acceleration = 0.2
    y = np.where(t < 3, acceleration * t**2 / 6, acceleration * (t - 1.5))
    table = f"{{table: {{t: {[f'{one:.2f} s' for one in t]}, y: {y.round(9).tolist()}}}}}".replace("'", "")
    result = simulate(text(speed=table, friction=0, stop=6))
    assert result.run["counters"]["partial_steps"] > 0.5 * result.run["counters"]["steps"]
    rows = np.flatnonzero((result.t > 4) & (result.t < 5.9))
    v = acceleration * (result.t[rows] - 1.5)
    beyond = np.asarray(result["line.node[160].x"])[rows] - START
    want = TAIL + drag(1.0) * (SHIP - v) ** 2 * beyond - 2 * 40 * acceleration
    force = -np.asarray(result["haul.force"])[rows]
    np.testing.assert_allclose(force.mean(), want.mean(), rtol=2e-3)
    np.testing.assert_allclose(force, want, rtol=1e-2)


@pytest.mark.slow
@pytest.mark.usefixtures("brief")
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("line", [LIGHTLY_DAMPED, ARRAY], ids=["rope", "array"])
def test_what_moves_with_the_end_may_be_left_out(simulate, monkeypatch, line, engine):
    """The whole lets slip 1 um/s for each kN in its bonds, the part does not."""
    scene = text(line=line)
    part = simulate(scene, **{"run.engine": engine})
    monkeypatch.setattr(parts, "LEAST", 10**9)
    whole = simulate(scene, **{"run.engine": engine})
    assert whole.run["counters"]["partial_steps"] == 0
    assert part.run["counters"]["partial_steps"] > 0.5 * part.run["counters"]["steps"]  # when it looks is by steps
    near = {"rodas": 1e-6, "stepping": 5e-5}[engine]
    for name in part.match("line.*node[*].x")[::9]:
        assert on_the_grid(part, name) == pytest.approx(on_the_grid(whole, name), abs=near), name
    assert np.ptp(np.asarray(part[part.match("line.*node[*].x")[-1]])) > 2.0


@pytest.mark.usefixtures("brief")
def test_strong_damping_at_the_border_of_what_is_left_out_is_no_reason_to_go_on_with_all(simulate):
    """The damper there feels the slip of the bond in the whole, some 1e-7 m/s, and none in the part.

    Of few steps, and among so few unknowns, half are taken before and between the looks.
    """
    counters = simulate(text()).run["counters"]
    assert counters["partial_steps"] > 0.4 * counters["steps"]


@pytest.mark.usefixtures("brief")
@pytest.mark.parametrize("line", [ROPE, ARRAY], ids=["rope", "array"])
def test_line_that_goes_out_and_comes_back_has_the_strain_it_went_with(simulate, line):
    result = simulate(text(line=line))
    assert result.run["energy"]["closure"] < 1e-3
    layers = ("line",) if line is ROPE else ("hose", "core")
    body = "node" if line is ROPE else "core_node"
    places = np.array([on_the_grid(result, f"line.{body}[{i}].x") for i in range(161)])
    inside = START + 2 + 2  # beyond the edge
    stays = went = 0
    for k in range(160):
        deep = np.minimum(places[k], places[k + 1]) > inside
        for layer in layers:
            tension = on_the_grid(result, f"line.{layer}[{k}].tension")[deep]
            if len(tension):
                assert np.ptp(tension) < 1e-3 * abs(tension).max() + 0.1, (layer, k)
        stays += deep.all()
        went += 0 < deep.sum() < len(deep)
    assert stays > 90
    assert went > 4


def test_a_margin_longer_than_the_line_leaves_nothing_to_move_as_one(simulate):
    far, along = (simulate(text(form, stop=3)) for form in ("rigid, margin: 100 m", "distributed"))
    for name in along.match("line.node[*].x")[::20]:
        assert on_the_grid(far, name) == pytest.approx(on_the_grid(along, name), abs=1e-6), name


def test_a_margin_that_holds_a_hose_within_its_module_is_told(scene):
    """Unless one is given it is the longest module, here 20 m, and 5 m; a rope has no hose to hold."""
    (told,) = scene(text(line=ARRAY)).check()
    assert "route.sea.margin = 2 m is shorter than a module of line, 20 m" in str(told)
    assert not scene(text("rigid", line=ARRAY)).check()
    assert not scene(text()).check()
    for line, margin in ((ARRAY, 25.0), (ROPE, 5.0)):
        (laid,) = laid_routes(scene(text("rigid", line=line)).flat)
        assert laid.line.line.rigid_from(START, laid.seas[0].station) == START + margin


@pytest.mark.slow
def test_a_speed_that_changes_before_a_wave_is_back_is_told(scene):
    """Waves run at sqrt(100 kN/2 kg/m) = 224 m/s, in 0.25 s out and back along 28 m; 2 kg/m 28 m 3 m/s^2 = 168 N."""
    speed = "{{table: {{t: [0 s, {0} s, {1} s, 2 s], y: [0, 0.3, 0.6, 0.6]}}}}"
    (told,) = scene(text(speed=speed.format(0.1, 0.2))).check()
    assert "at 0 s the speed changes by 0.6 m/s in 0.2 s, and a wave needs 0.25 s to the end of the 28 m" in str(told)
    assert "adds 168 N" in str(told)
    assert not scene(text(speed=speed.format(0.15, 0.3))).check()
    assert not scene(text("distributed", speed=speed.format(0.1, 0.2))).check()


WOUND = """
    components:
      line: {{type: {line}, length: 70 m, element: 0.25 m, start: -30 m, tension: 300 N}}
      route:
        type: Route
        stations:
          - {{name: winch, type: Winch, radius: 0.5 m, moment: 20 kg*m^2}}
          - {{name: bend, type: Bend, start: 2 m, angle: 60 deg, radius: 1 m, friction: 0.3}}
          - {{name: sea, type: Sea, start: 4 m, speed: 3 m/s, tail: 300 N, form: rigid, margin: 2 m}}
      drum: {{type: MotionSource, velocity: {speed}}}
    connections:
      - [line.path, route.path]
      - [drum.flange, route.winch.rim]
    friction: {{method: hold}}
    run: {{stop: 9 s, accuracy: 1e-5, engine: rodas}}
    record: {{every: 50 ms, signals: ["line.node[*].x", drum.force, energy.*]}}
"""


@pytest.mark.usefixtures("brief")
def test_line_on_the_drum_and_line_in_the_sea_are_left_out_at_once(simulate, monkeypatch):
    scene = WOUND.format(line=LIGHTLY_DAMPED, speed=THERE_AND_BACK)
    part = simulate(scene)
    monkeypatch.setattr(parts, "LEAST", 10**9)
    whole = simulate(scene)
    assert part.run["counters"]["partial_steps"] > 0.7 * part.run["counters"]["steps"]
    assert part.run["energy"]["closure"] < 1e-5
    for name in part.match("line.node[*].x")[::9]:
        assert on_the_grid(part, name) == pytest.approx(on_the_grid(whole, name), abs=1e-6), name


TWISTED = """
    components:
      line: {type: Cable, length: 30 m, element: 0.25 m, start: -2 m, tension: 300 N, mass: 2 kg/m, stiffness: 100 kN,
             damping_ratio: 0.5, torsion: {stiffness: 150 N*m^2, inertia: 6e-3 kg*m, damping_ratio: 5}}
      route: {type: Route, stations: [{name: sea, type: Sea, start: 0 m, speed: 3 m/s, tail: 300 N, form: rigid}]}
      wall: {type: Ground}
      hold: {type: Housing}
      hand: {type: TorqueSource, torque: {ramp: {to: 20 N*m, over: 10 s}}}
    connections:
      - [line.path, route.path]
      - [wall.flange, line.inboard]
      - [hold.shaft, line.inboard_twist]
      - [line.outboard_twist, hand.shaft]
    run: {stop: 20 s}
    record: {every: 0.5 s, signals: ["line.twist[*].angle"]}
"""


def test_a_line_that_moves_as_one_is_free_to_twist(simulate):
    """A couple at the end turns it by T length/GJ, as a line that is held nowhere else."""
    result = simulate(TWISTED)
    assert result.run["counters"]["partial_steps"] > 0
    for k in (60, 120):
        assert result[f"line.twist[{k}].angle"][-1] == pytest.approx(20 * k * 0.25 / 150, rel=1e-3)


def test_effects_tell_what_the_waves_of_the_line_out_there_cost(scene):
    """Where the line goes beyond the margin, 25 m for this array; not where it stays inside."""
    def switched(form, length=40):
        found = switches(scene(text(form, line=ARRAY, length=length)))
        return [(one.label, dict(one.settings)) for one in found if "sea" in one.name]

    assert switched("distributed") == [("route.sea.form rigid", {"route.stations[2].form": "rigid"})]
    assert switched("rigid") == [("route.sea.form distributed", {"route.stations[2].form": "distributed"})]
    assert switched("distributed", length=20) == []


@pytest.mark.slow
def test_all_of_a_line_comes_out_of_the_sea_and_goes_back(simulate):
    """Hauled in until nothing moves with the end but itself, and out again: the tension is that of the line along."""
    speed = "{table: {t: [0 s, 1 s, 11 s, 12 s, 14 s, 15 s, 25 s, 26 s], y: [0, -0.8, -0.8, 0, 0, 0.8, 0.8, 0]}}"
    scene = text(speed=speed, stop=30, length=11, start=1.5, friction=0)
    rigid = simulate(scene)
    end = np.asarray(rigid["line.node[44].x"])
    assert end.min() < START < START + 4 < end.max()
    row = int(np.searchsorted(rigid.t, 13.9))
    assert -rigid["haul.force"][row] == pytest.approx(TAIL + drag(SHIP) * max(end[row] - START, 0), rel=1e-4)
    assert -rigid["haul.force"][-1] == pytest.approx(TAIL + drag(SHIP) * (end[-1] - START), rel=1e-4)
    moving = int(np.searchsorted(rigid.t, 24))
    want = TAIL + drag(SHIP - 0.8) * (end[moving] - START)
    assert -rigid["haul.force"][moving] == pytest.approx(want, rel=1e-3)
    assert rigid.run["energy"]["closure"] < 1e-3

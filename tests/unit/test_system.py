"""The compiled system: kinematic groups with ratios, where it begins, and what its equations determine."""
# ruff: noqa: E501 - netlists and their parts read best on one line

import ctypes
import itertools

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError
from fairlead.system.assembly.matching import unmatched

PINION = """\
schema: 1
name: pinion
components:
  motor: {type: Inertia, moment: 2 kg*m^2, speed: 3 rad/s}
  pinion: {type: Rack, radius: 0.5 m, offset: 0.1 m}
  gear: {type: Gear, ratio: -4}
  wheel: {type: Inertia, moment: 0.25 kg*m^2}
  load: {type: Mass, mass: 8 kg}
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  eye: {type: MotionSensor}
connections:
  - [motor.shaft, pinion.pinion, gear.a]
  - [gear.b, wheel.shaft]
  - [load.flange, pinion.rack, spring.b, eye.flange]
  - [spring.a, wall.flange]
run: {stop: 1 s}
"""


def load(tmp_path, text):
    (tmp_path / "scene.yaml").write_text(text)
    return fairlead.load(tmp_path / "scene.yaml")


def rhs(system, y):
    system = system.instance()
    f, values = np.zeros(system.n), np.array(y, dtype=float)
    kinds = (ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)
    ctypes.CFUNCTYPE(None, *kinds)(system.callbacks["rhs"])(system.context, 0.0, values.ctypes.data, f.ctypes.data)
    return f


def recorded(system, y):
    """Every output by name, at y."""
    system = system.instance()
    out, values = np.zeros(system.n_outputs), np.array(y, dtype=float)
    kinds = (ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)
    ctypes.CFUNCTYPE(None, *kinds)(system.callbacks["outputs"])(system.context, 0.0, values.ctypes.data, out.ctypes.data)
    return dict(zip((signal.name for signal in system.recorded), out, strict=False))


def test_geared_bodies_are_one_degree_of_freedom_told_by_the_one_that_goes_along(tmp_path):
    """Inertias add with the ratio squared: (2 + 8 * 0.5^2 + 0.25 * 4^2) / 0.5^2 = 32 kg at the load."""
    flat = load(tmp_path, PINION).flat
    free = [group for group in flat.groups if group.free]
    assert len(free) == 1
    assert free[0].name == "load"
    assert free[0].domain.name == "translational"
    assert free[0].mass == pytest.approx(32.0)
    assert free[0].start == pytest.approx((0.0, 1.5))


@pytest.mark.parametrize("order", list(itertools.permutations(("light", "heavy", "other"))))
def test_which_body_tells_the_motion_of_shafts_in_gear_does_not_depend_on_their_order(tmp_path, order):
    bodies = {"light": "{type: Inertia, moment: 0.1 kg*m^2, speed: 3 rad/s}",
              "heavy": "{type: Inertia, moment: 2 kg*m^2}", "other": "{type: Inertia, moment: 0.2 kg*m^2}"}  # fmt: skip
    listed = "\n".join(f"  {name}: {bodies[name]}" for name in order)
    text = f"""schema: 1
components:
{listed}
  first: {{type: Gear, ratio: 2}}
  second: {{type: Gear, ratio: -1.5}}
connections:
  - [light.shaft, first.a]
  - [heavy.shaft, first.b, second.a]
  - [other.shaft, second.b]
run: {{stop: 1 s}}
"""
    assert load(tmp_path, text).system.unknown_names[:2] == ["heavy.angle", "heavy.speed"]


def test_a_force_at_the_rack_turns_the_pinion_with_its_radius(tmp_path):
    """At angle 0.2 rad the rack is at 0.1 + 0.5 * 0.2 = 0.2 m: spring 20 N, torque -10 N m, acceleration -10/8."""
    system = load(tmp_path, PINION).system
    assert system.unknown_names[:2] == ["load.x", "load.v"]
    assert [unknown.unit for unknown in system.numbering.unknowns[:2]] == ["m", "m/s"]
    y = np.zeros(system.n)
    y[:2] = 0.2, 1.5
    assert rhs(system, y)[:2] == pytest.approx([1.5, -20.0])
    said = recorded(system, y)
    assert said["spring.tension"] == pytest.approx(20.0)
    assert said["eye.x"] == pytest.approx(0.2)
    assert said["eye.v"] == pytest.approx(1.5)
    assert said["eye.a"] == pytest.approx(0.5 * -10.0 / 8.0)
    assert said["wheel.speed"] == pytest.approx(-12.0)


@pytest.mark.parametrize(
    ("given", "angle", "speed"),
    [
        ("{motor.angle: 30 deg}", np.pi / 6, 3.0),
        ("{load.x: 0.35 m}", 0.5, 3.0),
        ("{load.flange.x: 0.35 m, load.v: 1 m/s}", 0.5, 2.0),
        ("{pinion.rack.v: -1 m/s}", -0.2, -2.0),
        ("{wheel.speed: 60 rpm}", -0.2, -2 * np.pi / 4),
        ('{"*.speed": 0 rad/s, load.v: 0 m/s}', -0.2, 0.0),
    ],
)
def test_initial_values_are_given_by_any_name_that_moves_with_the_unknown(tmp_path, given, angle, speed):
    """Where no position is given, that of the load is zero: -0.2 rad at the motor."""
    system = load(tmp_path, f"{PINION}initial: {given}\n").system
    assert system.initial[:2] == pytest.approx([0.1 + 0.5 * angle, 0.5 * speed])  # at the load


def test_an_initial_value_of_a_state_or_a_multiplier_is_taken(tmp_path):
    text = fairlead.load("belt").netlist.path.read_text() + "initial: {pad.force: 2 N, block.x: 20 mm}\n"
    system = load(tmp_path, text).system
    begin = dict(zip(system.unknown_names, system.initial, strict=True))
    assert (begin["pad.force"], begin["block.x"], begin["block.v"]) == (2.0, 0.02, 0.2)


def test_a_source_of_velocity_starts_where_the_body_it_drives_starts(tmp_path):
    text = """\
schema: 1
name: driven
components:
  belt: {type: MotionSource, velocity: 0.2 m/s}
  load: {type: Mass, mass: 8 kg, position: 3 m}
connections: [[belt.flange, load.flange]]
run: {stop: 1 s}
"""
    assert recorded(load(tmp_path, text).system, np.zeros(2))["load.x"] == pytest.approx(3.0)


def chain(*parts):
    """A netlist of parts in a row between a wall and a mass."""
    names = [f"p{k}" for k in range(len(parts))]
    components = "".join(f"  {name}: {part}\n" for name, part in zip(names, parts, strict=True))
    ends = ["wall.flange", *(f"{name}.{port}" for name in names for port in "ab"), "block.flange"]
    joins = "".join(f"  - [{a}, {b}]\n" for a, b in zip(ends[::2], ends[1::2], strict=True))
    return (f"schema: 1\nname: chain\ncomponents:\n  wall: {{type: Ground}}\n  block: {{type: Mass, mass: 1 kg}}\n{components}"
            f"connections:\n{joins}run: {{stop: 1 s}}\n")  # fmt: skip


SPRING, DAMPER = "{type: Spring, stiffness: 10 N/m}", "{type: Damper, damping: 1 N*s/m}"
TETHER, PAD = "{type: Tether, stiffness: 10 N/m}", "{type: Contact, method: hold, normal_force: 1 N, curve: 0.3}"
BINDING = "{type: Contact, method: binding, normal_force: 1 N, curve: 0.3}"


@pytest.mark.parametrize(
    "parts",
    [(SPRING, SPRING), (SPRING, SPRING, SPRING), (SPRING, DAMPER), (DAMPER, DAMPER), (SPRING, TETHER), (BINDING, BINDING),
     (BINDING, SPRING), (PAD, SPRING), (PAD, DAMPER)],
    ids=["two springs", "three springs", "spring and damper", "two dampers", "spring and slack line", "two binding contacts",
         "binding contact and spring", "held contact and spring", "held contact and damper"],
)  # fmt: skip
def test_a_massless_node_is_determined_by_what_is_beside_it(tmp_path, parts):
    assert load(tmp_path, chain(*parts)).check() == []


@pytest.mark.parametrize("parts", [(PAD, PAD), (TETHER, TETHER)], ids=["two held", "two slack"])
def test_a_massless_node_whose_force_no_law_determines_is_named(tmp_path, parts):
    with pytest.raises(ModelError, match=r"node \{p0.b, p1.a\} has no mass and no law determines its force while "):
        load(tmp_path, chain(*parts)).check()


@pytest.mark.parametrize("parts", [(SPRING, SPRING), (SPRING, DAMPER), (DAMPER, DAMPER), (BINDING, BINDING), (PAD, DAMPER), (PAD, SPRING)])
def test_what_counts_as_determined_has_a_regular_matrix_at_the_start(tmp_path, parts):
    """C = columns of M where differential, of -J where algebraic: what a consistent start solves with."""
    from tests.components.test_assembly import Called

    system = load(tmp_path, chain(*parts)).system
    rng = np.random.default_rng(3)
    called = Called(system)
    jacobian, _ = called.jacobian(0.0, rng.uniform(-1, 1, system.n))
    matrix = np.where(system.differential, called.mass(), -jacobian)
    assert np.linalg.matrix_rank(matrix) == system.n


def test_the_matching_finds_as_many_pairs_as_there_are():
    """Against the rank of random matrices with generic entries, which equals the size of a maximum matching."""
    rng = np.random.default_rng(11)
    for _ in range(60):
        n = int(rng.integers(2, 9))
        full = (rng.random((n, n)) < 0.3) * rng.uniform(1, 2, (n, n))
        parts = unmatched([set(np.flatnonzero(full[:, column]).tolist()) for column in range(n)])
        assert bool(parts) == (np.linalg.matrix_rank(full) < n)
        for part in parts:
            rows = {row for column in part for row in np.flatnonzero(full[:, column])}
            assert len(rows) < len(part)

"""Held contacts that close a circle share the force so that the sum of its squares is least.

Compared with the least-norm solution of the balances by numpy's `lstsq`, which knows neither circles nor shares.
"""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.errors import ModelError
from tests.conftest import Scene

PAD = "curve: {curve: coulomb, stiction: 0.5, coulomb: 0.4}"


def two_pads(one: float, two: float) -> str:
    """A block on two pads side by side, the second the other way round, pulled by a force that grows by 4 N/s."""
    return f"""
    components:
      wall: {{type: Ground}}
      block: {{type: Mass, mass: 2 kg}}
      pull: {{type: ForceSource, force: {{drift: {{rate: 4 N/s}}}}}}
      one: {{type: Contact, method: hold, normal_force: {2 * one} N, {PAD}}}
      two: {{type: Contact, method: hold, normal_force: {2 * two} N, {PAD}}}
    connections: [[wall.flange, one.a, two.b], [one.b, two.a, block.flange, pull.flange]]
    parameters: {{engine: rodas}}
    run: {{stop: 3 s, accuracy: 1e-4, engine: "{{engine}}"}}
    record: {{every: 0.1 s}}
    """


ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping"])


@ENGINES
def test_two_contacts_side_by_side_carry_half_each(simulate: Scene, engine: str) -> None:
    result = simulate(two_pads(10, 10), engine=engine, **{"run.stop": "2 s"})
    assert not result.events
    if engine == "rodas":  # the forces of stepping are means over a step
        assert result["one.friction"] == pytest.approx(2 * result.t, abs=1e-9)
    assert result["one.friction"][-1] > 3.0
    assert result["two.friction"] == pytest.approx(-result["one.friction"], abs=1e-9)
    assert np.abs(result["block.v"]).max() < 1e-15


@ENGINES
def test_when_the_weaker_lets_go_the_stronger_carries_what_is_left(simulate: Scene, engine: str) -> None:
    """Limits 5 and 3 N, Coulomb forces 4 and 2.4 N. The load is 4 t; both carry 2 t.

    At 3 N each, t = 1.5, the weaker gives way to 2.4 N without moving; the other has the rest until that is
    5 N, at t = 1.85; from there on 2 v' = 4 t - 6.4.
    """
    result = simulate(two_pads(5, 3), engine=engine)
    assert [(e.component, e.zone_to) for e in result.events] == [("two", "backward"), ("one", "forward")]
    assert [e.t for e in result.events] == pytest.approx([1.5, 1.85], rel=1e-9 if engine == "rodas" else 1e-4)
    assert result["two.friction"][-1] == pytest.approx(-2.4)
    assert result["block.v"][-1] == pytest.approx(3.0**2 - 3.2 * 3.0 - (1.85**2 - 3.2 * 1.85), rel=1e-4)
    if engine == "rodas":
        after = (result.t > 1.5) & (result.t < 1.85 - 1e-6)
        assert result["one.friction"][after] == pytest.approx(4 * result.t[after] - 2.4)
        assert np.abs(result["block.v"][result.t < 1.85]).max() < 1e-15


def test_a_contact_that_slides_in_name_only_holds_again_when_its_share_is_less(simulate: Scene) -> None:
    """The load goes up to 6.8 N and back to 0.5 N: the weaker is at 2.4 N from t = 1.5 until half the load is that."""
    pull = "force: {table: [[0 s, 0 N], [1.7 s, 6.8 N], [3.2 s, 0.5 N], [4 s, 0.5 N]]}"
    result = simulate(two_pads(5, 3).replace("force: {drift: {rate: 4 N/s}}", pull), **{"run.stop": "4 s"})
    again = 1.7 + (6.8 - 4.8) / (6.8 - 0.5) * 1.5
    assert [(e.component, e.zone_to) for e in result.events] == [("two", "backward"), ("two", "held")]
    assert [e.t for e in result.events] == pytest.approx([1.5, again], rel=1e-9)
    assert np.abs(result["block.v"]).max() < 1e-15
    late = result.t > again
    assert result["one.friction"][late] == pytest.approx(-result["two.friction"][late])
    assert result["one.friction"][-1] == pytest.approx(0.25)


RING = """
    components:
      {masses}
      {pulls}
      {pads}
    connections:
      {joins}
    run: {{stop: 0.1 s, accuracy: 1e-4}}
"""


def ring(masses: np.ndarray, loads: np.ndarray) -> str:
    """Free bodies in a ring, a contact between neighbours all round."""
    n, line = len(masses), "\n      ".join
    return RING.format(
        masses=line(f"m{k}: {{type: Mass, mass: {mass:.17g} kg}}" for k, mass in enumerate(masses)),
        pulls=line(f"f{k}: {{type: ForceSource, force: {load:.17g} N}}" for k, load in enumerate(loads)),
        pads=line(f"c{k}: {{type: Contact, method: hold, normal_force: 1 kN, {PAD}}}" for k in range(n)),
        joins=line(f"- [m{k}.flange, f{k}.flange, c{k}.a, c{(k - 1) % n}.b]" for k in range(n)),
    )  # fmt: skip


@pytest.mark.parametrize("n", [3, 4, 25])
def test_a_free_ring_moves_as_one_body_and_no_force_goes_round_in_it(simulate: Scene, n: int) -> None:
    rng = np.random.default_rng(n)
    masses, loads = 10 ** rng.uniform(-1, 1, n), rng.normal(0, 10, n)
    result = simulate(ring(masses, loads))
    forces = np.array([result[f"c{k}.friction"][-1] for k in range(n)])
    speeds = np.array([result[f"m{k}.v"][-1] for k in range(n)])
    acceleration = loads.sum() / masses.sum()
    assert speeds == pytest.approx(acceleration * 0.1, rel=1e-9)
    # Contact k takes +s_k from its body b = k + 1 and -s_k from a = k.
    slips = np.roll(np.eye(n), 1, axis=1) - np.eye(n)
    assert forces == pytest.approx(np.linalg.lstsq(slips.T, loads - masses * acceleration)[0], rel=1e-9, abs=1e-9)
    assert forces.sum() == pytest.approx(0.0, abs=1e-9)


BETWEEN = """
    components:
      left: {type: MotionSource, position: {sine: {amplitude: 0.02 m, frequency: 2 Hz}}}
      right: {type: MotionSource, @OTHER@}
      block: {type: Mass, mass: 2 kg, velocity: 0 m/s}
      one: {type: Contact, method: hold, normal_force: 100 N, curve: 0.5}
      two: {type: Contact, method: hold, normal_force: 200 N, curve: 0.5}
    connections: [[left.flange, one.a], [one.b, block.flange, two.a], [two.b, right.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {every: 5 ms}
"""


def test_a_body_between_two_walls_that_move_alike_is_driven_half_by_each(simulate: Scene) -> None:
    result = simulate(BETWEEN.replace("@OTHER@", "position: {sine: {amplitude: 0.02 m, frequency: 2 Hz}}"))
    late = result.t > 0.1  # at first it has to be caught: the walls start with a speed
    wave = 4 * np.pi
    half = 2 * 0.02 * wave**2 * np.sin(wave * result.t[late]) / 2
    assert result["one.friction"][late] == pytest.approx(half, rel=1e-6, abs=1e-6)
    assert result["two.friction"][late] == pytest.approx(-half, rel=1e-6, abs=1e-6)
    assert np.abs(result["one.slip"][late]).max() < 1e-8  # of walls at up to 0.25 m/s, at an accuracy of 1e-6


@pytest.mark.parametrize("other", ["velocity: 0.1 m/s", "velocity: {ramp: {to: 0.1 m/s, over: 1 s}}"])
def test_a_body_between_two_walls_that_part_goes_with_the_one_that_holds_it_better(simulate: Scene, other: str) -> None:
    still = BETWEEN.replace("position: {sine: {amplitude: 0.02 m, frequency: 2 Hz}}}", "velocity: 0 m/s}", 1)
    result = simulate(still.replace("@OTHER@", other))
    late = result.t > 0.1
    assert result["one.friction"][late] == pytest.approx(50.0)  # it slips on the left, at its limit
    assert np.abs(result["two.slip"][late]).max() < 1e-12
    speed = 0.1 if other.endswith("m/s") else 0.1 * result.t[late]
    assert result["block.v"][late] == pytest.approx(speed, abs=1e-12)


GEARED = """
    parameters: {ratio: 2}
    components:
      a: {type: Inertia, moment: 2 kg*m^2}
      b: {type: Inertia, moment: 3 kg*m^2}
      arm_a: {type: Rack, radius: 1 m}
      arm_b: {type: Rack, radius: 1 m}
      pull_a: {type: ForceSource, force: 5 N}
      pull_b: {type: ForceSource, force: 2 N}
      one_a: {type: Rack, radius: 0.1 m}
      one_b: {type: Rack, radius: 0.05 m}
      two_a: {type: Rack, radius: 0.3 m}
      two_b: {type: Rack, radius: "{0.3/ratio} m"}
      one: {type: Contact, method: hold, normal_force: 1 kN, curve: 0.5}
      two: {type: Contact, method: hold, normal_force: 1 kN, curve: 0.5}
    connections:
      - [a.shaft, arm_a.pinion, one_a.pinion, two_a.pinion]
      - [b.shaft, arm_b.pinion, one_b.pinion, two_b.pinion]
      - [pull_a.flange, arm_a.rack]
      - [pull_b.flange, arm_b.rack]
      - [one_a.rack, one.a]
      - [one_b.rack, one.b]
      - [two_a.rack, two.a]
      - [two_b.rack, two.b]
    run: {stop: 0.5 s, accuracy: 1e-6}
"""


@ENGINES
@pytest.mark.parametrize("ratio", [2.0, 2.5])
def test_two_friction_gears_share_by_their_radii_and_lock_when_their_ratios_differ(
    simulate: Scene, engine: str, ratio: float
) -> None:
    """slip = r_b w_b - r_a w_a for each; with equal ratios r_a/r_b both can hold while the shafts turn."""
    result = simulate(GEARED.replace("1e-6}", f"1e-6, engine: {engine}}}"), ratio=ratio)
    slips = np.array([[-0.1, 0.05], [-0.3, 0.3 / ratio]])
    inertia, torque = np.diag([2.0, 3.0]), np.array([5.0, 2.0])
    # M w' + C^T s = torque, C w' = 0, s of least norm.
    whole = np.block([[inertia, slips.T], [slips, np.zeros((2, 2))]])
    exact = np.linalg.lstsq(whole, np.concatenate([torque, np.zeros(2)]))[0]
    assert [result[f"{name}.rate"][-1] for name in "ab"] == pytest.approx(0.5 * exact[:2], abs=1e-9)
    assert [result[f"{pad}.friction"][-1] for pad in ("one", "two")] == pytest.approx(exact[2:], rel=1e-9)
    assert (abs(exact[0]) > 0.1) == (ratio == 2.0)


LOCKED = """
      {a}: {{type: Inertia, moment: 2 kg*m^2}}
      {b}: {{type: Inertia, moment: 3 kg*m^2}}
      {b}_arm: {{type: Rack, radius: 1 m}}
      {b}_pull: {{type: ForceSource, force: {{table: [[0 s, 0 N], [1 s, {most} N], [3 s, {least} N]]}}}}
      {a}_one: {{type: Rack, radius: 0.1 m}}
      {b}_one: {{type: Rack, radius: 0.05 m}}
      {a}_two: {{type: Rack, radius: 0.3 m}}
      {b}_two: {{type: Rack, radius: 0.12 m}}
      {a}{b}_one: {{type: Contact, normal_force: 100 kN, curve: 0.5}}
      {a}{b}_two: {{type: Contact, normal_force: 100 kN, curve: 0.5}}
"""
JOINED = """
      - [{a}.shaft, {a}_one.pinion, {a}_two.pinion]
      - [{b}.shaft, {b}_arm.pinion, {b}_one.pinion, {b}_two.pinion]
      - [{a}_one.rack, {a}{b}_one.a]
      - [{b}_one.rack, {a}{b}_one.b]
      - [{a}_two.rack, {a}{b}_two.a]
      - [{b}_two.rack, {a}{b}_two.b]
"""


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
@pytest.mark.parametrize("beside", ["the ground", "the ground, turned round", "two others"])
def test_a_brake_at_what_is_locked_holds_again_when_its_share_is_less(simulate: Scene, beside, engine):
    """Shafts stand still by two ratios that differ, so the brake has no slip to tell by; its limit is 2 N."""
    pairs = [{"a": "a", "b": "b", "most": 6, "least": -6}, {"a": "c", "b": "d", "most": -4, "least": 4}]
    pairs = pairs if beside == "two others" else pairs[:1]
    one, other = ("brake.a", "brake.b") if "turned" in beside else ("brake.b", "brake.a")
    far = "[d_pull.flange, d_arm.rack" if beside == "two others" else "[ground.flange"
    result = simulate(
        "    components:\n      brake: {type: Contact, normal_force: 4 N, curve: 0.5}"
        + "\n      ground: {type: Ground}" * (beside != "two others")
        + "".join(LOCKED.format(**names) for names in pairs) + "    connections:"
        + "".join(JOINED.format(**names) for names in pairs) + f"      - [b_pull.flange, b_arm.rack, {one}]\n"
        f"      - {far}, {other}]\n    run: {{stop: 3 s, accuracy: 1e-6, engine: {engine}}}"
    )  # fmt: skip
    slips = np.zeros((2 * len(pairs) + 1, 2 * len(pairs)))
    for k in range(len(pairs)):
        slips[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = [[-0.1, 0.05], [-0.3, 0.12]]
        slips[-1, 2 * k + 1] = (1, -1)[k]
    loads = np.array([size for names in pairs for size in (0.0, names["most"])])
    share = np.linalg.lstsq(slips.T, loads)[0][-1]  # of the brake, as the loads are at their most, if it held
    begins = 2.0 / share
    assert [(e.component, e.zone_from == "held") for e in result.events] == [("brake", first) for first in (1, 0, 1)]
    assert [e.t for e in result.events] == pytest.approx([begins, 2 - begins, 2 + begins], abs=1e-6)
    assert result.at("brake.friction", 2.0) == pytest.approx(0.0, abs=1e-6)


UNEQUAL = """
    from fairlead.component import Component, Law, Parameter, Translational, Unknown, hold


    class Lever(Component):
        \"\"\"Holds b to a multiple of the speed of a, with one force on both, which no lever has.\"\"\"

        a, b = Translational(), Translational()
        arm = Parameter("1", "Lever arm.", above=0)
        force = Unknown("N", "Its force.")

        def law(p, a, b, force):
            \"\"\"b is geared to a.\"\"\"
            return Law(a=-force, b=+force, force=hold(b.v - p.arm * a.v))
"""


def test_holds_that_are_no_plain_sums_of_speeds_are_not_guessed_at(scene: Scene, library) -> None:
    text = """
    components:
      wall: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      one: {type: Lever, arm: 2}
      two: {type: Lever, arm: 2}
    connections: [[wall.flange, one.a, two.a], [block.flange, one.b, two.b]]
    run: {stop: 1 s}
    """
    with pytest.raises(ModelError, match="one and two hold in a closed circle, and the force of one and two does not"):
        scene(text, libraries=(library(UNEQUAL),)).check()


@ENGINES
def test_levers_whose_arms_are_parameters_share_by_them(simulate: Scene, library, engine: str) -> None:
    """Two between a block that is pushed and one that stands on its friction: s_j = C_j w, of least sum of squares."""
    text = f"""
    components:
      wall: {{type: Ground}}
      base: {{type: Mass, mass: 2 kg}}
      pad: {{type: Contact, method: hold, normal_force: 100 N, curve: 0.5}}
      block: {{type: Mass, mass: 1 kg}}
      push: {{type: ForceSource, force: 6 N}}
      one: {{type: Lever, arm: 2}}
      two: {{type: Lever, arm: 3}}
    connections: [[wall.flange, pad.a], [base.flange, pad.b, one.a, two.a], [push.flange, block.flange, one.b, two.b]]
    run: {{stop: 0.1 s, engine: {engine}}}
    record: {{signals: [one.told, two.told, pad.friction, block.v]}}
    """
    told = 'force = Unknown("N", "Its force.")\n        told = Output("N", "The same.")'
    proportional = UNEQUAL.replace("a=-force", "a=-p.arm * force").replace("hold\n", "hold, Output\n", 1)
    proportional = proportional.replace('force = Unknown("N", "Its force.")', told)
    proportional = proportional.replace("- p.arm * a.v))", "- p.arm * a.v), told=force)")
    result = simulate(text, libraries=(library(proportional),))
    slips = np.array([[0.0, 1.0], [-2.0, 1.0], [-3.0, 1.0]])  # pad, one, two by the speeds of base and block
    slips[0] = 1.0, 0.0
    exact = np.linalg.lstsq(slips.T, np.array([0.0, 6.0]))[0]
    got = [result[name][-1] for name in ("pad.friction", "one.told", "two.told")]
    assert got == pytest.approx(exact, abs=1e-6)
    assert abs(result["block.v"]).max() < 1e-9


@ENGINES
def test_a_load_that_swings_for_an_hour_moves_nothing(simulate: Scene, engine: str) -> None:
    """Two bodies on a wall and on each other, side by side: three contacts, of which one is one too many."""
    text = """
    components:
      wall: {type: Ground}
      left: {type: Mass, mass: 1 kg}
      right: {type: Mass, mass: 3 kg}
      shake: {type: ForceSource, force: {sine: {amplitude: 5 N, frequency: 0.01 Hz}}}
      one: {type: Contact, method: hold, normal_force: 20 N, curve: 0.5}
      two: {type: Contact, method: hold, normal_force: 20 N, curve: 0.5}
      three: {type: Contact, method: hold, normal_force: 20 N, curve: 0.5}
    connections:
      - [wall.flange, one.a, three.a]
      - [left.flange, one.b, two.a]
      - [two.b, right.flange, three.b, shake.flange]
    run: {stop: 3600 s, accuracy: 1e-4, engine: ENGINE}
    record: {every: 25 s}
    """.replace("ENGINE", engine)
    result = simulate(text)
    assert not result.events
    assert np.abs([result["left.v"], result["right.v"]]).max() < 1e-12
    assert np.abs([result["left.x"], result["right.x"]]).max() < {"rodas": 1e-12, "stepping": 1e-10}[engine]
    if engine == "rodas":  # the forces of stepping are means over a step
        load = 5 * np.sin(2 * np.pi * result.t / 100)
        assert result["three.friction"] == pytest.approx(2 / 3 * load, abs=5e-3)
        assert result["one.friction"] == pytest.approx(1 / 3 * load, abs=5e-3)


@pytest.mark.slow
def test_a_damped_node_without_mass_is_held_and_so_is_one_on_a_spring(simulate) -> None:
    """wall, pad, node, damper, block: while the pad holds, the block's speed decays at the rate c/m, or it swings."""
    text = """
    components:
      wall: {type: Ground}
      block: {type: Mass, mass: 2 kg, velocity: 1 m/s}
      pad: {type: Contact, method: hold, normal_force: 10 N, curve: 0.5}
      other: {type: Damper, damping: 3 N*s/m}
    connections: [[wall.flange, pad.a], [pad.b, other.a], [other.b, block.flange]]
    run: {stop: 1 s, accuracy: 1e-7, engine: rodas}
    """
    result = simulate(text)
    assert not result.events
    assert result["block.v"][-1] == pytest.approx(np.exp(-1.5), rel=1e-6)
    assert np.abs(result["pad.slip"]).max() < 1e-12
    sprung = simulate(text.replace("{type: Damper, damping: 3 N*s/m}", "{type: Spring, stiffness: 3 N/m}"))
    assert sprung["block.v"][-1] == pytest.approx(np.cos(1.5**0.5), rel=1e-6)

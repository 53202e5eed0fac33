"""Rigid contacts side by side: one that comes to stiction first and falls to sliding friction in place is told of.

How they share a load is not determined. By least squares, pads of 6 and 4.2 N carry half each: the weaker falls to
3.5 N at a load of 8.4 N, and the stronger lets go at 6 + 3.5 N. Had it held its 4.2 N, they had carried 10.2 N.
"""

from __future__ import annotations

import warnings

import pytest

from fairlead.errors import RunWarning
from tests.conftest import Scene

PADS = """
    components:
      floor: {{type: Ground}}
      block: {{type: Mass, mass: 1 kg}}
      push: {{type: ForceSource, force: {{drift: {{rate: {rate} N/s}}}}}}
      {pads}
    connections: [[floor.flange, {feet}], [block.flange, push.flange, {heads}]]
    run: {{stop: 6 s, accuracy: 1e-5, engine: {engine}}}
"""


def pads(*limits: tuple[float, float], engine: str = "rodas", rate: float = 2.0, size: float = 1.0) -> str:
    """A block on pads side by side, of stiction and sliding friction [N], pushed by a load that grows."""
    curve = "curve: {{curve: coulomb, stiction: {:.6g}, coulomb: {:.6g}}}"
    kinds = [curve.format(*(force / 10 for force in one)) for one in limits]
    names = [f"pad{k}" for k in range(len(limits))]
    listed = "\n      ".join(f"{n}: {{type: Contact, normal_force: {10 * size} N, {c}}}" for n, c in zip(names, kinds))
    return PADS.format(
        pads=listed, feet=", ".join(f"{n}.a" for n in names), heads=", ".join(f"{n}.b" for n in names),
        engine=engine, rate=rate * size,
    )  # fmt: skip


UNEQUAL = (6.0, 5.0), (4.2, 3.5)


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_contact_that_falls_in_place_is_told_with_when_and_what_else_may_be(simulate: Scene, engine: str) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        result = simulate(pads(*UNEQUAL, engine=engine))
    (one,) = result.run["gave_way"]["first"]
    assert one["contact"] == "pad1"
    assert one["t"] == pytest.approx(8.4 / 2, rel=2e-3)
    assert one["left"] == pytest.approx(3.5 / 4.2)
    (said,) = [str(w.message) for w in told if issubclass(w.category, RunWarning) and "stiction" in str(w.message)]
    assert "pad1" in said
    assert "4.2" in said
    assert "83.3 %" in said


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(
    ("limits", "gave"),
    [
        (UNEQUAL, {"pad1"}),
        (UNEQUAL[::-1], {"pad0"}),
        (((6.0, 5.0), (6.0, 5.0)), set()),  # equal ones let go together, and the block moves
        (((6.0, 5.0), (4.2, 4.2)), set()),  # what does not fall goes on carrying its limit
        (((6.0, 5.0),), set()),
        (((6.0, 5.0), (4.2, 3.5), (1.0, 0.9)), {"pad1", "pad2"}),
    ],
)
def test_only_what_falls_while_others_hold_the_body_is_told(
    simulate: Scene, limits: tuple[tuple[float, float], ...], gave: set[str], size: float
) -> None:
    result = simulate(pads(*limits, size=size).replace("1 kg", f"{size} kg"))
    assert {one["contact"] for one in result.run["gave_way"]["first"]} == gave


def test_a_sudden_load_above_all_limits_is_no_matter_of_shares(simulate: Scene) -> None:
    """All let go in one instant, one after another: the block moves, and nothing is told."""
    scene = pads(*UNEQUAL).replace("{drift: {rate: 2.0 N/s}}", "{step: {from: 0 N, to: 20 N, at: 1 s}}")
    assert "step" in scene
    assert simulate(scene).run["gave_way"]["count"] == 0


def test_through_a_gear_and_a_third_body_as_well(simulate: Scene) -> None:
    """A pad at the block, and one at a rack that turns with it: the shafts are one body, and the circle is closed."""
    result = simulate("""
    components:
      floor: {type: Ground}
      push: {type: ForceSource, force: {drift: {rate: 2 N/s}}}
      wheel: {type: Inertia, moment: 1 kg*m^2}
      near: {type: Rack, radius: 1 m}
      far: {type: Rack, radius: 0.5 m}
      one: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.6, coulomb: 0.5}}
      two: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.1, coulomb: 0.05}}
    connections:
      - [near.rack, push.flange, one.b]
      - [wheel.shaft, near.pinion, far.pinion]
      - [far.rack, two.b]
      - [floor.flange, one.a, two.a]
    run: {stop: 5 s, accuracy: 1e-5}
    """)
    assert [one["contact"] for one in result.run["gave_way"]["first"]] == ["two"]


WEAK = (3.0, 1.0), (2.0, 1.0)


def _said(result) -> list[str]:
    return [said for said in result.run["remarks"] if "side by side" in said]


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize(
    ("limits", "load"),
    [(WEAK, 4.0), (WEAK[::-1], 4.0), (((5.0, 2.0), (2.0, 0.5), (1.9, 0.4)), 3 * 1.9)],
    ids=["two", "the other way round", "three"],
)
def test_one_that_takes_the_others_with_it_is_told_as_well(
    simulate: Scene, engine: str, limits: tuple[tuple[float, float], ...], load: float
) -> None:
    """Two carry half each; the weaker is at its 2 N at a load of 4 N, and the other cannot carry the 3 N left."""
    if len(limits) == 3:
        limits = ((2.3, 0.2), *limits[1:])  # what the third leaves is above 2.3 and 2 N
    result = simulate(pads(*limits, engine=engine))
    (first, *_) = result.run["gave_way"]["first"]
    assert first["moved"]
    assert first["t"] == pytest.approx(load / 2, rel=2e-3)
    (said,) = _said(result)
    assert "could not carry the rest, and let go with it" in said
    assert "without moving" not in said
    assert result["block.v"][-1] > 0.1


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("limits", [((3.0, 1.0), (3.0, 1.0)), ((3.0, 1.0),), ((3.0, 3.0), (2.0, 2.0))])
def test_contacts_that_are_alike_or_do_not_fall_are_not(simulate: Scene, engine: str, limits) -> None:
    assert not _said(simulate(pads(*limits, engine=engine)))


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_karnopp_keeps_its_stiction_and_is_not_told_to_have_lost_it(simulate: Scene, engine: str) -> None:
    """Both keep their limits until the slip is out of the band: at 4.9 N nothing moves, and at 5 N and more it does."""
    text = pads(*WEAK, engine=engine) + "    friction: {method: karnopp}\n"
    result = simulate(text.replace("stop: 6 s", "stop: 2.45 s"))
    assert result["pad1.friction"][-1] == pytest.approx(2.0)
    assert abs(result["block.v"][-1]) < 1e-9
    assert not _said(result)
    assert not _said(simulate(text))


def test_nor_is_a_load_by_signal_that_jumps_above_all_limits(simulate: Scene) -> None:
    """All of the force is asked for at once."""
    text = pads(*UNEQUAL).replace("{type: ForceSource, force: {drift: {rate: 2.0 N/s}}}", "{type: ForceActuator}")
    hand = "      hand: {type: SignalSource, value: {step: {to: 20, at: 1 s}}}"
    text = text.replace("      floor:", f"{hand}\n      floor:")
    text = text.replace("connections: [", "connections: [[hand.signal, push.force], ")
    assert not _said(simulate(text))

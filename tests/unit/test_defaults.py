"""What a netlist gets that says nothing: what the study of docs/accuracy.md recommends, and how a creep is told."""

import pathlib
import re

import pytest

from fairlead.component.registry import known_types
from fairlead.errors import ModelError
from fairlead.netlist.settings import RunSettings

PAGE = pathlib.Path(__file__).parents[2] / "docs" / "accuracy.md"
BLOCK = """\
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  pad: {type: Contact, normal_force: 10 N, curve: 0.4PAD}
  hand: {type: ForceSource, force: 3 N}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, hand.flange]
run: {stop: 1 s}
"""
BRAKE = """\
components:
  brake: {type: Brake, radius: 0.2 m, curve: 0.4, normal_force: 100 N, creep: 1 mm/s}
  flywheel: {type: Inertia, moment: 1 kg*m^2}
connections: [[brake.shaft, flywheel.shaft]]
run: {stop: 1 s}
"""


def studied() -> dict[tuple[str, float], int]:
    """(treatment, accuracy) -> number of models within 1 %, from the last row of the table of the defaults."""
    rows = [line.strip("| ").split(" | ") for line in PAGE.read_text(encoding="utf-8").splitlines() if "|" in line]
    head = next(row for row in rows if "binding 1e-2" in row)
    last = next(row for row in rows if row[0] == "within 1 %")
    found = {}
    for name, cell in zip(head, last, strict=False):
        if of := re.match(r"\*\*(\d+) of \d+", cell):
            method, _, accuracy = name.rpartition(" ")
            found[method, float(accuracy)] = int(of[1])
    return found


def test_the_defaults_are_the_choice_with_most_models_within_one_percent():
    found = studied()
    assert len(found) == 7
    best = max(found, key=lambda choice: found[choice])
    assert best == (known_types()["Contact"].default_word, RunSettings(stop=1.0).accuracy)
    assert list(found.values()).count(found[best]) == 1


def test_a_block_without_a_word_on_friction_does_not_creep(simulate):
    result = simulate(BLOCK.replace("PAD", ""))
    assert abs(result["pad.slip"]).max() == 0
    assert abs(result["block.x"]).max() == 0


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            BLOCK.replace("PAD", ", creep: 1 mm/s"),
            r"scene0.yaml:6:56: pad.creep: Contact \(method: hold\) has no parameter creep; it belongs to method "
            r"binding, .*tanh.*\.\n    Write method: binding, or leave creep out.",
        ),
        (
            BLOCK.replace("PAD", "") + "friction: {creep: 1 mm/s}\n",
            r"scene0.yaml:12:12: friction.creep: no contact of the scene takes it; it belongs to method "
            r"binding, .*\n    Write friction: \{method: binding, creep: ...\}, or leave creep out",
        ),
        (
            BRAKE,
            r"scene0.yaml:4:3: brake.creep: nobody chose a treatment of friction, and hold does not creep.\n"
            r"    Write method: binding beside it, or leave creep out.",
        ),
    ],
    ids=["contact", "scene", "brake"],
)
def test_a_creep_without_a_method_is_told_with_a_way_out(scene, text, said):
    with pytest.raises(ModelError, match=said):
        scene(text).check()


@pytest.mark.parametrize(("where", "method"), [("friction", "hold"), ("friction", "binding"), ("pad", "hold")])
def test_where_a_method_is_said_a_creep_of_the_scene_waits_for_one_that_takes_it(scene, where, method):
    text = BLOCK.replace("PAD", "") + "friction: {creep: 1 mm/s}\n"
    assert scene(text, **{f"{where}.method": method}).check() == []


def test_a_null_takes_away_what_a_contact_says_of_another_method(scene):
    text = BLOCK.replace("PAD", ", method: binding, creep: 1 mm/s, form: literal")
    settings = {"pad.method": "hold", "pad.creep": "null", "pad.form": "null"}
    assert scene(text, **settings).check() == []
    with pytest.raises(ModelError, match=r"pad.form: .* has no parameter form; it belongs to method binding\."):
        scene(text, **{**settings, "pad.form": "literal"}).check()

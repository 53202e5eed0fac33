"""The published JSON Schema: draft-07, accepts every bundled model as typed, and rejects mistakes."""

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import fairlead
from fairlead.component import Component, Parameter, Translational
from fairlead.component.json_schema import draft7, json_schema
from fairlead.component.registry import known_types
from fairlead.netlist.yaml12 import read_yaml

MODELS = sorted((Path(__file__).parents[2] / "models").glob("*.yaml"))
SCENE = """
schema: 1
parameters: {mu: 0.3, method: hold, push: 3 N}
components:
  ground: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}}
  rope: {type: Tether, stiffness: 1 kN/m}
  push: {type: ForceSource, force: {ramp: {to: 3 N, over: 1 s}}}
  route: {type: Route, stations: [{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: 0.3}]}
connections:
  - [ground.flange, pad.a]
  - [block.flange, pad.b, push.flange]
friction: {method: hold}
effects: {energy: off}
run: {stop: 1 s}
record: {every: 1 ms, plots: [{title: Slip, signals: [pad.slip]}]}
"""


@pytest.fixture(scope="module")
def schema() -> dict[str, Any]:
    return fairlead.json_schema()


@pytest.fixture(scope="module")
def validator(schema: dict[str, Any]) -> jsonschema.Draft7Validator:
    return jsonschema.Draft7Validator(schema)


def plain(text: str) -> Any:
    """A netlist as an editor's language server sees it, expressions not yet worked out."""
    tree, faults = read_yaml(text, "scene.yaml")
    assert tree is not None
    assert not faults
    return tree.plain()


def changed(path: str, value: Any) -> Any:
    """The scene with one value put in; REMOVE takes it away."""
    scene = copy.deepcopy(plain(SCENE))
    *owners, last = path.split("/")
    node = scene
    for key in owners:
        node = node[int(key)] if isinstance(node, list) else node[key]
    if value is REMOVE:
        del node[last]
    elif isinstance(node, list):
        node[int(last)] = value
    else:
        node[last] = value
    return scene


REMOVE = object()


def test_it_is_a_valid_draft_07_schema(schema: dict[str, Any]) -> None:
    jsonschema.Draft7Validator.check_schema(schema)
    assert schema["$schema"] == "http://json-schema.org/draft-07/schema#"
    text = json.dumps(schema)
    assert not any(f'"{word}":' in text for word in ("$defs", "prefixItems", "discriminator", "gt", "ge"))


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_every_bundled_model_is_accepted(path: Path, validator: jsonschema.Draft7Validator) -> None:
    assert [error.message for error in validator.iter_errors(plain(path.read_text(encoding="utf-8")))] == []


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("components/block/mass", "{2*mu} kg"),
        ("components/block/mass", 2),
        ("components/pad/method", "{method}"),
        ("components/pad/method", "tanh"),
        ("components/pad/curve", "{mu}"),
        ("components/pad/curve", 0.3),
        ("components/pad/curve", {"coulomb": 0.3}),
        ("components/pad/curve", {"curve": "table", "points": [[0, 0.5], ["10 mm/s", 0.4]]}),
        ("components/pad/creep", "0.1 mm/s"),
        ("components/push/force", "{push}"),
        ("components/push/force", "3 N"),
        ("friction", None),
        ("friction/creep", "{mu}"),
        ("run/stop", "{mu} s"),
        ("run/max_steps", "{100*mu}"),
        ("limits", {"pad.slip": {"below": "1 m/s"}}),
    ],
)
def test_forms_that_the_netlist_allows_are_accepted(
    path: str, value: Any, validator: jsonschema.Draft7Validator
) -> None:
    assert [error.message for error in validator.iter_errors(changed(path, value))] == []


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("components/block/type", "Mas"),
        ("components/block/type", REMOVE),
        ("components/block/mass", REMOVE),
        ("components/block/mass", "heavy"),
        ("components/block/mass", -1),
        ("components/block/mass", [1]),
        ("components/block/weight", "2 kg"),
        ("components/Block", {"type": "Mass", "mass": 1}),
        ("components/pad/method", "glue"),
        ("components/pad/normal", "10 N"),
        ("components/pad/stick_velocity", "10 N"),
        ("components/pad/curve", "stribek"),
        ("components/pad/curve", REMOVE),
        ("components/pad/curve/velocity", REMOVE),
        ("components/pad/curve/curve", "hump"),
        ("components/pad/curve/speed", 1),
        ("components/push/force", {"ram": 3}),
        ("components/route/stations", {"bend": 1}),
        ("components/route/stations/0/type", "Bent"),
        ("components/route/stations/0/radius", REMOVE),
        ("connections/0", ["ground.flange"]),
        ("connections/0", ["ground", "pad.a"]),
        ("friction/methode", "hold"),
        ("run/stop", REMOVE),
        ("run", REMOVE),
        ("run/engine", "euler"),
        ("record/evry", "1 ms"),
        ("conections", []),
        ("schema", 2),
    ],
)
def test_mistakes_are_rejected(path: str, value: Any, validator: jsonschema.Draft7Validator) -> None:
    validator.validate(plain(SCENE))
    assert not validator.is_valid(changed(path, value))


def test_the_method_decides_which_parameters_a_contact_has(validator: jsonschema.Draft7Validator) -> None:
    scene = changed("components/pad/method", "hold")
    scene["components"]["pad"]["creep"] = "0.1 mm/s"
    assert not validator.is_valid(scene)
    scene["components"]["pad"]["method"] = "binding"
    assert validator.is_valid(scene)


def test_hover_texts_say_what_and_how(schema: dict[str, Any]) -> None:
    stiffness = schema["definitions"]["Spring"]["properties"]["stiffness"]["description"]
    assert stiffness.startswith("Tension per stretch.")
    assert "500 kN/m" in stiffness
    assert "Linear spring" in schema["definitions"]["Spring"]["description"]


@pytest.mark.slow
def test_a_class_of_the_user_is_in_the_schema() -> None:
    class Sticker(Component):
        """Made up for this test."""

        a = Translational()
        grip = Parameter("N", "How hard.", least=0)

        def law(p, a):
            return (p.grip * a.v,)

    validator = jsonschema.Draft7Validator(json_schema({**known_types(), "Sticker": Sticker}))
    assert validator.is_valid(changed("components/block", {"type": "Sticker", "grip": "3 N"}))
    assert not validator.is_valid(changed("components/block", {"type": "Sticker", "gripp": "3 N"}))


def test_what_pydantic_says_in_2020_12_is_said_in_draft_07() -> None:
    emitted = {
        "$defs": {"Pair": {"type": "array", "prefixItems": [{"type": "string"}, {"type": "string"}], "items": False}},
        "properties": {"title": {"$ref": "#/$defs/Pair", "description": "Two words."}},
    }
    pair = {"type": "array", "items": [{"type": "string"}] * 2, "additionalItems": False, "description": "Two words."}
    assert draft7(emitted) == {"properties": {"title": pair}}

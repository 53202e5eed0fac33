"""Parameters are checked by a model of the members that are named; what it says is what the model of all says."""

from pathlib import Path
from typing import Any

import pytest

from fairlead.component import parameters
from fairlead.component.registry import known_types
from fairlead.errors import Location
from fairlead.netlist.netlist import Value

HERE = Location("x.yaml", 1, 1)
PAD = {"normal_force": "10 N"}
WRITTEN: dict[str, tuple[str, dict[str, Any]]] = {
    "a member by name": ("Contact", {**PAD, "curve": {"curve": "stribeck", "stiction": 0.5, "coulomb": 0.4}}),
    "a bare number": ("Contact", {**PAD, "curve": 0.4}),
    "no member": ("Contact", PAD),
    "a word that is none": ("Contact", {**PAD, "curve": "stribek"}),
    "a setting of another member": ("Contact", {**PAD, "curve": {"curve": "coulomb", "velocity": "1 m/s"}}),
    "a wrong unit inside": ("Contact", {**PAD, "curve": {"curve": "coulomb", "stiction": "1 N", "coulomb": 0.4}}),
    "no map": ("Contact", {**PAD, "curve": [1, 2]}),
    "a word that is no text": ("Contact", {**PAD, "curve": {"curve": [1]}}),
    "stations of two sorts": ("Route", {"stations": [
        {"type": "Bend", "start": "3 m", "angle": "90 deg", "radius": "1 m", "friction": 0.3},
        {"type": "Straight", "start": "5 m", "length": "2 m"}]}),
    "a station of no sort": ("Route", {"stations": [{"type": "Bend", "start": "3 m"}, {"type": "Bent"}]}),
    "stations without a list": ("Route", {"stations": 3}),
}  # fmt: skip


def value(written: Any) -> Value:
    if isinstance(written, dict):
        return Value({name: value(one) for name, one in written.items()}, HERE)
    return Value([value(one) for one in written] if isinstance(written, list) else written, HERE)


def named(name: str) -> Any:
    kind = known_types()[name]
    return kind.members["hold"] if name == "Contact" else kind


def told(kind: type, raw: dict[str, Value]) -> tuple[Any, list[str]]:
    values, faults = parameters.read(kind, raw, "one", HERE, Path())
    return flat(values), [str(fault) for fault in faults]


def flat(values: Any) -> Any:
    if hasattr(values, "given"):
        return values.type, {name: flat(one) for name, one in values.given.items()}
    return [flat(one) for one in values] if isinstance(values, list) else repr(values)


@pytest.mark.parametrize("case", WRITTEN)
def test_what_is_written_means_the_same_to_both(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, written = WRITTEN[case]
    kind, raw = named(name), {key: value(one) for key, one in written.items()}
    found = told(kind, raw)
    monkeypatch.setattr(parameters, "_named_members", lambda *_: None)
    assert found == told(kind, raw)
    assert (found[0] is None or found[0] == "None") == (found[1] != [])


def test_members_that_nobody_names_are_not_made(monkeypatch: pytest.MonkeyPatch) -> None:
    kind, asked = named("Contact"), []
    raw = {"normal_force": value("10 N"), "curve": value({"curve": "coulomb", "stiction": 0.5, "coulomb": 0.4})}
    model_of = parameters.model_of
    monkeypatch.setattr(parameters, "model_of", lambda one: asked.append(one.__name__) or model_of(one))
    parameters._model.cache_clear()
    assert parameters.read(kind, raw, "pad", HERE, Path())[1] == []
    assert asked == ["Coulomb"]

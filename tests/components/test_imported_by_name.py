"""The bundled library is imported by name: what a scene needs and no more, with whole families in one order."""

import json
import subprocess
import sys

import pytest

from fairlead.component import Controller
from fairlead.component.base import Declared, check_declared, slips_of
from fairlead.component.bundled import Bundled, bundled, written
from fairlead.netlist.files import bundled_models

TELL = """
def tell():
    from fairlead.component.base import Family
    kinds = list(Family.__subclasses__())
    for kind in kinds:
        kinds += kind.__subclasses__()
    heads = {f"{k.__module__}.{k.__name__}": list(k.members) for k in kinds if "members" in k.__dict__}
    modules = sorted(name for name in sys.modules if name.startswith("fairlead.components."))
    print(json.dumps([heads, modules]))
"""


def told_by(statement: str) -> tuple[dict[str, list[str]], list[str]]:
    """Members by the head of their family, and the modules of the library that are in memory, after `statement`."""
    script = f"import json, sys\n{TELL}\n{statement}\ntell()"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, timeout=600)
    heads, modules = json.loads(done.stdout.splitlines()[-1])
    return heads, modules


ALL = "from fairlead.component.bundled import bundled; bundled()"


@pytest.fixture(scope="module")
def everything() -> tuple[dict[str, list[str]], list[str]]:
    return told_by(ALL)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["belt", "single_bend"])
def test_a_scene_imports_a_part_of_the_library_and_whole_families_in_their_order(model, everything) -> None:
    heads, modules = told_by(f"import fairlead; fairlead.load('{model}').assembly")
    assert 0 < len(modules) < 0.6 * len(everything[1])
    assert heads == {head: everything[0][head] for head in heads}


@pytest.mark.slow
@pytest.mark.parametrize("model", sorted(bundled_models()))
def test_every_scene_has_whole_families_in_their_order(model, everything) -> None:
    heads, _ = told_by(f"import fairlead; fairlead.load('{model}').assembly")
    assert heads == {head: everything[0][head] for head in heads}


def test_the_texts_tell_where_every_type_and_member_stands() -> None:
    known = written()
    assert known is not None
    for name, kind in bundled().items():
        assert kind.__module__ in known.where[name]
        for member in getattr(kind, "members", {}).values():
            assert (member.__module__, member.__name__) in known.place or not member.__module__.startswith("fairlead.")


def test_a_class_by_name_is_that_of_the_whole_library_and_an_unknown_one_is_none() -> None:
    types = Bundled()
    assert {name: types[name] for name in bundled()} == bundled()
    assert types.get("Sprung") is None
    assert "Placed" not in types  # a class of the library that is no type
    assert [head.__name__ for head in types.heads()] == ["Contact"]


def bundled_classes() -> list[type[Declared]]:
    """All classes of the library, half-models too."""
    bundled()
    kinds = list(Declared.__subclasses__())
    for kind in kinds:
        kinds += kind.__subclasses__()
    return [kind for kind in kinds if kind.__module__.startswith("fairlead.components.")]


def test_no_bundled_class_has_a_slip_of_the_pen() -> None:
    ours = bundled_classes()
    assert len(ours) > 200
    assert {kind.__name__: slips for kind in ours if (slips := list(slips_of(kind)))} == {}


def test_bundled_classes_are_declared_as_those_of_a_user_must_be() -> None:
    """It is asked here and not whenever one is created, which took a fiftieth of a short command."""
    whole = [one for one in bundled_classes() if "declaration" in vars(one) and not issubclass(one, Controller)]
    assert len(whole) > 150
    for kind in whole:
        check_declared(kind)


OWN = """
from fairlead.component import Parameter
from fairlead.components.friction.curve import Curve

class Coulomb(Curve):
    "One of a user's own under a bundled word."
    coulomb = Parameter("1", "Coefficient.")
    stiction = Parameter("1", "Coefficient at rest.")

    def coefficient(p, v):
        return p.coulomb

import fairlead
fairlead.load("belt").assembly
assert Curve.members["coulomb"] is Coulomb, Curve.members
"""


@pytest.mark.slow
def test_a_member_of_ones_own_counts_although_the_bundled_one_of_its_word_is_imported_later() -> None:
    told_by(OWN)

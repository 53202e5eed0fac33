"""Kernels that a wheel brings traced and lowered: the same machine code, and only where they fit."""

import json
import pathlib
from collections.abc import Iterator
from typing import Any

import pytest

import fairlead
import fairlead.kernels.lowered_ahead as lowered_ahead
import fairlead.native as native
import fairlead.system.callbacks.table as table
from fairlead.component import Component, Law, Parameter, Translational
from fairlead.component.parameters import make
from fairlead.component.values import Variant, variant_of
from fairlead.kernels.kernel import _build, lowered


@pytest.fixture
def variants() -> list[Variant]:
    """Those of a small bundled model."""
    return list(dict.fromkeys(one.variant for one in fairlead.load("belt").flat.instances))


@pytest.fixture
def file(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch, variants: list[Variant]) -> Iterator[pathlib.Path]:
    """A file with the kernels of these, where that of a wheel would be."""
    path = tmp_path / "bundled.kernels"
    lowered_ahead.write(path, {lowered_ahead.name_of(one, 0): lowered(one, 0) for one in variants})
    monkeypatch.setattr(lowered_ahead, "FILE", path)
    lowered_ahead._stored.cache_clear()
    yield path
    lowered_ahead._stored.cache_clear()


def machine_code(variant: Variant) -> bytes:
    """What the cache would hold of a kernel."""
    return native.object_code(_build(variant).functions["kernel"].inspect_llvm())


def test_the_machine_code_is_that_of_a_kernel_traced_here(
    file: pathlib.Path, monkeypatch: pytest.MonkeyPatch, variants: list[Variant]
) -> None:
    assert file.exists()
    brought = [machine_code(one) for one in variants]
    facts = [_build(one).meta for one in variants]
    monkeypatch.setattr("fairlead.kernels.kernel.find", lambda variant, rated: None)
    assert brought == [machine_code(one) for one in variants]
    traced = [json.loads(json.dumps(_build(one).meta)) for one in variants]
    assert facts == traced


def test_a_kernel_that_is_brought_is_not_traced(
    file: pathlib.Path, monkeypatch: pytest.MonkeyPatch, variants: list[Variant]
) -> None:
    def refuse(variant: Variant, rated: int) -> None:
        raise AssertionError(f"{variant.label} was traced")

    monkeypatch.setattr("fairlead.kernels.kernel.write_source", refuse)
    assert all(_build(one).functions for one in variants)
    with pytest.raises(AssertionError, match="was traced"):
        _build(variants[0], 1)  # with the rates of its flows: another kernel


@pytest.mark.parametrize("named", ["sources", "this_system"])
def test_what_was_made_of_other_sources_or_for_another_system_is_not_used(
    file: pathlib.Path, monkeypatch: pytest.MonkeyPatch, variants: list[Variant], named: str
) -> None:
    assert lowered_ahead.find(variants[0], 0)
    lowered_ahead._stored.cache_clear()
    monkeypatch.setattr(lowered_ahead, named, lambda: "another")
    assert lowered_ahead.find(variants[0], 0) is None


def test_a_torn_file_is_as_good_as_none(file: pathlib.Path, variants: list[Variant]) -> None:
    file.write_bytes(file.read_bytes()[:-1])
    assert lowered_ahead.find(variants[0], 0) is None
    lowered_ahead._stored.cache_clear()
    file.unlink()
    assert lowered_ahead.find(variants[0], 0) is None


class Rod(Component):
    """A spring of a user."""

    a, b = Translational("one end"), Translational("the other end")
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)

    def law(p: Any, a: Any, b: Any) -> Law:
        """Tension."""
        tension = p.stiffness * (b.x - a.x)
        return Law(a=-tension, b=+tension, stored=p.stiffness * (b.x - a.x) ** 2 / 2)


def test_a_class_of_a_user_is_traced_whatever_the_file_holds(
    file: pathlib.Path, variants: list[Variant], monkeypatch: pytest.MonkeyPatch
) -> None:
    variant = variant_of(make(Rod, stiffness=1.0))
    given = lowered(variants[0], 0)
    lowered_ahead.write(file, {lowered_ahead.name_of(variant, 0): given})
    assert lowered_ahead.find(variant, 0) is None


def test_what_goes_with_every_model_is_brought_optimised(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The machine code is made of the file alone, and of sources that are others it is not taken."""

    def refuse(*given: Any, **named: Any) -> None:
        raise AssertionError("was lowered anew")

    name, path = table.name_ahead(), tmp_path / "bundled.kernels"
    lowered_ahead.write(path, {name: table.compiled_ahead("generic")})
    monkeypatch.setattr(lowered_ahead, "FILE", path)
    lowered_ahead._stored.cache_clear()
    monkeypatch.setattr("fairlead.kernels.lowering.lower_together", refuse)
    build = table._build()
    assert set(build.functions) == set(table.CALLBACKS)
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path / "cache"))
    code = native.load_or_compile("callbacks", lambda: build)
    assert len(set(code.address.values())) == len(table.CALLBACKS)
    monkeypatch.setattr(table, "name_ahead", lambda: "callbacks of other sources")
    with pytest.raises(AssertionError, match="lowered anew"):
        table._build()
    lowered_ahead._stored.cache_clear()

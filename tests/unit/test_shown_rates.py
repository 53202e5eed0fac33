"""What outputs read that is known only after the forces: found by the laws that give it, as by all of them."""

import ctypes
from types import SimpleNamespace

import numpy as np
import pytest

import fairlead
from fairlead.kernels import layout
from tests.unit.test_following import WITHOUT_INERTIA

CALL = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_double, ctypes.c_int64, ctypes.c_int64)
SCENES = ("belt", "hundred_blocks", "single_bend", "capstan", "guidance_route", "long_deployment")
FEW = 6
"""Signals of one kind that are asked for."""


def late_names(system):
    """Names of outputs that read an acceleration or a reaction, some of each kind."""
    found, kinds = [], {}
    for signal in system.signals:
        kind = (signal.name.split("[")[0], signal.name.rpartition(".")[2])
        kinds[kind] = kinds.get(kind, 0) + 1
        if kinds[kind] <= FEW and system.recording([signal.name]).late:
            found.append(signal.name)
    return found


def rows(system, names, rates, seed):
    """One row of these signals near the start, and `rates` of the context, which is put there if given."""
    asked = SimpleNamespace(accuracy=None, record=names, start=0.0)
    here = system.instance(asked)
    context = here.memory["context"]
    if rates is not None:
        context[layout.RATES_SHOWN] = rates
    y = here.initial + 1e-3 * np.random.default_rng(seed).normal(size=here.n)
    out = np.zeros(here.n_outputs)
    CALL(here.callbacks["outputs"])(here.context, 0.3, y.ctypes.data, out.ctypes.data)
    return out, int(context[layout.RATES_SHOWN])


@pytest.mark.parametrize("name", SCENES)
def test_some_laws_give_the_same_row_as_all(name):
    """To the last bit, since they add up in the same order."""
    system = fairlead.load(name).system
    names = late_names(system)
    assert names
    for one in [names, *([name] for name in names[:FEW])]:
        for seed in (0, 1):
            all_asked, _ = rows(system, one, layout.ALL_RATES, seed)
            some, rates = rows(system, one, None, seed)
            assert rates != layout.NO_RATES
            assert np.array_equal(some, all_asked)


@pytest.mark.slow
def test_of_a_long_line_few_laws_are_asked_for_the_force_of_a_source():
    system = fairlead.load("long_deployment").system
    record = system.recording(["belts.force", "line.core[*].tension"])
    assert record.rates == layout.SOME_RATES
    asked = sum(end - first for _, first, end in record.shown_flows.tolist())
    everyone = sum(block.count for block in system.blocks if layout.FLOWS in block.kernel.structure.modes)
    assert 0 < asked < 0.2 * everyone


def test_what_is_known_before_the_forces_asks_for_none():
    system = fairlead.load("belt").system
    record = system.recording([])
    assert record.rates == layout.NO_RATES
    assert not len(record.shown_flows)


def test_where_rows_are_no_sums_of_flows_all_laws_are_asked(tmp_path):
    (tmp_path / "light.yaml").write_text(WITHOUT_INERTIA)
    system = fairlead.load(tmp_path / "light.yaml").system
    assert system.recording(["hand.force"]).rates == layout.ALL_RATES

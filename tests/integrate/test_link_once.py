"""Functions that are linked and optimised once: the same code, and no trace left in numba."""

from __future__ import annotations

import ctypes

import numba
import pytest
from numba.core.codegen import JITCodeLibrary
from numba.core.registry import cpu_target

import fairlead.native as native
from fairlead.integrate.link_once import linked_once

SIGNATURE = numba.float64(numba.int64)


def inner_and_outer():
    inner = numba.njit(error_model="numpy", _nrt=False, no_cpython_wrapper=True, no_cfunc_wrapper=True)(
        lambda k: 1.0 / (1.0 + k)
    )

    def outer(n):
        total = 0.0
        for k in range(n):
            total += inner(k)
        return total

    return inner, outer


def called(function) -> float:
    loaded = native._load(*native._compiled(native.Build({}, {"outer": function})), cached=False)
    return ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_int64)(loaded.address["outer"])(1000)


@pytest.mark.slow
def test_a_function_and_what_it_calls_give_the_same_number_linked_once_or_as_numba_links():
    expected = sum(1.0 / (1.0 + k) for k in range(1000))  # a sum in the same order is the same to the last bit
    _, outer = inner_and_outer()
    with linked_once():
        late = numba.cfunc(SIGNATURE, error_model="numpy", _nrt=False)(outer)
    _, outer = inner_and_outer()
    usual = numba.cfunc(SIGNATURE, error_model="numpy", _nrt=False)(outer)
    assert called(late) == called(usual) == expected


def test_a_function_that_was_left_to_be_linked_is_there_for_those_that_numba_links():
    inner, outer = inner_and_outer()
    with linked_once():
        numba.cfunc(SIGNATURE, error_model="numpy", _nrt=False)(outer)
    assert inner.signatures  # typed and lowered inside
    usual = numba.cfunc(SIGNATURE, error_model="numpy", _nrt=False)(outer)
    assert usual.ctypes(1000) == sum(1.0 / (1.0 + k) for k in range(1000))


def test_numba_is_left_as_it_was_even_after_a_mistake():
    generator = cpu_target.target_context.codegen()
    before = (generator._library_class, generator.set_env)
    with pytest.raises(ZeroDivisionError), linked_once():
        raise ZeroDivisionError
    assert (generator._library_class, generator.set_env) == before
    assert generator._library_class is JITCodeLibrary


def test_where_numba_is_built_otherwise_functions_are_made_as_numba_makes_them(monkeypatch):
    class Other(JITCodeLibrary):
        pass

    generator = cpu_target.target_context.codegen()
    monkeypatch.setattr(generator, "_library_class", Other)
    with linked_once():
        assert generator._library_class is Other

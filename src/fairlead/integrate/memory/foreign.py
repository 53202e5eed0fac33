"""Compiled code's view of the outside: arrays at addresses and C functions at addresses.

Imported only when the loop is compiled (it needs numba).
"""

from __future__ import annotations

import operator
import os
from typing import Any

import numba
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, lower_builtin, models, register_model
from numba.np import arrayobj

from fairlead.integrate.memory.layout import CHECK, LAYOUT

compiled = numba.njit(error_model="numpy", _nrt=False, no_cpython_wrapper=True, no_cfunc_wrapper=True)
"""How every function of the loop is compiled: no exceptions, no reference counts."""

MEMORY = numba.from_dtype(LAYOUT)


class View(types.Array):
    """Values at an address, for indices that are never negative.

    numba asks of every index of its own arrays whether it counts from the end. The loop never does that, and where an
    index is read from an array, as in all that is sparse, the question took up to 40 % of the time. With
    FAIRLEAD_CHECK_INDICES set the loop is compiled to trap where an index lies outside.
    """

    def __init__(self, kind: types.Type) -> None:
        super().__init__(kind, 1, "C", name=f"view({kind})")


register_model(View)(models.ArrayModel)


def _place(context: Any, builder: Any, view: types.Type, value: Any, index: Any) -> Any:
    """Pointer to the value at `index`."""
    made = arrayobj.make_array(view)(context, builder, value)
    if os.environ.get(CHECK):
        outside = builder.icmp_unsigned(">=", index, builder.extract_value(made.shape, 0))
        with builder.if_then(outside, likely=False):
            builder.call(builder.module.declare_intrinsic("llvm.trap", (), ir.FunctionType(ir.VoidType(), [])), [])
            builder.unreachable()
    return builder.gep(made.data, [index], inbounds=True)


@lower_builtin(operator.getitem, View, types.Integer)
def _read(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    view, _ = signature.args
    return builder.load(_place(context, builder, view, *arguments))


@lower_builtin(operator.setitem, View, types.Integer, types.Number)
def _write(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    view, _, kind = signature.args
    value, index, given = arguments
    builder.store(context.cast(builder, given, kind, view.dtype), _place(context, builder, view, value, index))
    return context.get_dummy_value()


def _array_of(kind: types.Type) -> Any:
    """An intrinsic that views `length` values of type `kind` at an address; numba's carray, inlined."""
    array = View(kind)

    @intrinsic
    def view(_context: Any, address: types.Type, length: types.Type) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
            address, length = arguments
            made = arrayobj.make_array(array)(context, builder)
            itemsize = context.get_constant(types.intp, 8)
            arrayobj.populate_array(
                made,
                data=builder.inttoptr(address, context.get_value_type(types.CPointer(kind))),
                shape=cgutils.pack_array(builder, [length]),
                strides=cgutils.pack_array(builder, [itemsize]),
                itemsize=itemsize,
                meminfo=None,
            )
            return made._getvalue()

        return array(types.int64, types.int64), generate

    return view


reals = _array_of(types.float64)
"""reals(address, length): the array of doubles there."""
indices = _array_of(types.int64)
"""indices(address, length): the array of whole numbers there."""


@intrinsic
def memory_at(_context: Any, address: types.Type) -> Any:
    """The struct of a run at `address`; numba keeps a record as the pointer to it."""

    def generate(context: Any, builder: Any, _signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], context.get_value_type(MEMORY))

    return MEMORY(types.int64), generate


def _function_at(result: types.Type, *kinds: types.Type) -> Any:
    """An intrinsic that calls the C function at an address with a tuple of arguments."""

    @intrinsic
    def call(_context: Any, address: types.Type, arguments: types.Type) -> Any:
        def generate(context: Any, builder: Any, _signature: Any, given: Any) -> Any:
            returns = ir.VoidType() if result is types.none else context.get_value_type(result)
            kind = ir.FunctionType(returns, [context.get_value_type(k) for k in kinds])
            function = builder.inttoptr(given[0], kind.as_pointer())
            value = builder.call(function, cgutils.unpack_tuple(builder, given[1]))
            return context.get_dummy_value() if result is types.none else value

        return result(types.int64, types.Tuple(kinds)), generate

    return call


_i, _d = types.int64, types.float64

field_at = _function_at(types.none, _i, _d, _i, _i)
"""rhs, guards, outputs: (ctx, t, y, out)."""
jacobian_at = _function_at(types.none, _i, _d, _i, _i, _i)
"""(ctx, t, y, values, ft)."""
mass_at = _function_at(types.none, _i, _i)
"""(ctx, values)."""
slip_at = _function_at(_i, _i, _d, _i, _i)
"""(ctx, t, y, r) -> how many rows hold."""
switch_at = _function_at(_i, _i, _d, _i, _i, _i)
"""(ctx, t, y, fired, nfired) -> how many zones changed."""
next_time_at = _function_at(_d, _i, _d)
"""(ctx, t) -> time of the next time event."""
at_time_at = _function_at(_i, _i, _d, _i)
"""(ctx, t, y) -> 1 if anything changed."""


@compiled
def copy(source, target):
    """target[:] = source; a slice assignment would make room for overlap on the heap."""
    for k in range(len(source)):
        target[k] = source[k]

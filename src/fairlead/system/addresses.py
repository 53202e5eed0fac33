"""Integer addresses as pointers and functions inside compiled code. Imported on a cache miss only.

Kernels are reached through their addresses, so the driver is compiled once for all models.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

F8 = types.CPointer(types.float64)
I8 = types.CPointer(types.int64)


def _pointer(kind: Any) -> Any:
    @intrinsic
    def cast(typing_context: Any, address: Any) -> Any:
        def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(kind))

        return kind(types.int64), code

    return cast


f8 = _pointer(F8)
i8 = _pointer(I8)


@intrinsic
def call_kernel(
    typing_context: Any, address: Any, mode: Any, block: Any, start: Any, stop: Any, z: Any, zones: Any, tables: Any, out: Any
) -> Any:  # fmt: skip
    """kernel(mode, block, start, stop, z, zones, tables, out) at an address."""

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kinds = [context.get_value_type(kind) for kind in signature.args[1:]]
        kernel = ir.FunctionType(ir.VoidType(), kinds)
        builder.call(builder.inttoptr(arguments[0], kernel.as_pointer()), arguments[1:])
        return context.get_dummy_value()

    i = types.int64
    return types.void(i, i, I8, i, i, F8, I8, F8, F8), code


KERNEL = types.void(types.int64, I8, types.int64, types.int64, F8, I8, F8, F8)

"""Machine code of a model for any processor of the architecture, as objects that a linker takes.

    objects(engine, own)   the loop, the callbacks and the kernels, and by which numbers data refer to their functions

Nothing comes from a cache of machine code, which is made for this processor: the loop comes as LLVM bitcode
(integrate/bitcode.py), laws are traced and lowered anew. Optimised as the generic build is (processor.py), so the
numbers are those of that.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any, NamedTuple

from fairlead.integrate.bitcode import loop_bitcode, loop_symbol
from fairlead.integrate.engine import Engine
from fairlead.kernels.kernel import Kernel, write_source
from fairlead.processor import for_any_processor
from fairlead.system.callbacks.table import CALLBACKS, SHARED
from fairlead.system.compiled.system import Instance

TRIPLE = "x86_64-unknown-linux-gnu"
LOOP = "fairlead_advance"
"""Name of the function that runs the loop on."""
FROM_C = ("sqrt", "pow", "exp", "log", "sin", "cos", "tan", "tanh", "atan", "memset", "memcpy", "memmove")
"""What the code calls in libc and libm."""


class Code(NamedTuple):
    """Objects, and what they name."""

    objects: Mapping[str, bytes]
    """By file name."""
    functions: Sequence[str]
    """Symbols by number."""
    numbers: Mapping[int, int]
    """Numbers by the addresses that these functions have in this process."""
    unreached: Sequence[str]
    """Symbols that the loop refers to on paths that are never reached."""


def objects(engine: Engine, own: Instance) -> Code:
    """Everything that a run of `own` calls. Raises UsageError where the loop cannot be compiled."""
    loop, unreached = _loop(engine)
    found = {"loop.o": loop, "callbacks.o": _callbacks()}
    functions = {address: _named(name) for name, address in own.callbacks.items()}
    kernels = {block.kernel.address: block.kernel for block in own.blocks}
    for k, (address, kernel) in enumerate(kernels.items()):
        functions[address] = _named(f"kernel_{k}")
        found[f"kernel_{k}.o"] = _kernel(kernel, functions[address])
    numbers = {address: k for k, address in enumerate(functions)}
    return Code(found, list(functions.values()), numbers, unreached)


def _named(name: str) -> str:
    """The symbol of a function in the library."""
    return f"fairlead_{name}"


@functools.cache
def _callbacks() -> bytes:
    """Object code of the callbacks, which are the same for all models."""
    from fairlead.kernels.lowering import lower_together

    with for_any_processor():
        (text,) = {made.text for made in lower_together(CALLBACKS, SHARED).values()}
    return _object(text, {name: _named(name) for name in CALLBACKS})


def _kernel(kernel: Kernel, name: str) -> bytes:
    """Object code of a kernel, under this name."""
    from fairlead.kernels.lowering import lower

    source = _source(kernel)
    with for_any_processor():
        text = lower(source, "kernel", file=f"<kernel of {kernel.variant.label}>").text
    return _object(text, {"kernel": name})


def _source(kernel: Kernel) -> str:
    """The text that a kernel was made of: that which has its structure, with or without rates."""
    wanted = _plain(kernel)
    for rated in (0, 1, 2):
        source, structure = write_source(kernel.variant, rated)
        if json.dumps(asdict(structure)) == wanted:
            return source
    raise AssertionError(f"the kernel of {kernel.variant.label} is made of a text that is not found again")


def _plain(kernel: Kernel) -> str:
    return json.dumps(asdict(kernel.structure))


def _machine() -> Any:
    """LLVM's target: code that may lie at any address."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="generic", features="", opt=3, reloc="pic", codemodel="default"
    )


def _object(text: str, names: Mapping[str, str]) -> bytes:
    """Object code of a module, whose functions get the names that only this library sees."""
    import llvmlite.binding as llvm

    module = llvm.parse_assembly(text)
    _rename(module, names)
    return bytes(_machine().emit_object(module))


def _rename(module: Any, names: Mapping[str, str]) -> None:
    """Give functions their names; others are the module's own."""
    from llvmlite.binding import Linkage, Visibility

    module.triple = TRIPLE
    for function in module.functions:
        if function.is_declaration:
            continue
        if function.name in names:
            function.linkage, function.visibility = Linkage.external, Visibility.hidden
            function.name = names[function.name]
        else:
            function.linkage = Linkage.internal


@functools.cache
def _loop(engine: Engine) -> tuple[bytes, list[str]]:
    """Object code of the loop, and the symbols that it names but never reaches."""
    import llvmlite.binding as llvm
    from llvmlite.binding import Linkage, Visibility

    module = llvm.parse_bitcode(loop_bitcode(engine))
    _rename(module, {loop_symbol(engine): LOOP})
    unreached = [one.name for one in module.functions if one.is_declaration and not _known(one.name)]
    for variable in module.global_variables:
        if variable.is_declaration:
            unreached.append(variable.name)
        elif variable.linkage == Linkage.common:
            variable.visibility = Visibility.hidden
    return bytes(_machine().emit_object(module)), sorted(unreached)


def _known(name: str) -> bool:
    """True of what LLVM makes itself or a C library has."""
    return name.startswith("llvm.") or name in FROM_C

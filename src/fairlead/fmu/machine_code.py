"""Machine code of a model for any processor of an architecture, as objects that a linker takes.

    objects(engine, own, platforms)   the loop, the callbacks and the kernels, and by which numbers data refer to their
                                      functions

Nothing comes from a cache of machine code, which is made for this processor: the loop comes as LLVM bitcode
(integrate/bitcode.py), laws are traced and lowered anew. Optimised as the generic build is (processor.py), so the
numbers are those of that. For another system the same bitcode is told that system's triple and how its data lie: it
names no instruction, all numbers in it have 64 bits, and its vectors are taken in pieces. Nothing is fused: a product
is rounded before it is added on every processor.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any, NamedTuple

from fairlead.errors import UsageError
from fairlead.fmu.platforms import HERE, PLATFORMS, Platform
from fairlead.integrate.bitcode import loop_bitcode, loop_symbol
from fairlead.integrate.engine import Engine
from fairlead.kernels.kernel import Kernel, write_source
from fairlead.processor import for_any_processor
from fairlead.system.callbacks.table import CALLBACKS, SHARED
from fairlead.system.compiled.system import Instance

LOOP = "fairlead_advance"
"""Name of the function that runs the loop on."""
FROM_C = ("sqrt", "pow", "exp", "log", "sin", "cos", "tan", "tanh", "atan", "memset", "memcpy", "memmove")
"""What the code calls in libc and libm; every system has these, by the same names and types."""


class Code(NamedTuple):
    """Objects, and what they name."""

    objects: Mapping[str, Mapping[str, bytes]]
    """By platform, and there by file name."""
    functions: Sequence[str]
    """Symbols by number."""
    numbers: Mapping[int, int]
    """Numbers by the addresses that these functions have in this process."""
    unreached: Sequence[str]
    """Symbols that the loop refers to on paths that are never reached."""


def objects(engine: Engine, own: Instance, platforms: Sequence[Platform] = (PLATFORMS[HERE],)) -> Code:
    """Everything that a run of `own` calls. Raises UsageError where the loop cannot be compiled."""
    unreached = _loop(engine, platforms[0].name)[1]
    found = {one.name: {"loop.o": _loop(engine, one.name)[0], "callbacks.o": _callbacks(one.name)} for one in platforms}
    functions = {address: _named(name) for name, address in own.callbacks.items()}
    kernels = {block.kernel.address: block.kernel for block in own.blocks}
    for k, (address, kernel) in enumerate(kernels.items()):
        functions[address] = _named(f"kernel_{k}")
        text = _lowered(kernel)
        for one in platforms:
            found[one.name][f"kernel_{k}.o"] = _object(text, {"kernel": functions[address]}, one)
    numbers = {address: k for k, address in enumerate(functions)}
    return Code(found, list(functions.values()), numbers, unreached)


def _named(name: str) -> str:
    """The symbol of a function in the library."""
    return f"fairlead_{name}"


@functools.cache
def _callbacks(platform: str) -> bytes:
    """Object code of the callbacks, which are the same for all models."""
    return _object(_lowered_callbacks(), {name: _named(name) for name in CALLBACKS}, PLATFORMS[platform])


@functools.cache
def _lowered_callbacks() -> str:
    from fairlead.kernels.lowering import lower_together

    with for_any_processor():
        (text,) = {made.text for made in lower_together(CALLBACKS, SHARED).values()}
    return text


def _lowered(kernel: Kernel) -> str:
    """The text in the language of LLVM of a kernel."""
    from fairlead.kernels.lowering import lower

    source = _source(kernel)
    with for_any_processor():
        return lower(source, "kernel", file=f"<kernel of {kernel.variant.label}>").text


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


def machine_for(platform: Platform) -> Any:
    """LLVM's target: code that may lie at any address. Raises UsageError where this LLVM has no such code."""
    import llvmlite.binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    try:
        target = llvm.Target.from_triple(platform.triple)
    except RuntimeError as error:
        raise UsageError(
            f"--platform {platform.name}: the llvmlite that is installed makes no code for it ({error}).\n"
            "    Take a newer one: pip install -U llvmlite."
        ) from error
    return target.create_target_machine(cpu="generic", features="", opt=3, reloc="pic", codemodel="default")


def _object(text: str, names: Mapping[str, str], platform: Platform) -> bytes:
    """Object code of a module, whose functions get the names that only this library sees."""
    import llvmlite.binding as llvm

    module = llvm.parse_assembly(text)
    _rename(module, names)
    return _emitted(module, platform)


def _emitted(module: Any, platform: Platform) -> bytes:
    """Object code of a module, made for a platform whatever it was written for."""
    machine = machine_for(platform)
    module.triple, module.data_layout = platform.triple, str(machine.target_data)
    return bytes(machine.emit_object(module))


def _rename(module: Any, names: Mapping[str, str]) -> None:
    """Give functions their names; others are the module's own."""
    from llvmlite.binding import Linkage, Visibility

    for function in module.functions:
        if function.is_declaration:
            continue
        if function.name in names:
            function.linkage, function.visibility = Linkage.external, Visibility.hidden
            function.name = names[function.name]
        else:
            function.linkage = Linkage.internal


@functools.cache
def _loop(engine: Engine, platform: str) -> tuple[bytes, list[str]]:
    """Object code of the loop, and the symbols that it names but never reaches."""
    import llvmlite.binding as llvm
    from llvmlite.binding import Linkage

    module = llvm.parse_bitcode(loop_bitcode(engine))
    _rename(module, {loop_symbol(engine): LOOP})
    unreached = [one.name for one in module.functions if one.is_declaration and not _known(one.name)]
    for variable in module.global_variables:
        if variable.is_declaration:
            unreached.append(variable.name)
        elif variable.linkage == Linkage.common:
            variable.linkage = Linkage.internal
    return _emitted(module, PLATFORMS[platform]), sorted(unreached)


def _known(name: str) -> bool:
    """True of what LLVM makes itself or a C library has."""
    return name.startswith("llvm.") or name in FROM_C

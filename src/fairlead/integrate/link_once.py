"""Compile many functions that call each other, and optimise them once, together.

numba makes every function ready to be called by itself: it links in all that the function calls, optimises the whole
again and makes machine code of it. For the two hundred functions of a loop, of which only the last is ever called from
outside, that is three quarters of the time.

    with linked_once():
        function = numba.cfunc(...)(advance)     # two hundred functions, typed and lowered, none made ready
    function.inspect_llvm()                      # linked, then optimised as numba does it: cheap passes, full passes

What LLVM is given to do is the same, so the numbers that the code computes are.

It reaches into numba: the class of a library is an attribute of the code generator. Where a version of numba has it
otherwise, functions are made as numba makes them: later, not differently.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from llvmlite.binding import Linkage
from numba.core.codegen import JITCodeLibrary
from numba.core.registry import cpu_target


class LinkedLate(JITCodeLibrary):
    """The code of one function, left as it was lowered until the module with all that it calls is asked for."""

    _whole = False
    _final_module: Any
    _shared_module: Any

    def finalize(self) -> None:
        """Nothing is added any more; nothing is linked, optimised or made native."""
        self._raise_if_finalized()
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Zero, which tells numba that there is nothing to call."""
        self._ensure_finalized()
        return 0

    def get_llvm_str(self) -> str:
        """The module with all that it calls, optimised; of its own functions only what others may call is kept."""
        self._make_whole()
        return super().get_llvm_str()

    def _get_module_for_linking(self) -> Any:
        """The module with all that it calls, for a library of numba's own kind."""
        self._ensure_finalized()
        if self._shared_module is None:
            self._shared_module = _linked(self)
        return self._shared_module

    def _make_whole(self) -> None:
        if self._whole:
            return
        self._ensure_finalized()
        own = {function.name for function in self._final_module.functions if not function.is_declaration}
        self._final_module = _linked(self)
        for function in self._final_module.functions:
            if not function.is_declaration:
                function.linkage = Linkage.external if function.name in own else Linkage.internal
        self._optimize_final_module()
        self._final_module.verify()
        self._whole = True


def _linked(first: LinkedLate) -> Any:
    """A module of the code of a library and of all that it calls, each once, as definitions that may occur again."""
    module, seen, waiting = first._final_module.clone(), {first}, list(first._linking_libraries)
    while waiting:
        library = waiting.pop()
        if library in seen:
            continue
        seen.add(library)
        if isinstance(library, LinkedLate):
            module.link_in(library._final_module, preserve=True)
            waiting += library._linking_libraries
        else:
            module.link_in(library._get_module_for_linking(), preserve=True)
    for function in module.functions:
        if not function.is_declaration and function.linkage == Linkage.external:
            function.linkage = Linkage.linkonce_odr
    return module


@contextlib.contextmanager
def linked_once() -> Iterator[None]:
    """What numba compiles inside is linked and optimised when its text is asked for."""
    generator = cpu_target.target_context.codegen()
    if getattr(generator, "_library_class", None) is not JITCodeLibrary:
        yield
        return
    generator._library_class = LinkedLate
    generator.set_env = _no_environment
    try:
        yield
    finally:
        del generator._library_class, generator.set_env


def _no_environment(_name: str, _environment: Any) -> None:
    """Code that is not loaded has no place for what numba's exceptions would read; the loop raises none."""

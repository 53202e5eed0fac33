"""Code that was compiled ahead: LLVM bitcode for any processor of an architecture, which llvmlite makes native.

    stored = find(module, sources)         what the installed package holds for a module of the loop, if it fits
    build = stored.for_here()              to be made native for this processor; takes two seconds, and no numba

LLVM's passes ran when it was made, so here only machine code is left to make.

A wheel holds one file for each module that is compiled on its own, beside this one (`bitcode.py` makes them). A file
tells the sources it was made of, the system and the LLVM. One that does not fit is not used: numba compiles anew, and
where numba is missing the reason is told.

LLVM reads the bitcode of older versions, so a wheel is built with the oldest llvmlite that is supported.
"""

from __future__ import annotations

import json
import pathlib
import platform
import struct
import sys
import zlib
from dataclasses import dataclass
from typing import Any

import fairlead.native as native
import fairlead.sealed as sealed

KIND = b"fairlead-bitcode-1\n"
FOLDER = pathlib.Path(__file__).parent


@dataclass(frozen=True)
class Bitcode:
    """Functions compiled ahead: symbol and bitcode by name, and what they were made of."""

    sources: str
    """Hash of the sources."""
    system: str
    """Processor architecture and operating system."""
    llvm: int
    """Major version of the LLVM that wrote it."""
    functions: dict[str, tuple[str, bytes]]

    def unfit(self, sources: str) -> str:
        """Why it cannot be used here for these sources; empty if it can."""
        import llvmlite.binding as llvm

        here = llvm.llvm_version_info[0]
        if self.sources != sources:
            return "the code compiled ahead was made of other sources"
        if self.system != this_system():
            return f"the code compiled ahead is for {self.system}, and this is {this_system()}"
        if self.llvm > here:
            return f"the code compiled ahead needs LLVM {self.llvm}, and this llvmlite has LLVM {here}"
        return ""

    def for_here(self) -> native.Build:
        """The functions, to be made native for the chosen processor (`processor.py`)."""
        return native.Build({}, {name: native.Optimised(*given) for name, given in self.functions.items()})


def this_system() -> str:
    """Architecture and operating system that bitcode is bound to; calls and data lie alike on all of these."""
    return f"{platform.machine()} {sys.platform}"


def find(module: str, sources: str) -> tuple[Bitcode | None, str]:
    """Bitcode of a module that fits its sources, or None and why there is none."""
    try:
        stored = read(FOLDER / f"{module}.bitcode")
    except FileNotFoundError:
        return None, "no code compiled ahead is installed (an editable install has none)"
    except (OSError, sealed.BrokenSealError) as error:
        return None, f"the code compiled ahead cannot be read: {error}"
    why = stored.unfit(sources)
    return (None, why) if why else (stored, "")


def read(path: pathlib.Path) -> Bitcode:
    """Bitcode from a file. Raises BrokenSealError when it is not whole, OSError when it cannot be read."""
    body = sealed.read(path, KIND)
    (length,) = struct.unpack_from("<Q", body)
    header: dict[str, Any] = json.loads(body[8 : 8 + length])
    functions, position = {}, 8 + length
    for name, symbol, size in header["functions"]:
        functions[name] = (symbol, zlib.decompress(body[position : position + size]))
        position += size
    return Bitcode(header["sources"], header["system"], header["llvm"], functions)


def write(path: pathlib.Path, code: Bitcode) -> None:
    """Write bitcode to a file in one go. Raises OSError."""
    packed = [(name, symbol, zlib.compress(text, 9)) for name, (symbol, text) in code.functions.items()]
    header = json.dumps({
        "sources": code.sources, "system": code.system, "llvm": code.llvm,
        "functions": [(name, symbol, len(text)) for name, symbol, text in packed],
    }).encode()  # fmt: skip
    sealed.write(path, KIND, struct.pack("<Q", len(header)) + header + b"".join(text for *_, text in packed))

"""Kernels of bundled parts that were traced and lowered when a wheel was built, so that a first run needs no SymPy.

    given = find(variant, rated)       facts and LLVM code of a kernel, or None: then it is traced
    code = find_module(name)           LLVM code of functions that go with every model (system/callbacks), or None
    write(path, kernels)               what `building/bundled_kernels.py` does

LLVM's passes have not run on a kernel, and run here for this processor: the machine code is that of a kernel traced
here. They have run on what goes with every model, as on the loop (integrate/bitcode.py). The file tells the sources it
was made of, the system and the LLVM that wrote it; one that does not fit is not used. An editable install has none.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import json
import pathlib
import platform
import struct
import sys
import zlib
from collections.abc import Mapping
from typing import Any, NamedTuple

import fairlead.sealed as sealed
from fairlead.component.replies import is_bundled
from fairlead.component.values import Variant

KIND = b"fairlead-kernels-1\n"
FILE = pathlib.Path(__file__).with_name("bundled.kernels")


class Given(NamedTuple):
    """A kernel: the facts of its Structure, and its LLVM bitcode."""

    facts: dict[str, Any]
    bitcode: bytes


def find_module(name: str) -> bytes | None:
    """Bitcode of several functions that the installed package holds under a name, if it fits; it is optimised."""
    stored = _stored()
    given = None if stored is None else stored.given(name)
    return None if given is None else given.bitcode


def find(variant: Variant, rated: int) -> Given | None:
    """What the installed package holds for a variant of bundled classes, if it fits."""
    stored = _stored() if _all_bundled(variant) else None
    return None if stored is None else stored.given(name_of(variant, rated))


def name_of(variant: Variant, rated: int) -> str:
    """A text that tells a variant, with the classes by where they are."""
    parts = [(name, name_of(part, 0)) for name, part in variant.parts]
    kind = f"{variant.type.__module__}:{variant.type.__qualname__}"
    return repr((kind, variant.words, parts, variant.absent, variant.swings, rated))


def _all_bundled(variant: Variant) -> bool:
    return is_bundled(variant.type) and all(_all_bundled(part) for _, part in variant.parts)


class Stored(NamedTuple):
    """A file that was read: where each kernel begins and ends in its body."""

    places: dict[str, tuple[int, int, int]]
    body: bytes

    def given(self, name: str) -> Given | None:
        """The kernel of that name, if it is there."""
        if name not in self.places:
            return None
        begin, facts, code = self.places[name]
        text = zlib.decompress(self.body[begin : begin + facts])
        return Given(json.loads(text), zlib.decompress(self.body[begin + facts : begin + facts + code]))


@functools.cache
def _stored() -> Stored | None:
    import llvmlite.binding as llvm

    try:
        body = sealed.read(FILE, KIND)
    except (OSError, sealed.BrokenSealError):  # none, as in an editable install, or one that is torn: traced then
        return None
    (length,) = struct.unpack_from("<Q", body)
    header = json.loads(body[8 : 8 + length])
    fits = header["system"] == this_system() and header["llvm"] <= llvm.llvm_version_info[0]
    return Stored(header["places"], body[8 + length :]) if fits and header["sources"] == sources() else None


def write(path: pathlib.Path, kernels: Mapping[str, Given]) -> None:
    """Write kernels, by `name_of`, to a file in one go. Raises OSError."""
    import llvmlite.binding as llvm

    places, packed, at = {}, [], 0
    for name, one in kernels.items():
        facts, code = zlib.compress(json.dumps(one.facts).encode(), 9), zlib.compress(one.bitcode, 9)
        places[name] = at, len(facts), len(code)
        packed += [facts, code]
        at += len(facts) + len(code)
    header = json.dumps({
        "sources": sources(), "system": this_system(), "llvm": llvm.llvm_version_info[0], "places": places,
    }).encode()  # fmt: skip
    sealed.write(path, KIND, struct.pack("<Q", len(header)) + header + b"".join(packed))
    path.chmod(0o644)  # others read what is installed for all


def this_system() -> str:
    """Architecture and operating system that the code is bound to."""
    return f"{platform.machine()} {sys.platform}"


def sources() -> str:
    """Hash of all that says what a bundled class is, and how its laws are traced and lowered."""
    spec = importlib.util.find_spec("fairlead.components")
    bundled = spec.submodule_search_locations if spec is not None else None
    state = hashlib.sha256()
    here = pathlib.Path(__file__).parent
    for folder in (*map(pathlib.Path, bundled or ()), here.parent / "component", here):
        for file in sorted(folder.rglob("*.py")):
            text = file.read_bytes().replace(b"\r\n", b"\n")
            state.update(f"{file.relative_to(folder).as_posix()} {len(text)} ".encode() + text)
    return state.hexdigest()

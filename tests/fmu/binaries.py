"""What the header of a library tells: its processor, what it offers, and what it asks of the system."""

from __future__ import annotations

import struct
from typing import NamedTuple

LATE = {0xC, 0x80000018}
"""Commands of Mach-O that name a library which is needed."""


class Told(NamedTuple):
    """Of one library."""

    machine: str
    offered: set[str]
    asked: set[str]
    """Names that other libraries have to define."""
    needed: set[str]
    """Those libraries."""
    versions: set[str] = frozenset()
    """Of the symbols that are asked for, where they have any."""


def told(library: bytes) -> Told:
    """Of ELF, PE and Mach-O with 64 bits."""
    if library[:4] == b"\x7fELF":
        return _elf(library)
    return _pe(library) if library[:2] == b"MZ" else _macho(library)


def sections(library: bytes) -> dict[str, tuple[int, int, int]]:
    """Of an ELF by name: where, how long, and what it is linked with."""
    at, size, count, names = *struct.unpack_from("<Q", library, 40), *struct.unpack_from("<HHH", library, 58)
    rows = [struct.unpack_from("<IIQQQQIIQQ", library, at + size * k) for k in range(count)]
    return {_text(library, rows[names][4] + row[0]): (row[4], row[5], row[6]) for row in rows}


def _elf(library: bytes) -> Told:
    kept = sections(library)
    text = kept[".dynstr"][0]
    at, length, _ = kept[".dynsym"]
    symbols = [struct.unpack_from("<IBBH", library, at + k) for k in range(24, length, 24)]
    shown = [name for name, kind, seen, place in symbols if place and kind >> 4 and not seen & 3]
    offered = {_text(library, text + name) for name in shown}
    asked = {_text(library, text + name) for name, kind, _, place in symbols if not place and kind >> 4 == 1}
    at, length, _ = kept[".dynamic"]
    rows = [struct.unpack_from("<qQ", library, at + k) for k in range(0, length, 16)]
    needed = {_text(library, text + value) for tag, value in rows if tag == 1}
    (machine,) = struct.unpack_from("<H", library, 18)
    return Told({62: "x86_64", 183: "aarch64"}[machine], offered, asked, needed, _versions(library, kept, text))


def _versions(library: bytes, kept: dict[str, tuple[int, int, int]], text: int) -> set[str]:
    found, at = set(), kept[".gnu.version_r"][0]
    while True:
        _, count, _, first, following = struct.unpack_from("<HHIII", library, at)
        one = at + first
        for _ in range(count):
            _, _, _, name, step = struct.unpack_from("<IHHII", library, one)
            found.add(_text(library, text + name))
            one += step
        if not following:
            return found
        at += following


def _pe(library: bytes) -> Told:
    (at,) = struct.unpack_from("<I", library, 60)
    machine, count, _, _, _, optional = struct.unpack_from("<HHIIIH", library, at + 4)
    tables = at + 24 + 112
    rows = [struct.unpack_from("<8sIIII", library, at + 24 + optional + 40 * k) for k in range(count)]

    def place(address: int) -> int:
        return next(where + address - begin for _, size, begin, _, where in rows if begin <= address < begin + size)

    exported, imported = (place(struct.unpack_from("<I", library, tables + 8 * k)[0]) for k in range(2))
    n_names, _, names = struct.unpack_from("<3I", library, exported + 24)
    pointers = struct.unpack_from(f"<{n_names}I", library, place(names))
    needed, asked = set(), set()
    while any(entry := struct.unpack_from("<5I", library, imported)):
        needed.add(_text(library, place(entry[3])))
        one = place(entry[0])
        while (thunk := struct.unpack_from("<Q", library, one)[0]) != 0:
            asked.add(_text(library, place(thunk) + 2))
            one += 8
        imported += 20
    return Told({0x8664: "x86_64"}[machine], {_text(library, place(p)) for p in pointers}, asked, needed)


def _macho(library: bytes) -> Told:
    magic, machine, _, _, count = struct.unpack_from("<5I", library)
    assert magic == 0xFEEDFACF
    at, offered, asked, needed = 32, set(), set(), set()
    for _ in range(count):
        command, length = struct.unpack_from("<II", library, at)
        if command in LATE:
            needed.add(_text(library, at + struct.unpack_from("<I", library, at + 8)[0]))
        if command == 2:
            table, n, text, _ = struct.unpack_from("<4I", library, at + 8)
            for k in range(n):
                name, kind = struct.unpack_from("<IB", library, table + 16 * k)
                if not kind & 0xE0 and kind & 1 and not kind & 0x10:  # none for a debugger, none that is its own
                    (offered if kind & 0x0E else asked).add(_text(library, text + name).removeprefix("_"))
        at += length
    return Told({0x1000007: "x86_64", 0x100000C: "aarch64"}[machine], offered, asked, needed)


def _text(library: bytes, at: int) -> str:
    return library[at : library.index(b"\0", at)].decode()

"""Libraries of macOS for several processors in one file, as version 2 of FMI has one folder for all of them."""

from __future__ import annotations

import struct
from collections.abc import Sequence

MAGIC = 0xCAFEBABE
"""FAT_MAGIC of Apple's <mach-o/fat.h>, which has the numbers of the head in big-endian order."""
PAGE = 14
"""Every part begins at a multiple of 2^PAGE bytes: pages are 16 kB on ARM and 4 kB on x86-64, and begin at no other."""


def universal(libraries: Sequence[bytes]) -> bytes:
    """One file of them all; of a single one that itself."""
    if len(libraries) == 1:
        return libraries[0]
    at, rows, body = 1 << PAGE, b"", b""
    for one in libraries:
        _, processor, kind = struct.unpack_from("<III", one)
        rows += struct.pack(">IIIII", processor, kind, at + len(body), len(one), PAGE)
        body += one + bytes(-len(one) % (1 << PAGE))
    head = struct.pack(">II", MAGIC, len(libraries)) + rows
    return head + bytes(at - len(head)) + body

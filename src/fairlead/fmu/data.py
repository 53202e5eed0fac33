"""Data as an object that a linker takes: names, and the bytes behind them."""

from __future__ import annotations

from collections.abc import Mapping

from fairlead.fmu.image import LINE, Image
from fairlead.fmu.machine_code import machine_for
from fairlead.fmu.platforms import Platform


def data_object(image: Image, platform: Platform) -> bytes:
    """The object that defines what `c/image.h` declares: links, runs, their bytes, and what instances share."""
    import numpy as np

    links = np.array(image.links, np.int64).reshape(-1, 3)
    at = np.cumsum([0, *(len(run) for _, run in image.runs)])[:-1]
    runs = np.array([(place, len(run), begin) for (place, run), begin in zip(image.runs, at, strict=True)], np.int64)
    return _object(
        {
            "fairlead_links": links.tobytes(), "fairlead_runs": runs.tobytes(),
            "fairlead_bytes": b"".join(run for _, run in image.runs), "fairlead_shared": image.shared,
        },
        platform,
    )  # fmt: skip


def _object(arrays: Mapping[str, bytes], platform: Platform) -> bytes:
    import llvmlite.binding as llvm

    machine = machine_for(platform)
    lines = [f'target datalayout = "{machine.target_data}"', f'target triple = "{platform.triple}"']
    for name, content in arrays.items():
        kept = content or b"\0"
        text = "".join(f"\\{byte:02X}" for byte in kept)
        lines.append(f'@{name} = hidden constant [{len(kept)} x i8] c"{text}", align {LINE}')
    return bytes(machine.emit_object(llvm.parse_assembly("\n".join(lines))))

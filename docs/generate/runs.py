"""Runs of small netlists for pictures, kept beside their picture until the netlist changes."""

from __future__ import annotations

import hashlib
import warnings
from pathlib import Path

import fairlead


def picture(netlist: Path, folder: Path, names: tuple[str, ...] = ()) -> Path:
    """The signals that a netlist records, drawn over time; made again when netlist or code version changed."""
    target = folder / f"{netlist.stem}.png"
    mark = folder / ".kept" / f"{netlist.stem}.sha"
    told = hashlib.sha256(netlist.read_bytes() + repr(names).encode()).hexdigest()
    if target.is_file() and mark.is_file() and mark.read_text(encoding="utf-8") == told:
        return target
    from fairlead.report.printed import printed

    mark.parent.mkdir(parents=True, exist_ok=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fairlead.RunWarning)  # some models are there to show what is remarked
        result = fairlead.load(netlist).run(out=None)
    printed(result, "signals", target, names)
    mark.write_text(told, encoding="utf-8")
    return target


def wiring(netlist: Path, folder: Path) -> Path:
    """The wiring of a netlist as a drawing."""
    target = folder / f"{netlist.stem}_wiring.svg"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(fairlead.load(netlist).graph("svg"), encoding="utf-8")
    return target

"""The mistakes that `check` finds, as it tells them: in order, where a value came from, and none behind another."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from fairlead.errors import Fault, ModelError

if TYPE_CHECKING:
    from fairlead.component.assembly import Assembly
    from fairlead.flatten.flat_model import FlatModel
    from fairlead.netlist.netlist import Netlist

BESIDE = ("run", "record", "limits", "initial", "nominal", "interface")
"""Blocks of a netlist that say nothing of what the model is made of."""


def in_order(faults: Iterable[Fault]) -> list[Fault]:
    """Each once, those with a place first, by place."""
    return sorted(dict.fromkeys(faults), key=lambda f: (f.where is None, f.where, f.what))


def with_origin(faults: Iterable[Fault], overrides: Mapping[str, str]) -> Iterator[Fault]:
    """Mistakes; those in a value that was given from outside say which, for they stand where the netlist uses it."""
    for fault in faults:
        given = [f"It was given as {name} = {text}." for name, text in overrides.items()
                 if f"= {text} " in f"{fault.what} " and not _named(name, fault)]  # fmt: skip
        yield replace(fault, way_out="\n".join([fault.way_out, *given])) if given else fault


def _named(name: str, fault: Fault) -> bool:
    """Whether a mistake names a setting, as a word of its own: `m` is none of `block.mass`."""
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", f"{fault.where} {fault.what}") is not None


def all_beside(faults: Iterable[Fault], texts: Mapping[str, str]) -> bool:
    """True if mistakes of the netlist leave the parts of the model as they are."""
    return all(_block_of(one, texts) in BESIDE for one in faults)


def _block_of(fault: Fault, texts: Mapping[str, str]) -> str:
    """The block of the netlist in which a mistake stands, "" where that is not known."""
    if fault.where is None or not fault.where.line:
        return ""
    above = texts.get(fault.where.file, "").splitlines()[: fault.where.line]
    return next((key[1] for line in reversed(above) if (key := re.match(r"(\w+)\s*:", line))), "")


def of_start_and_border(netlist: Netlist, assembly: Assembly, flat: FlatModel) -> list[Fault]:
    """Mistakes in `initial`, `nominal` and `interface`, for which a model is compiled that has others elsewhere."""
    from fairlead.analysis.statics.start_profile import laid_under_statics
    from fairlead.outer import interface_faults
    from fairlead.system.compile import compile, untraceable

    if untraceable(flat):
        return []
    found = list[Fault]()
    try:
        flat = laid_under_statics(flat)
        compile(flat)
    except ModelError as error:
        found += [one for one in error.faults if one.what.startswith(("initial.", "nominal."))]
    bare = replace(flat, assembly=replace(assembly, netlist=replace(netlist, initial={}, nominal={})))
    with contextlib.suppress(ModelError):
        found += interface_faults(netlist, assembly.entries, compile(bare))
    return found

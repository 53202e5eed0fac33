"""What `check` and the start of a run remark about a scene that can run, but not well."""

from __future__ import annotations

from dataclasses import replace

from fairlead.analysis.remarks.old_names import old_names
from fairlead.analysis.remarks.recording import left_out, sparse
from fairlead.analysis.remarks.unusual import unusual
from fairlead.analysis.remarks.widths import too_wide
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.settings import RunSettings


def remarks(flat: FlatModel, settings: RunSettings | None = None) -> list[Fault]:
    """What is odd but not wrong, in a run with these settings; None for those of the netlist.

    Contacts too wide, weak clamps, tight curves, winches without line, rigid seas that are not, slow drives, records
    of nothing but both ends, names that went with an effect, values that are hardly meant, outputs by a name of old.
    """
    assembly = flat.assembly
    if settings is not None and settings != assembly.netlist.run:
        assembly = replace(assembly, netlist=replace(assembly.netlist, run=settings))
    return [*too_wide(flat), *_of_statics(flat), *sparse(assembly.netlist), *left_out(assembly), *unusual(assembly),
            *old_names(assembly)]  # fmt: skip


def _of_statics(flat: FlatModel) -> list[Fault]:
    """On lines on routes and on drives; a scene that has neither does not read in what solves them."""
    if not flat.assembly.routings and not any(one.type.answers.follows for one in flat.instances):
        return []
    from fairlead.analysis.remarks.lines import on_lines
    from fairlead.analysis.remarks.slow_drives import slow_drives
    from fairlead.analysis.statics.solution import statics

    solved = statics(flat)
    return [*on_lines(solved), *slow_drives(flat, solved)]

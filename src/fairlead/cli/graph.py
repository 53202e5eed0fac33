"""`fairlead graph`: the wiring of a netlist as a drawing."""

import enum
import pathlib
from typing import Annotated

import typer

from fairlead.cli.options import Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import place, refuse_place
from fairlead.cli.terminal import echo


class Format(enum.StrEnum):
    """The drawing languages; SVG needs no further program."""

    MERMAID = "mermaid"
    DOT = "dot"
    SVG = "svg"


SUFFIXES = {".mmd": Format.MERMAID, ".dot": Format.DOT, ".gv": Format.DOT, ".svg": Format.SVG}


def graph(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    kind: Annotated[
        Format | None, typer.Option("--format", help="Default: by the ending of --out, else mermaid.")
    ] = None,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write to this file, not to standard output."),
    ] = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Draw which port meets which, as Mermaid, DOT or SVG."""
    import fairlead

    refuse_place("--out", out, endings=() if kind else (*SUFFIXES, ".md", ".txt"))
    if kind is None:
        kind = SUFFIXES.get(out.suffix, Format.MERMAID) if out else Format.MERMAID
    text = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries).graph(kind.value)
    if out is None:
        echo(text)
        return
    place(out, text)
    if not quiet:
        echo(f"{kind.value} drawing in {out}")

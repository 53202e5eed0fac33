"""`fairlead describe`: what a netlist has become after a stage, or what a component type is."""

import enum
import pathlib
from typing import Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.cli.options import AsJson, Libraries, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.terminal import echo
from fairlead.errors import UsageError

WHAT = """Describe what?
    fairlead describe types      all types of parts, a sentence each
    fairlead describe Worm       a type: its ports, parameters and signals; --all has its zones and equations as well
    fairlead describe belt       a netlist or a bundled model, as the pipeline sees it; --stage says at which stage
    fairlead describe hold       a word of a netlist, such as a treatment of friction"""


class Stage(enum.StrEnum):
    """The stages of the pipeline whose output can be looked at."""

    NETLIST = "netlist"
    COMPONENT = "component"
    FLATTEN = "flatten"
    SYSTEM = "system"


def describe(
    subject: Annotated[
        str,
        typer.Argument(
            help="A netlist, a bundled model, a type such as Spring, `types` for the list, or a word such as hold.",
            autocompletion=completion.subjects,
            default_factory=str,
            show_default=False,
        ),
    ],
    settings: Settings,
    libraries: Libraries,
    stage: Annotated[Stage, typer.Option(help="For a netlist: the stage to look at.")] = Stage.FLATTEN,
    everything: Annotated[bool, typer.Option("--all", help="Of a type: its zones and equations as well.")] = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Print a netlist as a stage left it, or a component type: ports, parameters, signals, and --all of it."""
    import fairlead

    if not subject:
        raise UsageError(WHAT)
    if is_type_name(subject) and everything and not as_json:
        text = fairlead.describe_type(subject, libraries)
    elif is_type_name(subject):
        text = _at_a_glance(subject, libraries, as_json)
    elif said := _word(subject, libraries):
        text = said
    else:
        text = fairlead.load(subject, set=parse_settings(settings), libraries=libraries).describe(stage.value)
    echo(text)


def _at_a_glance(subject: str, libraries: list[str], as_json: bool) -> str:
    """What one needs to use a type, or all types, as a page or as JSON."""
    import json

    from fairlead.component.registry import known_types
    from fairlead.describe.catalogue import catalogue, innards, record, sentence, short
    from fairlead.describe.page import named

    types = known_types(libraries)
    if subject == "types":
        inside = innards(types)
        rows = [{"type": n, "doc": sentence(kind), "inside": n in inside} for n, kind in sorted(types.items())]
        return json.dumps(rows, indent=2) if as_json else "\n".join(catalogue(types))
    kind = named(subject, types)
    return json.dumps(record(subject, kind), indent=2) if as_json else "\n".join(short(subject, kind))


def _word(subject: str, libraries: list[str]) -> str:
    """The page of a word such as `hold`, the name of a friction treatment; empty for a netlist, or a word unknown."""
    from fairlead.component.registry import known_types
    from fairlead.describe.words import page
    from fairlead.netlist.files import bundled_models

    if not subject.isidentifier() or subject in bundled_models() or pathlib.Path(subject).exists():
        return ""
    return "\n".join(page(subject, known_types(libraries))).rstrip()


def is_type_name(subject: str) -> bool:
    """Types are CamelCase words, and `types` means all; models are lower_snake names or paths to files."""
    named = subject == "types" or (subject.isidentifier() and subject[0].isupper())
    return named and not pathlib.Path(subject).exists()

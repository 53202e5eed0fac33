"""`fairlead new`: files to start something of one's own from; they keep the contract and run as they are."""

import enum
import keyword
import pathlib
import re
from typing import Annotated

import typer

from fairlead.cli.beginnings import BEGINNINGS
from fairlead.cli.options import Quiet, Verbose
from fairlead.cli.terminal import echo


class Kind(enum.StrEnum):
    """What can be started from a file of ours."""

    FRICTION = "friction"
    CURVE = "curve"
    COMPONENT = "component"
    CONTROLLER = "controller"
    MODEL = "model"
    ROUTE = "route"


def new(
    kind: Annotated[Kind, typer.Argument(help="What to begin.")],
    name: Annotated[str, typer.Argument(help="Its name in lower_snake; becomes NAME.py, NAME.yaml or both.")],
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Begin something of your own: a friction law, curve, component, controller, model or route that runs as it is."""
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name) or keyword.iskeyword(name):
        raise typer.BadParameter(f"{name!r} is not a name in lower_snake, such as my_law.")
    named = "".join(part.capitalize() for part in name.split("_"))
    begin = BEGINNINGS[kind.value]
    if "py" in begin.files:
        _refuse_known(kind, name, named)
    files = {pathlib.Path(f"{name}.{end}"): text for end, text in begin.files.items()}
    if there := [str(file) for file in files if file.exists()]:
        raise typer.BadParameter(f"{' and '.join(there)} is there already; choose another name.")
    for file, text in files.items():
        try:
            with file.open("x", encoding="utf-8") as stream:
                stream.write(text.format(word=name, kind=named))
        except FileExistsError:
            raise typer.BadParameter(f"{file} is there already; choose another name.") from None
    if not quiet:
        echo(f"wrote {' and '.join(map(str, files))}; {begin.then.format(word=name)}")


def _refuse_known(kind: Kind, name: str, named: str) -> None:
    """A file of the user must not replace a treatment, a curve or a type of the library."""
    from fairlead.component.registry import known_types

    types = known_types()
    families = {Kind.FRICTION: ("method", types["Contact"].members)}  # type: ignore[attr-defined]
    if kind is Kind.CURVE:
        from fairlead.components.friction.curve import Curve

        families[Kind.CURVE] = ("curve", Curve.members)
    word, members = families.get(kind, ("", {}))
    if name in members:
        known = ", ".join(members)
        raise typer.BadParameter(f"{word} {name} is in the library already ({known}); choose another name.")
    if kind in (Kind.COMPONENT, Kind.CONTROLLER) and named in types:
        raise typer.BadParameter(f"type {named} is in the library already; choose another name.")

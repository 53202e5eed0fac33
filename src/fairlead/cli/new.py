"""`fairlead new`: a file to start a friction law of one's own from; it keeps the contract and runs as it is."""

import enum
import keyword
import pathlib
import re
from typing import Annotated

import typer

from fairlead.cli.options import Quiet, Verbose
from fairlead.cli.terminal import echo

LAW = '''"""Friction law {word}, a method of every contact: fairlead friction 0.4 --method {word} --library {file}"""

from fairlead.component import Law, Parameter, Zones, guard, sqrt, tanh, zone
from fairlead.components.friction.contact import Contact


class {kind}(Contact):
    """T = N mu(|v|) tanh(v/creep): make it yours."""

    creep = Parameter("m/s", "Speed over which the sign changes.", default=1e-4, above=0)
    zones = Zones("on", "off")  # what happens in zone "off", and what leads there, every contact knows

    @zone("on")
    def on(p, a, b, grip, pace):
        """Friction against the slip v; `grip` is the normal force and `pace` is 1, but for load and warmth."""
        v = b.v - a.v
        friction = grip * p.curve.coefficient(pace * sqrt(v**2 + p.creep**2)) * tanh(v / p.creep)
        return Law(a=-friction, b=+friction, slip=v, friction=friction, dissipated=friction * v,
                   creep_rate=v * (1 - tanh(v / p.creep) ** 8))  # slow slip is creep

    @guard("off", to="on", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift
'''


class Kind(enum.StrEnum):
    """What can be started from a file of ours."""

    FRICTION = "friction"


def new(
    kind: Annotated[Kind, typer.Argument(help="What to begin.")],
    name: Annotated[str, typer.Argument(help="Its name in lower_snake; becomes NAME.py and method: NAME.")],
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Begin a friction law of your own: a file of under 30 lines that passes the contract suite and runs."""
    if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name) or keyword.iskeyword(name):
        raise typer.BadParameter(f"{name!r} is not a name in lower_snake, such as my_law.")
    _refuse_known(name)
    file = pathlib.Path(f"{name}.py")
    text = LAW.format(word=name, file=file, kind="".join(part.capitalize() for part in name.split("_")))
    try:
        with file.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise typer.BadParameter(f"{file} is there already; choose another name.") from None
    if not quiet:
        echo(f"wrote {file}; in a netlist: method: {name}, and run it with --library {file}")


def _refuse_known(name: str) -> None:
    """A file of the user must not replace a treatment of the library."""
    from fairlead.component.registry import known_types

    members = known_types()["Contact"].members  # type: ignore[attr-defined]
    if name in members:
        raise typer.BadParameter(
            f"method {name} is in the library already ({', '.join(members)}); choose another name."
        )

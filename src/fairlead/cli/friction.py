"""`fairlead friction`: force against slip speed, as a scene's contacts or a curve of one's own give it."""

import json
import pathlib
import re
from collections import ChainMap
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from fairlead.cli.options import AsJson, Libraries, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import FIGURES, refuse_place
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead.analysis.characteristic import Characteristic
    from fairlead.analysis.treatments.in_scene import InScene
    from fairlead.component.base import Family
    from fairlead.component.values import Values
    from fairlead.errors import Fault


def friction(
    subject: Annotated[
        str,
        typer.Argument(help="A netlist, a bundled model, or a curve: 0.4, or '{curve: tustin, stiction: 0.5, ...}'."),
    ],
    settings: Settings,
    libraries: Libraries,
    method: Annotated[str, typer.Option(help="For a curve: the treatment.", show_default="that of a new scene")] = "",
    normal: Annotated[str, typer.Option(help="Normal force where the scene gives none.", show_default="1 N")] = "",
    out: Annotated[
        pathlib.Path,
        typer.Option("--out", "-o", metavar="PATH",
                     help="Leave the figures in this folder; or the figure in this PNG, SVG or PDF."),
    ] = pathlib.Path("results"),
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Draw friction against slip speed with its zones; print creep, breakaway, holding capacity, stiffness."""
    from fairlead.quantities import si
    from fairlead.report.friction_figure import draw

    is_file = out.suffix[1:].isalpha() and not out.is_dir()
    refuse_place("--out", out, folder=not is_file, endings=FIGURES if is_file else ())
    usual, records = si(normal or "1 N", "N"), []
    if usual <= 0:
        raise typer.BadParameter(f"--normal {normal}: a contact is pressed with more than 0 N.")
    contacts, remarks = contacts_of(subject, settings, libraries, method)
    if normal and all(one.place.normal is not None for one in contacts.values()):
        raise typer.BadParameter(
            f"--normal {normal}: every contact of {subject} has a normal force of its own. Change that with --set."
        )
    for number, (names, one) in enumerate(contacts.items()):
        found = one.characteristic(usual)
        file = out.with_stem(f"{out.stem}{number or ''}") if is_file else out / f"friction{number or ''}.png"
        file.parent.mkdir(parents=True, exist_ok=True)
        figure = draw(found, file, f"{names}: {found.label}")
        rows = found.rows()
        records.append({"contacts": names, "method": found.label, "figure": str(figure), **dict(rows)})
        if not (as_json or quiet):
            note = " (of no scene; set it with --normal)" if one.place.normal is None and not normal else ""
            echo(f"{names}: {found.label}")
            for name, value in rows:
                echo(f"  {name:<18}{value}{note if name == 'normal force' else ''}")
            echo(f"  wrote {figure}")
    for remark in remarks:
        echo(f"warning: {remark}", err=True)
    if as_json:
        echo(json.dumps(records, indent=2))


class Shown(NamedTuple):
    """A contact with its numbers, and those that the scene around it adds."""

    values: "Values"
    place: "InScene"

    def characteristic(self, usual: float) -> "Characteristic":
        """Its force over slip, pressed with `usual` [N] where the scene has no number for that."""
        from fairlead.analysis.characteristic import characteristic

        found = characteristic(self.values, usual if self.place.normal is None else self.place.normal)
        return found if self.place.arm is None else found.at_arm(self.place.arm)


def contacts_of(
    subject: str, settings: list[str], libraries: list[str], method: str
) -> tuple[dict[str, Shown], list["Fault"]]:
    """Contacts by name, and remarks on them; equal ones share an entry, named by the first and how many follow."""
    from fairlead.analysis.treatments.in_scene import InScene, in_scene

    if _is_curve(subject):
        if settings:
            raise typer.BadParameter(
                f"--set {settings[0]} is for a netlist. A curve has its numbers in its braces; write a netlist with a "
                "Contact to set more."
            )
        subject = f"{{{subject}}}" if subject.startswith("curve") else subject
        return {subject: Shown(_of_curve(subject, libraries, method), InScene(None, None))}, []
    if subject in (curves := _curves(libraries)):
        raise typer.BadParameter(f"{subject} is a curve: give it with its numbers, {_written_out(subject, curves)}.")
    if subject in _treatments(libraries):
        raise typer.BadParameter(f"{subject} treats a curve: name that, and add --method {subject}.")
    if method:
        raise typer.BadParameter(
            f"--method {method} is for a curve; contacts of a netlist have their own treatment. "
            f"Set it there: --set friction.method={method}, or --set PART.method={method} where a part has one."
        )
    import fairlead
    from fairlead.analysis.remarks.widths import too_wide
    from fairlead.analysis.treatments.treatments import contacts

    model = fairlead.load(subject, set=parse_settings(settings), libraries=libraries)
    found: dict[str, list[Any]] = {}
    places = in_scene(model.flat, contacts(model))
    for instance in contacts(model):
        found.setdefault(f"{instance.values!r} {places[instance.path]}", []).append(instance)
    if not found:
        raise typer.BadParameter(f"{subject} has no contact.")
    named = {
        each[0].path + (f" and {len(each) - 1} more like it" if len(each) > 1 else ""): Shown(
            each[0].values, places[each[0].path]
        )
        for each in found.values()
    }
    return named, too_wide(model.flat)


def _is_curve(subject: str) -> bool:
    """True for a number and for a curve in words, with or without its braces."""
    return bool(re.match(r"\{|curve *:", subject)) or subject.replace(".", "", 1).isdigit()


def _of_curve(text: str, libraries: list[str], method: str) -> "Values":
    from fairlead.component.given import Part
    from fairlead.component.parameters import read
    from fairlead.errors import Location, ModelError, did_you_mean
    from fairlead.netlist.yaml12 import read_yaml

    members = _treatments(libraries)
    method = method or next(iter(members.values())).default_word
    if method not in members:
        raise typer.BadParameter(f"there is no method {method!r}. {did_you_mean(method, members)}")
    (part,) = (name for name, one in members[method].declaration.parameters.items() if isinstance(one, Part))
    tree, faults = read_yaml(f"{part}: {text}", part)
    if tree is None or faults:
        raise typer.BadParameter(f"{text!r} is not a curve: {'; '.join(map(str, faults))}")
    values, faults = read(members[method], tree.entries, method, Location("SUBJECT"), pathlib.Path())
    if values is None or faults:
        raise ModelError(faults)
    return values


def _curves(libraries: list[str]) -> dict[str, Any]:
    """Curves of friction by their word, those of one's own as well."""
    from fairlead.component.given import Part

    parts = [one for member in _treatments(libraries).values() for one in member.declaration.parameters.values()]
    families: list[Any] = [one.family for one in parts if isinstance(one, Part)]
    return dict(ChainMap(*(family.members for family in families)))


def _written_out(word: str, curves: dict[str, Any]) -> str:
    """A curve as it is given: '{curve: stribeck, coulomb: ..., velocity: ...}'."""
    from fairlead.component.given import REQUIRED

    given = curves[word].declaration.parameters
    wanted = [name for name, one in given.items() if getattr(one, "default", None) is REQUIRED]
    return "'{" + ", ".join([f"curve: {word}", *(f"{name}: ..." for name in wanted)]) + "}'"


def _treatments(libraries: list[str]) -> dict[str, Any]:
    """Members of the families of contacts, by method."""
    from fairlead.component.registry import known_types
    from fairlead.component.scene import is_head

    heads = [kind for kind in known_types(libraries).values() if is_head(kind) and _is_pressed(kind)]
    return dict(ChainMap(*(head.members for head in heads)))


def _is_pressed(head: "type[Family]") -> bool:
    """True for a family of contacts."""
    return any(member.answers.pressed_by for member in head.members.values())

"""The pages in docs/treatments and the figures of docs/friction.md, made from the classes and by the code.

    python docs/make.py            pages and figures, half a minute; also the table in docs/stepping.md
    python docs/make.py pages      pages only, docs/howto/parts.md among them

A test compares the pages with what this writes, so they cannot go stale.
"""

from __future__ import annotations

import inspect
import pathlib
import sys
import tempfile
from collections.abc import Iterator
from typing import Any

import fairlead
from fairlead.component.registry import known_types
from fairlead.describe.interface import beyond, first_line, parameter_rows, shared

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE))
from generate.text import flowing  # noqa: E402 - found by the line above

PAGES, FIGURES = HERE / "treatments", HERE / "figures"
NOTE = "<!-- written by docs/make.py from the class; change that -->"
TABLE_BEGINS, TABLE_ENDS = "<!-- table of stepping -->", "<!-- end of table -->"
NORMAL = 10.0  # N, for the figures
CURVE = {"curve": "stribeck", "stiction": 0.5, "coulomb": 0.3, "velocity": 5e-3}
COLOURS = 200  # of a figure; with a hundred, thin lines lose theirs
MIRRORED = "The same the other way"
LETTERS = (
    "T is the friction, v the slip, N the normal force, mu(v) the curve, mu_s its value from rest, F_s = N mu_s the",
    "largest friction of a contact that holds. af is the applied force, which the contact would have to take to hold.",
)
FLAT = ("bristle",)  # nothing to draw over slip speed: its friction does not depend on it


def pages() -> dict[pathlib.Path, str]:
    """Every page and its text."""
    contact: Any = known_types()["Contact"]
    known = sorted(contact.members.items())  # by name: the order of imports differs from process to process
    members = {word: member for word, member in known if member.__module__.startswith("fairlead.")}
    base = shared(member.declaration for member in members.values())
    found = {PAGES / f"{word}.md": "\n".join(page(word, member, base)) for word, member in members.items()}
    return {PAGES / "README.md": "\n".join(index(contact, members, base)), **found}


def stepping() -> tuple[pathlib.Path, str]:
    """The page on the error of a step with the table of what `stepping` can do."""
    from fairlead.analysis.treatments.stepping_table import page as table

    path = HERE / "stepping.md"
    before, rest = path.read_text(encoding="utf-8").split(TABLE_BEGINS)
    return path, f"{before}{TABLE_BEGINS}\n{table()}\n{TABLE_ENDS}{rest.split(TABLE_ENDS)[1]}"


def which_part() -> tuple[pathlib.Path, str]:
    """The page that leads from what an engineer calls a part to its type."""
    from fairlead.describe.part_names import page

    bundled = {name: kind for name, kind in known_types().items() if kind.__module__.startswith("fairlead.")}
    return HERE / "howto" / "parts.md", "\n".join(page(bundled, NOTE.replace("class", "classes")))


def page(word: str, member: Any, base: Any) -> Iterator[str]:
    """One treatment: what its class says of itself, its parameters, its zones and what leads where."""
    yield from (f"# `method: {word}`", "", NOTE, "")
    yield from (f"This page has the equation, the zones, the parameters and the limits of `method: {word}`.",
                "[How do I choose a friction law?](../howto/friction.md) says when to take it.", "")  # fmt: skip
    equation, _, rest = (inspect.getdoc(member) or "").partition("\n\n")
    yield from (*block(equation), "")
    yield from (*LETTERS, "")
    yield from flowing(rest, "../")
    if word not in FLAT:
        yield f"![Friction over slip speed](../figures/{word}.png)"
    own = beyond(member.declaration, base)
    rows = parameter_rows({name: one for name, one in own.parameters.items() if name != "effects"}, 0)
    if rows:
        yield from ("", "## Parameters of its own", "", *block("\n".join(rows)))
    yield from ("", "## Zones", "", "| from | to | when |", "|---|---|---|")
    for mark in member.declaration.guards.values():
        if mark.direction < 0 or first_line(mark.function).startswith(MIRRORED):
            continue
        others = set(mark.zones) == set(member.declaration.zones) - {mark.to}
        start = "every other" if others else ", ".join(f"`{zone}`" for zone in mark.zones)
        yield f"| {start} | `{mark.to}` | {first_line(mark.function)} |"
    yield from ("", "The other direction is the mirror image.")
    exempt = getattr(member, "exempt", {})
    if exempt:
        yield from ("", "## Where it breaks the contract of components", "")
        yield from (f"- {name}: {reason}" for name, reason in exempt.items())
    command = f"`fairlead describe {member.__name__}`"
    yield from ("", f"Equations as compiled: {command}. Other treatments: [list](README.md).", "")


def index(contact: Any, members: dict[str, Any], base: Any) -> Iterator[str]:
    """All treatments, and what they have in common."""
    yield from ("# Treatments of friction: which methods and curves are there?", "", NOTE, "")
    yield from ("Look up here what you may write as `method` and `curve` of a contact. To choose, read",
                "[How do I choose a friction law?](../howto/friction.md);",
                "[Friction](../friction.md) compares the methods.", "")  # fmt: skip
    yield from ("## Methods", "", "| `method` | Law |", "|---|---|")
    for word, member in members.items():
        yield f"| [`{word}`]({word}.md) | {cell(first_line(member))} |"
    yield from ("", "## Every contact", "", *block(inspect.getdoc(contact) or ""))
    yield from ("", "Parameters:", "", *block("\n".join(parameter_rows(base.parameters, 0))))
    curve: Any = contact.members["hold"].declaration.parameters["curve"].family
    yield from ("", "## Curves", "", *block(inspect.getdoc(curve) or ""), "", "| `curve` | Law |", "|---|---|")
    for word, member in sorted(curve.members.items()):
        if not member.__module__.startswith("fairlead."):
            continue  # of a user's library that happens to be loaded
        yield f"| `{word}` | {cell(first_line(member))} |"
    yield ""


def cell(text: str) -> str:
    """Text with bars that a table would take for its own."""
    return text.replace("|", "\\|")


def block(text: str) -> list[str]:
    """Text as it stands."""
    return ["```text", *text.splitlines(), "```"]


def figures() -> None:
    """Draw what docs/friction.md and the pages show."""
    from fairlead.analysis.characteristic import characteristic
    from fairlead.component.parameters import make
    from fairlead.report.friction_figure import draw

    contact: Any = known_types()["Contact"]
    for word, member in contact.members.items():
        if word not in FLAT:
            values = make(member, curve=CURVE, normal_force=NORMAL)
            small(draw(characteristic(values, NORMAL), FIGURES / f"{word}.png", f"method: {word}"))
    printed = make(contact.members["binding"], curve=CURVE, normal_force=NORMAL, form="literal")
    small(draw(characteristic(printed, NORMAL), FIGURES / "literal.png", "method: binding, form: literal"))
    steps(FIGURES / "steps.png")
    comparison(FIGURES / "compare.png")


def steps(path: pathlib.Path) -> None:
    """Step size over time of the block and spring: what a sign inside a step does to an implicit method."""
    import matplotlib
    import numpy as np

    from fairlead.report.figures import DOTS_PER_INCH, STYLE
    from fairlead.report.panel import COLOURS as LINES

    with matplotlib.rc_context({**STYLE, "backend": "agg"}), tempfile.TemporaryDirectory() as folder:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(8, 3), layout="constrained")
        ax = figure.subplots()
        for number, method in enumerate(("naive_sign", "tanh", "binding", "hold")):
            model = fairlead.load(every_step(pathlib.Path(folder)), {"method": method})
            result = model.run(out=f"{folder}/{method}", check=False)  # naive_sign uses its steps up, as it is to show
            h = np.diff(result.t)
            ax.plot(result.t[1:][h > 0], h[h > 0], ".", markersize=3, color=LINES[number], label=method)
        ax.set_yscale("log")
        ax.set_xlabel("time [s]")
        ax.set_ylabel("step [s]")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), markerscale=3)
        figure.savefig(path, dpi=DOTS_PER_INCH)
    small(path)


def every_step(folder: pathlib.Path) -> pathlib.Path:
    """The bundled block and spring, every step recorded, ended after a few thousand steps."""
    import fairlead.models

    text = (pathlib.Path(fairlead.models.__file__).parent / "block_and_spring.yaml").read_text(encoding="utf-8")
    file = folder / "scene.yaml"
    run = "run: {stop: 4 s, accuracy: 1e-5, max_steps: 3000}\n"
    file.write_text(text[: text.index("run: {")] + run, encoding="utf-8")
    return file


def comparison(path: pathlib.Path) -> None:
    """Error, creep and cost of the methods on one scene, as `fairlead compare` draws it."""
    from fairlead.analysis.cost.compare import compare
    from fairlead.report.compare_figure import draw

    methods = [m for m in known_types()["Contact"].members if m not in ("bristle", "naive_sign")]  # type: ignore[attr-defined]
    with tempfile.TemporaryDirectory() as folder:
        found = compare(
            lambda chosen: fairlead.load("block_and_spring", set=chosen), {"pad.method": methods}, out=folder
        )
        small(draw(found, path))


def small(path: pathlib.Path) -> None:
    """The same picture with few colours."""
    from PIL import Image

    Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)


def main() -> None:
    """Write everything."""
    PAGES.mkdir(exist_ok=True)
    for path, text in [*pages().items(), stepping(), which_part()]:
        path.write_text(text, encoding="utf-8")
    if sys.argv[1:] != ["pages"]:
        figures()


if __name__ == "__main__":
    main()

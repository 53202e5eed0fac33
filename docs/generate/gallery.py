"""The gallery: every bundled model with what it shows, its command and a picture."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import fairlead.models

from generate.runs import picture, wiring
from generate.tables import fence

TAKEN = {"single_bend": "page_light.png", "guidance_route": "page_dark.png"}
"""Models with a picture of their page in docs/figures, which a browser takes."""
DEAR = frozenset({"guidance_route_electric", "guidance_route_ideal", "long_deployment", "long_route"})
"""Models whose runs take too long for a build: they show their wiring only."""


def pages(docs: Path, folder: Path) -> dict[str, str]:
    """gallery.md."""
    models = sorted(Path(str(fairlead.models.__file__)).parent.glob("*.yaml"))
    lines = ["# Gallery", "", "Every bundled model runs by its name: with a question, a command and a picture.", ""]
    for model in models:
        lines += _entry(model, folder / "gallery")
    return {"gallery.md": "\n".join(lines)}


def _entry(model: Path, folder: Path) -> Iterator[str]:
    question, told = comment(model)
    wiring(model, folder)
    yield from (f"## {model.stem}", "", question, "", *fence("sh", f"fairlead run {model.stem} --report"))
    if model.stem in TAKEN:
        yield from (f"![The page of {model.stem}](../figures/{TAKEN[model.stem]})", "")
    elif model.stem not in DEAR:
        picture(model, folder)
        yield from (f"![Signals of {model.stem}](gallery/{model.stem}.png)", "")
    yield from (f"![Wiring of {model.stem}](gallery/{model.stem}_wiring.svg)", "")
    yield from ("What to know and to look at:", "", *fence("text", told)) if told else ()


def comment(model: Path) -> tuple[str, str]:
    """First paragraph of the comment at the head of a netlist, and the rest."""
    head = re.match(r"(?:#.*\n)+", model.read_text(encoding="utf-8"))
    text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in head[0].splitlines()) if head else ""
    first, _, rest = text.partition("\n\n")
    return " ".join(first.split()), rest.strip("\n")

"""The gallery: every bundled model with what it shows, its command and a picture."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import fairlead.models

from generate.runs import picture, wiring
from generate.tables import fence
from generate.text import flowing

TAKEN = {"single_bend": "page_light.png", "guidance_route": "page_dark.png"}
"""Models with a picture of their page in docs/figures, which a browser takes."""
DEAR = frozenset({
    "guidance_route_electric", "guidance_route_ideal", "guidance_route_sized", "long_deployment",
    "long_deployment_sized", "long_route", "long_route_sized", "plant", "electronics",
})  # fmt: skip
"""Models that show their wiring only: their runs take too long for a build, or say nothing without their other half."""
FOLDERS = {"machines": "Whole machines", "hard": "Hard cases, each with a closed form",
           "sized": "With sizes that have a source", "coupled": "Two halves that are coupled"}  # fmt: skip
"""Folders of models below the bundled ones, with their headings."""
ABOUT = """\
Every bundled model, with the question that it answers, its command and a picture. The small netlist of a part stands on
the page of the part ([components](components/index.md)).
"""
COUPLED = "python benchmarks/coupled_route.py"

QUESTIONS = {
    "belt": "When does a block on a moving belt stick, and when does it slip?",
    "block_and_spring": "How late does a block break away that is pulled through a spring, and does it creep before?",
    "capstan": "How does the tension of a rope grow round a bend?",
    "crustacean": "Does an array that carries its load in the hose ruck in two bends and a tube?",
    "friction_anchor": "How far does a line on a guide give way to a pull, and what of that stays?",
    "guidance_route": "What do winch and deployer have to do while an array is deployed and hauled back?",
    "guidance_route_electric": "The same with electric drives: what do play and friction of the gears change?",
    "guidance_route_ideal": "What do the line and its friction do by themselves, with drives that have no limits?",
    "guidance_route_torsion": "How much does a line twist that is hauled in through a route and wound on a drum?",
    "hundred_blocks": "How do fronts of sticking and slipping run through a rod on a hundred guides?",
    "long_deployment": "What tension has a line of 300 m while nearly all of it goes from the drum into the sea?",
    "long_route": "Which of three bends and a pulley makes the tension?",
    "power_unit": "How does the pressure of a power unit swing when a large flow is opened and slammed shut?",
    "sandwich": "Who holds a hose that lies between a device and its core?",
    "single_bend": "Does the hose of an array ruck in a bend, where, when and why?",
    "slack_start": "Does the core go slack when a line with hardly any pull behind it is started?",
    "torsion": "How far does a twist reach along a line on a guide, and what of it stays?",
    "valve_motor": "How fast does a hydraulic motor run up when its valve opens?",
    "weak_clamp": "How hard must belts press a line so that it does not slip when it starts?",
    "winch_drive": "How well does a controlled winch keep its speed when the line pulls harder?",
}
"""What each bundled model answers."""


def pages(docs: Path, folder: Path) -> dict[str, str]:
    """gallery.md."""
    folder_of = Path(str(fairlead.models.__file__)).parent
    lines = ["# Gallery", "", ABOUT, ""]
    for model in sorted(folder_of.glob("*.yaml")):
        lines += _entry(model, folder / "gallery", f"fairlead run {model.stem} --report")
    for below, heading in FOLDERS.items():
        lines += [f"## {heading}", ""]
        for model in sorted(folder_of.glob(f"{below}/*.yaml")):
            command = COUPLED if below == "coupled" else f"fairlead run {below}/{model.stem} --report"
            lines += _entry(model, folder / "gallery", command, level="###")
    return {"gallery.md": "\n".join(lines)}


def _entry(model: Path, folder: Path, command: str, level: str = "##") -> Iterator[str]:
    """Question, command, picture and wiring of a model, under a heading of its name."""
    question, told = comment(model)
    wiring(model, folder)
    asked = QUESTIONS.get(model.stem)
    yield from (f"{level} {model.stem}", "", *((f"**{asked}**", "") if asked else ()), question, "")
    yield from fence("sh", command)
    if model.stem in TAKEN:
        yield from (f"![The page of {model.stem}](../figures/{TAKEN[model.stem]})", "")
    elif model.stem not in DEAR:
        picture(model, folder)
        yield from (f"![Signals of {model.stem}](gallery/{model.stem}.png)", "")
    yield from (f"![Wiring of {model.stem}](gallery/{model.stem}_wiring.svg)", "")
    yield from ("What to know and to look at:", "", *flowing(told, "../")) if told else ()


def comment(model: Path) -> tuple[str, str]:
    """First paragraph of the comment at the head of a netlist, and the rest."""
    head = re.match(r"(?:#.*\n)+", model.read_text(encoding="utf-8"))
    text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in head[0].splitlines()) if head else ""
    first, _, rest = text.partition("\n\n")
    return " ".join(first.split()), rest.strip("\n")

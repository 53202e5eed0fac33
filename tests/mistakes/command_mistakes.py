"""Mistakes on the command line. The place is the word that was typed wrongly."""

from __future__ import annotations

from tests.mistakes.entry import ERROR, Mistake, Typed, words

Words = str | tuple[str, ...]


def command(name: str, *typed: str, place: Words, part: Words, cure: Words, answer: str = ERROR) -> Mistake:
    """A command as it is typed behind `fairlead`."""
    return Mistake(name, Typed(typed), words(place), words(part), words(cure), answer)


MISTAKES = (
    command("a file is misspelt", "check", "pullr.yaml", place="pullr.yaml", part="pullr.yaml", cure="puller.yaml"),
    command("a verb is misspelt", "chek", "puller.yaml", place="chek", part="chek", cure="check"),
    command("a scene parameter is misspelt", "check", "puller.yaml", "--set", "mue=0.4", place="--set", part="mue",
            cure="mu"),
    command("a component's parameter is misspelt", "check", "puller.yaml", "--set", "pad.normal_forc=30",
            place="--set", part=("pad", "normal_forc"), cure="normal_force"),
    command("a component is misspelt", "check", "puller.yaml", "--set", "pda.normal_force=30", place="--set",
            part="pda", cure=("pad", "pad.normal_force")),
    command("a value is forgotten", "check", "puller.yaml", "--set", "mu", place="--set", part="mu",
            cure=("NAME=VALUE", "mu=", "mu=0.6")),
    command("a value has a decimal comma", "check", "puller.yaml", "--set", "run.stop=5,5", place=("--set", "run.stop"),
            part="5,5", cure=("5.5", "decimal point", "decimal comma")),
    command("a value has a wrong unit", "check", "puller.yaml", "--set", "pad.normal_force=30 mm",
            place=("--set", "pad.normal_force"), part="30 mm", cure="N"),
    command("a start value of a misspelt mass", "check", "puller.yaml", "--set", "initial.blok.x=1 mm", place="--set",
            part="blok.x", cure=("block.x", "initial.block.x")),
    command("a station that the route has not", "check", "haul.yaml", "--set", "route.stations[9].radius=1 m",
            place="--set", part="stations[9]", cure=("0 to 3", "0 ... 3", "4 items", "wheel", "list of 4")),
    command("a station's name is misspelt", "check", "haul.yaml", "--set", "route.stations.whel.radius=1 m",
            place="--set", part="whel", cure="wheel"),
    command("compare varies a misspelt parameter", "compare", "puller.yaml", "--vary", "pad.metod=hold,tanh",
            place="--vary", part="metod", cure=("pad.method", "mean method", "friction.method")),
    command("compare varies over a treatment that there is not", "compare", "puller.yaml", "--vary",
            "friction.method=hold,foo", place=("--vary", "friction.method"), part="foo", cure=("binding", "tanh")),
    command("compare takes the error from a misspelt signal", "compare", "puller.yaml", "--vary",
            "pad.method=hold,tanh", "--signals", "blok.x", place="--signals", part="blok.x", cure="block.x"),
    command("a budget is a mass", "cost", "puller.yaml", "--budget", "60 kg", place="--budget", part="60 kg",
            cure=("s", "60 s", "time")),
    command("a scene without a line is asked for its statics", "statics", "puller.yaml", place=("puller.yaml",
            "puller"), part="line", cure=("route", "docs/routes.md")),
    command("the speed of statics is a length", "statics", "haul.yaml", "--speed", "0.3 m", place="--speed",
            part="0.3 m", cure=("m/s", "0.3 m/s")),
    command("margins of a folder that is not there", "margins", "results/nothing", place="results/nothing",
            part="results/nothing", cure=("run", "fairlead run", "folder")),
    command("a component type is misspelt", "describe", "Sprng", place="Sprng", part="Sprng", cure="Spring"),
    command("a library is not there", "check", "puller.yaml", "--library", "nothing.py", place="--library",
            part="nothing.py", cure=("file", "folder", "no such file", "does not exist", "not found")),
)  # fmt: skip

"""What is asked of a sweep, from options of the command line or a sweep file, all mistakes at once.

model: single_bend
set: {run.stop: 10 s}
grid: {mu: "0.2:0.7:0.05", method: [hold, binding]}
figures: {ruck: margin(ruck), peak: "peak(line.hose[*].tension)"}
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from fairlead.cases.figures import Function
from fairlead.cases.separators import separated_otherwise
from fairlead.errors import Fault, Location, ModelError, UsageError, listing, shown
from fairlead.netlist.netlist import Value
from fairlead.netlist.settings import Count, Strict
from fairlead.netlist.translate import validate
from fairlead.netlist.yaml12 import read_yaml
from fairlead.studies.sweeps.design import Design, Sample
from fairlead.studies.sweeps.distributions import Distribution, read_distribution
from fairlead.studies.sweeps.functions import FromFile
from fairlead.studies.sweeps.ranges import RangeError, read_range

Plain = str | int | float | bool
MOST_BYTES = 50_000_000


class Sampling(Strict):
    """A sample: how many points of which distributions."""

    kind: Literal["latin_hypercube", "sobol", "monte_carlo", "saltelli", "morris"]
    """How points are chosen; saltelli and morris are those for indices."""
    samples: Count
    """How many; of morris, trajectories; of saltelli, the base, which makes (parameters + 2) times as many."""
    over: Annotated[dict[str, str], Field(min_length=1)]
    """Distribution of each parameter, such as normal(0.4, 0.05)."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Another seed, other points."""
    correlations: dict[str, float] = {}
    """Rank correlations of monte_carlo, by the two names: {mu~speed: 0.5}."""


class SweepFile(Strict):
    """A file that says what to sweep."""

    called = "a sweep file"
    elsewhere = {"vary": "grid", "parameters": "set", "over": "sample", "libraries": "library", "signals": "figures"}
    model: str
    """A netlist, by its path from this file or by the name of a bundled model."""
    library: list[str] = []
    """Files with components of your own, by their paths from this file."""
    set: dict[str, Plain] = {}
    """Values that all cases have."""
    grid: dict[str, str | list[Plain]] = {}
    """Values of each parameter; all combinations are cases."""
    cases: list[dict[str, Plain]] = []
    """Cases one by one."""
    csv: str = ""
    """A file of cases: names in the first line, a case in each further one."""
    sample: Sampling | None = None
    """Points of distributions."""
    figures: dict[str, str] = {}
    """Figures of each case."""
    max_steps: Count | None = None
    """Steps after which a case ends."""
    keep: list[str] = []
    """Cases whose full results are kept."""


@dataclass(frozen=True)
class Plan:
    """A sweep as asked for."""

    model: str
    design: Design
    settings: Mapping[str, str] = field(default_factory=dict)
    libraries: tuple[str, ...] = ()
    figures: Mapping[str, str | Function] | None = None
    """None: those of the netlist."""
    max_steps: int | None = None
    keep: tuple[str, ...] = ()


def is_sweep_file(path: str) -> bool:
    """Whether a path is a YAML file with a key that sweep files have and netlists do not; `model:` may be misspelt."""
    file = Path(path)
    if not file.is_file() or file.suffix not in (".yaml", ".yml"):
        return False
    text = file.read_text(encoding="utf-8", errors="replace")
    return re.search(r"^(model|grid|cases|sample)\s*:", text, re.MULTILINE) is not None


def read_plan(path: str) -> Plan:
    """The plan of a sweep file. Raises ModelError with every mistake."""
    file = Path(path)
    tree, faults = read_yaml(file.read_text(encoding="utf-8", errors="replace"), str(file))
    if tree is None:
        raise ModelError(faults)
    made, wrong = validate(SweepFile, tree)
    if faults or wrong:
        raise ModelError([*faults, *wrong])
    asked, blocks = Asked(), tree.entries
    places = {block: {name: one.where for name, one in blocks[block].entries.items()} for block in ("grid", "figures")
              if block in blocks}  # fmt: skip
    for name, values in made.grid.items():
        text = values if isinstance(values, str) else None
        asked.grid[name] = (
            asked.range(places["grid"][name], name, text) if text is not None else list(map(_text, values))
        )
    asked.listed += [{name: _text(value) for name, value in one.items()} for one in made.cases]
    if made.csv:
        asked.read_csv(file.parent / made.csv)
    if made.sample is not None:
        where = _at(blocks["sample"], "over")
        over = {name: asked.distribution(where, name, text) for name, text in made.sample.over.items()}
        pairs = asked.pairs(_at(blocks["sample"], "correlations"), made.sample.correlations)
        asked.sample = Sample(made.sample.kind, made.sample.samples, over, made.sample.seed, pairs)
    figures = {name: asked.figure(places["figures"][name], text, file.parent) for name, text in made.figures.items()}
    beside = file.parent / made.model
    model = str(beside) if beside.is_file() else made.model
    libraries = tuple(str(file.parent / one) for one in made.library)
    settings = {name: _text(value) for name, value in made.set.items()}
    return Plan(model, asked.design(), settings, libraries, figures or None, made.max_steps, tuple(made.keep))


class Asked:
    """Parts of a design as they are read, and what is wrong with them."""

    def __init__(self) -> None:
        """Nothing read yet."""
        self.grid: dict[str, list[Any]] = {}
        self.listed: list[dict[str, Any]] = []
        self.sample: Sample | None = None
        self.faults: list[Fault] = []

    def design(self) -> Design:
        """The design. Raises ModelError with what is wrong in its parts, UsageError for the whole."""
        if self.faults:
            raise ModelError(self.faults)
        made = Design(self.grid, self.listed, self.sample)
        made.refuse()
        return made

    def range(self, where: Location, name: str, text: str) -> list[str]:
        """Values of a name."""
        try:
            return read_range(text)
        except RangeError as error:
            self.faults.append(Fault(where, f"{shown(name)} = {shown(text)}: {error.what}", error.way_out))
            return []

    def distribution(self, where: Location, name: str, text: str) -> Distribution:
        """The distribution of a name."""
        try:
            return read_distribution(text)
        except RangeError as error:
            self.faults.append(Fault(where, f"{shown(name)} = {shown(text)}: {error.what}", error.way_out))
            return Distribution("choice", words=("",))

    def figure(self, where: Location, text: str, folder: Path) -> str | Function:
        """A figure: its text, or a function in a file of the user."""
        named = re.fullmatch(r"\s*(.+\.py)\s*:\s*(\w+)\s*", text)
        if named is None:
            return text
        try:
            return FromFile.of(folder / named[1], named[2])
        except UsageError as error:
            self.faults.append(Fault(where, str(error)))
            return text

    def figures(self, texts: Iterable[str], option: str) -> dict[str, str | Function]:
        """Figures of a command line, `NAME=FIGURE` or just FIGURE, by name."""
        wanted: dict[str, str | Function] = {}
        written: dict[str, str] = {}
        for text in texts:
            named = re.fullmatch(r"\s*([^=()]+?)\s*=\s*(.+)", text)
            name, said = (named[1], named[2]) if named else (text.strip(), text)
            if name in written and written[name] != said:
                what = f"{option} gives {shown(name)} twice: {shown(written[name])} and {shown(said)}"
                self.faults.append(Fault(Location(option), what, "Give each figure a name of its own."))
            wanted[name], written[name] = self.figure(Location(option), said, Path()), said
        return wanted

    def pairs(self, where: Location, given: Mapping[str, float]) -> dict[tuple[str, str], float]:
        """Correlations by two names."""
        found = {}
        for text, value in given.items():
            one, tilde, other = (part.strip() for part in text.partition("~"))
            if not (one and tilde and other) or one == other or not -1 < value < 1:
                what = f"{shown(text)} = {value}: this is no correlation of two parameters"
                self.faults.append(Fault(where, what, "Write it as mu~speed: 0.5, above -1 and below 1."))
            else:
                found[one, other] = value
        return found

    def read_csv(self, file: Path) -> None:
        """Cases of a CSV file; each text as it stands there."""
        if not file.is_file():
            self.faults.append(Fault(Location(str(file)), "there is no such file of cases"))
            return
        if file.stat().st_size > MOST_BYTES:
            self.faults.append(Fault(Location(str(file)), f"this file has more than {MOST_BYTES} bytes"))
            return
        with file.open(encoding="utf-8-sig", errors="replace", newline="") as stream:
            lines = [[cell.strip() for cell in row] for row in csv.reader(stream)]
        if other := separated_otherwise(lines[0] if lines else ()):
            self.faults.append(Fault(Location(str(file), 1, 1), *other))
            return
        names = lines[0] if lines else []
        if not any(any(row) for row in lines[1:]) or not all(names) or len(set(names)) < len(names):
            what = "a file of cases has different names in its first line, and a case in each further one"
            self.faults.append(Fault(Location(str(file), 1, 1), what, "Write mu,method and below it 0.3,hold."))
            return
        for number, row in enumerate(lines[1:], 2):
            if not any(row):
                continue
            if len(row) != len(names) or not all(row):
                what = (
                    f"this line has {sum(map(bool, row))} values, the first one names {len(names)} ({listing(names)})"
                )
                comma = "A comma separates values, so numbers have a point." if len(row) > len(names) else ""
                self.faults.append(Fault(Location(str(file), number, 1), what, comma))
            else:
                self.listed.append(dict(zip(names, row, strict=True)))


def options(texts: Iterable[str], option: str, example: str) -> dict[str, str]:
    """`["mu=0.2:0.7:0.05"]` by name. Raises UsageError for what is no NAME=TEXT, or a name that comes twice."""
    found: dict[str, str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise UsageError(f"{option} {shown(text)}: NAME=VALUES is wanted, such as {option} {example}.")
        if name in found:
            raise UsageError(f"{option} gives {shown(name)} twice: {shown(found[name])} and {shown(value)}.")
        found[name] = value
    return found


def figures_of_options(texts: Iterable[str], option: str) -> dict[str, str | Function]:
    """Figures of a command line by name. Raises ModelError for a file without such a function."""
    asked = Asked()
    wanted = asked.figures(texts, option)
    if asked.faults:
        raise ModelError(asked.faults)
    return wanted


def plan_of_options(model: str, settings: Mapping[str, str], libraries: Sequence[str], *, grid: Sequence[str],
                    cases: Path | None, over: Sequence[str], sample: tuple[str, int] | None, seed: int,
                    correlate: Sequence[str], figures: Sequence[str], max_steps: int | None,
                    keep: Sequence[str]) -> Plan:  # fmt: skip
    """The plan of a command line. Raises ModelError, UsageError."""
    asked = Asked()
    for name, text in options(grid, "--grid", "mu=0.2:0.7:0.05").items():
        asked.grid[name] = asked.range(Location("--grid"), name, text)
    if cases is not None:
        asked.read_csv(cases)
    laws = options(over, "--over", "mu='uniform(0.2, 0.7)'")
    if bool(laws) != bool(sample):
        lacks = (
            "--sobol, --lhs, --monte-carlo, --saltelli or --morris, and how many"
            if laws
            else "--over NAME=DISTRIBUTION"
        )
        raise UsageError(f"A sample needs {lacks}.")
    if sample is not None:
        found = {name: asked.distribution(Location("--over"), name, text) for name, text in laws.items()}
        given = {name: _number(text) for name, text in options(correlate, "--correlate", "mu~speed=0.5").items()}
        pairs = asked.pairs(Location("--correlate"), given)
        if pairs and sample[0] != "monte_carlo":
            raise UsageError("--correlate goes with --monte-carlo: the other samples have independent parameters.")
        asked.sample = Sample(sample[0], sample[1], found, seed, pairs)
    wanted = asked.figures(figures, "--figure")
    return Plan(model, asked.design(), settings, tuple(libraries), wanted or None, max_steps, tuple(keep))


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("inf")


def _at(block: Value, name: str) -> Location:
    return block.entries[name].where if name in block.entries else block.where


def _text(value: Plain) -> str:
    return {True: "true", False: "false"}[value] if isinstance(value, bool) else str(value)

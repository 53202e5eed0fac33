"""What is asked of a fit, from its file, all mistakes at once.

model: servo.yaml
records:
  slow: {file: slow.csv, time: t, signals: {arm.angle: angle}, set: {load.mass: 0.5 kg}}
parameters:
  mu: {start: 0.3, low: 0.05, high: 1, log: true}
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.netlist.netlist import Value
from fairlead.netlist.settings import Count, Strict
from fairlead.netlist.translate import validate
from fairlead.netlist.yaml12 import read_yaml
from fairlead.quantities import QuantityError, fits, quantity, split

Plain = str | int | float | bool
LINEAR, ROBUST = "linear", ("soft_l1", "huber", "cauchy", "arctan")


class SignalFile(Strict):
    """A measured signal: the column, and what the line of names does not say of it."""

    column: str
    """Name of the column."""
    unit: str = ""
    """Unit of the column, if its name bears none; else that of the model's signal."""
    noise: str | float | None = None
    """Standard deviation of the noise; without it, it is estimated from what the fit leaves."""


class RecordFile(Strict):
    """A measured record."""

    file: str
    """A CSV file, by its path from this one."""
    time: str = "time"
    """Name of the column with times."""
    unit: str = ""
    """Unit of the times, if the column bears none; else s."""
    model: str = ""
    """A model of its own."""
    set: dict[str, Plain] = {}
    """Values of its own."""
    signals: Annotated[dict[str, str | SignalFile], Field(min_length=1)]
    """Signals of the model, and the columns that hold them."""


class ParameterFile(Strict):
    """A parameter that is sought."""

    start: str | float
    """Where the search begins."""
    low: str | float
    """It is not below."""
    high: str | float
    """It is not above."""
    log: bool = False
    """Whether it is sought by its logarithm."""


class LossFile(Strict):
    """What is made small."""

    kind: Literal["linear", "soft_l1", "huber", "cauchy", "arctan"] = "linear"
    """linear: least squares; the others let go of outliers."""
    scale: Annotated[float, Field(gt=0)] = 1.0
    """Residual, in standard deviations of the noise, from which on a robust loss lets go."""
    by: Literal["auto", "time", "features", "statistics"] = "auto"
    """auto: features when there are any, else in time; statistics where the course cannot be foretold."""


class LawFile(Strict):
    """A law to be compared with others."""

    set: dict[str, Plain] = {}
    """Values that make this law."""
    model: str = ""
    """A model of its own."""
    parameters: dict[str, ParameterFile] = {}
    """Parameters beside those of the fit."""


class FitFile(Strict):
    """A file that says what to fit."""

    called = "a fit file"
    model: str = ""
    """A netlist, by its path from this file or by the name of a bundled model."""
    library: list[str] = []
    """Files with components of your own, by their paths from this file."""
    set: dict[str, Plain] = {}
    """Values that all records have."""
    records: Annotated[dict[str, RecordFile], Field(min_length=1)]
    """Measured records by name."""
    parameters: Annotated[dict[str, ParameterFile], Field(min_length=1)]
    """What is sought."""
    features: dict[str, str] = {}
    """Features of the records that are to agree, such as period(block.x)."""
    loss: LossFile = LossFile()
    """What is made small."""
    leave_out: list[str] = []
    """Records that are foretold and not fitted."""
    laws: dict[str, LawFile] = {}
    """Laws to be compared, each with every record left out in turn."""
    starts: Count = 3
    """Searches; the first from `start`, the others from points between the bounds."""
    seed: Annotated[int, Field(ge=0)] = 0
    """Of those points."""
    max_steps: Count | None = None
    """Steps after which a run ends."""


@dataclass(frozen=True)
class Sought:
    """A parameter that is sought, in SI; `unit` as it was written."""

    name: str
    start: float
    low: float
    high: float
    log: bool
    unit: str
    factor: float
    where: Location


@dataclass(frozen=True)
class Law:
    """A law: its values, its model if it has one of its own, and its own parameters."""

    name: str
    settings: Mapping[str, str] = field(default_factory=dict)
    model: str = ""
    sought: tuple[Sought, ...] = ()


@dataclass(frozen=True)
class Asked:
    """A fit file as read; `places` says where the parts of each record stand."""

    file: Path
    given: FitFile
    sought: tuple[Sought, ...]
    laws: tuple[Law, ...]
    tree: Value

    def at(self, *path: str) -> Location:
        """The place of an entry; that of the nearest one above it when it is not there."""
        value = self.tree
        for name in path:
            if name not in value.entries:
                break
            value = value.entries[name]
        return value.named_at

    def model_of(self, record: str, law: Law) -> str:
        """Path or name of the model of a record under a law."""
        name = self.given.records[record].model or law.model or self.given.model
        beside = self.file.parent / name
        return str(beside) if beside.is_file() else name

    def settings_of(self, record: str, law: Law) -> dict[str, str]:
        """Values of a record under a law; those of the law come last."""
        given = {**self.given.set, **self.given.records[record].set}
        return {**{name: text_of(value) for name, value in given.items()}, **law.settings}


def read_fit(path: str | Path) -> Asked:
    """What a fit file asks. Raises ModelError with every mistake in its form."""
    file = Path(path)
    if not file.is_file():
        raise ModelError([Fault(Location(str(path)), "there is no such fit file", "Give the path of a YAML file.")])
    tree, faults = read_yaml(file.read_text(encoding="utf-8", errors="replace"), str(file))
    if tree is None:
        raise ModelError(faults)
    made, wrong = validate(FitFile, tree)
    if made is None:
        raise ModelError([*faults, *wrong])
    sought = tuple(_sought(made.parameters, tree.entries["parameters"], faults))
    blocks = tree.entries["laws"].entries if made.laws else {}
    laws = tuple(
        Law(name, {key: text_of(value) for key, value in law.set.items()}, law.model,
            tuple(_sought(law.parameters, blocks[name].entries["parameters"], faults)) if law.parameters else ())
        for name, law in made.laws.items()
    )  # fmt: skip
    asked = Asked(file, made, sought, laws, tree)
    faults += _of_the_whole(asked)
    if faults:
        raise ModelError(faults)
    return asked


def _of_the_whole(asked: Asked) -> Iterator[Fault]:
    given = asked.given
    for name in given.leave_out:
        if name not in given.records:
            hint = did_you_mean(name, given.records)
            yield Fault(asked.at("leave_out"), f"leave_out: there is no record {shown(name)}. {hint}".rstrip(),
                        f"There are {listing(given.records)}.")  # fmt: skip
    if set(given.leave_out) >= set(given.records):
        yield Fault(asked.at("leave_out"), "every record is left out", "Leave at least one to be fitted.")
    for name, record in given.records.items():
        if not (record.model or given.model or all(law.model for law in given.laws.values() or [LawFile()])):
            yield Fault(asked.at("records", name), f"{name} has no model", "Write model: at the top, or in the record.")
    if given.loss.by == "features" and not given.features:
        yield Fault(asked.at("loss", "by"), "loss.by = features, and there are none", "Write features: below it.")
    if given.laws and len(given.records) < 2:
        what = "laws are compared by leaving each record out in turn, and there is one record"
        yield Fault(asked.at("laws"), what, "Give two records or more, or split the one.")


def _sought(given: Mapping[str, ParameterFile], block: Value, faults: list[Fault]) -> Iterator[Sought]:
    for name, one in given.items():
        where = block.entries[name]
        values = {}
        for part in ("start", "low", "high"):
            try:
                values[part] = quantity(str(getattr(one, part)))
            except QuantityError as error:
                faults.append(Fault(where.entries[part].where, f"{name}.{part} = {error.what}", error.allowed))
        if len(values) < 3:
            continue
        start, low, high = values["start"], values["low"], values["high"]
        for part in ("low", "high"):
            bare = not split(str(getattr(one, part)))[1]  # in SI
            if not bare and not fits(values[part].dimension, start.dimension):
                what = f"{name}: {part} = {getattr(one, part)} and start = {one.start} are of different kinds"
                faults.append(Fault(where.entries[part].where, what, "Give all three in units of one kind."))
        if not low.value < high.value:
            faults.append(Fault(where.where, f"{name}: low = {one.low} is not below high = {one.high}"))
        elif not low.value <= start.value <= high.value:
            what = f"{name}: start = {one.start} is not between low = {one.low} and high = {one.high}"
            faults.append(Fault(where.entries["start"].where, what, "Begin between the bounds."))
        elif one.log and low.value <= 0:
            what = f"{name}: low = {one.low}, and its logarithm is sought"
            faults.append(Fault(where.entries["low"].where, what, "Give a bound above zero, or leave log out."))
        else:
            number, unit = split(str(one.start))
            factor = start.value / number if number else quantity(f"1 {unit}").value if unit else 1.0
            yield Sought(name, start.value, low.value, high.value, one.log, unit, factor, where.named_at)


def text_of(value: Plain) -> str:
    """A value as the command line has it."""
    return {True: "true", False: "false"}[value] if isinstance(value, bool) else str(value)


def laws_of_options(texts: Iterable[str]) -> tuple[Law, ...]:
    """All pairs of what `--compare method=hold,lugre --compare curve=...` names. Raises UsageError."""
    import itertools

    from fairlead.studies.sweeps.plan import options

    found = {name: [one.strip() for one in text.split(",") if one.strip()]
             for name, text in options(texts, "--compare", "friction.method=hold,lugre,tanh").items()}  # fmt: skip
    laws = []
    for pick in itertools.product(*found.values()):
        settings = dict(zip(found, pick, strict=True))
        laws.append(Law(", ".join(f"{name}={value}" for name, value in settings.items()), settings))
    return tuple(laws)

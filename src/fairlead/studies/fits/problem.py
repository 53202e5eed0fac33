"""Residuals of a fit: what a model computes beside what was measured, in standard deviations.

In time, the residual of a signal is (computed - measured)/scale at every time of the record, where scale is the noise
if it is given, else the spread of the measured signal; under a robust loss, which must know what an outlier is, then
the noise that is left of it. By features, it is that of each feature. A run that does not
finish leaves residuals of FAR, so that a search turns away from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

import fairlead
from fairlead.analysis.record.declared_signals import signals_of
from fairlead.cases.cases import Cases
from fairlead.errors import Fault, Location, ModelError, did_you_mean, shown
from fairlead.studies.fits.features import STATISTICS, Feature, FeatureError, read_feature
from fairlead.studies.fits.fit_file import Asked, Law, RecordFile, SignalFile, Sought
from fairlead.studies.fits.measured import Column, Measured, column_of, read_table, times_of

Floats = NDArray[np.float64]
FAR = 1e3
NORMAL = 1.4826
"""Deviation of normal noise over the median of its size."""
TIME, FEATURES, STATISTIC = "time", "features", "statistics"


@dataclass(frozen=True)
class Record:
    """A record beside its model: its cases, its values, what is measured, and the units of its signals."""

    name: str
    cases: Cases
    measured: Measured
    units: Mapping[str, str]

    def computed(self, values: Mapping[str, float]) -> Floats | None:
        """Signals at the times of the record, shape (signals, times); None when the run did not finish."""
        row, curves = self.cases.curves(values, list(self.measured.values), self.measured.times)
        return curves if row.status == "finished" and np.isfinite(curves).all() else None

    def sentence(self, values: Mapping[str, float]) -> str:
        """How the case of these values ended."""
        row, _ = self.cases.curves(values, list(self.measured.values), self.measured.times)
        return f"{row.status}: {row.sentence}"


@dataclass(frozen=True)
class Target:
    """What of a record is to agree: residuals of its curves or features."""

    record: Record
    by: str
    features: tuple[Feature, ...] = ()
    left: Mapping[str, float] = field(default_factory=dict)
    """Noise of signals for which none is given, as a fit before this one left it."""

    @property
    def count(self) -> int:
        """Number of residuals."""
        return len(self.features) if self.by != TIME else self.record.measured.times.size * len(self.record.units)

    @property
    def known_noise(self) -> bool:
        """Whether every scale is a given noise."""
        if self.by == TIME:
            return all(one is not None for one in self.record.measured.noise.values())
        return all(one.noise is not None for one in self.features)

    def residuals(self, values: Mapping[str, float]) -> Floats:
        """Residuals, shape (count,), without unit."""
        curves = self.record.computed(values)
        return np.full(self.count, FAR) if curves is None else self.of(curves)

    def without(self, values: Mapping[str, float]) -> tuple[str, ...]:
        """Names of features that have no value in the run for these parameters, as a period without a swing."""
        curves = self.record.computed(values) if self.features else None
        if curves is None:
            return ()
        got = dict(zip(self.record.measured.values, curves, strict=True))
        return tuple(one.text for one in self.features if not np.isfinite(one.of(self.record.measured.times, got)))

    def of(self, curves: Floats) -> Floats:
        """Residuals of computed curves."""
        measured = self.record.measured
        if self.by == TIME:
            parts = [(got - value) / self._scale(name)
                     for got, (name, value) in zip(curves, measured.values.items(), strict=True)]  # fmt: skip
            return np.concatenate(parts)
        got = dict(zip(measured.values, curves, strict=True))
        found = [(one.of(measured.times, got) - one.of(measured.times, measured.values)) /
                 (one.noise or one.noise_in(measured.times, measured.values)) for one in self.features]  # fmt: skip
        return np.where(np.isfinite(found), found, FAR)

    def _scale(self, name: str) -> float:
        noise, spread = self.record.measured.noise[name], float(np.std(self.record.measured.values[name]))
        return noise if noise is not None else self.left.get(name, spread if spread > 0 else 1.0)

    def with_noise_of(self, r: Floats, least: float) -> Target:
        """The same with a noise where none is given: from the median size of its residuals, which outliers hardly move.

        `least` is a residual that is rounding.
        """
        if self.by != TIME:
            return self
        parts = zip(self.record.measured.values, np.split(r, len(self.record.units)), strict=True)
        left = {name: max(NORMAL * float(np.median(np.abs(own))), least) * self._scale(name) for name, own in parts}
        return replace(self, left=left)


def records_of(asked: Asked, law: Law = Law("")) -> list[Record]:  # noqa: B008 - frozen
    """All records beside their models under a law. Raises ModelError with every mistake; nothing is run."""
    faults: list[Fault] = []
    records = [_record(asked, name, given, law, faults) for name, given in asked.given.records.items()]
    for name, text in asked.given.features.items():
        for one in _features(asked, [(name, text)], records, faults):
            if all(record is not None for record in records) and not any(_has(record, one) for record in records):
                what = f"{name} = {shown(text)} has no value in any record"
                faults.append(Fault(asked.at("features", name), what, "Leave it out, or measure longer."))
    if faults:
        raise ModelError(dict.fromkeys(faults))
    return [record for record in records if record is not None]


def targets_of(asked: Asked, records: Iterable[Record], chaotic: Mapping[str, bool]) -> list[Target]:
    """What of each record is to agree; that of a chaotic one are its statistics, unless time is insisted on."""
    made = []
    for record in records:
        by: str = asked.given.loss.by
        if by == "auto":
            by = FEATURES if asked.given.features else STATISTIC if chaotic.get(record.name) else TIME
        texts = list(asked.given.features.items()) if by == FEATURES else [
            (shape.format(name), shape.format(name)) for name in record.measured.values for shape in STATISTICS
        ] if by == STATISTIC else []  # fmt: skip
        features = tuple(one for one in _features(asked, texts, [record], []) if _has(record, one))
        made.append(Target(record, by, features))
    return made


def _has(record: Record | None, one: Feature) -> bool:
    """Whether a feature has a value in what was measured."""
    if record is None or not set(one.signals) <= set(record.units):
        return False
    return bool(np.isfinite(one.of(record.measured.times, record.measured.values)))


def _features(
    asked: Asked, texts: Iterable[tuple[str, str]], records: Sequence[Record | None], faults: list[Fault]
) -> list[Feature]:
    made = []
    for name, text in texts:
        where = asked.at("features", name)
        try:
            made.append(read_feature(name, text))
        except FeatureError as error:
            faults.append(Fault(where, f"{name} = {shown(text)}: {error.what}", error.way_out))
            continue
        there = [record for record in records if record is not None]
        if there and not any(set(made[-1].signals) <= set(record.units) for record in there):
            known = dict.fromkeys(signal for record in there for signal in record.units)
            hint = " ".join(filter(None, (did_you_mean(one, known) for one in made[-1].signals if one not in known)))
            what = f"{name} = {shown(text)}: no record measures all of its signals. {hint}".rstrip()
            faults.append(Fault(where, what, "Name them under signals: of a record."))
    return made


def _record(asked: Asked, name: str, given: RecordFile, law: Law, faults: list[Fault]) -> Record | None:
    """A record, or None with what is wrong with it."""
    before = len(faults)
    file = asked.file.parent / given.file
    table, wrong = read_table(file, asked.at("records", name, "file"))
    faults += wrong
    times = None
    if table is not None:
        times, wrong = times_of(table, Column(given.time, given.unit, "s", asked.at("records", name, "time")))
        faults += wrong
    stop = {} if times is None or not len(times) or wrong else {"run.stop": repr(float(times[-1]))}
    model = _model(asked, name, law, stop, faults)
    if model is None:
        return None
    units = {one.name: one.unit for one in signals_of(model.flat.assembly)}
    values, noise = {}, {}
    for signal, column in given.signals.items():
        where = asked.at("records", name, "signals", signal)
        if signal not in units:
            what = f"{model.netlist.name} has no signal {shown(signal)}. {did_you_mean(signal, units)}".rstrip()
            faults.append(Fault(where, what, "`fairlead describe MODEL` tells all of them."))
            continue
        one = column if isinstance(column, SignalFile) else SignalFile(column=column)
        if table is not None:
            values[signal], wrong = column_of(table, Column(one.column, one.unit, units[signal], where))
            faults += wrong
        noise[signal] = _noise(one, units[signal], where, faults)
    if times is not None and not wrong and len(times) and times[0] < model.netlist.run.start:
        what = f"the record begins at {times[0]:g} s, before the run at {model.netlist.run.start:g} s"
        faults.append(Fault(Location(str(file), 2, 1), what, "Set run.start, or shift the times."))
    if len(faults) > before or times is None:
        return None
    return Record(name, Cases(model, {}, max_steps=asked.given.max_steps), Measured(times, values, noise),
                  {signal: units[signal] for signal in values})  # fmt: skip


def _noise(one: SignalFile, unit: str, where: Location, faults: list[Fault]) -> float | None:
    from fairlead.quantities import QuantityError, si

    if one.noise is None:
        return None
    try:
        value = si(one.noise, unit)
    except QuantityError as error:
        faults.append(Fault(where, f"noise = {error.what}", error.allowed))
        return None
    if value <= 0:
        faults.append(Fault(where, f"noise = {one.noise} is not above zero", "Leave it out; it is then estimated."))
    return value


def _model(asked: Asked, name: str, law: Law, stop: dict[str, str], faults: list[Fault]) -> fairlead.Model | None:
    """The model of a record at the start of all parameters, checked."""
    settings = {**asked.settings_of(name, law), **stop}
    libraries = [str(asked.file.parent / one) for one in asked.given.library]
    where = asked.at("records", name)
    try:
        model = fairlead.load(asked.model_of(name, law), set=settings, libraries=libraries)
    except ModelError as error:
        faults += [_placed(fault, where) for fault in error.faults]
        return None
    for one in (*asked.sought, *law.sought):
        try:
            model.beside({one.name: repr(one.start)}).assembly  # noqa: B018 - the parameter is checked
        except ModelError as error:
            faults += [Fault(one.where, fault.what, fault.way_out) for fault in error.faults]
    return model


def _placed(fault: Fault, where: Location) -> Fault:
    """A fault of the model in its own file stays there; one of a value of the fit file is placed here."""
    return fault if fault.where is not None and fault.where.line else Fault(where, fault.what, fault.way_out)


@dataclass(frozen=True, eq=False)
class Group:
    """Residuals that share a noise: their places, whether it is given, and whether they follow each other in time."""

    at: NDArray[np.intp]
    known: bool
    in_order: bool
    record: str = ""
    signal: str = ""


@dataclass(frozen=True)
class Problem:
    """Parameters and targets: residuals over z, the parameters in units of their ranges or by their logarithms."""

    sought: tuple[Sought, ...]
    targets: tuple[Target, ...]

    def values(self, z: Floats) -> dict[str, float]:
        """Parameters by name, in SI."""
        return {one.name: float(np.exp(x)) if one.log else float(x * scale_of(one))
                for one, x in zip(self.sought, z, strict=True)}  # fmt: skip

    def z(self, values: Iterable[float]) -> Floats:
        """What is searched, from parameters in SI."""
        return np.array([np.log(v) if one.log else v / scale_of(one)
                         for one, v in zip(self.sought, values, strict=True)])  # fmt: skip

    @property
    def start(self) -> Floats:
        """Where the search begins."""
        return self.z(one.start for one in self.sought)

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """Lower and upper bounds of z."""
        return self.z(one.low for one in self.sought), self.z(one.high for one in self.sought)

    def residuals(self, z: Floats) -> Floats:
        """All residuals."""
        values = self.values(z)
        return np.concatenate([one.residuals(values) for one in self.targets])

    @cached_property
    def groups(self) -> tuple[Group, ...]:
        """Residuals that share a noise: a signal of a record each, and all features together."""
        made, features, begin = [], [], 0
        for one in self.targets:
            place = np.arange(begin, begin + one.count)
            if one.by == TIME:
                noise = one.record.measured.noise
                made += [Group(at, noise[name] is not None, True, one.record.name, name)
                         for at, name in zip(np.split(place, len(noise)), one.record.measured.values, strict=True)]
            else:
                features.append(place)
            begin += one.count
        if features:
            made.append(Group(np.concatenate(features), all(one.known_noise for one in self.targets), False))
        return tuple(made)

    @property
    def known_noise(self) -> bool:
        """Whether residuals are in standard deviations of a given noise."""
        return all(one.known_noise for one in self.targets)


def scale_of(one: Sought) -> float:
    """What a parameter without logarithm is counted in: the larger of its bounds without sign."""
    return max(abs(one.low), abs(one.high))

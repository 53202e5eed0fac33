"""The `run` and `record` blocks: how far, how exactly, by which method, and what is written down."""

from __future__ import annotations

import re
from typing import Annotated, ClassVar, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, WithJsonSchema, model_validator

from fairlead.errors import shown
from fairlead.netlist.hover import say
from fairlead.quantities import QuantityError, wanted, whole, written


class Strict(BaseModel):
    """A frozen block in which an unknown key is an error; its docstrings are the hover texts of editors."""

    called: ClassVar[str] = ""
    """What messages call a file that holds it, as in "a netlist has no key x"; empty for what is no file."""
    elsewhere: ClassVar[dict[str, str]] = {}
    """Keys that other tools or commands have, with the key that means the same here."""
    model_config = ConfigDict(
        extra="forbid", frozen=True, strict=True, hide_input_in_errors=True, json_schema_extra=say
    )


def _schema_of(unit: str) -> WithJsonSchema:
    return WithJsonSchema({"type": ["number", "string"], "description": wanted(unit)})


MOST_COUNTED = 10**12  # steps or switches of a budget; a processor needs weeks for them

# Text with a unit (or an expression in braces) or a bare number comes in, an SI float is kept.
Seconds = Annotated[float, BeforeValidator(lambda value: written(value, "s")), _schema_of("s")]
Metres = Annotated[float, BeforeValidator(lambda value: written(value, "m")), _schema_of("m")]
Number = Annotated[
    float, BeforeValidator(lambda value: written(value, "1")), WithJsonSchema({"type": ["number", "string"]})
]
Count = Annotated[int, BeforeValidator(whole), Field(gt=0, le=MOST_COUNTED)]
Duration = Annotated[Seconds, Field(gt=0)]


LONGEST_FILE_NAME = 200  # bytes; file systems take 255
SHORTEST_FRAME = 1e-9  # of a run, and of the times themselves: a billion steps, whose ends are known to 1e-7 of one
SHORTEST = 1e-12  # s, and as a share of the times themselves: below it matrices of the engines are rounded away


class RunSettings(Strict):
    """How a run goes; every time is a quantity (`20 s`, `10 ms`) or a bare number of seconds."""

    stop: Seconds
    """Time at which the run ends, as in `stop: 10 s`."""
    start: Seconds = 0.0
    """Time at which the run starts."""
    accuracy: Annotated[Number, Field(ge=1e-12, le=0.1)] = 1e-4
    """Relative accuracy; sets the tolerances of all unknowns together."""
    engine: Literal["auto", "rodas", "stepping", "ida"] = "auto"
    """The engine. rodas locates every switch; stepping finds many stick-slip switches inside each step; ida is an
    independent check (BDF by SUNDIALS). auto is rodas, or stepping for 100 contacts and more that hold exactly
    with laws that are linear between switches and stiction not above sliding friction; run.json says which and why."""
    method: Literal["auto", "rodas5p", "rodas3p"] = "auto"
    """The Rosenbrock method; auto takes rodas5p. rodas3p (order 3) serves loose accuracies with few switches."""
    max_step: Duration | None = None
    """Longest step."""
    real_time: Duration | None = None
    """Steps of this length, with bounded work in each, by the engine stepping: `1 ms` to run beside a clock. What is
    not done within the bound is counted as an overrun (docs/real_time.md)."""
    first_step: Duration | None = None
    """First step tried, at the start and after every switch."""
    step_floor: Duration | None = None
    """Steps shorter than this, several in a row, are chatter or a stop."""
    max_wall: Duration | None = None
    """Wall time, from when the engine is loaded, after which the run stops and keeps what it has."""
    max_steps: Count | None = None
    """Steps after which the run stops and keeps what it has."""
    max_events: Count | None = None
    """Zone switches after which the run stops and keeps what it has."""
    chatter: Literal["warn", "hold", "stop"] = "warn"
    """What happens to a contact that toggles faster than its dwell."""
    dwell: Duration | None = None
    """Shortest time a zone lasts before its toggling counts as chatter. When not given a hundredth of the accuracy, at
    most 1e-6, of the span, and no longer than nothing moves by more than a tenth of its error weight."""

    @model_validator(mode="after")
    def _ends_after_it_starts(self) -> RunSettings:
        if self.stop <= self.start:
            raise QuantityError(f"stop = {self.stop:g} s is not after start = {self.start:g} s",
                                "Give a stop above the start; both are times, not lengths of a run.")  # fmt: skip
        least = SHORTEST * max(1.0, abs(self.start), abs(self.stop))
        if self.stop - self.start < least:
            what = f"stop = {self.stop:.15g} s is {self.stop - self.start:.2g} s after start = {self.start:.15g} s"
            raise QuantityError(what, f"A run lasts {least:.2g} s at least here. Is the unit meant?")
        return self

    @model_validator(mode="after")
    def _steps_fit_the_run(self) -> RunSettings:
        step, span = self.real_time, self.stop - self.start
        if step is None:
            return self
        given = f"real_time = {step:.9g} s"
        least = SHORTEST_FRAME * max(span, abs(self.start), abs(self.stop))
        if step > span:
            raise QuantityError(f"{given} is longer than the run, which lasts {span:.9g} s",
                                "Give the length of one step, such as 1 ms.")  # fmt: skip
        if step < least:
            raise QuantityError(f"{given} is too short for a run to {self.stop:g} s",
                                f"A step lasts {least:.2g} s at least here. Is the unit meant?")  # fmt: skip
        if self.engine not in ("auto", "stepping"):
            raise QuantityError(f"{given}, and engine = {self.engine}, which has no steps of one length",
                                "Take engine: stepping (or auto), or leave real_time out.")  # fmt: skip
        for name, other in (("max_step", self.max_step), ("first_step", self.first_step)):
            if other is not None and (name == "first_step" or other < step):
                raise QuantityError(f"{given}, and {name} = {other:.9g} s", f"All steps are alike: leave {name} out.")
        return self


def _figure_file(value: object) -> object:
    """The name of a figure, refused before the run if nothing could be written there after it."""
    if not isinstance(value, str) or not value:
        return value
    ends = re.search(r"\.([A-Za-z]{2,5})$", value)
    if re.search(r"[/\\]", value) or value.startswith("."):
        raise QuantityError(f"{shown(value)} is not a plain file name", "Figures stay in the folder of the run.")
    if not value.isprintable() or len(value.encode("utf-8", "replace")) > LONGEST_FILE_NAME:
        what = f"{shown(value)} is no name for a file"
        raise QuantityError(what, f"A name has at most {LONGEST_FILE_NAME} bytes, all of them to be seen.")
    if ends and ends[1].lower() != "png":
        what = f"{shown(value)} is no figure that can be drawn"
        raise QuantityError(what, f"Figures are PNG: write {shown(value[: ends.start()])}.png.")
    return value


class Plot(Strict):
    """A figure drawn at the end of a run."""

    signals: Annotated[list[str], Field(min_length=1)]
    """Patterns of the signals to draw, such as `line.*.tension`."""
    title: str = ""
    """Title above the figure."""
    file: Annotated[str, BeforeValidator(_figure_file)] = ""
    """File name inside the run directory, such as `tension.png`."""
    kind: Literal["lines", "map"] = "lines"
    """lines over time; or a map of the elements of a line: time to the right, place upward, value as colour."""
    along: str = ""
    """Of a map: pattern of the signals that tell the places, such as `line.hose_node[*].x`; else the number counts."""
    between: Annotated[list[Metres], Field(min_length=2, max_length=2)] | None = None
    """Of a map with `along`: from where to where."""

    @model_validator(mode="after")
    def _is_a_map(self) -> Plot:
        if self.kind != "map" and (self.along or self.between):
            raise QuantityError("`along` and `between` belong to a map; give kind: map")
        if self.between and not self.along:
            raise QuantityError("`between` is a range of places; give the signals that tell them under `along`")
        if self.between and self.between[0] >= self.between[1]:
            raise QuantityError(f"between: {self.between[0]:g} m is not below {self.between[1]:g} m")
        return self


class RecordSettings(Strict):
    """Which signals are written down, and how often."""

    signals: list[str] = ["*"]
    """Patterns of the signals to record, such as `line.*.tension`."""
    every: Duration | None = None
    """Interval between recorded points; without it, every accepted step is recorded."""
    plots: list[Plot] = []
    """Figures drawn at the end of a run."""

"""Clocks of FMI 3.0 (section 2.2.9): when they tick, and what a description must say of them.

A time-based clock ticks by itself, at t_0 = start + shift and at t_i = t_{i-1} + interval:

    constant          interval and shift from the description
    fixed, tunable    from the description or the netlist; without one there, the FMU is asked at the start
    changing          after every tick the FMU is asked when the next is
    countdown         after every event the FMU is asked whether one is to come

A triggered clock is a signal: an output clock the number of its ticks so far, an input clock a whole number at whose
every rise it ticks.
"""

from __future__ import annotations

import io
import math
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass

from fairlead.errors import shown
from fairlead.foreign.refusals import Refused

PERIODIC = ("constant", "fixed", "tunable")
TIMINGS = (*PERIODIC, "changing", "countdown", "triggered")
COUNTED = "Ticks so far."


@dataclass(frozen=True)
class Clock:
    """A time-based clock; its interval and shift [s] where the description has them."""

    name: str
    reference: int
    timing: str
    interval: float | None
    shift: float

    @property
    def settable(self) -> bool:
        """Whether the netlist may give its interval."""
        return self.timing in ("fixed", "tunable") and self.interval is not None


def clocks_of(text: bytes) -> tuple[dict[str, Clock], bytes]:
    """Time-based clocks of a description, and the description with clocks as FMPy reads them. Raises Refused.

    FMPy knows neither the attributes of a clock nor types of clocks, so those are resolved here.
    """
    if b"<Clock" not in text:
        return {}, text
    root = ET.fromstring(text)
    types = {one.get("name"): one.attrib for one in root.iterfind("TypeDefinitions/ClockType")}
    found: dict[str, Clock] = {}
    for one in root.iterfind("ModelVariables/Clock"):
        declared = types.get(one.attrib.pop("declaredType", None), {})
        for name, value in declared.items():
            if name not in ("name", "description"):
                one.attrib.setdefault(name, value)
        timing = one.get("intervalVariability", "")
        if timing not in TIMINGS:
            said = shown(timing) if timing else "missing"
            raise Refused(f"has the clock {shown(one.get('name'))}, of which nothing says when it ticks: "
                          f"intervalVariability is {said}", "Export it again.")  # fmt: skip
        if timing != "triggered":
            clock = _clock(one.attrib, timing)
            found[clock.name] = clock
    return found, ET.tostring(root)


def _clock(said: Mapping[str, str], timing: str) -> Clock:
    """A time-based clock. Raises Refused for times that are none."""
    name = said.get("name", "")
    interval = _time(said, name, "interval")
    shift = _time(said, name, "shift") or 0.0
    if timing == "constant" and interval is None:
        raise Refused(f"has the constant clock {shown(name)} without an interval (intervalDecimal)",
                      "Export it again with one, or without the clock.")  # fmt: skip
    if interval is not None and interval <= 0:
        raise Refused(f"has the clock {shown(name)} with an interval of {interval:g} s, and it is to be above 0",
                      "Export it again.")  # fmt: skip
    return Clock(name, int(said.get("valueReference", "0")), timing, interval, shift)


def _time(said: Mapping[str, str], clock: str, what: str) -> float | None:
    """`interval` or `shift` [s], as a decimal or else as a fraction. Raises Refused."""
    decimal, counter = said.get(f"{what}Decimal"), said.get(f"{what}Counter")
    try:
        if counter is not None and "resolution" in said:
            return int(counter) / int(said["resolution"])  # the more exact of the two
        value = float(decimal) if decimal is not None else None
    except (ValueError, ZeroDivisionError):
        value = math.nan
    if value is not None and not (math.isfinite(value) and value >= 0):
        raise Refused(f"has the clock {shown(clock)} with {what}Decimal = {shown(decimal)}", "Export it again.")
    return value


def as_fmu(text: bytes) -> io.BytesIO:
    """An archive with nothing but a description, for FMPy to read."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("modelDescription.xml", text)
    packed.seek(0)
    return packed

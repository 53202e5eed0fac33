"""Why a hose rucks, or does not: what the device at its place takes out of the line, and who bears it.

A bend with the coefficient mu takes q = mu (T_hose + T_core)/R per length out of the hose, which touches it. The
bulkheads are pressed by the core's tension alone and hand at most q_i = mu_i T_core/R on to the core. What they cannot
hand on stays in the hose. They hold it while

    mu <= mu_i EA_core/(EA_hose + EA_core)          both layers with one strain          (physics 7a)

All tensions are those of the run at one instant, in the elements next to the device.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fairlead.analysis.margins.ruck_words import DIGITS, called, figure, moment
from fairlead.analysis.record.recorded_line import RecordedLine
from fairlead.results import Result

LAYERS = 2
LEAST = 0.5
"""Share of the compression that a device has to explain before it is called the cause."""


def cause(result: Result, record: dict[str, Any], found: Mapping[str, Any]) -> dict[str, Any] | None:
    """What the device at the place of a verdict does there; None where that cannot be told.

    Tensions [N] on both sides of the device by layer (`inboard`, `outboard`), its `friction` and that of the layers on
    each other (from rest, sliding), `turn` [rad], `critical`: the coefficient up to which the layers hold each other,
    `devices`: names of the bends from the place to the outboard end, `sum` of their mu times angle from there on.
    """
    nodes = RecordedLine(result, record).nodes
    if nodes is None:
        return None
    told = [one for here in _stations(record, found) if (one := _seen(result, record, found, nodes, here))]
    return next((one for one in told if _explains(one, found)), told[0] if told else None)


def _seen(result: Result, record: dict[str, Any], found: Mapping[str, Any], nodes: Any, here: dict[str, Any]
          ) -> dict[str, Any] | None:  # fmt: skip
    """What one device does; None where tensions beside it were not recorded."""
    row = max(int(np.searchsorted(result.t, found["t"], side="right")) - 1, 0)
    sides = _sides(nodes[row], here["begin"], here["end"])
    names = [[f"{record['line']}.{layer}[{k}].tension" for layer in record["layers"]] for k in sides]
    if not all(name in result for each in names for name in each):
        return None
    t = recorded_time(result, found["t"])
    inboard, outboard = ([float(result.at(name, t)) for name in each] for each in names)
    bends = [one for one in record["stations"] if _rubs(one) and not one["moves"]
             and found["place"] < one["end"] and one["begin"] < nodes[row][-1]]  # fmt: skip
    return {
        "station": called(here), "friction": list(here["friction"]), "turn": _turn(here), "moves": here["moves"],
        "inner_friction": record.get("inner_friction"), "inboard": inboard, "outboard": outboard,
        "begin": here["begin"], "end": here["end"],
        "critical": _critical(record, here), "devices": [called(one) for one in bends],
        "sum": sum(one["friction"][1] * _turn(one, found["place"]) for one in bends),
    }  # fmt: skip


def _explains(one: Mapping[str, Any], found: Mapping[str, Any]) -> bool:
    """True if of the friction there so much stays in the hose as rucks it, or much of that, and compresses the place.

    Friction compresses the hose on the side that has less tension.
    """
    if not found["rucks"]:
        return True
    sense = _sense(one)
    beyond = one["begin"] > found["place"] if sense > 0 else one["end"] < found["place"]
    return not beyond and sense * (one["inboard"][0] - one["outboard"][0]) >= LEAST * found["ruck_force"]


def _sense(one: Mapping[str, Any]) -> float:
    """1 where tension grows inboard, as of a line that is hauled, -1 where it falls."""
    return math.copysign(1.0, sum(one["inboard"]) - sum(one["outboard"]))


def recorded_time(result: Result, t: float) -> float:
    """The time itself, or the end of what was recorded, if a run was ended after its last row and t is later."""
    return min(max(t, float(result.t[0])), float(result.t[-1]))


def _rubs(station: Mapping[str, Any]) -> bool:
    """True for a bend with friction."""
    ends = station["begin"] is not None and station["end"] is not None
    return bool(ends and station["curvature"] and station.get("friction"))


def _stations(record: Mapping[str, Any], found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Bends that may be the cause at a place: the one it is in or beside, and those next to it on either side.

    Beside is not farther than an element. Only a verdict that it rucks is due to a bend farther away.
    """
    place, k = found.get("place"), found["element"]
    bends = [one for one in record["stations"] if _rubs(one)]
    if place is None or len(record["layers"]) != LAYERS or k + 1 >= len(record["places"]) or not bends:
        return []
    here: dict[str, Any] = min(bends, key=lambda one: _away(one, place))
    near = [here] if _away(here, place) <= record["places"][k + 1] - record["places"][k] else []
    if not found["rucks"]:
        return near
    inboard = [one for one in bends if one["end"] <= place]
    outboard = [one for one in bends if one["begin"] >= place]
    beside = [max(inboard, key=lambda one: one["end"])] if inboard else []
    beside += [min(outboard, key=lambda one: one["begin"])] if outboard else []
    return near + [one for one in beside if one not in near]


def _away(station: Mapping[str, Any], place: float) -> float:
    """How far a place is from a station [m]."""
    return float(max(station["begin"] - place, place - station["end"], 0.0))


def _sides(nodes: Any, begin: float, end: float) -> tuple[int, int]:
    """The last element inboard of a device and the first one outboard of it, else elements at the ends."""
    last = len(nodes) - 2
    inner = int(np.searchsorted(nodes, begin, side="right")) - 2
    outer = int(np.searchsorted(nodes, end, side="left"))
    return min(max(inner, 0), last), min(max(outer, 0), last)


def _turn(station: Mapping[str, Any], place: float = -math.inf) -> float:
    """By how much a bend turns the line from a place in it, or before it, to its outboard end [rad]."""
    return float(station["curvature"] * (station["end"] - max(station["begin"], place)))


def _critical(record: Mapping[str, Any], station: Mapping[str, Any]) -> float | None:
    """Coefficient up to which the layers hold each other on a bend; None where something else presses them as well."""
    inner, stiff = record.get("inner_friction"), record.get("stiffnesses") or []
    if not inner or len(stiff) != LAYERS or station.get("squeeze"):
        return None
    return float(inner[0] * stiff[1] / sum(stiff))


def why(found: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The cause of a verdict in words: what they are about, and a sentence or two; empty where it is not known."""
    one = found.get("cause")
    if not one or one["moves"]:
        return []
    if not found["rucks"]:
        return _holds(one)
    one = _rounded(one)
    hose = (one["inboard"][0], one["outboard"][0])
    if max(hose) - min(hose) < LEAST * found["ruck_force"]:
        return [("Why", f"Not told: on both sides of {one['station']} the hose has nearly the same tension "
                        f"({_f(hose[0])} and {_f(hose[1])} N), so friction there is not the cause.")]  # fmt: skip
    first = (f"The compression differs from element to element; element {found['element']} is the first to pass "
             f"{figure(found['ruck_force'])} N.")  # fmt: skip
    about = "Why" if len(found.get("places") or ()) < 2 else "Why it began"
    said = f"{_friction(one, found['t'])} {_shared(one)} {first}"
    return [(about, said), *_capstan(one, found["element"]), *_way_out(one)]


def _friction(one: Mapping[str, Any], t: float) -> str:
    """What the device takes at t."""
    low, high = sorted((sum(one["inboard"]), sum(one["outboard"])))
    grows = f"from {_f(low)} to {_f(high)} N" if low > 0 else f"by {_f(high - low)} N"
    return (
        f"Friction on {one['station']}. At t = {moment(t)} s the line slides over it with mu = "
        f"{figure(one['friction'][1])}, and its tension grows {grows} there. These {_f(high - low)} N act on the hose, "
        f"which touches {one['station']}."
    )


def _shared(one: Mapping[str, Any]) -> str:
    """Who bears it."""
    sense = _sense(one)
    hose, core = (sense * (a - b) for a, b in zip(one["inboard"], one["outboard"], strict=True))
    inner, critical = one["inner_friction"], one["critical"]
    limit = ""
    if critical is not None and one["friction"][1] > critical:
        limit = (f" They cannot pass on all, for only the core's tension presses them (mu = {figure(inner[0])} while "
                 f"they hold, {figure(inner[1])} while they slide).")  # fmt: skip
    passed = f"The bulkheads pass {_f(core)} N of them on to the core.{limit} The other {_f(hose)} N stay in the hose"
    if core < 0:
        passed = f"The core's tension falls by {_f(-core)} N there, which the hose takes as well: {_f(hose)} N in all"
    return (
        f"{passed}: its tension goes from {_f(one['inboard'][0])} N inboard of {one['station']} to "
        f"{_f(one['outboard'][0])} N outboard of it. A tension below zero is a compression."
    )


def _rounded(one: Mapping[str, Any]) -> dict[str, Any]:
    """The cause with all tensions rounded to one place, so that sums and differences of what is told agree."""
    most = max(abs(sum(one[side])) for side in ("inboard", "outboard"))
    digit = DIGITS - 1 - math.floor(math.log10(most)) if most > 0 else 0
    return {**one, **{side: [round(each, digit) for each in one[side]] for side in ("inboard", "outboard")}}


def _capstan(one: Mapping[str, Any], element: int) -> list[tuple[str, str]]:
    devices: Sequence[str] = one["devices"]
    if not devices or not one["sum"]:
        return []
    names = devices[0] if len(devices) == 1 else f"{', '.join(devices[:-1])} and {devices[-1]}"
    return [("Capstan", f"From the outboard end the line runs over {names} to element {element}. The sum of mu × angle "
                        f"up to there is {figure(one['sum'])}, which multiplies a steady tension by "
                        f"exp({figure(one['sum'])}) = {figure(math.exp(one['sum']))}.")]  # fmt: skip


def _way_out(one: Mapping[str, Any]) -> list[tuple[str, str]]:
    critical = one["critical"]
    if critical is None or one["friction"][1] <= critical:
        return []
    inner = figure(one["inner_friction"][0])
    return [("Way out", f"Below mu = {figure(critical)} on {one['station']} the bulkheads would hold the hose. "
                        f"That is their mu, {inner}, times the core's share of the tension.")]  # fmt: skip


def _holds(one: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Why it does not ruck, where a bend would be the place for it."""
    critical = one["critical"]
    if critical is None or one["friction"][1] > critical:
        return []
    return [("Why", f"On {one['station']} mu = {figure(one['friction'][1])} is below {figure(critical)}, up to which "
                    "the bulkheads hold the hose on the core. So both move as one, and the core bears the friction.",
             )]  # fmt: skip


def _f(value: float) -> str:
    """A sum or difference of rounded tensions: all its digits, but not what binary fractions add."""
    return np.format_float_positional(float(f"{value:.10g}"), trim="-")


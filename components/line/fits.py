"""Whether a line fits a route: told with numbers before the run."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from fairlead.components.line.mesh import finest
from fairlead.components.route.bond import SLOWEST_HOLD, TAKES_HOLD
from fairlead.components.route.placing import TOUCHES, Placed, slits

from fairlead.errors import Fault, Location

SHARPEST, ADVISED = 0.5, 0.25  # rad per element; above about 0.25 the capstan error of the mesh shows
FEWEST = 2  # elements on a device that is to be seen by the mesh at all; five nodes are advised


def fits(assembly: Any, line: Any, laid: Any, route: Any) -> list[Fault]:
    """Faults of a line on a route: no devices, elements too coarse, bends too tight, a drum too small."""
    placed = route.line.placed
    if not placed:
        return [Fault(route.where, f"{route.path}.stations is empty.", "Give at least one device.")]
    found = []
    for one in placed:
        where = _where(assembly, route, one)
        name = f"{route.path}.{one.name}"
        found += [Fault(where, f"{name}: {what}.", way) for what, way in _device(one, line, laid)]
    for one in placed:
        if one.station.stores():
            found += [Fault(_start(assembly, laid), what, way) for what, way in _untouched(assembly, laid, route, one)]
    shortest, loops = finest(line.mesh), [one for one in placed if one.station.draws(0.0) is not None]
    if len(loops) > 1:
        what = f"{route.path} has {len(loops)} tensioners; a line runs through one at most."
        found.append(Fault(_where(assembly, route, loops[1]), what, "Leave out the others."))
    if loops and line.rigid:
        place = f"{route.path}.{loops[0].name}"
        rigid = f"a {'core' if line.stretch == 'core_stretch' else 'line'} that does not stretch"
        what = f"{laid.path}.{line.stretch} is off, and {rigid} cannot run through {place}."
        found.append(Fault(laid.where, what, f"Switch {line.stretch} on, or leave out the tensioner."))
    for name, which in (("ruck_force", "is watched for rucking"), ("hose_relaxation", "relaxes")):
        if loops and getattr(line.values, name, None) is not None:
            place = f"{route.path}.{loops[0].name}"
            what = f"{laid.path}.{name}: hose that {which} cannot run through {place}."
            found.append(Fault(laid.where, what, f"Leave out {name}, or the tensioner."))
    for before, after, gap in slits(placed, shortest):
        what = f"{route.path}.{after.name} begins {gap:.3g} m after {before.name} ends, less than an element"
        way_out = f"Let it begin at {before.end:g} m, or leave at least {shortest:.3g} m between them."
        found.append(Fault(_where(assembly, route, after), f"{what} ({shortest:.3g} m).", way_out))
    return found


def _device(one: Placed, line: Any, laid: Any) -> Iterator[tuple[str, str]]:
    """What is wrong between a line and one device, and the way out."""
    p, shortest, radius = line.values, finest(line.mesh), one.station.bend_radius()
    if radius:
        turn = shortest / radius
        if turn > SHARPEST:
            yield (
                f"an element of {shortest:g} m turns through {turn:.2g} rad in a radius of {radius:g} m",
                f"Use elements of at most {ADVISED * radius:.3g} m ({ADVISED:g} rad): "
                f"{math.ceil((one.end - one.begin) / (ADVISED * radius))} on this device.",
            )
        if p.bend_radius is not None and radius < p.bend_radius:
            yield (
                f"its radius of {radius:g} m is tighter than {laid.path} allows, {p.bend_radius:g} m",
                "Use a larger radius, or a line that may be bent more.",
            )
    extent = one.end - one.begin
    if one.station.rubs() is not None and extent < FEWEST * shortest:
        yield (
            f"it is {extent:.3g} m long, shorter than {FEWEST} elements of {shortest:.3g} m",
            f"Use elements of at most {extent / FEWEST:.3g} m; {extent / 4:.3g} m puts five nodes on it.",
        )
    if one.station.edge is not None and math.isfinite(extent) and extent < one.station.edge:
        yield f"it is {extent:.3g} m long, shorter than its edge of {one.station.edge:.3g} m", "Use a shorter edge."
    if one.station.stores() and one.station.edge is not None and not TAKES_HOLD < one.station.edge <= SLOWEST_HOLD:
        yield (
            f"its edge is {one.station.edge:g} m, and a drum takes hold of line over more than {TAKES_HOLD:g} m, up to "
            f"{SLOWEST_HOLD:g} m",
            "Give another edge, or leave it out.",
        )
    if one.station.stores() and one.station.layers == "on":
        yield from _drum(one, p)


def _untouched(assembly: Any, laid: Any, route: Any, winch: Placed) -> Iterator[tuple[str, str]]:
    """A line that a winch does not hold, and nothing else does."""
    p, drum = laid.values, f"{route.path}.{winch.name}"
    begin, end = p.start, p.start + p.length
    if begin > winch.end - TOUCHES and not _held_otherwise(assembly, laid, route):
        away = f"begins {begin - winch.end:.3g} m outboard of" if begin > winch.end + TOUCHES else "only reaches"
        yield (
            f"{laid.path} {away} {drum}, and nothing else holds it: it lies from {begin:g} to {end:g} m, and what "
            f"lies inboard of {winch.end:g} m is on the drum.",
            f"Let it start below {winch.end:g} m by what is to be paid out, or leave out the winch and drive "
            f"{laid.path}.inboard.",
        )


def _held_otherwise(assembly: Any, laid: Any, route: Any) -> bool:
    """Whether something else moves the line: a connection at its inboard end, or a device that grips it."""
    named = {end.text for ends in assembly.netlist.connections for end in ends}
    return f"{laid.path}.inboard" in named or any(route.line.squeezing())


def _start(assembly: Any, laid: Any) -> Location:
    """Where the netlist says where the line begins; the line itself when it does not."""
    entry = assembly.netlist.components.get(laid.path)
    start = entry.parameters.get("start") if entry is not None else None
    return start.where if start is not None else laid.where


def _drum(one: Placed, p: Any) -> Iterator[tuple[str, str]]:
    """A drum that cannot take the line."""
    layers, lies = one.station.wound(p.diameter), one.station.filled + max(one.end - p.start, 0.0)
    if layers.wraps < 1:
        yield (
            f"its width of {layers.width:g} m takes no wrap of a line of {layers.diameter:g} m",
            "Give a wider drum.",
        )
    elif one.station.height is not None and layers.capacity < lies:
        yield (
            f"it takes {layers.capacity:.4g} m of line ({layers.most} layers of {layers.wraps} wraps), "
            f"and {lies:.4g} m lie on it at the start",
            "Give a wider drum, higher flanges or a larger radius, or let the line start further outboard.",
        )


def _where(assembly: Any, route: Any, one: Placed) -> Location:
    """Where the device stands in the netlist; the route itself when it was not written there."""
    entry = assembly.netlist.components.get(route.path)
    listed = entry.parameters.get("stations") if entry is not None else None
    items = listed.content if listed is not None and isinstance(listed.content, list) else []
    return items[one.number].where if one.number < len(items) else route.where

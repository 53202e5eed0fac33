"""How hose and core share the tension of an array: an estimate for a line that came to this state from rest.

Where a device presses, the bulkheads hold the hose as long as they can drag it along against the device,
mu_bulkhead T_core >= mu T; there both have one strain. Elsewhere they are free of each other, between two places
that hold (or two connectors): what acts on the hose, drag and friction, is taken by the hose alone, and both have one
length:

    integral of (T_hose/EA_hose - T_core/EA_core) ds = 0

Where bulkheads slip in a bend the core's tension grows by exp(mu_bulkhead theta) the way the total does, and the span
goes on through the bend (physics 7a). What an array brings with it from before, such as strain it was wound on with, is
not in it: a run tells that.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.statics.laid_route import coefficient
from fairlead.analysis.statics.sliding import counts

if TYPE_CHECKING:
    from fairlead.analysis.statics.states import Passage, State

Values = NDArray[np.float64]


@dataclass(frozen=True)
class Share:
    """Tensions of the layers along one passage [N], as `Passage.tension`; `slips`: the bulkheads cannot hold."""

    hose: Values
    core: Values
    slips: bool


@dataclass(frozen=True)
class Shares:
    """All passages of a state; `registration` is the largest de-registration [m] that this makes."""

    shares: tuple[Share, ...]
    registration: float

    @property
    def lowest(self) -> float:
        """Lowest tension of the hose [N]."""
        return float(min(one.hose.min() for one in self.shares))


@dataclass
class _Span:
    """Parts of the line between two places that hold: core tension = unknown * grown + added."""

    parts: list[tuple[int, slice]]
    grown: list[Values]
    added: list[Values]


def shares(state: State) -> Shares | None:
    """Shares of every passage; None for a line of one layer."""
    hose, core = state.route.layers
    if not core or not state.passages:
        return None
    together = core / (hose + core)
    slips = [_slips(state, one, together) for one in state.passages]
    holds = [_presses(one) and not slip for one, slip in zip(state.passages, slips, strict=True)]
    cores = [together * one.tension for one in state.passages]
    most = 0.0
    for span in _spans(state, holds, slips):
        most = max(most, _solve(state, span, cores, hose, core))
    hoses = [one.tension - inner for one, inner in zip(state.passages, cores, strict=True)]
    return Shares(tuple(map(Share, hoses, cores, slips)), most)


def _presses(one: Passage) -> bool:
    """True where bulkheads are pressed on the hose: in curves and clamps."""
    return one.device is not None and bool(one.piece.curvature or _squeezed(one))


def _squeezed(one: Passage) -> float:
    """Load of clamps and tight tubes on the bulkheads [N/m]."""
    if one.device is None:
        return 0.0
    return one.piece.pressed if one.device.clamps else float(one.device.station.squeeze())


def _slips(state: State, one: Passage, together: float) -> bool:
    """True where the bulkheads cannot give the hose what the device takes of it."""
    if not _presses(one) or one.device is None:
        return False
    held = coefficient(state.route.says.inner_curve, 0.0)
    tension = np.maximum(one.tension, 0.0)
    presses = together * tension * one.piece.curvature + _squeezed(one)
    can = held * counts(presses, *state.route.power(state.route.says.inner_curve))
    if one.device.machine is not None and not one.device.machine.drives and not one.piece.curvature:
        return False
    if one.device.clamping:
        needed = np.full_like(tension, together * abs(one.outboard - one.inboard) / one.piece.length)
    elif one.device.machine is not None:  # a wheel goes with the hose
        return False
    else:
        needed = abs(one.friction) * one.piece.counts(tension * one.piece.curvature + one.piece.pressed)
    return bool((needed > can * (1 + 1e-9)).any())


def _spans(state: State, holds: list[bool], slips: list[bool]) -> list[_Span]:
    """Cut at what holds and at the connectors."""
    connectors = state.route.connectors(state.way)
    spans, grown, added = [_Span([], [], [])], 1.0, 0.0
    for k, one in enumerate(state.passages):
        cuts = [0, *np.flatnonzero(np.isin(one.places[1:-1], connectors)) + 1, len(one.places) - 1]
        for begin, end in itertools.pairwise(map(int, cuts)):
            if begin or holds[k]:
                spans.append(_Span([], [], []))
                grown, added = 1.0, 0.0
            if holds[k]:
                continue
            piece = slice(begin, end + 1)
            growth, more = _core(state, one, piece, slips[k])
            spans[-1].parts.append((k, piece))
            spans[-1].grown.append(grown * growth)
            spans[-1].added.append(added * growth + more)
            grown, added = float(spans[-1].grown[-1][-1]), float(spans[-1].added[-1][-1])
    return [span for span in spans if span.parts]


def _core(state: State, one: Passage, piece: slice, slips: bool) -> tuple[Values, Values]:
    """How the core's tension changes along a part: by a factor, and by what is added [N]."""
    runs = one.places[piece] - one.places[piece][0]
    growth, more = np.ones_like(runs), np.zeros_like(runs)
    says = state.route.says
    if one.device is not None and one.device.station.slope and says.weight:
        share = says.masses[1] / sum(says.masses)
        more = more - share * says.weight * math.sin(one.device.station.slope) * runs
    if slips:
        slid = coefficient(says.inner_curve, state.speed) * _loaded(state, one, piece)
        sense = math.copysign(1, one.outboard - one.inboard)
        growth = np.exp(sense * slid * one.piece.curvature * runs)
        more = more + sense * slid * _squeezed(one) * runs
    return growth, more


def _loaded(state: State, one: Passage, piece: slice) -> float:
    """Factor of the friction of bulkheads that depends on the load, which is that of the core's share in the middle."""
    stiff = state.route.says.stiffnesses
    tension = float(np.mean(np.maximum(one.tension[piece], 0.0))) * stiff[1] / sum(stiff)
    load = tension * one.piece.curvature + _squeezed(one)
    return float(counts(load, *state.route.power(state.route.says.inner_curve))) / load if load > 0 else 1.0


def _solve(state: State, span: _Span, cores: list[Values], hose: float, core: float) -> float:
    """Put the core's tension of a span into `cores`; returns its largest de-registration [m]."""
    total = grown = added = 0.0
    for (k, piece), growth, more in zip(span.parts, span.grown, span.added, strict=True):
        one = state.passages[k]
        total += float(np.trapezoid(one.tension[piece], one.places[piece]))
        grown += float(np.trapezoid(growth, one.places[piece]))
        added += float(np.trapezoid(more, one.places[piece]))
    both = 1 + hose / core
    unknown = (total - both * added) / (both * grown) if grown else 0.0
    gone, most = 0.0, 0.0
    for (k, piece), growth, more in zip(span.parts, span.grown, span.added, strict=True):
        one = state.passages[k]
        inner = np.maximum(unknown * growth + more, 0.0)
        cores[k][piece] = inner
        strain = inner / core - (one.tension[piece] - inner) / hose
        steps = np.diff(one.places[piece]) * (strain[1:] + strain[:-1]) / 2
        way = gone + np.cumsum(steps)
        if len(way):
            gone, most = float(way[-1]), max(most, float(np.abs(way).max()))
    return most

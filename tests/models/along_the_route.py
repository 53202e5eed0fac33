"""Tensions along the guidance route: measured, and of steady sliding (physics section 7b).

Where the line slides steadily the tensions are products of capstans, whatever the model is made of:

    before the deployer  T_winch exp(+-mu A)      in the sea  tail + drag * length      after it  T_sea exp(-+mu B)

with + while deploying. The drag belongs to the speed of the water along the line, ship less line. Tensions ripple
as single elements stick and slip, so they are compared as means over time.
"""

import math

import numpy as np

from tests.reference.capstan import tension_ratio
from tests.reference.hanging_line import drag_per_length

BEND_A, BEND_B, SEA = math.pi / 2, math.pi / 3, 10.0
WINCH, TAIL, SHIP, SPEED = 200.0, 150.0, 4.0, 0.5
PLACES = (1.0, 4.2, 7.2, 9.7)  # m: at the winch, before and after the deployer, at the sea


def rows_between(result, begin, end):
    """Rows at equal spans of time; those that are recorded at events beside them would weigh bursts of events."""
    return np.searchsorted(result.t, np.arange(begin, end, 0.05))


def tension_at(result, places, begin, end):
    """Mean tension of the line [N] at places of the route [m] over a span of time."""
    hose, core = (result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
    tension = hose + core
    nodes = result.columns(result.match("line.hose_node[*].x"))
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    rows = rows_between(result, begin, end)
    return np.mean([np.interp(places, middle[k], tension[k]) for k in rows], axis=0)


def closed_form(result, mu, way, begin, end):
    """The four tensions [N]; `way` is +1 while deploying."""
    rows = rows_between(result, begin, end)
    length = result["line.hose_node[160].x"][rows].mean() - SEA
    sea = TAIL + length * drag_per_length(1025.0, 0.003, 0.085, SHIP - way * SPEED)
    return [
        WINCH,
        WINCH * tension_ratio(way * mu, BEND_A),
        sea * tension_ratio(-way * mu, BEND_B),
        sea,
    ]


def inside(result):
    """Which elements are between the drum and the sea, [rows, elements]."""
    nodes = result.columns(result.match("line.hose_node[*].x"))
    return (nodes[:, 1:] < SEA) & (nodes[:, :-1] > 0.0)


def layer(result, name):
    """Tensions of the hose or the core [rows, elements], N."""
    return result.columns(result.match(f"line.{name}[*].tension"))

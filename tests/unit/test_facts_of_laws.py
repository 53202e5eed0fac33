"""Facts of laws that are found as expressions, alone: rates of flows, shares of friction, who shares, slots."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import sympy

from fairlead.component.declare import ELECTRICAL, TRANSLATIONAL
from fairlead.component.symbols import symbol
from fairlead.component.trace import HoldRow, Traced, TracedGuard, TracedZone
from fairlead.kernels import layout
from fairlead.kernels.break_away import least_left
from fairlead.kernels.flow_rates import NoRateError, flow_rates, joins, rate, yields
from fairlead.kernels.guard_slots import in_slots, latches
from fairlead.kernels.held_pairs import held_pairs, held_ratios

A, B, VA, VB, T, U, S, F, P, Q = (symbol(text) for text in (
    "port:a:x", "port:b:x", "port:a:v", "port:b:v", "t", "in:u", "own:s", "own:f", "p:stiff", "p:ratio"))  # fmt: skip
HAS = SimpleNamespace(
    ports={"a": SimpleNamespace(domain=TRANSLATIONAL), "b": SimpleNamespace(domain=TRANSLATIONAL),
           "pin": SimpleNamespace(domain=ELECTRICAL)},
    states={"s": None}, unknowns={"f": None},
)  # fmt: skip
TRACED = {"variant": SimpleNamespace(), "tables": [], "time_tables": []}


def row(slip):
    """What holds this slip."""
    speeds = {"port:a:v": slip.coeff(VA), "port:b:v": slip.coeff(VB)}
    return HoldRow(slip, {name: ratio for name, ratio in speeds.items() if ratio != 0}, slip)


VALUES = [
    P * (A - B) ** 3,
    U * sympy.sin(2 * A) + T**2 * B,
    P * S * sympy.exp(-A),
    sympy.tanh(S * U) + sympy.cos(T) * F,
    F**2 * A + VA * B,
]


@pytest.mark.parametrize("value", VALUES, ids=str)
@pytest.mark.parametrize("seed", range(3))
def test_a_rate_is_the_slope_of_what_is_taken_in_along_the_motion(value, seed):
    """By a difference in time, positions moved by speeds, states by rates, unknowns solved for; speeds stay."""
    rng = np.random.default_rng(seed)
    zone = TracedZone(own={"s": -3 * S + A * VB, "f": 2 * F - P * A * S})
    at = dict(zip((A, B, VA, VB, T, U, S, P, Q), rng.uniform(0.3, 1.5, 9), strict=True))
    given = float(rng.normal())  # how fast the signal changes

    def moved(dt):
        there = at | {A: at[A] + dt * at[VA], B: at[B] + dt * at[VB], T: at[T] + dt, U: at[U] + dt * given,
                      S: at[S] + dt * float(zone.own["s"].subs(at))}  # fmt: skip
        there[F] = there[P] * there[A] * there[S] / 2
        return float(value.subs(there))

    found = rate(value, zone, HAS).subs({symbol("in:u:rate"): given, F: at[P] * at[A] * at[S] / 2}).subs(at)
    assert float(found) == pytest.approx((moved(1e-6) - moved(-1e-6)) / 2e-6, rel=1e-6)


def test_a_rate_that_no_law_tells_is_named():
    zone = TracedZone(flows={"a": P * A, "b": F**2, "pin": symbol("port:pin:x")}, own={"f": F**2 - A})
    rates, hindered = flow_rates(zone, HAS)
    assert rates == {"a": P * VA}
    assert hindered.keys() == {"b", "pin"}
    assert "f" in hindered["b"]
    assert "voltage at pin" in hindered["pin"]
    with pytest.raises(NoRateError):
        rate(VA, zone, HAS, speeds=False)
    held = TracedZone(holds={"f": row(VB - VA)})
    assert rate(F * A, held, HAS) == F * VA  # what holds keeps its force


SLOPES = {"4 |p|": 20.0, "|p| + 3": 8.0}
"""Sums of all slopes of all ports, for a parameter of -5."""


@pytest.mark.parametrize(
    ("flows", "ports", "weights", "slope"),
    [
        ({"a": P * (VA - VB), "b": -P * (VA - VB)}, ["a", "b"], [1.0, -1.0], "4 |p|"),
        ({"a": U * VA}, ["a"], [1.0], "1"),
        ({"a": A * VA, "b": P * A * VA}, ["a"], [1.0], ""),
        ({"a": P * VA, "b": 3 * VB}, ["a", "b"], [0.0, 0.0], "|p| + 3"),
        ({"a": P * A}, None, None, None),
    ],
)
def test_forces_join_the_ports_whose_speeds_they_read(flows, ports, weights, slope):
    found = joins(TracedZone(flows=flows), HAS)
    if ports is None:
        assert found == []
        return
    [one] = found
    assert (one["ports"], one["weights"]) == (ports, weights)
    if slope in SLOPES:
        assert eval(one["slope"], {"p": {"stiff": -5.0}, "abs": abs}) == SLOPES[slope]
    else:
        assert one["slope"] == slope


def test_a_flow_that_follows_a_speed_through_a_state_yields():
    zone = TracedZone(flows={"a": P * S, "b": P * A, "pin": F}, own={"s": VA - S, "f": F - 2 * S})
    assert yields(zone, HAS) == {"a", "pin"}
    zone.own["s"] = A - S
    assert yields(zone, HAS) == set()


@pytest.mark.parametrize("sense", [-1, 1, 2])
def test_how_a_contact_that_holds_shares_is_known_where_its_power_is_force_times_slip(sense):
    slip = 3 * VB - VA
    holding = TracedZone(flows={"a": -sense * F, "b": 3 * sense * F}, holds={"f": row(slip)})
    assert held_pairs([holding, TracedZone()]) == {"f": ({"a": -1.0, "b": 3.0}, float(sense))}
    other = TracedZone(flows={"a": -sense * F, "b": 3 * sense * F}, holds={"f": row(2 * slip)})
    assert held_pairs([holding, other]) == {}  # not the same in every zone
    for flows in ({"a": -F, "b": 2 * F}, {"a": -F}, {"a": -F, "b": 3 * F, "pin": F}, {"a": -U * F, "b": 3 * U * F}):
        assert held_pairs([TracedZone(flows=flows, holds={"f": row(slip)})]) == {}


def test_a_lever_shares_by_its_parameters_where_it_holds_in_all_zones():
    slip = Q * VB - VA
    holding = TracedZone(flows={"a": -2 * F, "b": 2 * Q * F}, holds={"f": row(slip)})
    [(ports, sense)] = held_ratios([holding]).values()
    assert ports.keys() == {"a", "b"}
    assert sense == 2.0
    assert eval(ports["b"], {"p": {"ratio": 0.25}}) == 0.25
    assert held_ratios([holding, TracedZone()]) == {}
    assert held_ratios([TracedZone(flows={"a": -F, "b": 3 * F}, holds={"f": row(3 * VB - VA)})]) == {}  # numbers
    assert held_ratios([TracedZone(flows={"a": -F, "b": Q**2 * F}, holds={"f": row(slip)})]) == {}


@pytest.mark.parametrize("seed", range(10))
def test_guards_of_one_slot_have_one_role_and_each_zone_keeps_its_order(seed):
    rng = np.random.default_rng(seed)
    zones = {}
    for name in ("one", "two", "three"):
        guards = []
        for k in range(int(rng.integers(0, 5))):
            of_force = rng.random() < 0.4
            value = (F if of_force else VA) - int(rng.integers(9)) + k * B
            unit = str(rng.choice(["N", "m/s"]))
            guards.append(TracedGuard(f"g{k}", "one", unit, [value], step=int(rng.integers(0, 2))))
        zones[name] = TracedZone(guards=guards, holds={"f": row(VB - VA)} if rng.random() < 0.7 else {})
    placed = in_slots(Traced(zones=zones, **TRACED))
    slots = {}
    for name, zone in placed.zones.items():
        real = [guard for guard in zone.guards if guard.name]
        assert real == zones[name].guards
        for k, guard in enumerate(zone.guards):
            if guard.name:
                held = bool(zones[name].holds) and any(F in value.free_symbols for value in guard.values)
                assert slots.setdefault(k, (held, guard.step != 0)) == (held, guard.step != 0)
            else:
                assert guard.values == [sympy.Float(layout.NOT_IN_FORCE)]


def test_a_zone_latches_unless_a_way_out_of_it_is_the_way_in_reversed():
    there = TracedGuard("rises", "on", "N", [U - 1])
    back = TracedZone(guards=[TracedGuard("falls", "off", "N", [1 - U])])
    zones = {"off": TracedZone(guards=[there]), "on": back}
    assert not latches(there, Traced(zones=zones, **TRACED))
    zones["on"] = TracedZone(guards=[TracedGuard("falls", "off", "N", [0.5 - U])])
    assert latches(there, Traced(zones=zones, **TRACED))


CURVES = {"0.5": 1.0, "{curve: coulomb, stiction: 0.5, coulomb: 0.4}": 0.8,
          "{curve: coulomb, stiction: 0.6, coulomb: 0.15}": 0.25}  # fmt: skip


@pytest.mark.parametrize("curve", CURVES)
@pytest.mark.parametrize("method", ["hold", "karnopp"])
def test_what_is_left_of_friction_is_sliding_over_stiction_whatever_presses(scene, curve, method):
    system = scene(f"""
    components:
      ground: {{type: Ground}}
      mass: {{type: Mass, mass: 1 kg}}
      pad: {{type: Contact, method: {method}, normal_force: 7 N, curve: {curve}}}
    connections: [[ground.flange, pad.a], [pad.b, mass.flange]]
    run: {{stop: 1 s}}
    """).system
    [left] = [least_left(block.kernel.structure.shares_left, instance.values)
              for block in system.blocks for instance in block.instances if instance.path == "pad"]  # fmt: skip
    assert left == pytest.approx(CURVES[curve])

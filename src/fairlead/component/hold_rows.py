"""The rows of what holds, as expressions: of a slip that stays zero, and of a relation of positions that does.

    hold(slip)             d(slip)/dt = -slip/tau          ratios of numbers and parameters: a row of M
    hold_position(gap)     0 = J a + (dJ/dt) v + c force   J = d(gap)/dx, which may move: M has nothing of it

The accelerations a of a position row are unknowns of their own (`system/numbering/unknowns.py`), so the index is one
and M stays constant; positions and speeds are brought back to gap = 0 and J v = 0 after every step
(`integrate/events/position.py`). The force acts on the ports by virtual work,  -force J,  and so does no work.

c = GIVE J (1/m) J' is a compliance far below the accuracy of a result. Where others hold all that the row could move,
as a contact that sticks holds the slider of a crank in its dead centre, no force is determined without it; with it,
that of the row is what the others leave, or is far beyond what a contact bears, which then lets go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

import sympy

from fairlead.component.declare import Port
from fairlead.component.keys import INPUT, OWN, PARAMETER, PORT, TABLE, TAU, TIME, Key, key
from fairlead.component.symbols import TraceError, inverse_mass, symbol

GIVE = 1e-10
"""Share of the acceleration by which a position row gives way: far above rounding, far below any accuracy."""


@dataclass(frozen=True)
class HoldRow:
    """What holds: its slip, and the coefficient of every speed in the row of M; of a position also the gap."""

    slip: sympy.Expr
    rates: dict[str, sympy.Expr]  # input key of a speed -> coefficient in the mass row
    impulse: sympy.Expr  # the slip that an impulse takes away when the zone is entered
    restitution: sympy.Expr = sympy.S.Zero  # a number, or the symbol of a parameter
    gap: sympy.Expr | None = None  # of a position row, whose ratios move and are in no row of M
    way: sympy.Expr | None = None  # of a stop: how far it is open, which has the slip as its rate
    ratios: dict[str, sympy.Expr] = field(default_factory=dict)  # port -> d(gap)/d(position)

    @property
    def place(self) -> sympy.Expr | None:
        """What positions should be where this holds, as what should be zero; None where only speeds are known."""
        return self.way if self.gap is None else self.gap


SLIP_ROUNDING = 2e-9
"""What a slip may be beyond `within` and still be taken away [m/s or rad/s]: twice what guards of speeds are known to,
so that a contact which a guard does not tear loose can hold."""


def slip_row(slip: sympy.Expr, within: sympy.Expr | None, restitution: sympy.Expr, place: str) -> HoldRow:
    """The row of a slip; `place` is where its law is written. Raises TraceError."""
    speeds = [s for s in slip.free_symbols if key(s.name).is_speed]
    rates = {s.name: sympy.diff(slip, s) for s in sorted(speeds, key=lambda s: s.name)}
    if not speeds or any(rate.free_symbols & set(speeds) for rate in rates.values()):
        raise TraceError(f"{place}: hold({slip}) wants a sum of speeds of ports, such as b.v - a.v")
    _fixed(slip, rates, place)
    little = 1 if within is None else (1 + sympy.sign(within + SLIP_ROUNDING - sympy.Abs(slip))) / 2
    _check_restitution(restitution, within is not None, place)
    return HoldRow(slip, rates, slip * little, restitution)


def slip_side(slip: sympy.Expr) -> sympy.Expr:
    """-slip/tau, less the acceleration of prescribed surfaces (zero for free ones)."""
    speeds = {s: key(s.name) for s in slip.free_symbols if key(s.name).is_speed}
    prescribed = {s: symbol(f"port:{speed.name}:A") for s, speed in speeds.items()}
    return -slip / symbol(f"p:{TAU}") - sum(sympy.diff(slip, s) * a for s, a in prescribed.items())


def _check_restitution(value: sympy.Expr, limited: bool, place: str) -> None:
    """What a rigid row gives back is a number or one parameter."""
    if not (value.is_number or (value.is_Symbol and key(value.name).is_fixed)):
        raise TraceError(f"{place}: the restitution {value} must be a number or a parameter, such as p.restitution")
    if value.is_number and not 0 <= value <= 1:
        raise TraceError(f"{place}: the restitution {value} must lie between 0, no rebound, and 1, no loss")
    if value != 0 and limited:
        raise TraceError(f"{place}: a hold `within` takes no impulse and gives none back; leave out its restitution")


def _fixed(slip: sympy.Expr, rates: dict[str, sympy.Expr], place: str) -> None:
    """Refuse a slip of which anything but the speeds moves.

    The row of a hold is d(slip)/dt = -slip/tau, with d(slip)/dt the sum of ratio times acceleration. What a moving
    ratio, or a moving speed that is added, would add to that is not in it.
    """
    for speed, rate in rates.items():
        if moving := _moving(rate):
            whose = f"{key(speed).name}'s speed"
            what = f"the ratio of {whose} varies with {moving}. A ratio must be made of numbers and parameters"
            way_out = (
                "Write a ratio that moves with positions as hold_position(gap), the relation of positions that stays "
                "zero and of which this is the rate; another one as a stiff spring and a damper between the two motions"
            )
            raise TraceError(f"{place}: hold({slip}): {what}. {way_out}.")
    if moving := _moving(slip.xreplace({symbol(speed): sympy.S.Zero for speed in rates})):
        what = f"what is added to the speeds varies with {moving}. It must be made of numbers and parameters"
        way_out = "Prescribe a speed that moves as that of a port, by a motion source"
        raise TraceError(f"{place}: hold({slip}): {what}. {way_out}.")


def _moving(expression: sympy.Expr) -> str:
    """What may vary within a run in this part of a slip; empty if nothing does."""
    varies = sorted(s.name for s in expression.free_symbols if not key(s.name).is_fixed)
    return ", ".join(dict.fromkeys(_said(key(text)) for text in varies))


def _said(one: Key) -> str:
    """The author's words for what a symbol stands for."""
    words = {
        TIME: "time", TABLE: f"the table {one.name!r}", INPUT: f"the signal {one.name!r}", OWN: repr(one.name),
        PARAMETER: f"the discrete {one.name[1:]!r}", PORT: f"the motion of {one.name!r}",
    }  # fmt: skip
    return words[one.kind]


def stop_row(row: HoldRow, ways_in: Iterable[sympy.Expr]) -> HoldRow:
    """The row with how far its stop is open, if it takes any impulse and one guard that leads to it says so.

    `ways_in` are the values of such guards. One says so that is a sum of positions with a multiple of the slip as rate.
    """
    if row.gap is not None or row.impulse != row.slip:
        return row
    found = {way for value in ways_in if (way := _way(row, value)) is not None}
    return replace(row, way=found.pop()) if len(found) == 1 else row


def _way(row: HoldRow, value: sympy.Expr) -> sympy.Expr | None:
    """The value in units of which the slip is the rate; None where it is not a sum of those positions."""
    places = {symbol(f"port:{key(speed).name}:x"): rate for speed, rate in row.rates.items()}
    if {s for s in value.free_symbols if not key(s.name).is_fixed} != places.keys():
        return None
    shares = {sympy.simplify(sympy.diff(value, place) / rate) for place, rate in places.items()}
    share = shares.pop()
    return sympy.expand(value / share) if not shares and share.is_number else None


def position_row(gap: sympy.Expr, ports: Mapping[str, Port], place: str) -> HoldRow:
    """The row of a relation of positions; `place` is where its law is written. Raises TraceError."""
    said = f"{place}: hold_position({gap})"
    positions = sorted({s for s in gap.free_symbols if not key(s.name).is_fixed}, key=lambda s: s.name)
    for one in (key(s.name) for s in positions):
        if one.is_speed:
            what = f"reads the speed of {one.name!r}. A gap is made of positions"
            raise TraceError(f"{said} {what}; write hold(slip) for a sum of speeds.")
        if one.kind != PORT or not ports[one.name].domain.mechanical:
            what = f"varies with {_said(one)}. A gap is made of positions or angles of ports, numbers and parameters"
            raise TraceError(f"{said} {what}. {_way_out(one)}")
    if not positions:
        raise TraceError(f"{said} wants positions of ports, such as b.x - p.radius*sin(a.angle).")
    names = [key(s.name).name for s in positions]
    ratios = {name: sympy.diff(gap, s) for name, s in zip(names, positions, strict=True)}
    slip = sum((ratio * symbol(f"port:{name}:v") for name, ratio in ratios.items()), sympy.S.Zero)
    return HoldRow(slip, {}, slip, gap=gap, ratios=ratios)


def _way_out(one: Key) -> str:
    if one.kind == TABLE:
        return "The bend of a table jumps from piece to piece; write a smooth formula, as a sum of sines."
    if one.kind == TIME:
        return "Prescribe what moves in time as the motion of a port, by a motion source."
    return "Give it as the motion of a port."


def position_side(row: HoldRow, unknown: str) -> sympy.Expr:
    """-(J a + (dJ/dt) v + c force), with the accelerations as unknowns of their own (or those of a given motion)."""
    speeds = {name: symbol(f"port:{name}:v") for name in row.ratios}
    total, ease = sympy.S.Zero, sympy.S.Zero
    for name, ratio in row.ratios.items():
        total += ratio * symbol(f"port:{name}:U")
        ease += ratio**2 * symbol(inverse_mass(name))
        for other, speed in speeds.items():
            total += sympy.diff(ratio, symbol(f"port:{other}:x")) * speed * speeds[name]
    return -total - GIVE * ease * symbol(f"own:{unknown}")


def put_on_ports(flows: dict[str, sympy.Expr], row: HoldRow, unknown: str, place: str) -> None:
    """Add to what the ports take in the force that keeps a gap. Raises TraceError where the law adds it too."""
    force = symbol(f"own:{unknown}")
    for port, flow in flows.items():
        if force in flow.free_symbols:
            what = f"{port} takes in {unknown}, which hold_position puts on its ports itself"
            raise TraceError(f"{place}: {what}. Leave it out of what the law gives for {port}.")
    for port, ratio in row.ratios.items():
        flows[port] = flows.get(port, sympy.S.Zero) - force * ratio


def check_everywhere(zones: Iterable[tuple[str, Mapping[str, HoldRow]]], place: Callable[[], str]) -> None:
    """Refuse a relation of positions that is not in force in every zone; `place` says where. Raises TraceError."""
    by_zone = {zone: {u: row.gap for u, row in holds.items() if row.gap is not None} for zone, holds in zones}
    first = next(iter(by_zone.values()), {})
    for zone, gaps in by_zone.items():
        for unknown in first.keys() | gaps.keys():
            if gaps.get(unknown) != first.get(unknown):
                what = f"hold_position of {unknown} is not the same in zone {zone!r} as in {next(iter(by_zone))!r}"
                why = "What holds a relation of positions holds it always"
                way_out = "Write what meets and parts as a spring and a damper of its own (a Tether, an EndStop)"
                raise TraceError(f"{place()}: {what}. {why}. {way_out}, or with hold(slip) where the ratio is fixed.")

"""The binding law as formulas: the force in each zone, and the force applied to the contact.

S is the sliding part, f the viscous coefficient; N the normal force that counts, v the slip speed; F_s = N mu_s.
`v_m < v_n` are the slip speeds between which f falls from f_m = F_s/creep to nothing. d = +-1 is the direction that a
zone stands for.
"""

from collections.abc import Callable
from typing import Any

from fairlead.components.friction.contact import drag
from fairlead.components.friction.curve import mu


def rest(p: Any, d: Any) -> Any:
    """mu_s in direction d; in between where a zone has both."""
    return p.mu_s if p.curve.backward is None else _between(p.mu_s, p.mu_s_backward, d)


def edge(p: Any, d: Any) -> Any:
    """mu(v_n) in direction d; in between where a zone has both."""
    return p.mu_n if p.curve.backward is None else _between(p.mu_n, p.mu_n_backward, d)


def border(p: Any, d: int) -> Any:
    """Slip speed where the plateau ends in direction d."""
    return p.border if p.curve.backward is None or d == 1 else p.border_backward


def _between(forward: Any, backward: Any, d: Any) -> Any:
    if d == 1 or d == -1:
        return forward if d == 1 else backward
    return forward * (1 + d) / 2 + backward * (1 - d) / 2


def plateau(p: Any, d: int, slip: Any, grip: Any) -> Any:
    """The viscous part with f = f_m, and S on its line through zero."""
    side = slip / p.border
    return grip * (rest(p, side) / p.creep + edge(p, side) / p.v_n) * slip


def ramp(p: Any, d: int, slip: Any, grip: Any) -> Any:
    """The viscous part falls to nothing; with the cap F_s, since the ramp is above it everywhere (physics 1.4).

    With sloping faces f = f_m (F_s - T)/(face F_s) falls with the force instead, which has the sum for T solved here:
    from (1 - face) F_s where the plateau ends it rises to F_s, never beyond. The load that the prism's faces belong to
    is T itself while a contact binds, since then nothing accelerates.
    """
    if p.face is not None:
        v, soft = d * slip, p.face * p.creep
        return d * grip * v * (edge(p, d) * soft / p.v_n + rest(p, d)) / (soft + v)
    if p.cap == "on":
        return d * grip * rest(p, d)
    coefficient = rest(p, d) / p.creep * (p.v_n - d * slip) / (p.v_n - p.v_m)
    return grip * (coefficient + edge(p, d) / p.v_n) * slip


def slide(p: Any, d: int, slip: Any, grip: Any) -> Any:
    """The curve."""
    return d * grip * mu(p.curve, d * slip, d) + drag(p, slip)


def latched(p: Any, d: int, slip: Any, grip: Any) -> Any:
    """The curve at v_n, however slow the slip still is."""
    return d * grip * edge(p, d) + drag(p, slip)


def transit(p: Any, d: int, slip: Any, grip: Any) -> Any:
    """S alone, on its line through zero."""
    return grip * edge(p, slip / p.v_n) / p.v_n * slip + drag(p, slip)


LAWS: dict[str, tuple[Callable[..., Any], int]] = {
    "plateau": (plateau, 0), "ramp_forward": (ramp, +1), "ramp_backward": (ramp, -1), "slide_forward": (slide, +1),
    "slide_backward": (slide, -1), "transit": (transit, 0), "break_forward": (latched, +1),
    "break_backward": (latched, -1),
}  # fmt: skip
"""The law of every zone in contact, and its direction."""
IN_CONTACT = tuple(LAWS)
BOUND = tuple(zone for zone, (law, _) in LAWS.items() if law in (plateau, ramp))
FORWARD, BACKWARD = (tuple(zone for zone, (_, d) in LAWS.items() if d == sense) for sense in (+1, -1))


def friction_in(p: Any, zone: str, slip: Any, grip: Any) -> Any:
    """Friction T [N] in a zone, smooth in slip and normal force."""
    law, d = LAWS[zone]
    return law(p, d, slip, grip)


def applied_force(p: Any, zone: str, a: Any, b: Any, grip: Any, bound_a: Any, bound_b: Any) -> Any:
    """The force that the contact would have to carry to hold [N], by the chosen definition.

    reduced    T + m a_rel,  1/m = 1/m_a + 1/m_b: no other contact of the two bodies is bound
    aggregate  each body moves together with what its other contact binds to it, of masses M:
               B + M (a_rel + (T - B)/m),  B the friction on the plateau at this slip
    naive      "the net applied force": all forces on b but this friction, T + m_b a_b, whatever the surface does

    In all of them T + m a_rel occurs, which a switch of this contact leaves as it is: so a switch cannot remove its own
    cause. Bound and settled, T = B and a_rel = 0, and the three agree.
    """
    slip = b.v - a.v
    friction = friction_in(p, zone, slip, grip)
    if p.applied_force == "naive":
        return friction + b.a / b.inverse_mass
    inverse = a.inverse_mass + b.inverse_mass
    free = friction + (b.a - a.a) / inverse
    if p.applied_force == "reduced":
        return free
    with_a = a.inverse_mass / (1 + bound_a * p.partner_mass_a * a.inverse_mass)
    with_b = b.inverse_mass / (1 + bound_b * p.partner_mass_b * b.inverse_mass)
    bound, share = capped_plateau(p, slip, grip), inverse / (with_a + with_b)
    return bound + share * (free - bound)


def capped_plateau(p: Any, slip: Any, grip: Any) -> Any:
    """Friction on the plateau, but at most F_s; for guards."""
    line, most = plateau(p, 0, slip, grip), grip * p.mu_s
    return (abs(line + most) - abs(line - most)) / 2

"""The binding law as formulas: the force in each zone, and the force applied to the contact.

S is the sliding part, f the viscous coefficient; N the normal force, v the slip speed; F_s = N mu_s.
`v_m < v_n` are the slip speeds between which f falls from f_m = F_s/creep to nothing.
"""

from typing import Any

BOUND = ("plateau", "ramp_forward", "ramp_backward")
IN_CONTACT = (*BOUND, "slide_forward", "slide_backward", "transit", "break_forward", "break_backward")


def direction(zone: str) -> int:
    """+1 in a forward zone, -1 in a backward one."""
    return -1 if zone.endswith("backward") else +1


def friction_in(p: Any, zone: str, slip: Any, normal: Any) -> Any:
    """Friction T [N] in a zone, smooth in slip and normal force."""
    d = direction(zone)
    if zone == "plateau":
        return normal * (p.mu_s / p.creep + p.mu_n / p.v_n) * slip
    if zone in BOUND and p.cap == "on":  # the ramp is above F_s everywhere (docs/physics.md 1.4)
        return d * normal * p.mu_s
    if zone in BOUND:
        coefficient = p.mu_s / p.creep * (p.v_n - d * slip) / (p.v_n - p.v_m)
        return normal * (coefficient + p.mu_n / p.v_n) * slip
    if zone.startswith("slide"):
        return d * normal * p.curve.coefficient(d * slip) + p.viscous * slip
    if zone.startswith("break"):
        return d * normal * p.mu_n + p.viscous * slip
    return normal * p.mu_n / p.v_n * slip + p.viscous * slip  # transit


def effective_mass(p: Any, zone: str, a: Any, b: Any, bound_a: Any, bound_b: Any) -> Any:
    """The mass M [kg] in  af = T + M a_rel  for the chosen definition of the applied force.

    naive      all forces on b but this friction, the surface taken as it is
    reduced    both bodies free of other bound contacts:  1/M = 1/m_a + 1/m_b
    aggregate  as reduced, each body together with what its other contact binds to it
    """
    if p.applied_force == "naive":
        return 1 / b.inverse_mass
    inverse_a, inverse_b = a.inverse_mass, b.inverse_mass
    if p.applied_force == "aggregate":
        inverse_a = inverse_a / (1 + bound_a * p.partner_mass_a * inverse_a)
        inverse_b = inverse_b / (1 + bound_b * p.partner_mass_b * inverse_b)
    return 1 / (inverse_a + inverse_b)


def applied_force(p: Any, zone: str, a: Any, b: Any, normal: Any, bound_a: Any, bound_b: Any) -> Any:
    """The force that the contact would have to carry to hold [N], af = T + M a_rel."""
    mass = effective_mass(p, zone, a, b, bound_a, bound_b)
    return friction_in(p, zone, b.v - a.v, normal) + mass * (b.a - a.a)

"""How the friction coefficient depends on the slip speed: the family of sliding curves."""

from fairlead.component import Parameter, Table, derived, exp
from fairlead.component.base import Family


class Curve(Family, abstract=True):
    """A sliding curve: `coefficient(v)` for slip speed v >= 0, and `breakaway()` from rest.

    In a netlist a bare number is a constant coefficient; a map names the curve:
    `{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}`.

    Every curve may depend on load and temperature as well (Hertz, softening of polymers):

        mu(a_T v) (N/N_ref)^(n - 1) exp(-alpha (Theta - Theta_ref)),    n = load_exponent, alpha = softening
        a_T = exp(-beta (Theta - Theta_ref)),                           beta = velocity_shift

    so that friction is mu N_ref (N/N_ref)^n, and warmed rubber slides at v as cold rubber does at a_T v. On a line N
    and N_ref are loads on a metre of it. A curve may have points of its own for backward slip, where a surface has a
    nap. What is not given is absent.
    """

    asked_with = {"velocity_shift": None}  # not every method knows it, so the contract suite does not give it at random
    key = "curve"
    needs = {"coefficient": "coefficient(p, v): friction over normal force at slip speed v >= 0 [m/s]"}
    gives = {
        "coefficient": "a number: friction over normal force",
        "breakaway": "a number: friction over normal force at which slipping begins",
        "scale": "a speed [m/s], or None",
    }
    default_word = "coulomb"
    bare = ("coulomb", "coulomb")
    backward = Table("m/s", "1", "Slip speed and coefficient for backward slip; as forward when absent.", default=None)
    load_exponent = Parameter("1", "n: friction grows as the normal force to the n.", default=None, above=0, most=2)
    load_reference = Parameter(
        "N", "N_ref, the normal force that the coefficients hold for; on a line that on a metre.", default=None, above=0
    )
    softening = Parameter("1/K", "alpha: relative loss of friction per kelvin.", default=None)
    velocity_shift = Parameter("1/K", "beta: relative shift of the curve to higher speeds per kelvin.", default=None)
    reference_temperature = Parameter(
        "K", "Theta_ref, the temperature the coefficients hold for.", default=293.15, above=0
    )

    def breakaway(p):
        """Coefficient that slipping must overcome to begin: `stiction` if there is one, else that at no speed."""
        return p.stiction if "stiction" in p.type.declaration.parameters else p.coefficient(0)

    @derived
    def breakaway_backward(p):
        """The same for backward slip."""
        return p.breakaway() if p.backward is None else p.backward(0.0)

    def scale(p):
        """Smallest speed [m/s] over which the curve changes; None when it does not."""
        return None

    def check(p):
        """An exponent wants the load that it is relative to; a table begins at rest and does not drive the slip."""
        if p.backward is not None:
            yield from points_make_sense("backward", p.backward)
        if p.load_exponent is not None and p.load_reference is None:
            yield (
                "load_exponent",
                "load_exponent is given without load_reference",
                "Give the normal force at which the coefficients were measured.",
            )


def mu(curve, v, d):
    """Coefficient at slip speed v in direction d: +1, -1, or in between where a law goes over smoothly."""
    if curve.backward is None or d == 1:
        return curve.coefficient(v)
    if d == -1:
        return curve.backward(v)
    return curve.coefficient(v) * (1 + d) / 2 + curve.backward(v) * (1 - d) / 2


def mu_s(curve, d):
    """Coefficient from rest in direction d, +1 or -1."""
    return curve.breakaway() if curve.backward is None or d == 1 else curve.breakaway_backward


def load_factor(curve, normal, least):
    """(N/N_ref)^(n-1), rounded off at the normal force `least` [N], so that none at all is no trouble."""
    if curve.load_exponent is None:
        return 1
    return ((normal**2 + least**2) / curve.load_reference**2) ** ((curve.load_exponent - 1) / 2)


def temperature_factor(curve, temperature):
    """exp(-alpha (Theta - Theta_ref))."""
    return 1 if curve.softening is None else exp(-curve.softening * (temperature - curve.reference_temperature))


def pace_of(curve, temperature):
    """a_T, the speed at Theta_ref over the speed at which friction is the same."""
    if curve.velocity_shift is None:
        return 1
    return exp(-curve.velocity_shift * (temperature - curve.reference_temperature))


def stays_in_place(p):
    """For `check` of what cannot shift its curve with the temperature."""
    if p.curve.velocity_shift is not None:
        yield (
            "curve", "velocity_shift is given, and this contact has its curve at one temperature",
            "Use method: hold, karnopp, tanh, arctan or root, or a softening instead.",
        )  # fmt: skip


def points_make_sense(name, table, what="coefficient", speed="m/s"):
    """Speeds from zero on, no negative coefficient or force, at any speed: what is wrong, as `check` says it."""
    if table.rows[0, 1] != 0.0:
        yield name, f"the first speed is {table.rows[0, 1]:g} m/s", "Begin the table at 0 m/s."
    if (table.rows[:, 3] < 0).any():
        yield name, f"a {what} is negative", f"A negative {what} would drive the slip."
    elif (falls := falls_below_zero(table)) is not None:
        yield (
            name, f"beyond: line has the {what} fall below zero from {falls:.4g} {speed} on",
            f"A negative {what} would drive the slip. Leave beyond out, and it stays at {table.terms[-1, 0]:g}; "
            "or give points as far as the slip goes.",
        )  # fmt: skip


def falls_below_zero(table):
    """Where a table whose points are not negative becomes negative beyond the last one; None where it never does."""
    end, slope = table.terms[-1, :2]
    return float(table.left[-1] - end / slope) if slope < 0 else None

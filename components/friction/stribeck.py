"""Friction that falls from stiction to a sliding level: Stribeck (Gaussian) and Tustin (exponential)."""

from fairlead.components.friction.curve import Curve

from fairlead.component import Parameter, exp


class Falling(Curve, abstract=True):
    """What the two have in common: two levels and a speed."""

    level = "coulomb"
    stiction = Parameter("1", "Coefficient at rest.", least=0, usual=(0, 2))
    coulomb = Parameter("1", "Coefficient at high speed.", least=0, usual=(0, 2))
    velocity = Parameter("m/s", "Stribeck velocity, the scale of the fall.", above=0)

    def scale(p):
        """The Stribeck velocity."""
        return p.velocity

    def check(p):
        """A curve that rises from rest is the hump."""
        yield from Curve.check(p)
        if p.stiction < p.coulomb:
            yield (
                "stiction", f"stiction {p.stiction:g} is below coulomb = {p.coulomb:g}",
                "The force to start sliding cannot be less than the sliding force; raise stiction, lower coulomb, "
                "or use curve: hump, which may rise.",
            )  # fmt: skip


class Stribeck(Falling):
    """mu(v) = coulomb + (stiction - coulomb) exp(-(v/velocity)^2)."""

    def coefficient(p, v):
        """Gaussian fall: flat at rest."""
        return p.coulomb + (p.stiction - p.coulomb) * exp(-((v / p.velocity) ** 2))


class Tustin(Falling):
    """mu(v) = coulomb + (stiction - coulomb) exp(-v/velocity)   (Tustin 1947)."""

    def coefficient(p, v):
        """Exponential fall: steepest at rest."""
        return p.coulomb + (p.stiction - p.coulomb) * exp(-v / p.velocity)

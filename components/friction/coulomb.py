"""Sliding friction that is constant, or grows in proportion to the speed."""

from fairlead.components.friction.curve import Curve

from fairlead.component import Parameter, derived


class Level(Curve, abstract=True):
    """A sliding level, and its own level from rest if wanted."""

    stiction = Parameter(
        "1", "Coefficient to start sliding; that of sliding when not given.", default=None, least=0, usual=(0, 2)
    )

    @derived
    def rest(p):
        """Coefficient from rest."""
        return p.coulomb if p.stiction is None else p.stiction

    def breakaway(p):
        """Coefficient from rest."""
        return p.rest

    def check(p):
        """Starting takes at least as much as sliding."""
        yield from Curve.check(p)
        if p.stiction is not None and p.stiction < p.coulomb:
            yield (
                "stiction", f"stiction {p.stiction:g} is below coulomb = {p.coulomb:g}",
                "The force to start sliding cannot be less than the sliding force; raise stiction or lower coulomb.",
            )  # fmt: skip


class Coulomb(Level):
    """mu(v) = coulomb for every v > 0; from rest `stiction` must be overcome."""

    level = "coulomb"
    coulomb = Parameter("1", "Coefficient while sliding.", least=0, usual=(0, 2))

    def coefficient(p, v):
        """The same at any speed."""
        return p.coulomb


class Viscous(Level):
    """mu(v) = coulomb + rate v: friction of a lubricated contact; from rest `stiction` must be overcome."""

    level = "coulomb"
    coulomb = Parameter("1", "Coefficient at vanishing speed.", default=0.0, least=0, usual=(0, 2))
    rate = Parameter("s/m", "Growth of the coefficient with speed.", above=0)

    def coefficient(p, v):
        """Grows in proportion to the speed."""
        return p.coulomb + p.rate * v

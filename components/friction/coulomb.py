"""Constant sliding friction, with its own level from rest if wanted."""

from fairlead.components.friction.curve import Curve

from fairlead.component import Parameter, derived


class Coulomb(Curve):
    """mu(v) = coulomb for every v > 0; from rest `stiction` must be overcome (the same when not given)."""

    coulomb = Parameter("1", "Coefficient while sliding.", least=0)
    stiction = Parameter("1", "Coefficient to start sliding.", default=None, least=0)

    def coefficient(p, v):
        """The same at any speed."""
        return p.coulomb

    @derived
    def rest(p):
        """Coefficient from rest."""
        return p.coulomb if p.stiction is None else p.stiction

    def breakaway(p):
        """Coefficient from rest."""
        return p.rest

    def check(p):
        """Starting takes at least as much as sliding."""
        if p.stiction is not None and p.stiction < p.coulomb:
            yield (
                "stiction", f"stiction {p.stiction:g} is below coulomb = {p.coulomb:g}",
                "The force to start sliding cannot be less than the sliding force; raise stiction or lower coulomb.",
            )  # fmt: skip

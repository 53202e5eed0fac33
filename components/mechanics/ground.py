"""A fixed point."""

from fairlead.component import Component, Translational


class Ground(Component):
    """A point that never moves; it takes whatever force comes."""

    flange = Translational("the fixed point")

    def law(p, flange):
        """Nothing to add; the motion is prescribed."""
        return (0,)

    def prescribes():
        """Position, velocity and acceleration of the flange: zero."""
        return {"flange": None}

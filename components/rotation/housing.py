"""A point that does not turn."""

from fairlead.component import Component, Rotational


class Housing(Component):
    """Never turns; it takes any torque.

    shaft.speed = 0.  Source: definition. Limits: it does not turn; what turns as given is a SpeedSource.
    """

    shaft = Rotational("the fixed point")

    def law(p, shaft):
        """Nothing to add; the motion is prescribed."""
        return (0,)

    def prescribes():
        """Angle, speed and acceleration of the shaft: zero."""
        return {"shaft": None}

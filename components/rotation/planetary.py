"""Gears of three shafts, of which any may be driven: one relation of their speeds, no inertia of their own."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, Unknown, hold


class Planetary(Component):
    """An ideal planetary gear:  sun.speed + ratio ring.speed = (1 + ratio) carrier.speed.

    Torques are in the ratio 1 : ratio : -(1 + ratio), so nothing is lost. A shaft that is joined to nothing with an
    inertia takes no torque, and then none carries any. Limits: the inertia of the planets is to be added to the
    carrier; losses are a ShaftFriction or a Gearbox beside it. How contacts at all three shafts share a load while all
    of them hold is not known: clutches and brakes must be pressed in turn, by signals.

    Source: Willis's equation, 1841; IdealPlanetary of the Modelica Standard Library.
    """

    sun = Rotational("shaft of the sun")
    ring = Rotational("shaft of the ring")
    carrier = Rotational("shaft of the planets' carrier")
    ratio = Parameter("1", "Teeth of the ring over those of the sun.", above=0, usual=(1, 20))
    carried = Unknown("N*m", "Torque that the gear gives to the sun.")
    torque = Output("N*m", "Torque that the gear gives to the sun, positive forward.")

    def law(p, sun, ring, carrier, carried):
        """One relation of speeds, and the torques that keep it without work."""
        relation = sun.speed + p.ratio * ring.speed - (1 + p.ratio) * carrier.speed
        return Law(
            sun=-carried, ring=-p.ratio * carried, carrier=(1 + p.ratio) * carried, carried=hold(relation),
            torque=carried, dissipated=0,
        )  # fmt: skip


class Differential(Component):
    """Shares the torque of a case equally between two shafts:  left.speed + right.speed = 2 case.speed.

    Limits: no friction between the side gears; for a limited slip put a Clutch between left and right.

    Source: IdealPlanetary with ratio 1 of the Modelica Standard Library.
    """

    case = Rotational("what is driven")
    left = Rotational("one side")
    right = Rotational("the other side")
    carried = Unknown("N*m", "Torque given to each side.")
    torque = Output("N*m", "Torque given to each side, positive forward.")

    def law(p, case, left, right, carried):
        """One relation of speeds."""
        relation = left.speed + right.speed - 2 * case.speed
        return Law(left=-carried, right=-carried, case=2 * carried, carried=hold(relation), torque=carried,
                   dissipated=0)  # fmt: skip


class SupportedGear(Component):
    """An ideal gear whose housing may turn:  b.speed - support.speed = ratio (a.speed - support.speed).

    The support takes what torque the two shafts leave over: a gear motor on a torque arm, a gear on a swinging frame.
    With the support at a Housing it is a `Gear`, which costs nothing.

    Source: Willis's equation, 1841. Limits: no loss and no play.
    """

    a = Rotational("driving shaft")
    b = Rotational("driven shaft")
    support = Rotational("the housing of the gear")
    ratio = Parameter("1", "Turns of b for one turn of a, seen from the support; not zero.")
    carried = Unknown("N*m", "Torque given to b.")
    torque = Output("N*m", "Torque given to b, positive forward.")

    def law(p, a, b, support, carried):
        """One relation of speeds, seen from the support."""
        relation = b.speed - p.ratio * a.speed - (1 - p.ratio) * support.speed
        return Law(
            b=-carried, a=p.ratio * carried, support=(1 - p.ratio) * carried, carried=hold(relation),
            torque=carried, dissipated=0,
        )  # fmt: skip

    def check(p):
        """A ratio of zero would hold b to the support for ever."""
        if p.ratio == 0:
            yield "ratio", "ratio is zero", "Hold a shaft with a prescribed motion instead."

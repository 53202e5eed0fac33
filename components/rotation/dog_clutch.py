"""A clutch of teeth that is shifted in and out."""

from fairlead.component import (
    Component,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    Unknown,
    Zones,
    guard,
    hold,
    least,
    zone,
)  # fmt: skip

SHIFTED = 0.5  # of the way: half in is in


class DogClutch(Component):
    """Joins two shafts while its teeth are engaged; they engage only at nearly the same speeds.

    out                torque = 0
    ahead, behind      torque = 0,   teeth are pressed on while b is faster, or slower
    closed             b.speed = a.speed,   torque = whatever holds, either way

    `engage` above 1/2 presses the teeth on. They go in as soon as |b.speed - a.speed| is below `synchronised`. Below
    1/2 they come out, under load too. When they go in, an impulse removes the slip that is left, and keeps the angular
    momentum.

    Limits: the teeth have no play (put a Backlash in series), and do not wait to meet a gap.

    Source: conservation of angular momentum; docs/integrator.md, Impacts.
    """

    a = Rotational("one shaft")
    b = Rotational("the other shaft")
    synchronised = Parameter("rad/s", "Slip below which the teeth go in.", default=1.0, above=0)
    engage = Input("1", "Above 1/2 presses the teeth on.", signed=True)
    carried = Unknown("N*m", "Torque carried from a to b.")
    torque = Output("N*m", "Torque carried from a to b; positive turns b forward.")
    slip = Output("rad/s", "Speed of b over a.")
    zones = Zones("out", "ahead", "behind", "closed", forward=["ahead"], backward=["behind"])

    @zone("out", "ahead", "behind")
    def apart(p, a, b, carried):
        """Nothing is carried."""
        return Law(a=0, b=0, carried=carried, torque=0, slip=b.speed - a.speed)

    @zone("closed")
    def together(p, a, b, carried):
        """One speed."""
        return Law(a=carried, b=-carried, carried=hold(b.speed - a.speed), torque=carried, slip=b.speed - a.speed)

    @guard("ahead", to="closed", unit="rad/s", mirrored="goes_in_from_below")
    def goes_in_from_above(p, a, b, direction):
        """Nearly one speed."""
        return p.synchronised - direction * (b.speed - a.speed)

    @guard("out", to="ahead", unit="1", mirrored="pressed_behind")
    def pressed_ahead(p, a, b, engage, direction):
        """Asked for, with b faster."""
        return least(engage - SHIFTED, 1 + direction * (b.speed - a.speed) / p.synchronised)

    @guard("*", to="out", unit="1")
    def comes_out(p, engage):
        """No longer asked for."""
        return SHIFTED - engage

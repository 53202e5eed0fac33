"""Classes whose ratios of speeds move: a cam, and a rod between two points of a plane."""

from fairlead.component import (
    Component,
    Law,
    Output,
    Parameter,
    Rotational,
    Translational,
    Unknown,
    cos,
    hold_position,
    sin,
    sqrt,
)


class Cam(Component):
    """A follower on a smooth cam:  follower.x = lift (1 - cos(angle) + share sin(2 angle)/4)."""

    shaft, follower = Rotational(), Translational()
    lift = Parameter("m", "Half of the way.", above=0)
    share = Parameter("1", "Of the second harmonic.", default=0.0)
    push = Unknown("N", "Force of the cam on the follower.")
    force = Output("N", "The same.")
    gap = Output("m", "What the follower is off its place.")

    def law(p, shaft, follower, push):
        """The relation of positions."""
        gap = follower.x - p.lift * (1 - cos(shaft.angle) + p.share * sin(2 * shaft.angle) / 4)
        return Law(push=hold_position(gap), force=push, gap=gap)


class Rod(Component):
    """Keeps the distance of two points of a plane, each of which has two ports."""

    x1, y1, x2, y2 = Translational(), Translational(), Translational(), Translational()
    length = Parameter("m", "Distance of the points.", above=0)
    pull = Unknown("N", "Force along the rod.")
    tension = Output("N", "Tension of the rod.")
    gap = Output("m", "What the distance is off.")

    def law(p, x1, y1, x2, y2, pull):
        """The relation of positions."""
        gap = sqrt((x1.x - x2.x) ** 2 + (y1.x - y2.x) ** 2) - p.length
        return Law(pull=hold_position(gap), tension=-pull, gap=gap)

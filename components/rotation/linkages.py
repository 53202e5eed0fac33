"""Linkages whose ratio moves: a cam, a pin of an arm, and a strut between a frame and an arm."""

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
)  # fmt: skip


class Linkage(Component, abstract=True):
    """Half-model: a shaft gives a slider its place, by parts that are rigid, without mass, play or loss.

    Shaft and slider each need an inertia of their own, unless their motion is given. Of angle and position one may be
    given at the start, and one of the speeds; the others follow.
    """

    shaft = Rotational("the shaft")
    slider = Translational("what it moves")
    push = Unknown("N", "Force on the slider along its line.")
    force = Output("N", "Force on the slider along its line, positive towards +x.")
    gap = Output("m", "What the slider is off its place, which a run keeps below its error weight.")


def led(slider, place, push):
    """One relation of positions; its force acts on both ports."""
    return Law(push=hold_position(slider.x - place), force=push, gap=slider.x - place)


class Cam(Linkage):
    """A cam lifts its follower as a sine:  slider.x = base + lift (1 - cos(lobes angle))/2.

    The follower stays on the cam, as in a groove. With one lobe it is an eccentric disc. A `force` below zero would
    lift a follower off that only a spring presses.

    Source: the harmonic cam, e.g. Shigley's Mechanical Engineering Design. Limits: no friction or play at the follower.
    """

    base = Parameter("m", "Position of the follower at its lowest.", default=0.0)
    lift = Parameter("m", "Travel from the lowest to the highest point.", above=0)
    lobes = Parameter("1", "How often it lifts in a turn.", default=1.0, above=0, most=20)

    def law(p, shaft, slider, push):
        """The follower is where the cam has it."""
        return led(slider, p.base + p.lift * (1 - cos(p.lobes * shaft.angle)) / 2, push)


class ArmPin(Linkage):
    """A pin on an arm that turns moves a slider:  slider.x = centre + radius sin(angle - zero).

    The slider has a slot for the pin, so it follows the pin along one line only. Use it like a Lever, but for large
    angles: two of them on one shaft, each with its radius, make a lever of two arms. On a shaft that turns all the way
    round it is a Scotch yoke.

    Source: kinematics of the Scotch yoke, e.g. Meriam and Kraige, Engineering Mechanics: Dynamics. Limits: slot and pin
    have no mass, play or friction.
    """

    radius = Parameter("m", "Distance of the pin from the shaft; negative: on the other side.")
    zero = Parameter("rad", "Angle at which the arm is at right angles to the line of the slider.", default=0.0)
    centre = Parameter("m", "Position of the slider at that angle.", default=0.0)

    def check(p):
        """An arm has a length."""
        if p.radius == 0:
            yield "radius", "radius is zero", "The pin would stand: take a Ground."

    def law(p, shaft, slider, push):
        """Where the pin is along the line."""
        return led(slider, p.centre + p.radius * sin(shaft.angle - p.zero), push)


class ArmStrut(Linkage):
    """A strut, such as a cylinder, from a point of the frame to a pin of an arm: slider.x is its length.

        slider.x = sqrt(frame^2 + radius^2 - 2 frame radius cos(angle - zero))

    `frame` and `radius` are the distances of its two ends from the shaft, and angle - zero is the angle between them.
    If a Cylinder is the strut, join its body with a Ground, and its rod with the slider by a RigidLink of the length
    that the cylinder has when it is in.

    Limits: the strut has no mass except that of the slider. The arm does not pass through the line of the frame point,
    where the strut has no leverage.

    Source: the law of cosines.
    """

    frame = Parameter("m", "Distance of the frame's point from the shaft.", above=0)
    radius = Parameter("m", "Distance of the pin from the shaft.", above=0)
    zero = Parameter("rad", "Angle at which the pin points at the frame's point.", default=0.0)
    leverage = Output("m", "Torque on the shaft per force of the strut that pushes.")

    def law(p, shaft, slider, push):
        """The third side of a triangle."""
        length = sqrt(p.frame**2 + p.radius**2 - 2 * p.frame * p.radius * cos(shaft.angle - p.zero))
        law = led(slider, length, push)
        return Law(**law.terms, leverage=p.frame * p.radius * sin(shaft.angle - p.zero) / length)

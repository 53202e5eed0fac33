"""A crank and its connecting rod: a shaft that moves a slider to and fro."""

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


class Crank(Component):
    """A crank on a shaft moves a slider by a rigid rod without mass, play or loss.

        slider.x = centre + radius cos(angle) + sqrt(rod^2 - (radius sin(angle) - offset)^2)

    At angle 0 without offset the slider is in its outer dead centre, at pi in the inner one. The crank passes both.
    Shaft and slider each need an inertia of their own, unless their motion is given. At the start you may give one of
    angle and position, and one of the speeds; the others follow.

    The rod leans, so it presses the slider on its guide with the force `thrust`. For a guide with friction take a
    Contact whose `normal` is a SignalSize of `thrust`.

    Limits: the rod has no mass; add its mass to the two sides.

    Source: kinematics of the slider-crank, e.g. Meriam and Kraige, Engineering Mechanics: Dynamics.
    """

    shaft = Rotational("the shaft with the crank")
    slider = Translational("what the rod moves")
    radius = Parameter("m", "Radius of the crank, from the shaft to the pin.", above=0)
    rod = Parameter("m", "Length of the connecting rod, above radius + |offset|.", above=0)
    offset = Parameter("m", "Distance of the slider's line from the shaft, to the side of angle pi/2.", default=0.0)
    centre = Parameter("m", "Position of the shaft along the slider's line.", default=0.0)
    push = Unknown("N", "Force of the rod on the slider along its line.")
    force = Output("N", "Force of the rod on the slider along its line, outwards positive.")
    thrust = Output("N", "Force of the slider on its guide, across its line, to the side of angle pi/2 positive.")
    gap = Output("m", "What the slider is off its place, which a run keeps below its error weight.")

    def law(p, shaft, slider, push):
        """One relation of positions; its force acts on both ports."""
        across = p.radius * sin(shaft.angle) - p.offset
        along = sqrt(p.rod**2 - across**2)
        gap = slider.x - p.centre - p.radius * cos(shaft.angle) - along
        return Law(push=hold_position(gap), force=push, thrust=-push * across / along, gap=gap)

    def check(p):
        """The crank turns all the way round."""
        if p.rod <= p.radius + abs(p.offset):
            what = f"rod {p.rod:g} m is not above radius + |offset| = {p.radius + abs(p.offset):g} m"
            yield "rod", what, "The crank could not turn round: take a longer rod."

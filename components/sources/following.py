"""Motions that a signal gives, along a line or of a shaft.

A motion has a speed and an acceleration, and a signal tells neither: it may jump. So a place and a speed follow their
signals as a filter does, whose states are the motion: `lag` says how closely. An acceleration needs none.
"""

from fairlead.component import Component, Input, Law, Output, Parameter, Rotational, State, Translational


def given(port, x, v, a):
    """Law of a motion along a line, that is x, v and a; the balance at the node tells the force."""
    return {"flange": 0, "x": x, "v": v, "a": a, "force": port.force, "supplied": port.force * port.v}


def turning(port, angle, speed, acceleration):
    """The same of a shaft."""
    return {"shaft": 0, "angle": angle, "speed": speed, "acceleration": acceleration, "torque": port.torque,
            "supplied": port.torque * port.speed}  # fmt: skip


def towards(p, wanted, place, rate):
    """Acceleration of what goes to a place with two lags of the same size, without overshoot."""
    return (wanted - place) / p.lag**2 - 2 * rate / p.lag


class Guided(Component, abstract=True):
    """What motions along a line by a signal have in common."""

    flange = Translational("the driven point")
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity.")
    a = Output("m/s^2", "Acceleration.")
    force = Output("N", "Force given in the direction of +x.")
    origin = Parameter("m", "Position at the start.", default=0.0, physics=False)
    place = State("m", "Position.", start="origin")

    def prescribes():
        """Names of the outputs that are the position, velocity and acceleration of the flange."""
        return {"flange": ("x", "v", "a")}


class Turned(Component, abstract=True):
    """What motions of a shaft by a signal have in common."""

    shaft = Rotational("the driven shaft")
    turned = Output("rad", "Angle.", name="angle")
    rate = Output("rad/s", "Angular speed.", name="speed")
    acceleration = Output("rad/s^2", "Angular acceleration.")
    torque = Output("N*m", "Torque given, positive forward.")
    origin = Parameter("rad", "Angle at the start.", default=0.0, physics=False)
    place = State("rad", "Angle.", start="origin")

    def prescribes():
        """Names of the outputs that are the angle, speed and acceleration of the shaft."""
        return {"shaft": ("angle", "speed", "acceleration")}


class PositionActuator(Guided):
    """Moves its flange to the position of a signal:  lag^2 x'' + 2 lag x' + x = wanted.

    It takes whatever force that takes: an ideal drive. A steady wish is reached without overshoot, a growing one
    followed 2 lag behind. It begins at rest at `origin`.

    Source: Position of the Modelica Standard Library, with a filter. Limits: no limit of force or speed.
    """

    wanted = Input("m", "Position to go to.", signed=True)
    lag = Parameter("s", "Time constant of each of the two lags.", default=1e-3, above=0)
    moving = State("m/s", "Velocity.")

    def law(p, flange, wanted, place, moving):
        """Second order, critically damped."""
        pull = towards(p, wanted, place, moving)
        return Law(place=moving, moving=pull, **given(flange, place, moving, pull))


class VelocityActuator(Guided):
    """Moves its flange with the velocity of a signal, with a lag:  lag v' = wanted - v.

    It takes whatever force that takes: an ideal drive.

    Source: Speed of the Modelica Standard Library, with a filter. Limits: no limit of force.
    """

    wanted = Input("m/s", "Velocity to go with.", signed=True)
    lag = Parameter("s", "Time constant with which the velocity follows.", default=1e-3, above=0)
    start = Parameter("m/s", "Velocity at the start.", default=0.0, physics=False)
    moving = State("m/s", "Velocity.", start="start")

    def law(p, flange, wanted, place, moving):
        """First order."""
        pull = (wanted - moving) / p.lag
        return Law(place=moving, moving=pull, **given(flange, place, moving, pull))


class AccelerationActuator(Guided):
    """Moves its flange with the acceleration of a signal, at any force:  v' = wanted.

    Source: Accelerate of the Modelica Standard Library. Limits: it bears any force; position and velocity drift with an
    error of the signal.
    """

    wanted = Input("m/s^2", "Acceleration.", signed=True)
    start = Parameter("m/s", "Velocity at the start.", default=0.0, physics=False)
    moving = State("m/s", "Velocity.", start="start")

    def law(p, flange, wanted, place, moving):
        """Two integrals."""
        return Law(place=moving, moving=wanted, **given(flange, place, moving, wanted))


class AngleActuator(Turned):
    """Turns its shaft to the angle of a signal:  lag^2 angle'' + 2 lag angle' + angle = wanted.

    It takes whatever torque that takes: an ideal drive, as a PositionActuator is along a line.

    Source: Position of the Modelica Standard Library, with a filter. Limits: no limit of torque or speed.
    """

    wanted = Input("rad", "Angle to turn to.", signed=True)
    lag = Parameter("s", "Time constant of each of the two lags.", default=1e-3, above=0)
    moving = State("rad/s", "Angular speed.")

    def law(p, shaft, wanted, place, moving):
        """Second order, critically damped."""
        pull = towards(p, wanted, place, moving)
        return Law(place=moving, moving=pull, **turning(shaft, place, moving, pull))


class SpeedActuator(Turned):
    """Turns its shaft with the speed of a signal, with a lag:  lag speed' = wanted - speed.

    It takes whatever torque that takes: an ideal drive. A PositionServo or a motor with a PiController is a real one.

    Source: Speed of the Modelica Standard Library, with a filter. Limits: no limit of torque.
    """

    wanted = Input("rad/s", "Speed to turn with.", signed=True)
    lag = Parameter("s", "Time constant with which the speed follows.", default=1e-3, above=0)
    start = Parameter("rad/s", "Speed at the start.", default=0.0, physics=False)
    moving = State("rad/s", "Angular speed.", start="start")

    def law(p, shaft, wanted, place, moving):
        """First order."""
        pull = (wanted - moving) / p.lag
        return Law(place=moving, moving=pull, **turning(shaft, place, moving, pull))

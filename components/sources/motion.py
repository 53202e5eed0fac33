"""A motion given in time, along a line or of a shaft."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, Translational, Waveform, derived_wave

LEAST_JUMP = 1e-9  # m, or of the position; less is rounding of the pieces


def jumps(path):
    """(place, height) of every jump of a quantity in time."""
    for at, height in path.jumps():
        if abs(height) > LEAST_JUMP * max(1.0, abs(path(at))):
            yield at, height


def integrated(rate, origin):
    """A quantity in time whose rate is given, and which is `origin` at t = 0."""
    return rate.integral(0.0).scaled(1.0, origin)


class MotionSource(Component):
    """Moves its flange as prescribed, at any force.

    Give either `velocity` (the position follows by integration from `origin`) or `position`.

    flange.v = velocity(t).  Source: definition. Limits: it bears any force; a position may not jump.
    """

    flange = Translational("the driven point")
    velocity = Waveform("m/s", "Velocity in time.", default=None)
    position = Waveform("m", "Position in time.", default=None)
    origin = Parameter(
        "m", "Position at t = 0 with a velocity; without it the motion begins where the body starts.", default=None,
        physics=False,
    )
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity.")
    a = Output("m/s^2", "Acceleration.")
    force = Output("N", "Force the source gives in the direction of +x.")

    def law(p, flange, t):
        """Position and its derivatives; the ledger takes the force from the balance at the node."""
        return Law(
            flange=0, x=p.motion(t), v=p.motion.rate(t), a=p.motion.second(t), force=flange.force,
            supplied=flange.force * flange.v,
        )  # fmt: skip

    moves_as = "motion"

    def prescribes():
        """Names of the outputs that are the position, velocity and acceleration of the flange."""
        return {"flange": ("x", "v", "a")}

    def check(p):
        """Exactly one of the two ways."""
        if (p.velocity is None) == (p.position is None):
            yield "", "give either velocity or position", "A velocity is integrated from `origin`."
        for at, jump in jumps(p.position) if p.position is not None else ():
            what = f"the position jumps by {jump:.3g} m at t = {at:g} s, which takes an infinite force"
            yield "position", what, "Give a ramp, or a velocity, which is integrated."

    def starts_at(p, x, t):
        """Where the driven body starts, and when, if only a velocity is given."""
        if p.position is None and p.origin is None:
            p.motion.polynomial.rows[:, 3] += x - p.motion(t)

    @derived_wave
    def motion(p):
        """The position as one wave."""
        return p.position if p.position is not None else integrated(p.velocity, p.origin or 0.0)


class SpeedSource(Component):
    """An ideal drive of given speed: turns its shaft as prescribed, at any torque.

    Give either `speed` (the angle follows by integration from `origin`) or `angle`.

    shaft.speed = speed(t).  Source: definition. Limits: it bears any torque; an angle may not jump.
    """

    shaft = Rotational("the driven shaft")
    speed = Waveform("rad/s", "Angular speed in time.", default=None)
    angle = Waveform("rad", "Angle in time.", default=None)
    origin = Parameter(
        "rad", "Angle at t = 0 with a speed; without it the motion begins where the shaft starts.", default=None,
        physics=False,
    )
    turned = Output("rad", "Angle.", name="angle")
    rate = Output("rad/s", "Angular speed.", name="speed")
    acceleration = Output("rad/s^2", "Angular acceleration.")
    torque = Output("N*m", "Torque the source gives, positive forward.")

    def law(p, shaft, t):
        """Angle and its derivatives; the ledger takes the torque from the balance at the node."""
        return Law(
            shaft=0, angle=p.motion(t), speed=p.motion.rate(t), acceleration=p.motion.second(t), torque=shaft.torque,
            supplied=shaft.torque * shaft.speed,
        )  # fmt: skip

    moves_as = "motion"

    def prescribes():
        """Names of the outputs that are the angle, speed and acceleration of the shaft."""
        return {"shaft": ("angle", "speed", "acceleration")}

    def check(p):
        """Exactly one of the two ways."""
        if (p.speed is None) == (p.angle is None):
            yield "", "give either speed or angle", "A speed is integrated from `origin`."
        for at, jump in jumps(p.angle) if p.angle is not None else ():
            what = f"the angle jumps by {jump:.3g} rad at t = {at:g} s, which takes an infinite torque"
            yield "angle", what, "Give a ramp, or a speed, which is integrated."

    def starts_at(p, x, t):
        """Where the driven shaft starts, and when, if only a speed is given."""
        if p.angle is None and p.origin is None:
            p.motion.polynomial.rows[:, 3] += x - p.motion(t)

    @derived_wave
    def motion(p):
        """The angle as one wave."""
        return p.angle if p.angle is not None else integrated(p.speed, p.origin or 0.0)

"""A motion given in time."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Waveform
from fairlead.component.values import Wave


class MotionSource(Component):
    """Moves its flange as prescribed, whatever force that takes.

    Give either `velocity` (the position follows by integration from `origin`) or `position`.
    """

    flange = Translational("the driven point")
    velocity = Waveform("m/s", "Velocity in time.", default=None)
    position = Waveform("m", "Position in time.", default=None)
    origin = Parameter(
        "m", "Position at t = 0 when the velocity is given; else where the driven body starts.", default=None
    )
    motion = Waveform("m", "Position in time, made from the above.", default=None)
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

    def prescribes():
        """Names of the outputs that are the position, velocity and acceleration of the flange."""
        return {"flange": ("x", "v", "a")}

    def check(p):
        """Exactly one of the two ways."""
        if (p.velocity is None) == (p.position is None):
            yield "", "give either velocity or position", "A velocity is integrated from `origin`."
        elif p.velocity is not None and p.velocity.sine.amplitude != 0:
            yield "velocity", "a sine cannot be given as a velocity", "Give it as a position."

    def starts_at(p, x):
        """Where the driven body starts, when only a velocity is given."""
        if p.position is None and p.origin is None:
            p.motion.polynomial.rows[:, 3] += x - p.motion(0.0)

    def prepare(given):
        """The position as one wave."""
        motion = given["position"]
        if given["velocity"] is not None and given["position"] is None:
            path = given["velocity"].polynomial.integral(0.0)
            path.rows[:, 3] += given["origin"] or 0.0
            motion = Wave(path)
        return {**given, "motion": motion}

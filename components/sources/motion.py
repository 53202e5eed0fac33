"""A motion given in time."""

import itertools
import math

from fairlead.component import Component, Law, Output, Parameter, Translational, Waveform, derived_wave
from fairlead.component.piecewise import Sine
from fairlead.component.values import Wave

LEAST_JUMP = 1e-9  # m, or of the position; less is rounding of the pieces


def jumps(path):
    """(place, height) of every jump of a piecewise polynomial."""
    for before, row in itertools.pairwise(path.rows):
        left, right = (sum(c * (row[0] - piece[2]) ** k for k, c in enumerate(piece[3:])) for piece in (before, row))
        if abs(right - left) > LEAST_JUMP * max(1.0, abs(left), abs(right)):
            yield float(row[0]), float(right - left)


class MotionSource(Component):
    """Moves its flange as prescribed, whatever force that takes.

    Give either `velocity` (the position follows by integration from `origin`) or `position`.
    """

    flange = Translational("the driven point")
    velocity = Waveform("m/s", "Velocity in time.", default=None)
    position = Waveform("m", "Position in time.", default=None)
    origin = Parameter(
        "m", "Position at t = 0 when the velocity is given; else where the driven body starts.", default=None,
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
        for at, jump in jumps(p.position.polynomial) if p.position is not None else ():
            what = f"the position jumps by {jump:.3g} m at t = {at:g} s, which takes an infinite force"
            yield "position", what, "Give a ramp, or a velocity, which is integrated."

    def starts_at(p, x):
        """Where the driven body starts, when only a velocity is given."""
        if p.position is None and p.origin is None:
            p.motion.polynomial.rows[:, 3] += x - p.motion(0.0)

    @derived_wave
    def motion(p):
        """The position as one wave."""
        if p.position is not None:
            return p.position
        path, sine = p.velocity.polynomial.integral(0.0), p.velocity.sine
        swing = Sine()
        if sine.amplitude != 0:
            swing = Sine(sine.amplitude / sine.omega, sine.omega, sine.phase - math.pi / 2)
        path.rows[:, 3] += (p.origin or 0.0) - swing.amplitude * math.sin(swing.phase)
        return Wave(path, swing)

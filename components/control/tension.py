"""Tension control of a winch: as a trim of its speed, or by its torque."""

from fairlead.component import Component, Discrete, Input, Law, Output, Parameter, clip, sampled, tanh


class TensionTrim(Component):
    """Outer loop about a speed loop: reference = line speed + trim,  trim = clip(K_p e + I, -most, most).

    e = tension - wanted: a line that is too tight makes the winch pay out faster (pay-out is positive). Sampled; the
    tension is that of one sample ago, and the integral stops gathering beyond the limit (back-calculation).

    Source: docs/physics.md, 5.7. Limits: the tension is not filtered; put a SignalLag before it.
    """

    keeps = "wanted"
    line_speed = Input("m/s", "Speed of the line, positive when paid out.", signed=True)
    tension = Input("N", "Tension at the winch.")
    wanted = Parameter("N", "Tension to be kept.", least=0)
    gain = Parameter("m/s/N", "K_p, speed per tension.", above=0)
    integral_time = Parameter("s", "T_i.", above=0)
    most = Parameter("m/s", "Largest trim.", above=0)
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    seen = Discrete("N", "Tension one sample ago.", start="wanted")
    summed = Discrete("m/s", "I.")
    held = Discrete("m/s", "Reference.")
    reference = Output("m/s", "Speed that the winch is to have.")
    integral = Output("m/s", "I, which the controller has gathered.")

    def law(p, held, summed):
        """Held between samples."""
        return Law(reference=held, integral=summed)

    @sampled(every="period")
    def sample(p, line_speed, tension, seen, summed):
        """PI on the tension, added to the speed."""
        error = seen - p.wanted
        asked = p.gain * error + summed
        trim = clip(asked, -p.most, p.most)
        gathered = p.gain / p.integral_time * error + 2 * (trim - asked) / p.integral_time
        return Law(seen=tension, summed=summed + p.period * gathered, held=line_speed + trim)


class TensionTorque(Component):
    """Torque mode: the shaft holds the line back with wanted * radius, helped over its own friction.

    torque = -wanted * radius + friction * tanh(speed/slow),  pay-out positive; sampled, held in between.

    Source: docs/physics.md, 4.4 and 5.7. Limits: the inertia of the drum is not compensated.
    """

    keeps = "wanted"
    radius = Input("m", "Radius at which the line leaves the drum.", default="drum_radius")
    speed = Input("rad/s", "Speed of the shaft, positive when it pays out.", signed=True)
    wanted = Parameter("N", "Tension to be kept.", least=0)
    drum_radius = Parameter("m", "Radius, when the input `radius` is not connected.", default=None, above=0)
    friction = Parameter("N*m", "Friction of drum and drive that the torque overcomes.", default=0.0, least=0)
    slow = Parameter("rad/s", "Speed below which friction is not helped over in full.", default=0.05, above=0)
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    held = Discrete("N*m", "Torque.")
    torque = Output("N*m", "Torque that the drive is to give.")

    def law(p, held):
        """Held between samples."""
        return Law(torque=held)

    @sampled(every="period")
    def sample(p, radius, speed):
        """Feed-forward only: the tension itself is not measured."""
        return Law(held=p.friction * tanh(speed / p.slow) - p.wanted * radius)

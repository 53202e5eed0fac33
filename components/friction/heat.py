"""Temperature of rubbing surfaces: given in time, or from the power that friction dissipates."""

from fairlead.component import Component, Effect, Input, Law, Output, Parameter, State, Waveform

THERMAL = {
    "capacity": Parameter("J/K", "Heat capacity of what is warmed.", above=0),
    "loss": Parameter("W/K", "Heat lost to the surroundings per kelvin above them.", default=0.0, least=0),
    "share": Parameter("1", "Part of the friction power that goes into it.", default=1.0, least=0, most=1),
    "ambient": Parameter("K", "Temperature of the surroundings, and at the start.", default=293.15, above=0),
}


class AmbientTemperature(Component):
    """The limit of `FrictionHeat` for a very large heat capacity: always at the temperature of the surroundings."""

    ambient = THERMAL["ambient"]
    friction = Input("N", "Friction of the contact; not read.", default=0.0)
    slip = Input("m/s", "Slip of the contact; not read.", default=0.0)
    temperature = Output("K", "Temperature.")

    def law(p):
        """The surroundings."""
        return Law(temperature=p.ambient)


class FrictionHeat(Component):
    """A body warmed by friction:  capacity dTheta/dt = share T v - loss (Theta - ambient).

    Connect a contact's `friction` and `slip` to it and its `temperature` back to the contact, whose curve has a
    `softening`. The heat is that of all friction work; what bent bristles store in between counts as well.

    Source: docs/physics.md, 1.2. Limits: one temperature for the whole body; heat that goes on from there needs thermal
    ports, see FrictionLoss.
    """

    capacity, loss, share, ambient = THERMAL.values()
    temperature_dependence = Effect("Warming; off: the temperature of the surroundings.", off=AmbientTemperature)
    friction = Input("N", "Friction of the contact.", default=0.0)
    slip = Input("m/s", "Slip of the contact.", default=0.0)
    theta = State("K", "Temperature.", start="ambient", nominal=300.0)
    temperature = Output("K", "Temperature.")

    def law(p, friction, slip, theta):
        """What comes in by friction less what is lost."""
        rate = (p.share * friction * slip - p.loss * (theta - p.ambient)) / p.capacity
        return Law(theta=rate, temperature=theta)


class TemperatureSource(Component):
    """A given temperature that may vary with time, as a signal.

    temperature = profile(t).  Source: as given. Limits: nothing cools or warms it; a TemperatureSensor reads a body.
    """

    profile = Waveform("K", "Temperature in time.")
    temperature = Output("K", "The temperature.")

    def law(p, t):
        """The profile."""
        return Law(temperature=p.profile(t))

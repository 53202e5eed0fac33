"""A hydraulic motor, or a pump: oil displaced turn by turn."""

from fairlead.component import Component, Effect, Hydraulic, Law, Output, Parameter, Rotational, sqrt

ROUNDED = 1e5  # Pa; the size of a pressure difference is rounded this far about zero


class HydraulicMotor(Component):
    """Oil that flows from a to b turns the shaft:  flow = displacement * speed,  torque = displacement * (p_a - p_b).

    Leakage is laminar: across, C_i (p_a - p_b), and out of either side into the housing, C_e p, where it is lost.
    Turned from outside it is a pump. Volumes, inertia and friction are components of their own; `loaded` is the
    torque of the oil without its sign, for friction that grows with it.

    Source: docs/physics.md, 5.3; Merritt 1967. Limits: no ripple from the pistons; the displacement is constant (a
    VariablePump has one that moves).
    """

    a = Hydraulic("high pressure when it drives forward")
    b = Hydraulic("the other side")
    shaft = Rotational("the shaft")
    swept = "displacement"
    displacement = Parameter("m^3/rad", "Oil per angle; 125 cm^3/rev is a size.", above=0)
    leakage = Effect("Oil leaks across and out.")
    internal_leakage = Parameter("m^3/s/Pa", "C_i, leakage from side to side.", default=0.0, least=0)
    external_leakage = Parameter("m^3/s/Pa", "C_e, leakage of each side to the housing.", default=0.0, least=0)
    torque = Output("N*m", "Torque of the oil on the shaft.")
    load_pressure = Output("Pa", "Pressure of a over b.")
    pressure_a = Output("Pa", "Pressure at a.")
    pressure_b = Output("Pa", "Pressure at b.")
    loss = Output("W", "What leakage makes heat; it may feed a HeatActuator.")
    loaded = Output("N*m", "The torque without its sign, to within 1 bar.")

    def law(p, a, b, shaft):
        """What drives the shaft brakes the oil."""
        difference = a.pressure - b.pressure
        torque, through = p.displacement * difference, p.displacement * shaft.speed
        into, out, lost = through, through, 0
        if p.leakage == "on":
            across = p.internal_leakage * difference
            into += across + p.external_leakage * a.pressure
            out += across - p.external_leakage * b.pressure
            lost = across * difference + p.external_leakage * (a.pressure**2 + b.pressure**2)
        size = p.displacement * (sqrt(difference**2 + ROUNDED**2) - ROUNDED)
        return Law(a=into, b=-out, shaft=-torque, torque=torque, load_pressure=difference, pressure_a=a.pressure,
                   pressure_b=b.pressure, loaded=size, loss=lost, dissipated=lost)  # fmt: skip

"""Heat: bodies that are warmed, what leads it between them, and where it comes from.

A thermal port has a temperature and takes in heat [W]. Heat flow is a power by itself, so thermal parts have no line in
the ledger of energy: what a contact or a resistor dissipates is told there once, and led on from here.
"""

from fairlead.component import Component, Input, Law, Output, Parameter, Thermal

ROOM = 293.15  # K
FAST = 1.0  # m/s, of what a fluid adds by its speed
SLOW = 1e-3  # of that; where the root of a speed is rounded


class HeatCapacity(Component):
    """A body of one temperature:  capacity dT/dt = heat that flows in. Capacity is mass times specific heat.

    Source: calorimetry; a lumped body, e.g. Incropera and DeWitt, Fundamentals of Heat and Mass Transfer. Limits: one
    temperature, which is fair while conductance inside is ten times that outside (Biot number below 0.1).
    """

    port = Thermal("the body")
    capacity = Parameter("J/K", "Heat per kelvin.", above=0)
    start_temperature = Parameter("K", "Temperature at the start.", default=ROOM, above=0, physics=False)
    temperature = Output("K", "Temperature.")

    def law(p, port):
        """Its capacity is an entry of the mass matrix, see `inertia`."""
        return Law(port=0, temperature=port.temperature)

    def inertia(p):
        """Capacity at the port [J/K]."""
        return {"port": p.capacity}

    def start(p):
        """Temperature at the start."""
        return {"port": p.start_temperature}


class FixedTemperature(Component):
    """Keeps its port at a temperature, at any heat flow: the air, the sea.

    port.temperature = temperature,  and `heat` is what goes out.  Source: definition. Limits: it does not warm,
    whatever it takes.
    """

    port = Thermal("the surroundings")
    temperature = Parameter("K", "Temperature.", default=ROOM, above=0)
    heat = Output("W", "Heat given.")

    def law(p, port):
        """The heat is known when all others are."""
        return Law(port=0, heat=port.heat)

    def prescribes():
        """The temperature does not change."""
        return {"port": None}

    def start(p):
        """The temperature."""
        return {"port": p.temperature}


class HeatConductor(Component):
    """heat = conductance (T_a - T_b),  from a to b. Of a wall the conductance is conductivity area/thickness.

    Source: Fourier's law. Limits: no heat is stored; the conductance does not depend on temperature.
    """

    a, b = Thermal("one side"), Thermal("the other side")
    conductance = Parameter("W/K", "Heat per kelvin of difference.", above=0)
    heat = Output("W", "Heat from a to b.")

    def law(p, a, b):
        """In proportion to the difference."""
        heat = p.conductance * (a.temperature - b.temperature)
        return Law(a=heat, b=-heat, heat=heat)


class HeatConvection(Component):
    """heat = coefficient area (T_a - T_b),  from a surface a to a fluid b, whose speed may be a signal.

        coefficient = still + moved sqrt(speed)

    Along a plate with laminar flow the coefficient grows with the root of the speed. The root is rounded at rest, so
    that it is smooth there. With s = v^6 + w^6 and w = 1 mm/s it is  s^(1/12) (1 - w^6/s).  This is 1.4 % low at 2
    mm/s and 1e-6 at 1 cm/s.

    Source: Pohlhausen 1921; VDI Heat Atlas, G4.

    Limits: no natural convection that grows with the difference; `still` has it at one difference.
    """

    a, b = Thermal("the surface"), Thermal("the fluid")
    area = Parameter("m^2", "Area of the surface.", above=0)
    still = Parameter("W/K/m^2", "Coefficient at rest; air has 5 to 10.", above=0)
    moved = Parameter("W/K/m^2", "What 1 m/s adds to it.", default=0.0, least=0)
    speed = Input("m/s", "Speed of the fluid along the surface.", 0.0, signed=True)
    heat = Output("W", "Heat from a to b.")

    def law(p, a, b, speed):
        """In proportion to the difference."""
        whole = (speed / FAST) ** 6 + SLOW**6
        root = whole ** (1 / 12) * (1 - SLOW**6 / whole)
        heat = (p.still + p.moved * root) * p.area * (a.temperature - b.temperature)
        return Law(a=heat, b=-heat, heat=heat)


class HeatActuator(Component):
    """Gives its port the heat of a signal: the `power` of a Resistor, the `loss` of a motor, a formula.

    port.heat = -heat, as it goes out there.  Source: definition. Limits: it warms, however hot the body is; a heat
    below zero cools.
    """

    port = Thermal("what is warmed")
    heat = Input("W", "Heat.", signed=True)
    given = Output("W", "The same.")

    def law(p, port, heat):
        """As told."""
        return Law(port=-heat, given=heat)


class FrictionLoss(Component):
    """Gives the heat of a contact to two bodies:  heat = friction slip,  `share` of it to b, the rest to a.

    Join `friction` and `slip` with those of a Contact, a Clutch, a Brake or a Bearing, or `torque` and `speed` with the
    torque and the slip of a ShaftFriction. The shares of two halves in contact are as their effusivities,
    sqrt(conductivity density specific heat). Source: Blok 1937; Carslaw and Jaeger 1959, Conduction of Heat in Solids,
    section 2.9.

    Limits: heat goes in at once and evenly; a flash temperature at the spots in contact is not there.
    """

    a, b = Thermal("the surface"), Thermal("the body")
    friction = Input("N", "Friction of a contact.", 0.0, signed=True)
    slip = Input("m/s", "Its slip.", 0.0, signed=True)
    torque = Input("N*m", "Friction torque of what turns.", 0.0, signed=True)
    speed = Input("rad/s", "Its slip.", 0.0, signed=True)
    share = Parameter("1", "Part of the heat that goes to b.", default=0.5, least=0, most=1)
    heat = Output("W", "Heat of both.")

    def law(p, friction, slip, torque, speed):
        """Friction times slip."""
        heat = friction * slip + torque * speed
        return Law(a=-(1 - p.share) * heat, b=-p.share * heat, heat=heat)


class OrificeLoss(Component):
    """Gives the loss of a flow to a body as heat:  heat = flow drop, such as those of an Orifice.

    Valves, leaks and motors tell their `loss`, which a HeatActuator takes.

    Source: the first law for a throttle. Limits: all of the loss stays in one body; the oil carries nothing away.
    """

    port = Thermal("what is warmed")
    flow = Input("m^3/s", "Flow.", signed=True)
    drop = Input("Pa", "Pressure drop.", signed=True)
    heat = Output("W", "The heat.")

    def law(p, port, flow, drop):
        """Flow times drop."""
        return Law(port=-flow * drop, heat=flow * drop)


class TemperatureSensor(Component):
    """Reads the temperature of a port and takes no heat; it may feed the `temperature` of a Contact.

    temperature = port.temperature.  Source: definition. Limits: exact and without lag; see SignalLag and SampledSensor.
    """

    port = Thermal("the body observed")
    temperature = Output("K", "Temperature.")

    def law(p, port):
        """Nothing is taken in."""
        return Law(port=0, temperature=port.temperature)

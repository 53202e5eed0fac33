"""A four-way servo valve."""

from fairlead.components.hydraulics.spool import Spool
from fairlead.components.hydraulics.valve_lands import ValveLands

from fairlead.component import Composite, Effect, Expansion, Hydraulic, Input, Output, Parameter

VALVE = {
    "rated_flow": Parameter("m^3/s", "Flow through one land, fully open, at the rated drop.", above=0),
    "rated_drop": Parameter("Pa", "Pressure drop over one land at which it is told.", default=35e5, above=0),
    "natural_frequency": Parameter("Hz", "Undamped frequency of the spool.", default=60.0, above=0),
    "damping": Parameter("1", "Damping of the spool relative to critical.", default=0.7, above=0),
    "rate_limit": Parameter("1/s", "Largest speed of the spool, in strokes.", default=None, above=0),
    "overlap": Parameter("1", "Share of the stroke without flow.", default=None, above=0, most=0.3),
    "leakage_conductance": Parameter("m^3/s/Pa", "Leakage of one land.", default=0.0, least=0),
    "critical_pressure": Parameter("Pa", "Drop below which flow is laminar.", default=1e5, above=0),
}
OF_SPOOL = ("natural_frequency", "damping", "rate_limit")


def spool_of(scene, valve, valve_dynamics):
    """The spool of a valve with these parameters."""
    return scene.make(Spool, valve_dynamics=valve_dynamics, **{name: getattr(valve, name) for name in OF_SPOOL})


def lands_of(scene, valve, leakage):
    """The lands of a valve with these parameters."""
    names = [name for name in VALVE if name not in OF_SPOOL]
    return scene.make(ValveLands, leakage=leakage, **{name: getattr(valve, name) for name in names})


class ServoValve(Composite):
    """Spool and lands: supply, tank, and the lines a and b to what is driven. See `Spool` and `ValveLands`.

    supply -> a and b -> tank while the opening is positive:  flow = |opening| rated_flow sqrt(drop/rated_drop).

    Source: docs/physics.md, 5.2; Merritt 1967. Limits: the command moves the spool, with no torque motor and no forces
    of the flow on it.
    """

    supply, tank = Hydraulic("pressure line"), Hydraulic("return line")
    a, b = Hydraulic("line to the load"), Hydraulic("line from the load")
    command = Input("1", "Opening asked for, -1 to 1; positive joins supply with a.")
    opening = Output("1", "Opening.")
    loss = Output("W", "What becomes heat in all lands; it may feed a HeatActuator.")
    valve_dynamics = Effect("The spool lags behind its command and hits stops.")
    leakage = Effect("Closed lands leak.")
    rated_flow = VALVE["rated_flow"]
    rated_drop = VALVE["rated_drop"]
    natural_frequency = VALVE["natural_frequency"]
    damping = VALVE["damping"]
    rate_limit = VALVE["rate_limit"]
    overlap = VALVE["overlap"]
    leakage_conductance = VALVE["leakage_conductance"]
    critical_pressure = VALVE["critical_pressure"]

    def expand(p, scene):
        """The spool moves the lands."""
        children = {"spool": spool_of(scene, p, p.valve_dynamics), "lands": lands_of(scene, p, p.leakage)}
        ports = {name: f"lands.{name}" for name in ("supply", "tank", "a", "b")}
        return Expansion(children, [("spool.opening", "lands.opening")], ports,
                         {"command": "spool.command", "opening": "spool.opening", "loss": "lands.loss"})  # fmt: skip

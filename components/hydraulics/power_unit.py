"""A hydraulic power unit: pump, accumulator, relief valve and pressure line."""

from fairlead.components.hydraulics.accumulator import Accumulator
from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.pressure_source import PressureSource, Tank
from fairlead.components.hydraulics.pump import PressurePump
from fairlead.components.hydraulics.relief_valve import ReliefValve
from fairlead.components.hydraulics.volume import Volume

from fairlead.component import Block, Composite, Effect, Expansion, Hydraulic, Output, Parameter, Part

PUMP = {
    "most": Parameter("m^3/s", "Full flow.", above=0),
    "band": Parameter("Pa", "Range below the pressure of the unit in which it regulates.", default=10e5, above=0),
    "lag": Parameter("s", "Time constant of the swash plate.", default=0.05, above=0),
}
ACCUMULATOR = {
    "volume": Parameter("m^3", "Volume of the gas at its precharge.", above=0),
    "precharge": Parameter("Pa", "Pressure of the gas without oil.", above=0),
    "exponent": Parameter("1", "Polytropic exponent of the gas.", default=1.2, above=1, most=2),
    "neck": Parameter("m", "Diameter of the neck.", default=0.03, above=0),
}
RELIEF = {
    "setting": Parameter("Pa", "Difference to the tank at which it opens.", above=0),
    "slope": Parameter("m^3/s/Pa", "Flow per pressure above the setting.", default=1e-9, above=0),
    "lag": Parameter("s", "Time constant of the poppet.", default=0.01, above=0),
}


class PowerUnit(Composite):
    """Supplies oil at a pressure and takes it back.

    supply_dynamics on     pressure-compensated pump, accumulator, relief valve and a line:
                           (V_line/bulk_modulus + V_gas/(n p)) dp/dt = Q_pump - Q_used - Q_relief
    supply_dynamics off    the pressure is constant

    Source: docs/physics.md, 5.5. Limits: those of the PressurePump, the Accumulator and the ReliefValve that it is made
    of.
    """

    supply, tank = Hydraulic("pressure line"), Hydraulic("return line")
    pressure = Parameter("Pa", "Pressure without flow, which is also that of the start.", above=0)
    tank_pressure = Parameter("Pa", "Pressure of the return line.", default=1e5, least=0)
    line_volume = Parameter("m^3", "Volume of the pressure line.", default=1e-3, above=0)
    pump = Block(PUMP, "Needed with supply_dynamics.", default=None)
    accumulator = Block(ACCUMULATOR, "None when not given.", default=None)
    relief = Block(RELIEF, "None when not given.", default=None)
    fluid = Part(Fluid, "What is pumped.", default="oil")
    supply_dynamics = Effect("Pump, accumulator and relief valve make the pressure vary.", "off")
    level = Output("Pa", "Pressure of the supply.", name="pressure")
    power = Output("W", "Hydraulic power given.")
    void = Output("m^3", "Volume without oil in the pressure line; none is told without supply_dynamics.")

    def check(p):
        """A pump, and pressures in order."""
        if p.supply_dynamics == "on" and p.pump is None:
            yield "pump", "supply_dynamics needs a pump", "Give pump: {most: 60 l/min}, or switch supply_dynamics off."
        if p.relief is not None and p.relief.setting <= p.pressure - p.tank_pressure:
            what = f"it opens at {p.relief.setting:g} Pa above the tank, below the {p.pressure:g} Pa of the unit"
            yield "relief.setting", what, "Raise it above the pressure of the unit."
        if p.accumulator is not None and p.accumulator.precharge >= p.pressure:
            what = f"a precharge of {p.accumulator.precharge:g} Pa is not below the {p.pressure:g} Pa of the unit"
            yield "accumulator.precharge", what, "Lower it, to about 0.9 of the lowest pressure in use."

    def expand(p, scene):
        """A constant pressure, or what makes it."""
        children = {"reservoir": scene.make(Tank, pressure=p.tank_pressure)}
        ports = {"tank": "reservoir.port"}
        if p.supply_dynamics == "off":
            children["source"] = scene.make(PressureSource, pressure=p.pressure)
            shown = {"pressure": "source.pressure", "power": "source.power"}
            return Expansion(children, [], {**ports, "supply": "source.port"}, shown)
        pump = {name: getattr(p.pump, name) for name in PUMP}
        children["pump"] = scene.make(PressurePump, cut_off=p.pressure, **pump)
        children["line"] = scene.make(Volume, volume=p.line_volume, pressure=p.pressure, fluid=p.fluid)
        line, back = ["line.port", "pump.outlet"], ["reservoir.port", "pump.inlet"]
        if p.accumulator is not None:
            gas = {name: getattr(p.accumulator, name) for name in ACCUMULATOR}
            children["accumulator"] = scene.make(Accumulator, pressure=p.pressure, fluid=p.fluid, **gas)
            line.append("accumulator.port")
        if p.relief is not None:
            children["relief"] = scene.make(ReliefValve, **{name: getattr(p.relief, name) for name in RELIEF})
            line.append("relief.a")
            back.append("relief.b")
        return Expansion(children, [tuple(line), tuple(back)], {**ports, "supply": "line.port"},
                         {"pressure": "line.pressure", "power": "pump.power", "void": "line.void"})  # fmt: skip

"""A hydraulic line: resistance, inertia and compliance of the oil in a pipe or hose."""

from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.volume import Volume

from fairlead.component import (
    Component,
    Composite,
    Count,
    Effect,
    Expansion,
    Hydraulic,
    Law,
    Output,
    Parameter,
    Part,
    State,
    derived,
    pi,
)  # fmt: skip


class Bore(Component, abstract=True):
    """Half-model of a straight bore."""

    a, b = Hydraulic("one end"), Hydraulic("the other end")
    length = Parameter("m", "Length.", above=0)
    diameter = Parameter("m", "Inner diameter.", above=0)
    fluid = Part(Fluid, "What flows.", default="oil")
    flow = Output("m^3/s", "Flow from a to b.")

    @derived
    def resistance(p):
        """Pressure drop per laminar flow, 128 rho nu L/(pi d^4) [Pa s/m^3]."""
        return 128 * p.fluid.density * p.fluid.viscosity * p.length / (pi * p.diameter**4)

    @derived
    def inertance(p):
        """Pressure drop per rate of flow, rho L/A [Pa s^2/m^3]."""
        return 4 * p.fluid.density * p.length / (pi * p.diameter**2)


class LaminarBore(Bore):
    """Laminar resistance alone:  p_a - p_b = R Q,  R = 128 rho nu L/(pi d^4)  (Hagen and Poiseuille)."""

    def law(p, a, b):
        """The flow follows at once."""
        drop = a.pressure - b.pressure
        flow = drop / p.resistance
        return Law(a=flow, b=-flow, flow=flow, dissipated=flow * drop)


class OilColumn(Bore):
    """A column of oil with inertia:  rho L/A dQ/dt = p_a - p_b - R Q.  Laminar (Reynolds number below 2300)."""

    fluid_inertia = Effect("The oil in the line has inertia.", off=LaminarBore)
    moving = State("m^3/s", "Flow.", nominal=1e-4)

    def law(p, a, b, moving):
        """The flow is a state; its energy is that of the moving oil."""
        rate = (a.pressure - b.pressure - p.resistance * moving) / p.inertance
        return Law(a=moving, b=-moving, moving=rate, flow=moving, stored=p.inertance * moving**2 / 2,
                   dissipated=p.resistance * moving**2)  # fmt: skip


class HydraulicLine(Composite):
    """A pipe or hose in equal sections: half a volume, a column of oil, half a volume.

    Waves travel with sqrt(bulk_modulus/rho), which n sections carry up to n/3 waves along the line. The compliance
    of the walls goes into the bulk modulus of the fluid. Without compressibility it is one column. Where a void opens
    is told by section: `volume[0].void` at a, `volume[n].void` at b.
    """

    a, b = Hydraulic("one end"), Hydraulic("the other end")
    length = Parameter("m", "Length.", above=0)
    diameter = Parameter("m", "Inner diameter.", above=0)
    sections = Count("Number of sections.", default=1, most=500)
    pressure = Parameter("Pa", "Pressure at the start; 1 bar when nothing on its nodes says.", default=None, above=0,
                         physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    fluid_inertia = Effect("The oil in the line has inertia.")
    compressibility = Effect("The oil in the line is compressed.")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")

    def expand(p, scene):
        """Columns and, between and beside them, volumes."""
        n = p.sections if p.compressibility == "on" else 1  # oil that is not compressed moves as one
        size = {"length": p.length / n, "diameter": p.diameter, "fluid": p.fluid}
        children = {f"column[{i}]": scene.make(OilColumn, fluid_inertia=p.fluid_inertia, **size) for i in range(n)}
        joins = [(f"column[{i}].b", f"column[{i + 1}].a") for i in range(n - 1)]
        if p.compressibility == "on":
            share = pi * p.diameter**2 / 4 * p.length / n
            for i in range(n + 1):
                children[f"volume[{i}]"] = scene.make(
                    Volume, volume=share / 2 if i in (0, n) else share, pressure=p.pressure, fluid=p.fluid,
                    cavitation=p.cavitation,
                )  # fmt: skip
                joins.append((f"volume[{i}].port", f"column[{i}].a" if i < n else f"column[{n - 1}].b"))
        return Expansion(children, joins, {"a": "column[0].a", "b": f"column[{n - 1}].b"})

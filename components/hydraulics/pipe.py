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
    """A column of oil with inertia:  rho L/A dq/dt = p_a - p_b - R Q.  Laminar (Reynolds number below 2300).

    Without smoothing Q = q. With it some oil passes beside the inertia, Q = q + smoothing (p_a - p_b - R Q)/Z, where
    Z = sqrt(rho bulk_modulus)/A; in steady flow it is none.
    """

    fluid_inertia = Effect("The oil in the line has inertia.", off=LaminarBore)
    smoothing = Parameter("1", "Numerical damping of the shortest waves.", default=None, least=0, most=1)
    moving = State("m^3/s", "Flow of the oil with inertia.", nominal=1e-4)

    @derived
    def beside(p):
        """Flow past the inertia per pressure [m^3/s/Pa]."""
        area = pi * p.diameter**2 / 4
        return (p.smoothing or 0.0) * area / (p.fluid.density * p.fluid.bulk_modulus) ** 0.5

    def law(p, a, b, moving):
        """The flow is a state; its energy is that of the moving oil."""
        drop = a.pressure - b.pressure
        flow = moving if p.smoothing is None else (moving + p.beside * drop) / (1 + p.beside * p.resistance)
        speeds_up = drop - p.resistance * flow
        lost = 0 if p.smoothing is None else p.beside * speeds_up**2
        return Law(a=flow, b=-flow, moving=speeds_up / p.inertance, flow=flow, stored=p.inertance * moving**2 / 2,
                   dissipated=p.resistance * flow**2 + lost)  # fmt: skip


class HydraulicLine(Composite):
    """A pipe or hose in equal sections: half a volume, a column of oil, half a volume.

    Waves travel with sqrt(bulk_modulus/rho), which n sections carry up to n/3 waves along the line. The compliance
    of the walls goes into the bulk modulus of the fluid. Without compressibility it is one column. Where a void opens
    is told by section: `volume[0].void` at a, `volume[n].void` at b.

    A front that is shorter than a section, as of a valve that shuts at once, rings in the sections: waves of their
    length run slower. However many there are, the pressure at the valve comes out too high by a share of the step
    rho c dv (Joukowsky) that depends on the time in which the valve shuts, in times length/(n c) of a section:

        at once 47 %,  1 section 39 %,  2 sections 19 %,  3 and more below 9 %

    `smoothing` is numerical damping in proportion to frequency, without more unknowns. For a valve that shuts at once
    it leaves

        smoothing              0       0.1     0.3     0.5     0.7     1
        too high by            47 %    36 %    20 %    9 %     3 %     0 %

    and damps a wave with the damping ratio smoothing sin(pi/k), if it is k sections long: that of the first mode of a
    line with an open and a closed end is smoothing pi/(4 n). Take 0.7 for the height of fronts, 0 for the damping of
    modes. Steady flow does not depend on it.

    Source: docs/physics.md, 5.1 (volumes); Joukowsky 1898; laminar loss of Hagen and Poiseuille. Limits: friction is
    that of steady laminar flow, whatever the frequency.
    """

    a, b = Hydraulic("one end"), Hydraulic("the other end")
    length = Parameter("m", "Length.", above=0)
    diameter = Parameter("m", "Inner diameter.", above=0)
    sections = Count("Number of sections.", default=1, most=500)
    pressure = Parameter("Pa", "Pressure at the start; 1 bar when nothing on its nodes says.", default=None, above=0,
                         physics=False)  # fmt: skip
    smoothing = Parameter("1", "Numerical damping of the shortest waves; none when not given.", default=None, least=0,
                          most=1)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    fluid_inertia = Effect("The oil in the line has inertia.")
    compressibility = Effect("The oil in the line is compressed.")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")

    def doubts(p):
        """Sections are for waves, and fronts ring in them."""
        if p.smoothing is None and p.sections > 1 and p.fluid_inertia == p.compressibility == "on":
            time = p.length / p.sections * (p.fluid.density / p.fluid.bulk_modulus) ** 0.5
            what = f"fronts shorter than {3 * time:.2g} s, as of a valve that shuts faster, come out too high, by up "
            what += "to 47 % of their step in pressure, whatever the number of sections"
            yield "sections", what, "Write smoothing: 0.7, which leaves 3 %, or smoothing: 0 where there are none."

    def expand(p, scene):
        """Columns and, between and beside them, volumes."""
        n = p.sections if p.compressibility == "on" else 1  # oil that is not compressed moves as one
        size = {"length": p.length / n, "diameter": p.diameter, "fluid": p.fluid}
        if p.compressibility == "on" and p.smoothing:
            size["smoothing"] = p.smoothing
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

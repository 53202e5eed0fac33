"""The pressure fluid, and how it is throttled. Pressures are absolute."""

from fairlead.component import Parameter, sqrt
from fairlead.component.base import Family


class Fluid(Family, abstract=True):
    """A pressure fluid, written in a netlist as `fluid: {density: 860 kg/m^3, bulk_modulus: 1.2 GPa}`."""

    key = "fluid"
    default_word = "oil"


class Oil(Fluid):
    """Mineral oil of constant density, bulk modulus and viscosity. The bulk modulus is that of oil and walls."""

    density = Parameter("kg/m^3", "Density.", default=870.0, above=0)
    bulk_modulus = Parameter("Pa", "Pressure per relative change of volume.", default=1e9, above=0)
    viscosity = Parameter("m^2/s", "Kinematic viscosity.", default=40e-6, above=0)

    def conductance(p, coefficient, area):
        """Flow per root of pressure drop of a sharp edge, C_d A sqrt(2/rho)."""
        return coefficient * area * sqrt(2 / p.density)


def throttled(conductance, drop, critical):
    """Flow through a sharp edge: conductance * sqrt(drop), laminar where the drop is below `critical`.

    Q = K drop/(drop^2 + critical^2)^(1/4);  0.841 of the square root at drop = critical, 0.9975 at ten times that.
    """
    return conductance * drop / sqrt(sqrt(drop**2 + critical**2))


def drop_of(conductance, flow, critical):
    """The pressure drop at which `throttled` gives `flow`, in closed form; odd in the flow.

    With q = (Q/K)^2 the square of the drop solves  z^2 - q^2 z - q^2 critical^2 = 0.
    """
    q = (flow / conductance) ** 2
    return flow / conductance * sqrt((q + sqrt(q**2 + 4 * critical**2)) / 2)

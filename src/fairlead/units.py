"""The units that fairlead knows by itself, and what they measure: a table.

A dimension has seven exponents: m, kg, s, A, K and two that SI lacks but an engineer does not:

- `rad`: angles are a kind of their own, so Hz never becomes rad/s nor a stiffness in N*m/rad one in N*m;
- `energy`: J carries it and N*m does not, so a torque refuses J. The other way is harmless (a work
  written as N*m), and electrical units are exempt, since there nobody confuses the two.
"""

from __future__ import annotations

import math
from fractions import Fraction

Dimension = tuple[Fraction | int, ...]
BASES = ("m", "kg", "s", "A", "K", "rad", "J")
NONE: Dimension = (0, 0, 0, 0, 0, 0, 0)
RAD, ENERGY = 5, 6

PREFIXES = {"n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1, "h": 1e2,
            "k": 1e3, "M": 1e6, "G": 1e9}  # fmt: skip
# Atom -> (factor to SI, exponents of m kg s A K rad energy). These take a prefix ...
METRIC: dict[str, tuple[float, Dimension]] = {
    "m": (1.0, (1, 0, 0, 0, 0, 0, 0)),
    "g": (1e-3, (0, 1, 0, 0, 0, 0, 0)),
    "s": (1.0, (0, 0, 1, 0, 0, 0, 0)),
    "A": (1.0, (0, 0, 0, 1, 0, 0, 0)),
    "K": (1.0, (0, 0, 0, 0, 1, 0, 0)),
    "rad": (1.0, (0, 0, 0, 0, 0, 1, 0)),
    "Hz": (1.0, (0, 0, -1, 0, 0, 0, 0)),
    "N": (1.0, (1, 1, -2, 0, 0, 0, 0)),
    "Pa": (1.0, (-1, 1, -2, 0, 0, 0, 0)),
    "bar": (1e5, (-1, 1, -2, 0, 0, 0, 0)),
    "J": (1.0, (2, 1, -2, 0, 0, 0, 1)),
    "W": (1.0, (2, 1, -3, 0, 0, 0, 1)),
    "V": (1.0, (2, 1, -3, -1, 0, 0, 1)),
    "ohm": (1.0, (2, 1, -3, -2, 0, 0, 1)),
    "l": (1e-3, (3, 0, 0, 0, 0, 0, 0)),
    "L": (1e-3, (3, 0, 0, 0, 0, 0, 0)),
}
# ... and these do not.
PLAIN: dict[str, tuple[float, Dimension]] = {
    "1": (1.0, NONE),
    "%": (1e-2, NONE),
    "min": (60.0, (0, 0, 1, 0, 0, 0, 0)),
    "h": (3600.0, (0, 0, 1, 0, 0, 0, 0)),
    "t": (1e3, (0, 1, 0, 0, 0, 0, 0)),
    "deg": (math.pi / 180, (0, 0, 0, 0, 0, 1, 0)),
    "°": (math.pi / 180, (0, 0, 0, 0, 0, 1, 0)),
    "rev": (2 * math.pi, (0, 0, 0, 0, 0, 1, 0)),
    "rpm": (2 * math.pi / 60, (0, 0, -1, 0, 0, 1, 0)),
}
# Declared unit -> (what it measures, an example), for messages.
KINDS = {
    "1": ("plain number", "0.35"), "m": ("length", "35 mm"), "m^2": ("area", "12 cm^2"),
    "m^3": ("volume", "2 l"), "s": ("time", "10 ms"), "Hz": ("frequency", "50 Hz"),
    "m/s": ("speed", "20 mm/s"), "m/s^2": ("acceleration", "9.81 m/s^2"), "kg": ("mass", "4.2 kg"),
    "kg/m": ("mass per length", "1.6 kg/m"), "kg/m^3": ("density", "850 kg/m^3"),
    "kg*m^2": ("moment of inertia", "0.2 kg*m^2"), "N": ("force", "12 kN"),
    "N/m": ("stiffness or force per length", "500 kN/m"), "N*s/m": ("damping coefficient", "40 N*s/m"),
    "N/s": ("rate of force", "2 kN/s"), "Pa": ("pressure", "210 bar"), "m^3/s": ("volume flow", "60 l/min"),
    "rad": ("angle", "90 deg"), "rad/s": ("angular speed", "1500 rpm"),
    "rad/s^2": ("angular acceleration", "3 rad/s^2"), "N*m": ("torque", "120 N*m"),
    "N*m/rad": ("rotational stiffness", "2 kN*m/rad"),
    "N*m*s/rad": ("rotational damping coefficient", "3 N*m*s/rad"), "J": ("energy", "2 kJ"),
    "W": ("power", "5.5 kW"), "V": ("voltage", "400 V"), "A": ("current", "12 A"),
    "ohm": ("resistance", "0.3 ohm"), "K": ("temperature", "293.15 K"),
}  # fmt: skip

# Base units of pint -> (factor to SI, place of the exponent).
ROOTS = {"meter": (1.0, 0), "gram": (1e-3, 1), "kilogram": (1.0, 1), "second": (1.0, 2), "ampere": (1.0, 3),
         "kelvin": (1.0, 4), "radian": (1.0, RAD)}  # fmt: skip
# Offered beside the table when a unit is unknown, and spellings that pint would take for something else
# (its Nm is a nautical mile, so a torque typed without the * would pass for a length).
PREFIXED = ("kN", "mm", "cm", "km", "kg", "ms", "kPa", "MPa", "kJ", "kW", "mrad", "kHz")
MISREAD = {"Nm": "N*m", "kNm": "kN*m", "Nmm": "N*mm", "Ns": "N*s", "kn": "kN, or knot", "kmh": "km/h",
           "per": "%"}  # fmt: skip

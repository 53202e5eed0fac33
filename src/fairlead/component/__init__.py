"""All that a component author imports: declarations, laws and the functions to write them with."""

from fairlead.component.base import Component, Composite, Declared, Expansion, Family
from fairlead.component.declare import (
    Block,
    Choice,
    Count,
    Discrete,
    Electrical,
    Hydraulic,
    Input,
    Law,
    Name,
    Output,
    Parameter,
    Part,
    Path,
    Rotational,
    State,
    Stations,
    Summing,
    Table,
    Translational,
    Unknown,
    Waveform,
    Zones,
    derived,
    derived_wave,
    guard,
    hold,
    sampled,
    zone,
)  # fmt: skip
from fairlead.component.functions import atan, cos, exp, log, pi, sin, sqrt, tanh

__all__ = [
    "Block", "Choice", "Component", "Composite", "Count", "Declared", "Discrete", "Electrical", "Expansion", "Family",
    "Hydraulic", "Input", "Law", "Name", "Output", "Parameter", "Part", "Path", "Rotational", "State", "Stations",
    "Summing", "Table", "Translational", "Unknown", "Waveform", "Zones", "atan", "cos", "derived", "derived_wave", "exp", "guard", "hold",
    "log", "pi", "sampled", "sin", "sqrt", "tanh", "zone",
]  # fmt: skip

"""All that a component author imports: declarations, laws and the functions to write them with."""

from fairlead.component.base import Component, Composite, Declared, Expansion, Family
from fairlead.component.controller import Controller
from fairlead.component.declare import (
    Carries,
    Discrete,
    Electrical,
    Hydraulic,
    Input,
    Law,
    Output,
    Path,
    Rotational,
    State,
    Summing,
    Thermal,
    Translational,
    Unknown,
    Zones,
    derived,
    derived_wave,
    guard,
    sampled,
    shared,
    zone,
)  # fmt: skip
from fairlead.component.functions import (
    atan,
    clip,
    cos,
    exceeds,
    exp,
    greatest,
    least,
    log,
    pi,
    sin,
    sqrt,
    tanh,
)  # fmt: skip
from fairlead.component.given import (
    Block,
    Choice,
    Count,
    Effect,
    Entries,
    File,
    Matrix,
    Name,
    Parameter,
    Part,
    Stations,
    Table,
    Text,
    Waveform,
)  # fmt: skip
from fairlead.component.holding import hold, hold_position

__all__ = [
    "Block", "Carries", "Choice", "Component", "Composite", "Controller", "Count", "Declared", "Discrete", "Effect",
    "Electrical", "Entries", "Expansion", "Family", "File", "Hydraulic", "Input", "Law", "Matrix", "Name", "Output",
    "Parameter", "Part", "Path", "Rotational", "State", "Stations", "Summing", "Table", "Text", "Thermal",
    "Translational", "Unknown", "Waveform", "Zones", "atan", "clip", "cos", "derived", "derived_wave", "exceeds", "exp",
    "greatest", "guard", "hold", "hold_position", "least", "log", "pi", "sampled", "shared", "sin", "sqrt", "tanh",
    "zone",
]  # fmt: skip

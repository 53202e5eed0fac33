"""The first stage: a YAML netlist becomes a frozen `Netlist` in which every entry knows its place."""

from fairlead.netlist.files import bundled_models, inside
from fairlead.netlist.load import load, survey
from fairlead.netlist.netlist import EndPoint, Entry, Netlist, Value
from fairlead.netlist.settings import Plot, RecordSettings, RunSettings

__all__ = [
    "EndPoint",
    "Entry",
    "Netlist",
    "Plot",
    "RecordSettings",
    "RunSettings",
    "Value",
    "bundled_models",
    "inside",
    "load",
    "survey",
]

"""A module of a towed array: core with bulkheads inside a hose, an end connector at each end."""

import math

from fairlead.components.friction.curve import Curve
from fairlead.components.line.array_line import ArrayLine
from fairlead.components.line.core_element import Core
from fairlead.components.line.hose_element import Hose
from fairlead.components.line.registration import Registration
from fairlead.components.mechanics.mass import Mass

from fairlead.component import (
    Block,
    Composite,
    Expansion,
    Parameter,
    Part,
    Path,
    Translational,
)  # fmt: skip

LAYER = {
    "mass": Parameter("kg/m", "Mass per length.", above=0),
    "stiffness": Parameter("N", "EA, tension per strain.", above=0),
    "damping_ratio": Parameter("1", "Damping of an element relative to critical.", default=0.05, least=0),
}


class ArrayModule(Composite):
    """Two-layer line of equal elements; nodes travel along the route, devices stand.

    hose[i], core[i]            elements between node i and i+1, i = 0 at the inboard end
    hose_node[i], core_node[i]  masses; at both ends hose and core are one body (end connector)
    registration[i]             core against hose, between the connectors
    outer[i], inner[i]          contacts with the devices of the route and of bulkheads with the hose

    Friction passes only where a device presses: without lateral load hose and core are free of each
    other. Bulkheads are smeared over the elements. At the start the tension is uniform.
    """

    inboard = Translational("inboard end connector")
    outboard = Translational("outboard end connector")
    path = Path("the route the line runs along")
    length = Parameter("m", "Length at the start, under the tension it has there.", above=0)
    element = Parameter("m", "Length of an element; rounded so that a whole number fits.", above=0)
    start = Parameter("m", "Position of the inboard end along the route at the start.", default=0.0)
    tension = Parameter("N", "Uniform tension at the start.", default=0.0, least=0)
    connector_mass = Parameter("kg", "Mass of each end connector.", default=0.0, least=0)
    hose = Block(LAYER, "The outer layer.")
    core = Block(LAYER, "The rope that carries the load.")
    bulkhead_friction = Part(Curve, "Friction of the bulkheads in the hose.", default=0.5)

    def check(p):
        """An element is no longer than the line."""
        if p.element > p.length:
            yield (
                "element",
                f"an element of {p.element:g} m is longer than the line of {p.length:g} m",
                "Make it shorter.",
            )

    def expand(p, scene):
        """Masses, elements and connectors; the contacts come when the line is laid on a route."""
        n = max(1, round(p.length / p.element))
        each = p.length / n
        free = each / (1 + p.tension / (p.hose.stiffness + p.core.stiffness))
        children, joins = {}, []
        registration = scene.make(Registration)
        for i in range(n + 1):
            share = each if 0 < i < n else each / 2
            x = p.start + i * each
            extra = p.connector_mass if i in (0, n) else 0.0
            children[f"hose_node[{i}]"] = scene.make(Mass, mass=p.hose.mass * share + extra, position=x)
            children[f"core_node[{i}]"] = scene.make(Mass, mass=p.core.mass * share, position=x)
            if 0 < i < n:
                children[f"registration[{i}]"] = registration
                joins.append((f"hose_node[{i}].flange", f"registration[{i}].hose"))
                joins.append((f"core_node[{i}].flange", f"registration[{i}].core"))
        for kind, layer, name in ((Hose, p.hose, "hose"), (Core, p.core, "core")):
            damping = 2 * layer.damping_ratio * math.sqrt(layer.stiffness / each * layer.mass * each)
            element = scene.make(kind, axial_stiffness=layer.stiffness, length=free, damping=damping)
            for i in range(n):
                children[f"{name}[{i}]"] = element
                joins.append((f"{name}[{i}].a", f"{name}_node[{i}].flange"))
                joins.append((f"{name}[{i}].b", f"{name}_node[{i + 1}].flange"))
        joins += [(f"hose_node[{i}].flange", f"core_node[{i}].flange") for i in (0, n)]
        ends = {"inboard": "hose_node[0].flange", "outboard": f"hose_node[{n}].flange"}
        return Expansion(children, joins, ends, line=ArrayLine(n, each, p))

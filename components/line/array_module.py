"""A towed array: core with bulkheads inside a hose, in modules with an end connector at each end."""

from __future__ import annotations

import math

from fairlead.components.friction.curve import Curve
from fairlead.components.line.core_element import Core
from fairlead.components.line.hose_element import Hose
from fairlead.components.line.laid_line import LaidLine
from fairlead.components.line.mesh import bulkheads, cut, too_fine
from fairlead.components.line.meter import Meter
from fairlead.components.line.registration import Registration
from fairlead.components.line.relaxing_hose import RelaxingHose
from fairlead.components.line.rigid_core import RigidCore
from fairlead.components.line.rucking_hose import RuckingHose, WatchedHose
from fairlead.components.line.torsion import TORSION, twisting
from fairlead.components.mechanics.mass import Mass

from fairlead.component import (
    Block,
    Choice,
    Composite,
    Count,
    Effect,
    Expansion,
    Parameter,
    Part,
    Path,
    Table,
    Translational,
)  # fmt: skip

LAYER = {
    "mass": Parameter("kg/m", "Mass per length.", above=0),
    "stiffness": Parameter("N", "EA, tension per strain.", above=0),
    "damping_ratio": Parameter("1", "Damping of an element relative to critical.", default=0.05, least=0),
}
RELAXING = {
    "stiffness": Parameter("N", "EA that relaxes, beside that of the hose.", above=0),
    "time": Parameter("s", "Time in which it relaxes.", above=0),
}


class ArrayModule(Composite):
    """Two-layer line in one or more modules; its nodes move along the route, the devices do not move.

    hose[i], core[i]            elements between node i and i+1, i = 0 at the inboard end
    hose_node[i], core_node[i]  masses; at the ends of modules hose and core are one body (end connector)
    registration[i]             core against hose, between the connectors
    outer[i], outer_NAME[i]     contacts with the standing devices of the route, and with each that moves
    inner[i]                    contacts of bulkheads with the hose

    Friction passes only where a device presses. Without lateral load hose and core move independently. Bulkheads are
    smeared over the elements. If `bulkhead_pitch` is longer than an element, the nodes nearest to the bulkheads have
    an inner contact each. At the start the tension is uniform.

    `graded` gives the length of elements over the place in the line. Make them short in the part that passes the
    devices, and long elsewhere: [[0 m, 2 m], [100 m, 2 m], [102 m, 0.25 m], [140 m, 0.25 m]].

    Source: docs/physics.md, 3; Tomlinson, Cooke, Cosserat 2003. Limits: no bending stiffness, and one direction along
    the route.
    """

    inboard = Translational("inboard end connector")
    outboard = Translational("outboard end connector")
    path = Path("the route the line runs along")
    length = Parameter("m", "Length at the start, under the tension it has there.", above=0)
    modules = Count("How many modules of equal length.", default=1)
    element = Parameter("m", "Length of an element; rounded so that a whole number fits.", above=0, mesh=True)
    graded = Table("m", "m", "Length of an element over its place in the line, from the inboard end.", default=None,
                   mesh=True)  # fmt: skip
    start = Parameter("m", "Position of the inboard end along the route at the start.", default=0.0)
    tension = Parameter("N", "Uniform tension at the start.", default=0.0, least=0)
    profile = Choice(("uniform", "statics"), "Tension along the line at the start: uniform, or as it slides steadily.",
                     default="uniform")  # fmt: skip
    connector_mass = Parameter("kg", "Mass of each end connector.", default=0.0, least=0)
    diameter = Parameter("m", "Outside diameter.", default=0.085, above=0)
    weight = Parameter("N/m", "Weight per length, less what the water carries.", default=0.0)
    bend_radius = Parameter("m", "Tightest radius the line may be bent to.", default=None, above=0, physics=False)
    side_wall = Parameter("N/m", "Load per length, tension over radius, that it bears.", default=None, above=0,
                          physics=False)  # fmt: skip
    hose = Block(LAYER, "The outer layer.")
    core = Block(LAYER, "The rope that carries the load.")
    bulkhead_friction = Part(Curve, "Friction of the bulkheads in the hose.", default=0.5)
    bulkhead_pitch = Parameter("m", "Distance of the bulkheads; smeared when not given.", default=None, above=0)
    ruck_force = Parameter("N", "Compression of the hose above which it rucks; not watched when not given.",
                           default=None, above=0)  # fmt: skip
    ruck_stiffness = Parameter("1", "Stiffness of the hose while it rucks, over that before.", default=1.0, above=0,
                               most=1)  # fmt: skip
    hose_relaxation = Block(RELAXING, "The hose is stiffer when strained fast; not when not given.", default=None)
    torsion = Block(TORSION, "Torsion of the line; none when not given.", default=None)
    hose_core_slip = Effect("Hose and core may part; off: one body with the mass and the stiffness of both.")
    core_stretch = Effect("The core stretches; off: the core of all modules is one body, with one position and speed.")
    tension_only_core = Effect("A core that cannot push; off: a spring.")
    device_friction = Effect("Friction of the line on all devices; off: none.")
    centrifugal = Effect("A line that runs round a bend presses less by its mass times speed squared.", default="off")
    line_damping = Effect("Damping of the elements; off: none.")
    gravity = Effect("Weight of the line; off: none.")
    planar_slip = Effect("Friction against the resultant of slipping and turning; off: against each by itself.")
    meters = Effect("Scuffing length and friction work of every contact, as states.", default="off")

    def check(p):
        """An element is no longer than a module."""
        yield from too_fine(p.length, p.element)
        if p.element > p.length / p.modules:
            whole = "the line" if p.modules == 1 else "a module"
            yield (
                "element",
                f"an element of {p.element:g} m is longer than {whole} of {p.length / p.modules:g} m",
                "Make it shorter.",
            )
        if p.ruck_force is not None and p.hose_relaxation is not None:
            yield "hose_relaxation", "hose that is watched for rucking does not relax", "Leave out one of the two."

    def expand(p, scene):
        """Masses, elements and connectors; the contacts come when the line is laid on a route."""
        mesh = cut(p.length, p.element, p.modules, p.graded)
        n = mesh.elements
        together = mesh.connectors if p.hose_core_slip == "on" else range(n + 1)
        children, joins = {}, []
        registration = scene.make(Registration)
        for i in range(n + 1):
            share, x = mesh.reach(i).length, p.start + mesh.places[i]
            extra = p.connector_mass if i in mesh.connectors else 0.0
            children[f"hose_node[{i}]"] = scene.make(Mass, mass=p.hose.mass * share + extra, position=x)
            children[f"core_node[{i}]"] = scene.make(Mass, mass=p.core.mass * share, position=x)
            if i in together:
                joins.append((f"hose_node[{i}].flange", f"core_node[{i}].flange"))
            else:
                children[f"registration[{i}]"] = registration
                joins.append((f"hose_node[{i}].flange", f"registration[{i}].hose"))
                joins.append((f"core_node[{i}].flange", f"registration[{i}].core"))
        for (kind, more), layer, name in ((hose_kind(p), p.hose, "hose"), ((core_kind(p), {}), p.core, "core")):
            made = {}
            for i, each in enumerate(map(_tidy, mesh.lengths)):
                if each not in made:
                    given = {"length": each} if kind is RigidCore else _element(p, layer, each)
                    made[each] = scene.make(kind, **given, **more)
                children[f"{name}[{i}]"] = made[each]
                joins.append((f"{name}[{i}].a", f"{name}_node[{i}].flange"))
                joins.append((f"{name}[{i}].b", f"{name}_node[{i + 1}].flange"))
        ends = {"inboard": "hose_node[0].flange", "outboard": f"hose_node[{n}].flange"}
        if p.torsion is not None:
            more, links, twist_ends = twisting(p, scene, mesh, ("hose", "core"))
            children, joins, ends = children | more, joins + links, ends | twist_ends
        marks = bulkheads(mesh, p.bulkhead_pitch) if p.hose_core_slip == "on" else {}
        meter = Meter if p.meters == "on" else None
        inner = "core_node" if p.hose_core_slip == "on" else ""
        laid = LaidLine(mesh, p, "hose_node", ("hose", "core"), inner, marks, meter)
        return Expansion(children, joins, ends, line=laid)


def hose_kind(p):
    """The class of hose elements, and what it is given besides."""
    if p.hose_relaxation is not None:
        return RelaxingHose, {"branch_stiffness": p.hose_relaxation.stiffness, "relaxation": p.hose_relaxation.time}
    if p.ruck_force is None:
        return Hose, {}
    if p.ruck_stiffness == 1:
        return WatchedHose, {"limit": p.ruck_force}
    return RuckingHose, {"limit": p.ruck_force, "softening": p.ruck_stiffness}


def core_kind(p):
    """The class of core elements."""
    if p.core_stretch == "off":
        return RigidCore
    return Core if p.tension_only_core == "on" else Hose


def _element(p, layer, each):
    """Parameters of an element of a layer whose length under the starting tension is `each`.

    Beside a core that does not stretch the hose is not stretched at the start either: the core has all of the tension.
    """
    stretched = p.tension if p.core_stretch == "on" else 0.0
    free = each / (1 + stretched / (p.hose.stiffness + p.core.stiffness))
    damping = 2 * layer.damping_ratio * math.sqrt(layer.stiffness / each * layer.mass * each)
    return {"axial_stiffness": layer.stiffness, "length": free, "damping": damping, "line_damping": p.line_damping}


def _tidy(length):
    """Without the rounding of differences, so that equal elements are told to be equal."""
    return round(length, 12)

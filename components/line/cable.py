"""A line of one layer: a cable, a rope, or an array that carries its load in the hose."""

from __future__ import annotations

import math

from fairlead.components.line.core_element import Core
from fairlead.components.line.hose_element import Hose
from fairlead.components.line.laid_line import LaidLine
from fairlead.components.line.mesh import cut, too_fine
from fairlead.components.line.meter import Meter
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
    Path,
    Table,
    Translational,
)  # fmt: skip


class Cable(Composite):
    """Line of one layer; its nodes move along the route, the devices do not move.

    line[i]                     elements between node i and i+1, i = 0 at the inboard end
    node[i]                     masses
    outer[i], outer_NAME[i]     contacts with the standing devices of the route, and with each that moves

    `compression: none` is a rope, which cannot push. `carried` is a stiff cable or a crustacean array. Such an array
    has its strength in the hose and no bulkheads, and may be monitored for rucking. Bending stiffness is left out.

    line_stretch    off: the line is one body with one position and one speed, the limit of a stiff line. Its tensions
                    follow from the balance of each node. They may push, and no element is monitored for rucking

    Source: docs/physics.md, 3. Limits: no motion across the route.
    """

    inboard = Translational("inboard end")
    outboard = Translational("outboard end")
    path = Path("the route the line runs along")
    length = Parameter("m", "Length at the start, under the tension it has there.", above=0)
    modules = Count("How many pieces of equal length, joined by connectors.", default=1)
    element = Parameter("m", "Length of an element; rounded so that a whole number fits.", above=0, mesh=True)
    graded = Table("m", "m", "Length of an element over its place in the line, from the inboard end.", default=None,
                   mesh=True)  # fmt: skip
    start = Parameter("m", "Position of the inboard end along the route at the start.", default=0.0)
    tension = Parameter("N", "Uniform tension at the start.", default=0.0, least=0)
    profile = Choice(("uniform", "statics"), "Tension along the line at the start: uniform, or as it slides steadily.",
                     default="uniform")  # fmt: skip
    connector_mass = Parameter("kg", "Mass of each end connector.", default=0.0, least=0)
    diameter = Parameter("m", "Outside diameter.", default=0.02, above=0)
    weight = Parameter("N/m", "Weight per length, less what the water carries.", default=0.0)
    bend_radius = Parameter("m", "Tightest radius the line may be bent to.", default=None, above=0, physics=False)
    side_wall = Parameter("N/m", "Load per length, tension over radius, that it bears.", default=None, above=0,
                          physics=False)  # fmt: skip
    mass = Parameter("kg/m", "Mass per length.", above=0)
    stiffness = Parameter("N", "EA, tension per strain.", above=0)
    damping_ratio = Parameter("1", "Damping of an element relative to critical.", default=0.05, least=0)
    compression = Choice(("none", "carried"), "Whether the line can push.", default="none")
    ruck_force = Parameter("N", "Compression above which it rucks, if it can push; not watched when not given.",
                           default=None, above=0)  # fmt: skip
    ruck_stiffness = Parameter("1", "Stiffness while it rucks, over that before.", default=1.0, above=0, most=1)
    torsion = Block(TORSION, "Torsion of the line; none when not given.", default=None)
    line_stretch = Effect("The line stretches; off: it is one body, with one position and speed.")
    device_friction = Effect("Friction of the line on all devices; off: none.")
    centrifugal = Effect("A line that runs round a bend presses less by its mass times speed squared.", default="off")
    line_damping = Effect("Damping of the elements; off: none.")
    gravity = Effect("Weight of the line; off: none.")
    planar_slip = Effect("Friction against the resultant of slipping and turning; off: against each by itself.")
    meters = Effect("Scuffing length and friction work of every contact, as states.", default="off")

    def check(p):
        """An element is no longer than the line; only what can push can ruck."""
        yield from too_fine(p.length, p.element)
        if p.element > p.length / p.modules:
            what = f"an element of {p.element:g} m is longer than the line of {p.length / p.modules:g} m"
            yield "element", what, "Make it shorter."
        if p.ruck_force is not None and p.compression == "none":
            yield "ruck_force", "a line that cannot push cannot ruck", "Leave it out, or write compression: carried."

    def expand(p, scene):
        """Masses and elements; the contacts come when the line is laid on a route."""
        mesh = cut(p.length, p.element, p.modules, p.graded)
        n, made = mesh.elements, {}
        children, joins = {}, []
        for i in range(n + 1):
            extra = p.connector_mass if i in mesh.connectors else 0.0
            mass = p.mass * mesh.reach(i).length + extra
            children[f"node[{i}]"] = scene.make(Mass, mass=mass, position=p.start + mesh.places[i])
        for i, each in enumerate(round(length, 12) for length in mesh.lengths):
            if each not in made:
                made[each] = _element(p, scene, each)
            children[f"line[{i}]"] = made[each]
            joins.append((f"line[{i}].a", f"node[{i}].flange"))
            joins.append((f"line[{i}].b", f"node[{i + 1}].flange"))
        ends = {"inboard": "node[0].flange", "outboard": f"node[{n}].flange"}
        if p.torsion is not None:
            more, links, twist_ends = twisting(p, scene, mesh, ("line",))
            children, joins, ends = children | more, joins + links, ends | twist_ends
        meter = Meter if p.meters == "on" else None
        laid = LaidLine(mesh, p, "node", ("line",), meter=meter, pushes=p.compression == "carried")
        return Expansion(children, joins, ends, line=laid)


def _element(p, scene, each):
    """An element whose length under the starting tension is `each`."""
    if p.line_stretch == "off":
        return scene.make(RigidCore, length=each)
    damping = 2 * p.damping_ratio * math.sqrt(p.stiffness / each * p.mass * each)
    given = {"axial_stiffness": p.stiffness, "length": each / (1 + p.tension / p.stiffness), "damping": damping,
             "line_damping": p.line_damping}  # fmt: skip
    if p.compression == "none":
        return scene.make(Core, **given)
    if p.ruck_force is None:
        return scene.make(Hose, **given)
    if p.ruck_stiffness == 1:
        return scene.make(WatchedHose, **given, limit=p.ruck_force)
    return scene.make(RuckingHose, **given, limit=p.ruck_force, softening=p.ruck_stiffness)

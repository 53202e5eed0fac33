"""Torsion of a line: a chain of inertias and springs in twist, beside the chain along the line."""

from __future__ import annotations

import math
from typing import Any

from fairlead.components.line.mesh import Mesh
from fairlead.components.rotation.inertia import Inertia

from fairlead.component import Component, Effect, Input, Law, Output, Parameter, Rotational

TORSION = {
    "stiffness": Parameter("N*m^2", "GJ, torque per twist per length.", above=0),
    "inertia": Parameter("kg*m", "Moment of inertia per length about the axis of the line.", above=0),
    "damping_ratio": Parameter("1", "Damping of an element relative to critical.", default=0.05, least=0),
    "coupling": Parameter("m", "Torque per tension of the rope inside, which wants to unlay.", default=0.0),
}


class TwistElement(Component):
    """One element of line in torsion.

        torque = GJ/length (b.angle - a.angle) + damping (b.speed - a.speed) + coupling * tension

    The coupling acts one way: the tension twists the line, but the work of this twist is not taken from the tension.
    So a rope that unlays does not get longer.
    """

    a = Rotational("inboard end")
    b = Rotational("outboard end")
    stiffness = Parameter("N*m^2", "GJ.", above=0)
    length = Parameter("m", "Length.", above=0)
    damping = Parameter("N*m*s/rad", "Torque per rate of twist.", default=0.0, least=0)
    coupling = Parameter("m", "Torque per tension.", default=0.0)
    tension = Input("N", "Tension of the element.", default=0.0)
    line_damping = Effect("Damping of the element; off: none.")
    torque = Output("N*m", "Torque carried, positive when b is turned ahead of a.")

    def law(p, a, b, tension):
        """A spring, a damper, and what the lay of the rope adds."""
        twist, rate = b.angle - a.angle, b.speed - a.speed
        elastic, lay = p.stiffness / p.length * twist, p.coupling * tension
        lossy = p.damping * rate if p.line_damping == "on" else 0
        torque = elastic + lossy + lay
        return Law(a=-torque, b=+torque, torque=torque, stored=elastic * twist / 2, dissipated=lossy * rate,
                   supplied=-lay * rate)  # fmt: skip


Made = tuple[dict[str, Any], list[Any], dict[str, str]]  # children, joins, ports


def twisting(p: Any, scene: Any, mesh: Mesh, layers: tuple[str, ...]) -> Made:
    """Children, joins and ports of the chain in twist: twist[i] at the nodes, torsion[i] between them.

    The tension that a coupling counts is that of the last of the layers, which carries the load.
    """
    given, n = p.torsion, mesh.elements
    children: dict[str, Any] = {}
    joins: list[Any] = []
    for i in range(n + 1):
        children[f"twist[{i}]"] = scene.make(Inertia, moment=given.inertia * mesh.reach(i).length)
    made: dict[float, Any] = {}
    for k, each in enumerate(round(length, 12) for length in mesh.lengths):
        if each not in made:
            damping = 2 * given.damping_ratio * math.sqrt(given.stiffness * given.inertia)
            made[each] = scene.make(TwistElement, stiffness=given.stiffness, length=each, damping=damping,
                                    coupling=given.coupling, line_damping=p.line_damping)  # fmt: skip
        children[f"torsion[{k}]"] = made[each]
        joins += [(f"twist[{k}].shaft", f"torsion[{k}].a"), (f"torsion[{k}].b", f"twist[{k + 1}].shaft")]
        if given.coupling:
            joins.append((f"{layers[-1]}[{k}].tension", f"torsion[{k}].tension"))
    ends = {"inboard_twist": "twist[0].shaft", "outboard_twist": f"twist[{n}].shaft"}
    return children, joins, ends

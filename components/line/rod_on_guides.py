"""A rod lying on many guides, each of which holds it by friction."""

import math

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.ground import Ground
from fairlead.components.mechanics.mass import Mass
from fairlead.components.mechanics.spring_damper import SpringDamper

from fairlead.component import Composite, Count, Expansion, Parameter, Translational


class RodOnGuides(Composite):
    """An elastic rod cut into `blocks` equal masses, each on a guide of its own.

    block[i]   masses, i = 0 at the free end        spring[i]   between block i and i+1
    guide[i]   contact of block i with the ground; its sliding friction is
               friction/blocks (1 + unevenness sin(wave i + phase))

    Mass, stiffness and friction are those of the whole rod, so that more blocks mean a finer rod.

    Source: docs/physics.md, 8 item 12. Limits: guides stand, and masses move along the rod only.
    """

    end = Translational("the end that is pulled")
    blocks = Count("How many blocks.", default=100, least=2, most=20_000, mesh=True)
    mass = Parameter("kg", "Mass of the rod.", above=0)
    axial_stiffness = Parameter("N", "EA over a length of 1 m: each spring has blocks times this.", above=0)
    damping_time = Parameter("s", "Damping of each spring over its stiffness.", default=0.0, least=0)
    friction = Parameter("N", "Sliding friction of the rod, without the unevenness.", above=0)
    unevenness = Parameter("1", "How much the guides differ.", default=0.0, least=0, below=1)
    wave = Parameter("rad", "Phase from guide to guide.", default=0.0)
    phase = Parameter("rad", "Phase of the first guide.", default=0.0)

    def expand(p, scene):
        """A row of blocks, springs and contacts; the coefficient of friction is 1, the normal forces differ."""
        n = p.blocks
        stiffness = p.axial_stiffness * n  # N/m: EA over the length of an element of 1/n m
        children, joins = {"ground": scene.make(Ground)}, []
        for i in range(n):
            normal = p.friction / n * (1 + p.unevenness * math.sin(p.wave * i + p.phase))
            children[f"block[{i}]"] = scene.make(Mass, mass=p.mass / n)
            children[f"guide[{i}]"] = scene.make(Contact, normal_force=normal, curve=1.0)
            joins.append((f"block[{i}].flange", f"guide[{i}].b"))
            joins.append(("ground.flange", f"guide[{i}].a"))
        for i in range(n - 1):
            children[f"spring[{i}]"] = scene.make(SpringDamper, stiffness=stiffness, damping=p.damping_time * stiffness)
            joins.append((f"block[{i}].flange", f"spring[{i}].a"))
            joins.append((f"block[{i + 1}].flange", f"spring[{i}].b"))
        return Expansion(children, joins, {"end": f"block[{n - 1}].flange"})

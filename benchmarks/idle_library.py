"""A row of blocks on guides of which only the last few press: a scene for contacts that are off."""

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.ground import Ground
from fairlead.components.mechanics.mass import Mass
from fairlead.components.mechanics.spring_damper import SpringDamper

from fairlead.component import Composite, Count, Expansion, Parameter, Translational


class LiftedRow(Composite):
    """Blocks joined by springs; the last `pressed` of them lie on their guides, the others hover.

    block[i]   masses, i = 0 at the free end        guide[i]   contacts of the last `guides` blocks with the ground
    """

    end = Translational("the end that is pulled")
    blocks = Count("How many blocks.", default=1000, least=2)
    guides = Count("How many have a guide.", default=1000, least=1)
    pressed = Count("How many press on it.", default=10, least=1)
    mass = Parameter("kg", "Mass of a block.", above=0)
    stiffness = Parameter("N/m", "Stiffness of a spring.", above=0)
    damping = Parameter("N*s/m", "Damping of a spring.", least=0)
    normal_force = Parameter("N", "Normal force of a block that presses.", above=0)
    lifted = Parameter("N", "Normal force of one that hovers: less than what counts as contact.", default=1e-9)

    def expand(p, scene):
        """A row from the free end to the pulled one."""
        n, children, joins = p.blocks, {"ground": scene.make(Ground)}, []
        for i in range(n):
            children[f"block[{i}]"] = scene.make(Mass, mass=p.mass)
            if i >= n - p.guides:
                normal = p.normal_force if i >= n - p.pressed else p.lifted
                children[f"guide[{i}]"] = scene.make(Contact, normal_force=normal, curve=1.0)
                joins += [(f"block[{i}].flange", f"guide[{i}].b"), ("ground.flange", f"guide[{i}].a")]
        for i in range(n - 1):
            children[f"spring[{i}]"] = scene.make(SpringDamper, stiffness=p.stiffness, damping=p.damping)
            joins += [(f"block[{i}].flange", f"spring[{i}].a"), (f"block[{i + 1}].flange", f"spring[{i}].b")]
        return Expansion(children, joins, {"end": f"block[{n - 1}].flange"})

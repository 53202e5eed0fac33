"""Friction between turning bodies: the sliding contact at a radius.

A friction torque is a friction force at a lever arm, whatever treats its sticking. So there is no second set of
laws for shafts: two racks of the same radius turn the shafts' motion into the slip of one `Contact`, which brings
every treatment and every curve along, those of the user included, tested once. The racks are no unknowns of
their own; a held clutch costs what a held pad costs. Speeds of curves and creep are slip speeds at the radius.
"""

from fairlead.components.friction.contact import Contact, small_lift
from fairlead.components.friction.curve import Curve
from fairlead.components.friction.frictionless import contact_of
from fairlead.components.friction.heat import THERMAL, FrictionHeat
from fairlead.components.mechanics.ground import Ground
from fairlead.components.rotation.rack import Rack

from fairlead.component import (
    Block,
    Choice,
    Component,
    Composite,
    Count,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Rotational,
)  # fmt: skip
from fairlead.errors import Fault, ModelError

METHODS = (
    "binding", "hold", "karnopp", "reset_integrator", "dahl", "lugre", "elastoplastic", "maxwell_slip", "tanh",
    "arctan", "root", "saturation",
)  # fmt: skip


class Pressing(Component):
    """The normal force of all faces together, signal in and out."""

    faces = Parameter("1", "Number of rubbing faces.", default=1.0, above=0)
    normal_force = Parameter("N", "Normal force, when the input `normal` is not connected.", default=None, least=0)
    normal = Input("N", "Normal force that presses the stack.", default="normal_force")
    pressing = Output("N", "Normal force times faces.")

    def law(p, normal):
        """Every face carries the whole normal force."""
        return Law(pressing=p.faces * normal)


class LeverArm(Component):
    """Friction at a radius as a torque, signal in and out."""

    radius = Parameter("m", "Lever arm.", above=0)
    friction = Input("N", "Friction at the radius.")
    torque = Output("N*m", "Friction torque.")

    def law(p, friction):
        """Force times lever arm."""
        return Law(torque=p.radius * friction)


class Rubbing(Composite, abstract=True):
    """What clutch, brake and bearing have in common: a contact at a radius, pressed on one or more faces."""

    radius = Parameter("m", "Mean radius at which friction acts.", above=0, usual=(1e-3, 10))
    curve = Part(Curve, "Coefficient of friction over slip speed at the radius.")
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method", "creep")
    creep = Parameter("m/s", "Tolerated creep at the radius; the scene's when not given.", default=None, above=0)
    normal_force = Parameter("N", "Normal force, when the input `normal` is not connected.", default=None, least=0)
    faces = Count("Number of rubbing faces, each pressed with the whole normal force.", default=1)
    heat = Block(THERMAL, "What friction warms; then the curve's softening is a fade.", default=None)
    normal = Input("N", "Normal force.", default="normal_force")
    torque = Output("N*m", "Friction torque, positive when it opposes positive slip.")
    friction = Output("N", "Friction of all faces, at the radius; times slip it is the loss (FrictionLoss).")
    slip = Output("m/s", "Slip speed at the radius.")
    temperature = Output("K", "Temperature of the faces, if they are warmed.")


def rubbing(p, scene, other):
    """Expansion of a contact between the shaft `b` and, at `other`, a shaft `a` or the ground."""
    word = {} if p.method is None else {"method": p.method}
    member = scene.member(Contact, word)
    creeps = "creep" in member.declaration.parameters
    if p.creep is not None and not creeps and not word and "method" not in scene.friction:
        what = f"creep: nobody chose a treatment of friction, and {member.word} does not creep."
        raise ModelError([Fault(None, what, "Write method: binding beside it, or leave creep out.")])
    own = {} if p.normal_force is None else small_lift(p.faces * p.normal_force)
    creep = {"creep": p.creep} if p.creep is not None and creeps else {}
    children = {
        "contact": contact_of(scene, p.curve, **word, **creep, **own),
        "pressing": scene.make(Pressing, faces=p.faces, normal_force=p.normal_force),
        "lever": scene.make(LeverArm, radius=p.radius),
        "rim_b": scene.make(Rack, radius=p.radius),
        **other,
    }
    surface = "rim_a.rack" if "rim_a" in other else "ground.flange"
    joins = [
        (surface, "contact.a"), ("rim_b.rack", "contact.b"), ("pressing.pressing", "contact.normal"),
        ("contact.friction", "lever.friction"),
    ]  # fmt: skip
    shown = {name: f"contact.{name}" for name in ("friction", "slip")}
    shown |= {"torque": "lever.torque", "normal": "pressing.normal"}
    if p.heat is not None:
        children["body"] = scene.make(FrictionHeat, **vars(p.heat))
        joins += [(f"contact.{name}", f"body.{name}") for name in ("friction", "slip")]
        joins.append(("body.temperature", "contact.temperature"))
        shown["temperature"] = "body.temperature"
    ports = {"a": "rim_a.pinion", "b": "rim_b.pinion"} if "rim_a" in other else {"shaft": "rim_b.pinion"}
    return Expansion(children, joins, ports, shown)


class Clutch(Rubbing):
    """Two shafts coupled by friction: torque up to faces * radius * mu * normal force, slip b over a.

    The normal force may be a signal: connect it to `normal`, and the clutch engages as it is pressed. For plates
    between radii r and R the mean radius is (r + R)/2 when they are run in (uniform wear). New plates (uniform
    pressure) have 2/3 (R^3 - r^3)/(R^2 - r^2). For fade use `heat` with a curve that has a `softening`.

    Source: Shigley's Mechanical Engineering Design, clutches (uniform wear and uniform pressure). Limits: all faces
    have one temperature and one coefficient; no drag while open.
    """

    a, b = Rotational("one shaft"), Rotational("the other shaft")

    def expand(p, scene):
        """A contact between two rims."""
        return rubbing(p, scene, {"rim_a": scene.make(Rack, radius=p.radius)})


class Brake(Rubbing):
    """A shaft held by friction against the housing: torque up to faces * radius * mu * normal force.

    Source: Shigley's Mechanical Engineering Design, disc and drum brakes (uniform wear). Limits: shoes do not press
    themselves on.
    """

    shaft = Rotational("the braked shaft")

    def expand(p, scene):
        """A contact between the rim and the ground."""
        return rubbing(p, scene, {"ground": scene.make(Ground)})


class Bearing(Rubbing):
    """A shaft that rubs in a plain bearing: torque radius * mu(slip) * load, with the bore's radius.

    torque = radius friction,  friction = faces mu(slip) normal,  slip = radius speed: positive against forward turning.
    A Stribeck or hump curve describes boundary, mixed and lubricated running; `normal` is the radial load.

    Source: docs/physics.md, 1.2 (curves); Stribeck 1902. Limits: the shaft does not shift in its bore, and no oil film
    forms in time.
    """

    shaft = Rotational("the shaft in the bearing")

    def expand(p, scene):
        """A contact between the journal and the housing."""
        return rubbing(p, scene, {"ground": scene.make(Ground)})

"""A body that slides between two stops."""

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.end_stop import EndStop
from fairlead.components.mechanics.ground import Ground
from fairlead.components.mechanics.mass import Mass
from fairlead.components.mechanics.rigid_stop import RigidStop
from fairlead.components.rotation.rubbing import METHODS

from fairlead.component import Choice, Composite, Effect, Expansion, Output, Parameter, Translational


class MassWithStops(Composite):
    """A body that slides with dry and viscous friction between two fixed stops: a spool, a slide, a hammer.

    mass a = force - friction,  lower <= x <= upper. Friction is `sliding` while it moves, `breakaway` from rest, with a
    decay over `speed` between (Stribeck), and `viscous` per speed besides. Stops that are `rigid` give back
    `restitution` of the speed at which the body comes; those that are `elastic` are an EndStop.

    Source: MassWithStopAndFriction of the Modelica Standard Library, as a composite of parts.

    Limits: stops are fixed; one coefficient of friction for the whole travel.
    """

    flange = Translational("the body itself")
    mass = Parameter("kg", "Mass.", above=0)
    lower = Parameter("m", "Position at the lower stop.", default=0.0)
    upper = Parameter("m", "Position at the upper stop.")
    sliding = Parameter("N", "Dry friction while it moves.", default=0.0, least=0)
    breakaway = Parameter("N", "Force to begin; that of sliding when not given.", default=None, least=0)
    speed = Parameter("m/s", "Speed over which breakaway falls to sliding.", default=0.01, above=0)
    viscous = Parameter("N*s/m", "Friction that grows with speed.", default=0.0, least=0)
    stops = Choice(("rigid", "elastic"), "Kind of the stops.", default="rigid")
    restitution = Parameter("1", "Share of speed given back, of rigid stops.", default=0.0, least=0, most=1)
    stiffness = Parameter("N/m", "Stiffness of elastic stops.", default=1e8, above=0)
    damping = Parameter("s/m", "Share of their force that is added per speed of approach.", default=5.0, least=0)
    position = Parameter("m", "Position at the start.", default=None, physics=False)
    velocity = Parameter("m/s", "Velocity at the start.", default=None, physics=False)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    rubs = Effect("Friction of the guide.")
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity.")
    friction = Output("N", "Friction, positive when it holds back a body that goes forward.")

    def check(p):
        """There is a travel between the stops, and the body begins there."""
        if p.upper <= p.lower:
            yield "upper", f"upper {p.upper:g} m is not above lower {p.lower:g} m", "Raise it."
        elif p.position is not None and not p.lower <= p.position <= p.upper:
            yield "position", f"position {p.position:g} m is beyond the stops", "Begin between lower and upper."
        if p.breakaway is not None and p.breakaway < p.sliding:
            what = f"breakaway {p.breakaway:g} N is below sliding = {p.sliding:g} N"
            yield "breakaway", what, "Beginning takes at least as much as sliding on."

    def expand(p, scene):
        """A mass, its stops at the ground, and a contact pressed with one newton."""
        children = {
            "body": scene.make(Mass, mass=p.mass, position=p.position, velocity=p.velocity),
            "ground": scene.make(Ground),
        }
        at_ground, at_body, shown = ["ground.flange"], ["body.flange"], {"x": "body.x", "v": "body.v"}
        if p.stops == "elastic":
            children["ends"] = scene.make(EndStop, lower=p.lower, upper=p.upper, stiffness=p.stiffness,
                                          damping=p.damping)  # fmt: skip
            at_ground, at_body = [*at_ground, "ends.a"], [*at_body, "ends.b"]
        else:
            children["below"] = scene.make(RigidStop, length=p.lower, restitution=p.restitution)
            children["above"] = scene.make(RigidStop, length=-p.upper, restitution=p.restitution)
            at_ground, at_body = [*at_ground, "below.a", "above.b"], [*at_body, "below.b", "above.a"]
        if p.rubs == "on" and (p.sliding or p.breakaway or p.viscous):
            word = {} if p.method is None else {"method": p.method}
            level = {"curve": "coulomb", "coulomb": p.sliding}
            if p.breakaway is not None:
                level = {"curve": "stribeck", "stiction": p.breakaway, "coulomb": p.sliding, "velocity": p.speed}
            children["guide"] = scene.make(Contact, curve=level, normal_force=1.0, viscous=p.viscous, **word)
            at_ground, at_body = [*at_ground, "guide.a"], [*at_body, "guide.b"]
            shown["friction"] = "guide.friction"
        return Expansion(children, [tuple(at_ground), tuple(at_body)], {"flange": "body.flange"}, shown)

"""Friction between two bodies as its force over their speed: what a test of a seal, a guide or a slide gives."""

from fairlead.components.friction.curve import points_make_sense
from fairlead.components.friction.frictionless import contact_of
from fairlead.components.rotation.rubbing import METHODS

from fairlead.component import Choice, Composite, Expansion, Output, Parameter, Table, Translational

PRESSED = 1.0  # N; a coefficient times it is the force


class SlideFriction(Composite):
    """Dry friction between two bodies given as a force over their speed v = b.v - a.v, with no normal force.

        force = sliding + (breakaway - sliding) exp(-(v/speed)^2) + viscous v        for v > 0, and the same backward

    Without `speed` the force falls from breakaway to sliding at once. With `points` of a measurement it follows these.
    On b the force acts against v. At rest it is the force that holds, up to breakaway. Join `a` with a Ground for a
    guide that stands.

    Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 1083, section 2 (Stribeck curve).

    Limits: the force does not depend on load, place or direction. For friction under a normal force take a Contact.
    """

    a = Translational("the guide, or a Ground")
    b = Translational("the body that slides in it")
    sliding = Parameter("N", "Force while it slides; or give points.", default=None, least=0)
    breakaway = Parameter("N", "Force to begin; that of sliding when not given.", default=None, least=0)
    speed = Parameter("m/s", "Speed over which breakaway falls to sliding.", default=None, above=0)
    viscous = Parameter("N*s/m", "Force that grows with speed, beside the dry one.", default=None, least=0)
    points = Table("m/s", "N", "Speed and force, first point at rest.", default=None)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    force = Output("N", "Friction, positive when it opposes positive slip.")
    slip = Output("m/s", "Speed of b over a.")

    def check(p):
        """One of the two ways, and a decay from something to something."""
        yield from contradictions(p, "force", "N", "sliding on", "m/s")

    def expand(p, scene):
        """A contact pressed with one newton."""
        word = {} if p.method is None else {"method": p.method}
        children = {"contact": contact_of(scene, curve_of(p), p.viscous, normal_force=PRESSED, **word)}
        shown = {"force": "contact.friction", "slip": "contact.slip"}
        return Expansion(children, [], {"a": "contact.a", "b": "contact.b"}, shown)


def contradictions(p, load, unit, going_on, speed):
    """What `sliding`, `breakaway`, `speed` and `points` say against each other; `load` is a force or a torque."""
    if (p.sliding is None) == (p.points is None):
        yield "", "give either sliding or points", f"One {load}, or {load}s over speed."
    if p.sliding is not None and p.breakaway is not None and p.breakaway < p.sliding:
        what = f"breakaway {p.breakaway:g} {unit} is below sliding = {p.sliding:g} {unit}"
        yield "breakaway", what, f"Beginning takes at least as much as {going_on}."
    if p.speed is not None and p.breakaway is None:
        yield "speed", "speed is given without breakaway", f"Give the {load} from which friction falls."
    if p.points is not None and (p.breakaway is not None or p.speed is not None):
        yield "points", "points are given beside breakaway or speed", f"The first point is the {load} to begin."
    if p.points is not None:
        yield from points_make_sense("points", p.points, load, speed)


def curve_of(p):
    """The curve whose coefficient is the force [N], or torque [N m], at a slip in m/s, or rad/s."""
    if p.points is not None:
        return {"curve": "table", "points": p.points}
    if p.speed is not None:
        return {"curve": "stribeck", "stiction": p.breakaway, "coulomb": p.sliding, "velocity": p.speed}
    begin = {} if p.breakaway is None else {"stiction": p.breakaway}
    return {"curve": "coulomb", "coulomb": p.sliding, **begin}

"""The span of a web between two rollers: material comes in with the strain that it has behind, and goes out."""

from fairlead.component import (
    Component,
    Effect,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Translational,
    Zones,
    guard,
    shared,
    sqrt,
    zone,
)  # fmt: skip

TEARS = 1e-3  # s; in which the energy of a torn web is gone: it only has a place in the ledger
CUT = 0.5  # of a signal that is 0 or 1
LEAST = 1e-3  # of `length`: with less left a rope is a wall, stiffness/length, and a step may jump through it


def forward(p, v):
    """The speed where it is positive, else nothing; a corner rounded over `slow`."""
    return (v + sqrt(v**2 + p.slow**2)) / 2


class Web(Component, abstract=True):
    """Half-model of a web between two rollers, elastic, without mass.

    S' = q_a - q_b        S = (free length)/(1 + strain), the material between the rollers
    q_a = a.v/(1 + before),      q_b = b.v/(1 + strain)        running forward, from a to b
    q_a = a.v/(1 + strain),      q_b = b.v/(1 + after)         running backward, each end for itself
    tension = stiffness strain + damping d(strain)/dt,  and none while damping would push

    A web sticks to a roller where it comes on to it and creeps where it leaves it. So it is carried over with the
    strain of the span that it comes from. Connect the `strain` of the span behind to `before`, and of the one ahead to
    `after`. The creep dissipates stiffness (strain - before)^2/2 for a metre of material. Energy that material brings
    along and takes along is told as supplied; between spans it cancels.

    Source: J. J. Shelton, Proc. American Control Conference 1986, 1423; G. Brandenburg, 3rd IFAC Conf. on
    Instrumentation and Automation in the Paper, Rubber and Plastics Industries, 1977, 411; docs/physics.md, 4.9.
    Limits: strain is small and elastic, equal over the width; no sag, no air, no sideways motion, no momentum of the
    web. A slack web has no tension and stays on its rollers.
    """

    a = Translational("rim of the roller behind, from which the web comes")
    b = Translational("rim of the roller ahead")
    length = Parameter("m", "Length of the web between the rollers.", above=0)
    stiffness = Parameter("N", "Young's modulus times width times thickness.", above=0, usual=(10, 1e9))
    tension = Parameter("N", "Tension at the start.", default=0.0, least=0, physics=False)
    damping = Parameter("N*s", "Tension per rate of strain, beside the elastic one; none when not given.", default=None,
                        above=0)  # fmt: skip
    slow = Parameter("m/s", "Speed below which the way of material over a roller is rounded.", default=1e-6, above=0)
    before = Input("1", "Strain of the web that comes on to the roller behind.", default=0.0)
    after = Input("1", "Strain of the web that comes on to the roller ahead while it runs backward.", default=0.0)
    pull = State("N", "Tension, and below zero what the web is longer than its way, as strain times stiffness.",
                 start="tension")  # fmt: skip
    carried = Output("N", "Tension; never negative.", name="tension")
    elastic = Output("N", "Stiffness times strain.")
    strain = Output("1", "Strain, never negative.")
    zones = Zones("taut", "slack", "closing")

    @guard("taut", "closing", to="slack", unit="N")
    def slackens(p, pull):
        """The strain falls through zero."""
        return -pull

    @guard("taut", to="closing", unit="N")
    def would_push(p, damped):
        """Closing so fast that the damping would push."""
        return None if p.damping is None else -damped

    @guard("closing", to="taut", unit="N")
    def catches(p, damped):
        """Closing no longer so fast."""
        return damped

    @guard("slack", to="taut", unit="N")
    def tightens(p, pull):
        """The slack is taken up."""
        return pull


def flows(p, a, b, before, after, strain):
    """Material in at a and out at b [m/s], energy that it brings less what it takes, and loss by creep [W].

    At last how much faster than its web the roller at b is, over that at a [m/s].
    """
    in_a, in_b = forward(p, a.v) / (1 + before), (b.v - forward(p, b.v)) / (1 + after)
    out_a, out_b = (a.v - forward(p, a.v)) / (1 + strain), forward(p, b.v) / (1 + strain)
    half = p.stiffness / 2
    brings = half * (before**2 * in_a - after**2 * in_b + strain**2 * (out_a - out_b))
    lost = half * ((strain - before) ** 2 * in_a - (strain - after) ** 2 * in_b)
    q_a, q_b = in_a + out_a, in_b + out_b
    return q_a, q_b, brings, lost, b.v - a.v - (1 + strain) * (q_b - q_a)


def straining(p, pull, length, rate, told):
    """Rate of strain of a web whose way is `length`, which grows with `rate`; `told` is what `flows` tells."""
    stretch = pull / p.stiffness
    return (1 + stretch) * (rate - (1 + stretch) * (told[0] - told[1])) / length


def with_damping(p, pull, length, rate, told):
    """What a stretched web would pull with its damping, below zero where that would push."""
    return pull if p.damping is None else pull + p.damping * straining(p, pull, length, rate, told)


def span(p, pull, zone, length, rate, told, **ports):
    """Law of a web whose way is `length`, which grows with `rate`; `told` is what `flows` tells of its ends.

    While it is closing, what its strain has stored goes into the damping.

    `ports` has the port of what moves, if any, and by how much it lengthens the way. The work of damping at a roller
    where the strain changes is told as supplied, as what material brings along.
    """
    _, _, brings, lost, slides = told
    stretch, grows = pull / p.stiffness, straining(p, pull, length, rate, told)
    stretched = zone != "slack"
    elastic = pull if stretched else 0
    damps = {"taut": 0 if p.damping is None else p.damping * grows, "closing": -pull, "slack": 0}[zone]
    tension = elastic + damps if zone == "taut" else 0
    stored = length * pull * stretch / (1 + stretch) / 2 if stretched else 0
    return Law(
        a=-tension, b=+tension, pull=p.stiffness * grows, tension=tension, elastic=elastic, stored=stored,
        strain=stretch if stretched else 0, supplied=brings - damps * slides,
        dissipated=lost + damps * grows * length / (1 + stretch), **{port: n * tension for port, n in ports.items()},
    )  # fmt: skip


def left_of(p, length):
    """Above zero, and at once above one, where less than LEAST of the free length is left."""
    return 1e6 * (LEAST - length / p.length)


class FixedSpan(Web, abstract=True):
    """Half-model of a web between rollers that stand, with what may end it."""

    @shared
    def damped(p, a, b, before, after, pull):
        """What it would pull with its damping."""
        return with_damping(p, pull, p.length, 0, flows(p, a, b, before, after, pull / p.stiffness))

    cut = Input("1", "Above 1/2 the web is cut.", default=0.0)
    left = Input("m", "Web left on an unwinder; when it is used up, its end comes through.", default=1.0, signed=True)


class WholeSpan(FixedSpan):
    """A span that never tears."""

    asked_with = {"stiffness": 1e5, "damping": 1e5}

    @zone("taut", "slack", "closing")
    def running(p, a, b, before, after, pull, zone):
        """The balance of material."""
        ends = flows(p, a, b, before, after, pull / p.stiffness if zone != "slack" else 0)
        return span(p, pull, zone, p.length, 0, ends)


class WebSpan(FixedSpan):
    """A web between two fixed rollers:  length d(strain)/dt = b.v (1 + strain) - a.v (1 + strain)^2/(1 + before).

    For small strain that is  length d(tension)/dt = stiffness (b.v - a.v) + a.v tension_before - b.v tension, the
    equation of Shelton and Brandenburg. `a` and `b` are the rims of the rollers (an Idler, an Unwinder, a Rack).

    breaking    on: the web tears at `strength`, or is cut by a signal, and its material may be used up; it then has no
                tension for the rest of the run. off: it never tears

    Source: docs/physics.md, 4.9; Shelton 1986; Brandenburg 1977. Limits: strain along the web alone, the same over its
    width; no mass, sag or air; elastic at any time.
    """

    asked_with = {"stiffness": 1e5, "damping": 1e5, "strength": 1e5}
    strength = Parameter("N", "Tension at which the web tears.", default=1e12, above=0, usual=(1, 1e12))
    breaking = Effect("The web tears, is cut, or runs out.", off=WholeSpan)
    zones = Zones("taut", "slack", "closing", "torn", "gone")

    @zone("taut", "slack", "closing")
    def running(p, a, b, before, after, pull, zone):
        """The balance of material."""
        ends = flows(p, a, b, before, after, pull / p.stiffness if zone != "slack" else 0)
        return span(p, pull, zone, p.length, 0, ends)

    @zone("torn")
    def torn(p, a, b, pull):
        """No tension; what the web had stored is lost."""
        e = pull / p.stiffness
        stored = p.length * pull * e / (1 + e) / 2
        lost = p.length * pull * e * (1 + e / 2) / (1 + e) ** 2 / TEARS
        return Law(a=0, b=0, pull=-pull / TEARS, tension=0, elastic=0, strain=0, stored=stored, dissipated=lost)

    @zone("gone")
    def gone(p, a, b, pull):
        """As torn, with nothing stored."""
        return Law(a=0, b=0, pull=-pull / TEARS, tension=0, elastic=0, strain=0)

    @guard("taut", to="torn", unit="N")
    def breaks(p, pull):
        """The tension reaches the strength."""
        return pull - p.strength

    @guard("taut", "closing", to="torn", unit="1")
    def is_cut(p, cut):
        """A signal cuts it."""
        return cut - CUT

    @guard("slack", to="gone", unit="1")
    def is_cut_slack(p, cut):
        """Likewise, without tension."""
        return cut - CUT

    @guard("taut", "closing", to="torn", unit="m")
    def runs_out(p, left):
        """Its end has come off the roll."""
        return -left

    @guard("slack", to="gone", unit="m")
    def runs_out_slack(p, left):
        """Likewise, without tension."""
        return -left


class WebAccumulator(Web):
    """Stores web in `strands` between fixed rollers and the rollers of a moving carriage.

    The free length is  length + strands carriage.x.  The force strands tension draws the carriage back. The tension
    follows from the mass balance of a span,

        length d(strain)/dt = (1 + strain) strands carriage.v - (1 + strain)^2 (a.v/(1 + before) - b.v/(1 + strain))

    Source: P. R. Pagilla and others, IEEE Trans. Industry Applications 37 (2001), 934.

    Limits: rollers inside have no inertia and no friction, so all strands have one tension. A run ends where less than
    a thousandth of `length` is left. With one strand it is one side of a loop round a dancer.
    """

    asked_with = {"stiffness": 1e5, "damping": 1e5, "length": 1e3}
    carriage = Translational("what lengthens the way of the web as x grows")
    strands = Parameter("1", "How often the web runs to the carriage or back.", default=2.0, above=0, usual=(1, 200))
    free = Output("m", "Free length, of all strands together.")
    used_up = Output("1", "Above 1 where less than a thousandth of `length` is left.", role="used_up", of="free")

    @shared
    def damped(p, a, b, carriage, before, after, pull):
        """What it would pull with its damping."""
        length, rate = p.length + p.strands * carriage.x, p.strands * carriage.v
        return with_damping(p, pull, length, rate, flows(p, a, b, before, after, pull / p.stiffness))

    @zone("taut", "slack", "closing")
    def running(p, a, b, carriage, before, after, pull, zone):
        """The balance of material, over a way that changes."""
        length, rate = p.length + p.strands * carriage.x, p.strands * carriage.v
        ends = flows(p, a, b, before, after, pull / p.stiffness if zone != "slack" else 0)
        law = span(p, pull, zone, length, rate, ends, carriage=p.strands)
        return Law(**law.terms, free=length, used_up=left_of(p, length))


def tail_flows(p, a, before, strain):
    """What `flows` tells, of a rope whose other end is a body: material comes and goes at the roller alone."""
    comes, goes = forward(p, a.v) / (1 + before), (a.v - forward(p, a.v)) / (1 + strain)
    half = p.stiffness / 2
    brings, lost = half * (before**2 * comes + strain**2 * goes), half * (strain - before) ** 2 * comes
    return comes + goes, 0, brings, lost, (1 + strain) * (comes + goes) - a.v


def tail(p, a, before, pull, zone, length, rate):
    """Law of a rope whose other end is a body."""
    strain = pull / p.stiffness if zone != "slack" else 0
    return span(p, pull, zone, length, rate, tail_flows(p, a, before, strain))


class RopeTail(Web):
    """A rope or web from a roller to a body that it is fastened to:  S' = q_a,  free length = length + b.x.

    For small strain  length d(tension)/dt = stiffness (b.v - a.v) + a.v tension_before.  What is paid out at `a` lets
    the body go; the force on it is `tension`, back towards the roller. `after` is not read: nothing comes from it.

    Source: docs/physics.md, 4.9. Limits: as of a WebSpan; a run ends where less than a thousandth of `length` is left.
    """

    asked_with = {"stiffness": 1e5, "damping": 1e5, "length": 1e3}
    b = Translational("the body at its end")
    free = Output("m", "Free length.")
    used_up = Output("1", "Above 1 where less than a thousandth of `length` is left.", role="used_up", of="free")

    @shared
    def damped(p, a, b, before, pull):
        """What it would pull with its damping."""
        return with_damping(p, pull, p.length + b.x, b.v, tail_flows(p, a, before, pull / p.stiffness))

    @zone("taut", "slack", "closing")
    def running(p, a, b, before, pull, zone):
        """The balance of material, over a way that the body changes."""
        law = tail(p, a, before, pull, zone, p.length + b.x, b.v)
        return Law(**law.terms, free=p.length + b.x, used_up=left_of(p, p.length + b.x))


class MovingTail(Web):
    """A RopeTail from a roller whose place moves, as that on a ship:  free length = length + b.x - place.x.

    `a` is the rim, as seen from the ship. The rope pulls the body and the place together, each with its tension.

    What the rope on the other side pulls is to be joined with `place` too. Source: as of a RopeTail.

    Limits: those of a RopeTail.
    """

    asked_with = {"stiffness": 1e5, "damping": 1e5, "length": 1e3}
    exempt = {"balance": "the rope also goes through `a`, whose rim moves with the place"}
    b = Translational("the body at its end")
    place = Translational("the ship")
    free = Output("m", "Free length.")
    used_up = Output("1", "Above 1 where less than a thousandth of `length` is left.", role="used_up", of="free")

    @shared
    def damped(p, a, b, place, before, pull):
        """What it would pull with its damping."""
        length, rate = p.length + b.x - place.x, b.v - place.v
        return with_damping(p, pull, length, rate, tail_flows(p, a, before, pull / p.stiffness))

    @zone("taut", "slack", "closing")
    def running(p, a, b, place, before, pull, zone):
        """The balance of material, over a way that both change."""
        length = p.length + b.x - place.x
        law = tail(p, a, before, pull, zone, length, b.v - place.v)
        return Law(**law.terms, place=-law.terms["b"], free=length, used_up=left_of(p, length))

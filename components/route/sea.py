"""The sea end of a route: drag along the line that is in the water, and what it tows."""

import math

from fairlead.components.route.station import Machinery, Station
from fairlead.components.route.tow import Tow

from fairlead.component import Choice, Parameter, Waveform

WATER = 1025.0  # kg/m^3, sea water
LEAST_MARGIN = 5.0  # m; some elements
HANDS_OVER = 2.0  # m over which a node becomes part of the rigid line, slow enough for its neighbours to follow


class Sea(Station):
    """All of the line outboard of `start` is in the sea, which flows past at the speed of the ship.

        drag per length = 1/2 rho C_t pi d |u| u,   u = speed - v      (v: speed of the line, outboard positive)

    At the outboard end of the line pulls `tail` and a drogue, 1/2 rho drogue |u| u (drogue: C_D A), also where that end
    has been hauled out of the water. The route is the frame in which the line moves: if `speed` changes, what the line
    needs to be accelerated with the ship is not in its tension.

    `form: lumped` leaves the drag of all line in the water to the outboard end, for a line that is not modelled as far
    as that: `beyond` is the length in the water outboard of the modelled end at the start. With the modelled line that
    lies in the sea it grows by what is paid out, and falls to none by what is hauled in. Where the sea begins the
    tension is that of the distributed form in steady tow; modelled line outboard of that has this tension to its end.
    The inertia of `beyond` is added to the end.

    `form: rigid` is for a line that travels through the route into the sea: what is further out than `margin` moves
    as one body with the outboard end. Drag, inertia and so the tension in steady tow are those of the distributed form;
    the stretch of the line out there and its waves are not counted, nor the time they cost. Its strain stays as it
    was when it passed the margin, and comes back with it; nodes are taken hold of and let go over 2 m. Hose and core
    are one out there, so that the margin of an array is its longest module and 5 m, unless one is given: a hose
    that has slid off its core in the route is held back by the next connector, and not earlier. Twist stays free.
    """

    word = "Sea"
    as_one = ("form", "rigid", "distributed")
    speed = Waveform("m/s", "Speed of the ship through the water.", default=0.0)
    drag_coefficient = Parameter("1", "Tangential drag coefficient C_t.", default=0.003, least=0)
    density = Parameter("kg/m^3", "Density of the water.", default=WATER, above=0)
    tail = Parameter("N", "Steady pull at the end of the line.", default=0.0, least=0)
    drogue = Parameter("m^2", "Drag area C_D A of a drogue at the end of the line.", default=0.0, least=0)
    form = Choice(("distributed", "rigid", "lumped"), "How the line in the water moves, and where its drag acts.",
                  default="distributed")  # fmt: skip
    margin = Parameter("m", "Line in the water that moves by itself before the rest moves as one, if rigid; 5 m, and "
                       "the longest module of a line with a hose that slips, when not given.",
                       default=None, least=0)  # fmt: skip
    beyond = Parameter("m", "Line in the water outboard of the modelled end, if lumped.", default=0.0, least=0)

    def extent(p):
        """It takes no length of the route."""
        return 0.0

    def span(p, start):
        """All that is outboard of it."""
        return start, math.inf

    def immerses(p):
        """What is outboard of it."""
        return True

    def per_length(p, diameter):
        """1/2 rho C_t pi d [kg/m^2]: drag per length and speed squared."""
        return 0.5 * p.density * p.drag_coefficient * math.pi * diameter

    def flow(p):
        """The speed of the ship."""
        return p.speed

    def drags(p, diameter):
        """Where it acts along the line."""
        return 0.0 if p.form == "lumped" else p.per_length(diameter)

    def dry_at(p, begin, place):
        """Place of the outboard end at which no line is in the water, of a sea that begins at `begin`, if lumped.

        At the start the end is at `place`. Line outboard of an end that is not yet in the water hangs down to it.
        """
        return min(begin, place) - p.beyond if p.beyond else begin

    def tows(p, diameter, begin, place, way):
        """The tail, the drogue, and drag that is lumped at the end."""
        drogue = 0.5 * p.density * p.drogue
        length = max(place + way - p.dry_at(begin, place), 0.0) if p.form == "lumped" else 0.0
        return p.tail, drogue + p.per_length(diameter) * length

    def keeps_apart(p):
        """The margin."""
        return p.margin

    def machinery(p, scene):
        """The speed of the ship, one signal for all nodes."""
        return Machinery({"tow": scene.make(Tow, speed=p.speed)}, outputs={"speed": "tow.through_water"})

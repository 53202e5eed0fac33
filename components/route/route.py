"""A guidance route: devices in order along a path coordinate."""

import itertools
from dataclasses import dataclass
from typing import Any

from fairlead.components.mechanics.ground import Ground
from fairlead.components.route.station import Station

from fairlead.component import Composite, Expansion, Path, Stations
from fairlead.component.piecewise import PiecewisePolynomial, constant, linear_table
from fairlead.component.tables import add
from fairlead.errors import Fault

SHARPEST, ADVISED = 0.5, 0.25  # rad per element; above about 0.25 the capstan error of the mesh shows


class Route(Composite):
    """Stations along a route; s = 0 at the inboard end, growing outboard. Fixed devices only, so far."""

    path = Path("the line that runs along it")
    stations = Stations(Station, "Devices in the order of the route.")

    def check(p):
        """In order, without overlap."""
        placed = sorted(p.stations, key=lambda station: station.start)
        for before, after in itertools.pairwise(placed):
            end = before.start + before.extent()
            if after.start < end:
                what = f"the device at {after.start:g} m begins before the one at {before.start:g} m ends, at {end:g} m"
                yield "stations", what, "Move one of them."

    def expand(p, scene):
        """The fixed surface all devices share; contacts come with the line."""
        return Expansion({"surface": scene.make(Ground)}, [], {}, line=RouteLine(tuple(p.stations)))


@dataclass(frozen=True)
class RouteLine:
    """What a line must know of a route."""

    stations: tuple[Any, ...]

    @property
    def friction(self) -> Any:
        """The curve of the surfaces."""
        return self.stations[0].friction

    def curvature(self, element: float) -> PiecewisePolynomial:
        """Curvature times window along the route [1/m], straight lines between the edges."""
        total = constant(0.0)
        for station in self.stations:
            total = add(total, window(station, element, 1 / station.bend_radius()))
        return total

    def faults(self, element: float, route: Any) -> list[Fault]:
        """What does not go together with a line of such elements."""
        found = []
        if not self.stations:
            found.append(Fault(route.where, f"{route.path}.stations is empty.", "Give at least one device."))
        for k, station in enumerate(self.stations):
            where = f"{route.path}.stations[{k}]"
            radius = station.bend_radius()
            turn = element / radius
            if turn > SHARPEST:
                what = f"{where}: an element of {element:g} m turns through {turn:.2g} rad in a radius of {radius:g} m."
                way_out = f"Use elements of at most {ADVISED * radius:.3g} m ({ADVISED:g} rad)."
                found.append(Fault(route.where, what, way_out))
            if station.extent() < (station.edge or element):
                what = f"{where} is {station.extent():.3g} m long, shorter than its edge."
                found.append(Fault(route.where, what, "Use shorter elements."))
            if repr(station.friction) != repr(self.stations[0].friction):
                what = f"{where}: devices of one route with different friction are not supported yet."
                found.append(Fault(route.where, what, "Give all stations of this route the same friction."))
        return found


def window(station: Any, element: float, height: float) -> PiecewisePolynomial:
    """Trapezoid of the given height over a station; its integral is height times the length of the station."""
    half = (station.edge or element) / 2
    begin, end = station.start, station.start + station.extent()
    return linear_table([begin - half, begin + half, end - half, end + half], [0.0, height, height, 0.0])

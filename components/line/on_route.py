"""What acts on the nodes of a line on a route: contacts and their loads, drums, weight, drag, loops."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Any

from fairlead.components.line.core_element import Core
from fairlead.components.line.hose_element import Hose
from fairlead.components.line.lateral_load import ClampLoad, LateralLoad, PressedLoad, RoundLoad
from fairlead.components.line.laying import Laying
from fairlead.components.line.line_weight import LineWeight
from fairlead.components.line.looped import LoopedCore, LoopedHose, step
from fairlead.components.line.twist_contact import LaidOn, PlanarContact
from fairlead.components.mechanics.mass import Mass
from fairlead.components.mechanics.rigid_link import RigidLink
from fairlead.components.rotation.rack import Rack
from fairlead.components.route.bearing_load import Told
from fairlead.components.route.drum import FastenedEnd, StoredNode, WoundNode
from fairlead.components.route.far_line import FarNode
from fairlead.components.route.placing import Placed
from fairlead.components.route.route_line import RouteLine, Surface
from fairlead.components.route.sea import HANDS_OVER, Sea
from fairlead.components.route.tensioner import Tensioner
from fairlead.components.route.tow import LumpedEnd, SeaDrag, TailEnd
from fairlead.components.route.untouched import Untouched
from fairlead.components.route.winch import Winch
from fairlead.components.route.window import Reach, Window, total

from fairlead.component.assembly import PortRef, with_other

FIXED_DEVICE = 1e9  # kg; what a body bound to a fixed device counts as
SIDES = ("in", "out")


def spread(curve: Any, reach: Reach) -> dict[str, float]:
    """Over what a load is spread on which friction depends: a line has `load_reference` on a metre, not on a node."""
    return {} if curve is None or curve.load_exponent is None else {"extent": reach.length}


@dataclass(frozen=True)
class OnRoute:
    """A line (a `LaidLine`) and the route it is laid on."""

    line: Any
    to: Laying
    path: str  # of the route
    route: RouteLine

    def node(self, i: int) -> None:
        """Contacts and forces of one node."""
        body, reach = f"{self.line.outer}[{i}]", self.line.mesh.reach(i)
        two = bool(self.line.inner) and i not in self.line.mesh.connectors
        bulkhead = (self.line.bulkheads or {}).get(i) if two else None
        surfaces = self.touched
        if i == 0 and any(self.given_by(drum) for drum in self.drums()):  # friction could not change its motion
            surfaces = []
        squeezed = self.clamps(i, body, reach) if surfaces or bulkhead is not None else {}
        slots = [made for one in surfaces if (made := self.contact(*one, i, body, reach, squeezed))]
        if bulkhead is not None:
            self.inner_contact(i, body, bulkhead, self.all_clamps(i, body, bulkhead, squeezed), slots)
        self.readings(i, body, reach)
        self.twist(i, body)
        bodies = [body] + ([f"{self.line.inner}[{i}]"] if two else [])
        for one in bodies:
            if not self.of_rigid_core(i, one):
                self.storage(i, one)
                self.far_out(i, one)
            self.weight(i, one, reach, bodies)
        self.drag(i, body, reach)

    def of_rigid_core(self, i: int, body: str) -> bool:
        """Whether a body moves with the inboard end anyhow, as a node of a core that does not stretch."""
        return self.line.rigid and i > 0 and (body != f"{self.line.outer}[{i}]" or self.line.is_one_body(i))

    @functools.cached_property
    def touched(self) -> list[tuple[Surface, list[Window]]]:
        """Surfaces that a node may touch, with what presses there besides tension; not those that change nothing."""
        wanted = [one for one in self.route.surfaces if self.rubs() or self.sums(one)]
        return [(one, one.pressed(self.line.weight)) for one in wanted]

    @functools.cached_property
    def bends(self) -> list[Window]:
        """All bends, for what lies in the line."""
        return [one.window(one.curvature) for one in self.route.placed if one.curvature]

    @functools.cached_property
    def tubes(self) -> list[Window]:
        """What squeezes without being pressed."""
        return [one.window(load) for one in self.route.placed if (load := one.station.squeeze())]

    @functools.cached_property
    def steep(self) -> list[Placed]:
        """Devices with a slope."""
        return [one for one in self.route.placed if one.station.slope]

    @functools.cached_property
    def reading(self) -> list[tuple[Placed, list[Window]]]:
        """Devices that tell a tension, and where they read it."""
        return [(one, [one.window(counts)]) for one in self.route.placed if (counts := one.station.reads())]

    def rubs(self) -> bool:
        """Whether the line rubs on devices."""
        return bool(self.line.values.device_friction == "on")

    def sums(self, surface: Surface) -> str:
        """The sum of loads that a device keeps, for its bearing, which a line presses on also without friction."""
        return self.route.machinery[surface.name].total if surface.name in self.route.machinery else ""

    def contact(
        self, surface: Surface, pressed: list[Window], i: int, body: str, reach: Reach, squeezed: dict[str, str]
    ) -> str:
        """Loads and contact of a node with one surface; the name of the contact, none where there is no friction."""
        name = f"outer_{surface.name}" if surface.name else "outer"
        load, told = "", [one.name for one, _ in surface.devices]
        if pressed:
            load = self.pressed_load(f"{name}_pressed[{i}]", body, reach, pressed)
        for one in told:
            if one in squeezed:
                load = squeezed[one]
        if surface.curved():
            kind = RoundLoad if surface.all_round else LateralLoad
            curved, layers = surface.curved(), self.line.layers
            load = self.tension_load(f"{name}_load[{i}]", kind, i, body, reach, curved, layers, load)
        if not load:
            return ""
        if self.rubs():
            two = self.line.inner and i not in self.line.mesh.connectors
            masses = {"partner_mass_b": self.to.mass(f"{self.line.inner}[{i}]")} if two else {}
            more = masses | spread(surface.friction, reach)
            self.rub(f"{name}[{i}]", i, f"{self.path}.{surface.flange}", body, load, surface.friction, more)
            self.meter(f"{name}[{i}]")
        if self.sums(surface):
            self.tell(surface.name, f"{name}_tells[{i}]", load)
        return f"{name}[{i}]" if self.rubs() else ""

    def tell(self, station: str, name: str, load: str) -> None:
        """Add the load of a node to the sum of a device, if it keeps one."""
        total_of = self.route.machinery[station].total
        if total_of:
            tells = self.to.child(name, Told)
            self.to.join(f"{load}.force", f"{tells}.value")
            self.to.join_to(f"{tells}.sum", f"{self.path}.{station}.{total_of}")

    def readings(self, i: int, body: str, reach: Reach) -> None:
        """What a node counts in the means of tensions that devices tell."""
        for one, windows in self.reading:
            name = f"reading_{one.name}"
            read = self.tension_load(f"{name}[{i}]", LateralLoad, i, body, reach, windows, self.line.layers, "")
            self.tell(one.name, f"{name}_tells[{i}]", read)

    def rub(self, name: str, i: int, surface: str, body: str, load: str, curve: Any, more: dict[str, float]) -> None:
        """The contact itself; for a line that twists, one in two directions or one in each."""
        p, extent = self.line.values, {name: value for name, value in more.items() if name == "extent"}
        if p.torsion is None or p.planar_slip == "off":
            self.to.contact(name, surface, body, load, curve, more)
        if p.torsion is None:
            return
        if p.planar_slip == "on":
            self.to.child(name, PlanarContact, curve=curve, radius=p.diameter / 2, **extent, **self.to.creep)
            self.to.join_to(f"{name}.a", surface)
            self.to.join(f"{body}.flange", f"{name}.b")
            self.to.join(f"twist[{i}].shaft", f"{name}.turning")
            self.to.join(f"{load}.force", f"{name}.normal")
            return
        if f"{self.to.line.path}.rim[{i}]" not in self.to.assembly.instances:
            self.to.child(f"rim[{i}]", Rack, radius=p.diameter / 2)
            self.to.join(f"twist[{i}].shaft", f"rim[{i}].pinion")
        self.to.contact(f"twist_{name}", self.to.still(), f"rim[{i}]", load, curve, extent, port="rack")

    def inner_contact(self, i: int, body: str, reach: Reach, clamped: str, slots: list[str]) -> None:
        """Bulkhead on hose: pressed by the tension of the core in bends, and by clamps."""
        core, load = f"{self.line.inner}[{i}]", clamped
        if self.bends:
            layers = self.line.layers[1:]
            load = self.tension_load(f"inner_load[{i}]", LateralLoad, i, core, reach, self.bends, layers, clamped)
        if not load:
            return
        curve = self.line.values.bulkhead_friction
        more = {"partner_mass_a": FIXED_DEVICE} | spread(curve, reach)
        self.to.contact(f"inner[{i}]", f"{self.to.line.path}.{body}.flange", core, load, curve, more)
        self.meter(f"inner[{i}]")
        if slots:
            self.to.exchange(slots[0], "bound_b", f"inner[{i}]")
            self.to.exchange(f"inner[{i}]", "bound_a", slots[0])

    def meter(self, contact: str) -> None:
        """What counts slip and work, if the line wants it."""
        if self.line.meter is not None:
            name, _, number = contact.partition("[")
            meter = self.to.child(f"{name}_meter[{number}", self.line.meter)
            self.to.join(f"{contact}.slip", f"{meter}.slip")
            self.to.join(f"{contact}.friction", f"{meter}.friction")

    def tension_load(
        self, name: str, kind: Any, i: int, body: str, reach: Reach, curved: list[Window],
        layers: tuple[str, ...], more: str,
    ) -> str:  # fmt: skip
        """A load fed by the tensions of the elements on both sides."""
        beside = self.line.mesh.neighbours(i)
        table = self.table(reach, *curved)
        heavy = self.line.heavy(layers)
        load = self.to.child(name, kind, curvature=table, share=1 / len(beside), **heavy)
        self.between(load, i, body, reach)
        for layer, entry in zip(layers, ("hose", "core")[-len(layers) :], strict=True):
            for element in beside:
                self.to.join(f"{layer}[{element}].tension", f"{load}.{entry}_{SIDES[element - i + 1]}")
        if more:
            self.to.join(f"{more}.force", f"{load}.more")
        return load

    def between(self, load: str, i: int, body: str, reach: Reach) -> None:
        """Join a load that counts the arc of its node with the node and those beside it, all of one layer."""
        behind, ahead = self.line.mesh.beside(i, reach)
        layer = body.partition("[")[0]
        for port, node in (("behind", behind), ("flange", i), ("ahead", ahead)):
            self.to.join(f"{load}.{port}", f"{layer}[{node}].flange")

    def pressed_load(self, name: str, body: str, reach: Reach, windows: list[Window]) -> str:
        """A load that does not come from tension."""
        load = self.to.child(name, PressedLoad, load=self.table(reach, *windows), length=reach.length)
        self.to.join(f"{load}.flange", f"{body}.flange")
        return load

    def clamps(self, i: int, body: str, reach: Reach) -> dict[str, str]:
        """Load of every clamping device on a node, by its name."""
        made = {}
        for one, output in self.route.squeezing():
            window = self.table(reach, one.window())
            load = self.to.child(f"clamp_{one.name}[{i}]", ClampLoad, window=window, length=reach.length)
            self.to.join(f"{load}.flange", f"{body}.flange")
            self.to.join_to(f"{load}.pressing", f"{self.path}.{output}")
            made[one.name] = load
        return made

    def all_clamps(self, i: int, body: str, reach: Reach, squeezed: dict[str, str]) -> str:
        """What squeezes a bulkhead: of one clamp the load on its node, of several their chain; tubes too."""
        tubes = self.tubes
        if len(squeezed) <= 1 and not tubes and reach == self.line.mesh.reach(i):
            return next(iter(squeezed.values()), "")
        load = ""
        if tubes:
            load = self.pressed_load(f"inner_pressed[{i}]", body, reach, tubes)
        for one, output in self.route.squeezing():
            window = self.table(reach, one.window())
            again = self.to.child(f"inner_clamp_{one.name}[{i}]", ClampLoad, window=window, length=reach.length)
            self.to.join(f"{again}.flange", f"{body}.flange")
            self.to.join_to(f"{again}.pressing", f"{self.path}.{output}")
            if load:
                self.to.join(f"{load}.force", f"{again}.more")
            load = again
        return load

    def storage(self, i: int, body: str) -> None:
        """The bond with the drum."""
        for one in self.route.of_type(Winch):
            made, station = self.route.machinery[one.name], one.station
            given = {"place": one.end, "lock": station.lock, "edge": station.edge or 0.1}
            name = self.of_layer("stored", body, i)
            if i == 0 and one in self.drums():
                self.fasten(body, f"{self.path}.{one.name}.{made.surface}", one.end)
                continue
            if station.layers == "off":
                stored = self.to.child(name, StoredNode, **given)
                self.to.join_to(f"{stored}.rim", f"{self.path}.{one.name}.{made.surface}")
            else:
                stored = self.to.child(name, WoundNode, **given)
                self.to.join_to(f"{stored}.drum", f"{self.path}.{one.name}.{made.surface}")
                self.to.join_to(f"{stored}.radius", f"{self.path}.{one.name}.layers.radius_now")
            self.to.join(f"{stored}.node", f"{body}.flange")

    def far_out(self, i: int, body: str) -> None:
        """The bond with the outboard end, where the line out in the sea is to move as one body with it."""
        last = self.line.mesh.elements
        for one in self.route.of_type(Sea):
            if one.station.moves_as_one() and i != last:
                place = self.line.rigid_from(one.begin, one.station) + HANDS_OVER / 2
                bond = self.to.child(self.of_layer("far", body, i), FarNode, place=place, edge=HANDS_OVER)
                self.to.join(f"{bond}.end", f"{self.line.outer}[{last}].flange")
                self.to.join(f"{bond}.node", f"{body}.flange")

    def of_layer(self, word: str, body: str, i: int) -> str:
        """Name of what acts on one body of a node: of a line with two layers, with the name of its own."""
        return f"{word}_{body.partition('_')[0]}[{i}]" if self.line.inner else f"{word}[{i}]"

    def drums(self) -> list[Placed]:
        """The drum that the inboard end of the line is fastened to, if it is."""
        winches = self.route.of_type(Winch)
        return [one for one in winches if one.station.layers == "off" and self.line.values.start < one.end]

    def given_by(self, drum: Placed) -> bool:
        """Whether the motion of a drum's rim is given."""
        instance, _, port = f"{self.path}.{drum.name}.{self.route.machinery[drum.name].surface}".rpartition(".")
        return PortRef(instance, port) in self.to.prescribed

    def fasten(self, body: str, rim: str, place: float) -> None:
        """The inboard end of a line that lies on the drum is fastened to it: one body, which holds all tension."""
        link = self.to.child("fastening", RigidLink, length=self.line.values.start)
        self.to.join_to(f"{link}.a", rim)
        self.to.join(f"{link}.b", f"{body}.flange")
        self.to.join(f"{self.to.child('on_drum', FastenedEnd, place=place)}.node", f"{body}.flange")

    def twist(self, i: int, body: str) -> None:
        """What holds the twist of a line on the drum; and its rim, where friction in turning acts by itself."""
        p = self.line.values
        if p.torsion is None:
            return
        for one in self.route.of_type(Winch):
            if one.station.layers == "off":
                drum = {"place": one.end, "edge": one.station.edge or 0.1, "lay": one.station.lay}
                laid = self.to.child(f"laid[{i}]", LaidOn, **drum)
                self.to.join(f"twist[{i}].shaft", f"{laid}.node")
                self.to.join(f"{body}.flange", f"{laid}.along")
                self.to.join_to(f"{laid}.rim", f"{self.path}.{one.name}.{self.route.machinery[one.name].surface}")

    def weight(self, i: int, body: str, reach: Reach, bodies: list[str]) -> None:
        """Weight along the slope, divided between the layers by mass."""
        weight = self.line.weight
        steep = self.steep
        if not weight or not steep:
            return
        share = self.to.mass(body) / sum(map(self.to.mass, bodies))
        windows = [one.window(weight * share * math.sin(one.station.slope)) for one in steep]
        name = self.of_layer("weight", body, i)
        child = self.to.child(name, LineWeight, fall=self.table(reach, *windows), length=reach.length)
        self.to.join(f"{child}.node", f"{body}.flange")

    def drag(self, i: int, body: str, reach: Reach) -> None:
        """Drag of the sea."""
        for one in self.route.of_type(Sea):
            per_length = one.station.drags(self.line.diameter)
            if per_length > 0:
                window = self.table(reach, one.window())
                child = self.to.child(f"drag[{i}]", SeaDrag, window=window, per_length=per_length, length=reach.length)
                self.to.join(f"{child}.node", f"{body}.flange")
                self.to.join_to(f"{child}.speed", f"{self.path}.{one.name}.tow.through_water")

    def ends(self) -> None:
        """What pulls at the outboard end; and how much lies on the drum at the start."""
        p, last = self.line.values, self.line.mesh.elements
        for one in self.route.of_type(Sea):
            s, end = one.station, f"{self.line.outer}[{last}].flange"
            pull = {"tail": s.tail, "drogue": 0.5 * s.density * s.drogue}
            if s.form == "lumped":
                pull |= {"per_length": s.per_length(p.diameter), "dry": s.dry_at(one.begin, p.start + p.length)}
            child = self.to.child("tail", LumpedEnd if s.form == "lumped" else TailEnd, **pull)
            self.to.join(f"{child}.node", end)
            if s.form == "lumped" and s.beyond:
                self.to.join(f"{self.to.child('behind', Mass, mass=sum(self.line.masses) * s.beyond)}.flange", end)
            self.to.join_to(f"{child}.speed", f"{self.path}.{one.name}.tow.through_water")
        for one in self.route.of_type(Winch):
            if one.station.layers == "on":
                wound = one.station.filled + max(one.end - p.start, 0.0)
                path, instances = f"{self.path}.{one.name}.layers", self.to.assembly.instances
                radius = one.station.wound(p.diameter).over_angle(wound, one.station.crossover)
                instances[path] = with_other(instances[path], radius=radius)

    def loops(self) -> None:
        """Elements that run through a tensioner take the loop into their stretch."""
        looped = {Hose: LoopedHose, Core: LoopedCore}
        instances, path = self.to.assembly.instances, self.to.line.path
        for one in self.route.of_type(Tensioner):
            table = step(one.begin, one.station.edge or max(self.line.mesh.lengths))
            for layer in self.line.layers:
                for k in range(self.line.mesh.elements):
                    old = instances[f"{path}.{layer}[{k}]"].values
                    given = {name: old.given[name] for name in ("axial_stiffness", "length", "damping", "line_damping")}
                    self.to.child(f"{layer}[{k}]", looped[old.type], **given, behind=table, ahead=table)
                    self.to.join_to(f"{layer}[{k}].carriage", f"{self.path}.{one.name}.carriage.flange")

    def bare(self) -> None:
        """Surfaces that no node can touch: standing ones, as guides of a line without weight, need no ground."""
        ground = f"{self.path}.surface"
        asked = {ground, *(f"{self.path}.{name}.{one.surface}".rpartition(".")[0]
                           for name, one in self.route.machinery.items())}  # fmt: skip
        joined = {ref for join in self.to.assembly.joins for ref in join.ports if ref.instance in asked}
        if not any(ref.instance == ground for ref in joined):
            self.to.assembly.instances.pop(ground, None)
        for name, mover in self.route.machinery.items():
            instance, _, port = f"{self.path}.{name}.{mover.surface}".rpartition(".")
            if mover.surface and PortRef(instance, port) not in joined:
                self.to.child(f"untouched_{name}", Untouched)
                self.to.join_to(f"untouched_{name}.surface", f"{instance}.{port}")

    def table(self, reach: Reach, *windows: Window) -> Any:
        """The sum of windows; the same table for all nodes of the same reach."""
        return _table(windows, reach)


@functools.lru_cache(maxsize=4096)
def _table(windows: tuple[Window, ...], reach: Reach) -> Any:
    return total(windows, reach)

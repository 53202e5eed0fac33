"""Adds children to a line that was expanded already, and joins them."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.ground import Ground

from fairlead.component.assembly import HandedOn, Join, PortRef, of_classes
from fairlead.component.declare import Input
from fairlead.component.values import Values


@dataclass(frozen=True)
class Laying:
    """The assembly, and the line whose children are added. Names of children are those below the line."""

    assembly: Any
    line: Any
    shared: dict[Any, Any] = field(default_factory=dict)

    def child(self, name: str, kind: type, **given: Any) -> str:
        """Add a child of a type; returns its name."""
        self.assembly.add(self.below + name, self.made(kind, **given), self.line.where)
        return name

    def contact(
        self, name: str, a: str, body: str, load: str, curve: Any, more: dict[str, float], port: str = "flange"
    ) -> None:
        """A contact as the scene's friction block treats it, between the port `a` (a full path) and a body.

        `more` are parameters that it takes if its treatment has them.
        """
        known = {key: value for key, value in more.items() if key in self.contact_takes}
        self.child(name, Contact, curve=curve, **known)
        self.join_to(f"{name}.a", a)
        self.join(f"{body}.{port}", f"{name}.b")
        self.join(f"{load}.force", f"{name}.normal")

    @functools.cached_property
    def contact_takes(self) -> Mapping[str, Any]:
        """Parameters of a contact as the scene's friction block treats it."""
        return self.assembly.scene.member(Contact, {}).declaration.parameters

    @functools.cached_property
    def below(self) -> str:
        """What the paths of its children begin with."""
        return f"{self.line.path}."

    def made(self, kind: type, **given: Any) -> Any:
        """Values of a child; equal children of a line share theirs."""
        key = (kind, *((name, value if isinstance(value, float) else id(value)) for name, value in given.items()))
        if key not in self.shared:
            self.shared[key] = self.assembly.scene.make(kind, **given)
            if any(isinstance(value, Values) for value in given.values()):
                self.assembly.handed_on.append(HandedOn(self.shared[key], kind, given))
        return self.shared[key]

    def exchange(self, name: str, entry: str, other: str) -> None:
        """Tell a contact whether the other one of its body is bound, if its treatment counts that."""
        has = self.assembly.instances[f"{self.line.path}.{name}"]
        counts = getattr(has.values, "applied_force", None) == "aggregate"
        if counts and isinstance(has.type.declaration.inputs.get(entry), Input):
            self.join(f"{other}.bound", f"{name}.{entry}")

    def join(self, one: str, two: str) -> None:
        """Connect two children."""
        self._join(self._inner(one), self._inner(two))

    def join_to(self, one: str, path: str) -> None:
        """Connect a child with something outside the line, by its full path."""
        instance, _, port = path.rpartition(".")
        self._join(self._inner(one), PortRef(instance, port))

    def _inner(self, text: str) -> PortRef:
        child, _, port = text.rpartition(".")
        return PortRef(self.below + child, port)

    def _join(self, *refs: PortRef) -> None:
        self.assembly.joins.append(Join(refs, self.line.where))

    def still(self) -> str:
        """A fixed point of the line's own, by its full path."""
        path = f"{self.line.path}.still"
        if path not in self.assembly.instances:
            self.child("still", Ground)
        return f"{path}.flange"

    @functools.cached_property
    def creep(self) -> dict[str, Any]:
        """The creep that the scene tolerates, if it says so."""
        said = self.assembly.scene.friction.get("creep")
        return {} if said is None else {"creep": said.plain()}

    def mass(self, name: str) -> float:
        """Mass of a node [kg]."""
        return float(self.assembly.instances[f"{self.line.path}.{name}"].values.mass)

    @functools.cached_property
    def prescribed(self) -> set[PortRef]:
        """Ports whose motion is given: those of motion sources, and what links, racks and gears tie to them."""
        given, tied = [], [join.ports for join in self.assembly.joins]
        for instance in of_classes(self.assembly.instances.values(), _prescribes_or_ties):
            path, says = instance.path, instance.type.answers
            given += [PortRef(path, port) for port in (says.prescribes() if says.prescribes is not None else ())]
            ties = says.ties(instance.values) if says.ties is not None else ()
            tied += [(PortRef(path, a), PortRef(path, b)) for a, b, *_ in ties]
        found = set(given)
        if not given:
            return found
        beside: dict[PortRef, list[tuple[PortRef, ...]]] = {}
        for ports in tied:
            for port in ports:
                beside.setdefault(port, []).append(ports)
        while given:
            more = {port for ports in beside.get(given.pop(), ()) for port in ports} - found
            found |= more
            given += more
        return found


def _prescribes_or_ties(kind: type) -> bool:
    return any(said is not None for said in (kind.answers.prescribes, kind.answers.ties))  # type: ignore[attr-defined]

"""What stands behind a flange that moves a line: a given speed, a force, a kept tension, nothing, or who knows.

From the flange all bodies are looked at that move with it, through gears (one degree of freedom), springs and teeth.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.statics.tracing import Traced, answer, trace
from fairlead.component.assembly import Instance, PortRef
from fairlead.component.values import Wave, steady
from fairlead.flatten.flat_model import FlatModel


@dataclass(frozen=True)
class Machine:
    """What acts at a port: one of speed, tension, efforts; nothing of all that: it is free, or `unknown`.

    `ratios` tells for each group of bodies that moves with the port how fast it does; `inertia` is that of all of them
    at the port, and is sped up by the line unless it is `paced`: driven with the line's speed. `left_out` names what
    acts on them and is not counted, such as brakes and dampers.
    """

    port: PortRef
    ratios: dict[int, float]
    inertia: float
    speed: Wave | None = None
    tension: float | None = None
    efforts: tuple[tuple[Instance, str, float, Wave | None], ...] = ()
    unknown: bool = False
    by: str = ""
    left_out: tuple[str, ...] = field(default=())
    paced: bool = False

    @property
    def drives(self) -> bool:
        """True when it takes whatever force its motion needs."""
        return self.speed is not None or self.unknown

    def effort(self, t: float, speed: float = 0.0) -> float:
        """Force (or torque) that it gives at the port, towards + [N, N m]."""
        total = 0.0
        for instance, port, ratio, told in self.efforts:
            inputs = {} if told is None else dict.fromkeys(instance.type.declaration.inputs, told(t))
            taken = answer(instance, port, t=t, rate=speed * ratio, inputs=inputs)
            total -= ratio * (taken or 0.0)
        return total

    def corners(self) -> list[float]:
        """Instants at which what acts changes its course [s]."""
        waves = [told for _, _, _, told in self.efforts if told is not None]
        given = [one for instance, *_ in self.efforts for one in instance.values.given.values()]
        waves += [one for one in given if isinstance(one, Wave)]
        return [t for wave in waves for t in wave.borders]


def bodies(flat: FlatModel, port: PortRef, without: tuple[str, ...] = ()) -> dict[int, float]:
    """Groups of bodies that move with a port in steady motion, and how fast they do when it moves with 1."""
    group, ratio, _ = flat.place(port)
    ratios, waiting = {group: 1 / ratio}, [group]
    while waiting:
        here = waiting.pop()
        for instance, name, own in _attached(flat, here, without):
            if not instance.type.answers.transmits:
                continue
            (other,) = (end for end in instance.type.declaration.ports if end != name)
            beyond, other_ratio, _ = flat.place(PortRef(instance.path, other))
            if beyond not in ratios:
                ratios[beyond] = own * ratios[here] / other_ratio
                waiting.append(beyond)
    return ratios


def machine(flat: FlatModel, port: PortRef, line: str, route: str) -> Machine:
    """What stands behind `port`; instances that belong to the line or the route (their paths) do not count."""
    without = (line, route)
    ratios = bodies(flat, port, without)
    efforts: list[tuple[Instance, str, float, Wave | None]] = []
    unknown: list[str] = []
    left_out: list[str] = []
    speed: Wave | None = None
    tension: float | None = None
    by = ""
    for here, ratio in ratios.items():
        prescribed = flat.groups[here].prescribed
        if prescribed is not None:
            speed, by = _prescribed(flat, prescribed, ratio), prescribed.by.instance
            unknown += [by] if speed is None else []
        for instance, name, own in _attached(flat, here, without):
            if instance.type.answers.transmits:
                continue
            if len(instance.type.declaration.ports) > 1:
                (left_out if _mechanical(instance) else unknown).append(instance.path)
                continue
            found = _effort(flat, instance, name)
            if found is None:
                unknown.append(instance.path)
            elif found.kept is not None:
                tension, by = found.kept, found.by
            else:
                efforts.append((instance, name, own * ratio, found.told()))
    inertia = sum(_inertia(flat, g, line) * r**2 for g, r in ratios.items())
    held = _controlled(flat, ratios) if speed is None else None
    if held is not None:
        speed, tension, by = held.told(), held.kept, held.by
    at_a_loss = bool(unknown) and speed is None and tension is None
    acting = tuple(one for one in efforts if _acts(one)) if speed is None and tension is None and not unknown else ()
    by = by or (unknown[0] if at_a_loss else acting[0][0].path if acting else "")
    paced = held is not None and tension is not None
    return Machine(port, ratios, inertia, speed, tension, acting, at_a_loss, by, tuple(dict.fromkeys(left_out)), paced)


def _prescribed(flat: FlatModel, prescribed: Any, ratio: float) -> Wave | None:
    """Speed of the port when its group is driven as given; None for a class that does not tell its motion."""
    if prescribed.outputs is None:
        return steady(0.0)
    source = flat.assembly.instances[prescribed.by.instance]
    _, own, _ = flat.place(prescribed.by)
    if not source.type.answers.moves_as:
        return None
    moves: Wave = getattr(source.values, source.type.answers.moves_as)
    return moves.derivative().scaled(1 / (own * ratio))


def _inertia(flat: FlatModel, group: int, line: str) -> float:
    """Inertia of a group without what the line itself brings to it."""
    made, own = flat.groups[group], 0.0
    for node, ratio in zip(made.nodes, made.ratios, strict=True):
        for ref in flat.nodes[node].ports:
            instance = flat.assembly.instances[ref.instance]
            inertia = instance.type.answers.inertia
            if ref.instance.startswith(f"{line}.") and inertia is not None:
                own += ratio**2 * inertia(instance.values).get(ref.port, 0.0)
    return made.mass - own


def _attached(flat: FlatModel, group: int, without: tuple[str, ...]) -> list[tuple[Instance, str, float]]:
    """(instance, its port, speed of the port over that of the group) of all that is joined to a group."""
    made = flat.groups[group]
    found = []
    for node, ratio in zip(made.nodes, made.ratios, strict=True):
        for ref in flat.nodes[node].ports:
            instance = flat.assembly.instances[ref.instance]
            inside = any(ref.instance.startswith(f"{path}.") for path in without)
            says = instance.type.answers
            if not (inside or says.ties or says.prescribes or says.inertia):
                found.append((instance, ref.port, ratio))
    return found


def _mechanical(instance: Instance) -> bool:
    return all(port.domain.mechanical for port in instance.type.declaration.ports.values())


def _effort(flat: FlatModel, instance: Instance, port: str) -> Traced | None:
    """Something with one flange: its input in time, if it has one; None when its force cannot be told."""
    inputs = list(instance.type.declaration.inputs)
    if answer(instance, port) is None or len(inputs) > 1:
        return None
    found = trace(flat, PortRef(instance.path, inputs[0])) if inputs else Traced(instance.path)
    return None if found is None or found.senses is not None else found


def _acts(effort: tuple[Instance, str, float, Wave | None]) -> bool:
    """False for what only looks on, such as a sensor."""
    instance, port, _, told = effort
    if told is not None or any(isinstance(one, Wave) for one in instance.values.given.values()):
        return True
    return bool(answer(instance, port, rate=1.0)) or bool(answer(instance, port))


def _controlled(flat: FlatModel, ratios: dict[int, float]) -> Traced | None:
    """A controller that makes the speed of one of these bodies follow a reference; told as the speed of the port."""
    for instance in flat.instances:
        follows = instance.type.answers.follows
        if follows is None:
            continue
        reference, measured = (trace(flat, PortRef(instance.path, name)) for name in follows)
        if reference is None or measured is None or measured.senses is None:
            continue
        group, ratio, _ = flat.place(measured.senses)
        if group not in ratios:
            continue
        if reference.kept is not None:
            return reference
        told = reference.told()
        if told is not None:
            slope = measured.factor * ratio * ratios[group]
            return Traced(instance.path, wave=told.scaled(1 / slope, -measured.offset / slope))
    return None

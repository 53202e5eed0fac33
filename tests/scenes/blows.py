"""Random blows: bodies that run into each other through rigid stops, ropes and walls that jump, held by friction.

Beside the netlist a scene says what it is made of, so that a test can work out each impact by itself.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

from tests.scenes.sketch import Sketch


@dataclass
class Stop:
    """b.x - a.x >= length; a body by its name, WALL for what is prescribed, FLOOR for what stands."""

    name: str
    a: str
    b: str
    length: float


@dataclass
class Blow:
    """A scene: its netlist, and what decides its impacts."""

    text: str = ""
    mass: dict[str, float] = field(default_factory=dict)
    stops: list[Stop] = field(default_factory=list)
    links: list[tuple[str, str]] = field(default_factory=list)
    rubs: list[tuple[str, str, float]] = field(default_factory=list)
    """Body that rubs on the floor, the stop whose force presses it, coefficient."""


WALL, FLOOR = "wall", "floor"


def blow(seed: int) -> Blow:
    """A random scene with impacts. The seed says its kind as well, so that neighbours differ."""
    s, scene = Sketch("blow", seed), Blow()
    KINDS[seed % len(KINDS)](s, scene)
    _rest(s, scene)
    engine, accuracy = s.pick("rodas", "rodas", "ida"), s.pick("1e-5", "1e-6")
    run = f"stop: {s.number(0.6, 1.2)} s, accuracy: {accuracy}, engine: {engine}"
    scene.text = s.text(friction="method: hold", run=run, every="10 ms").replace(", every", ", every")
    return scene


def _body(s: Sketch, scene: Blow, name: str, at: float, speed: float) -> str:
    """A body at a place, with a speed."""
    mass = s.number(0.2, 5)
    s.add(name, "Mass", mass=f"{mass} kg", position=f"{at!r} m", velocity=f"{speed!r} m/s")
    scene.mass[name] = float(mass)
    return name


def _port(s: Sketch, name: str) -> str:
    if name == FLOOR:
        s.add(FLOOR, "Ground")
    return f"{name}.flange"


def _stop(s: Sketch, scene: Blow, a: str, b: str, length: float = 0.0) -> Stop:
    """A rigid stop between two bodies."""
    stop = Stop(f"stop{len(scene.stops)}", a, b, length)
    s.add(stop.name, "RigidStop", length=f"{length!r} m")
    s.join(_port(s, a), f"{stop.name}.a")
    s.join(_port(s, b), f"{stop.name}.b")
    scene.stops.append(stop)
    return stop


def _row(s: Sketch, scene: Blow, count: int) -> list[str]:
    """Bodies one behind the other with gaps, some of which are closed; they go towards the first."""
    at, names = 0.0, []
    for i in range(count):
        speed = -float(s.number(0.3, 4)) if i and s.maybe(0.7) else 0.0
        names.append(_body(s, scene, f"block{i}", at, speed if i == 0 or at > 0 else 0.0))
        if s.maybe(0.7):
            at += float(s.number(0.02, 0.5))
    return names


def _chain(s: Sketch, scene: Blow) -> None:
    """A row with stops between neighbours, now and then a wall before the first."""
    names = _row(s, scene, s.many(2, 3, 4, 6))
    for a, b in itertools.pairwise(names):
        _stop(s, scene, a, b)
    if s.maybe(0.5):
        _stop(s, scene, FLOOR, names[0], -float(s.number(0.02, 0.3)))


def _tree(s: Sketch, scene: Blow) -> None:
    """Each body stops at one before it, not always its neighbour."""
    names = _row(s, scene, s.many(3, 4, 6))
    for i in range(1, len(names)):
        _stop(s, scene, names[s.random.randrange(max(0, i - 2), i)], names[i])


def _ring(s: Sketch, scene: Blow) -> None:
    """Two ways from the first to the last: four stops that may all touch, of which three are enough."""
    gap, tight = float(s.number(0.02, 0.3)), s.maybe(0.5)
    first = _body(s, scene, "first", 0.0, float(s.number(0.3, 3)))
    ways = [_body(s, scene, f"way{k}", gap if tight else gap * (1 + k), 0.0) for k in range(2)]
    last = _body(s, scene, "last", gap if tight else 3 * gap, -float(s.number(0.3, 3)) if s.maybe(0.5) else 0.0)
    for way in ways:
        _stop(s, scene, first, way)
        _stop(s, scene, way, last)


def _doubled(s: Sketch, scene: Blow) -> None:
    """Stops side by side between the same bodies."""
    names = _row(s, scene, s.many(2, 3))
    for a, b in itertools.pairwise(names):
        for _ in range(s.pick(1, 2, 3)):
            _stop(s, scene, a, b)


def _rope(s: Sketch, scene: Blow) -> None:
    """Bodies that run apart until ropes that do not stretch are taut."""
    count = s.many(2, 3, 4)
    speed = 0.0
    names = []
    for i in range(count):
        names.append(_body(s, scene, f"bead{i}", 0.1 * i, speed))
        speed = speed + float(s.number(0.1, 3)) if s.maybe(0.6) else 0.0
    for i, (a, b) in enumerate(itertools.pairwise(names)):
        _stop(s, scene, b, a, -0.1 - float(s.number(0.01, 0.2)))
        if s.maybe(0.4):
            _stop(s, scene, a, b, 0.05)
        if i == 0 and s.maybe(0.3):
            _stop(s, scene, names[0], FLOOR, -float(s.number(0.05, 0.3)))


def _kicked(s: Sketch, scene: Blow) -> None:
    """A wall whose speed jumps drives a row that touches it or comes near."""
    speed, when = float(s.number(0.3, 3)), s.number(0.05, 0.2)
    jump = s.pick(f"{{step: {{to: {speed} m/s, at: {when} s}}}}", f"{speed} m/s")
    s.add(WALL, "MotionSource", velocity=jump, origin="0 m")
    names = _row(s, scene, s.many(1, 2, 4))
    _stop(s, scene, WALL, names[0], 0.0 if "step" in jump and s.maybe(0.6) else -float(s.number(0.02, 0.3)))
    for a, b in itertools.pairwise(names):
        _stop(s, scene, a, b)


def _scraped(s: Sketch, scene: Blow) -> None:
    """A row whose blows press others against the floor that slide along it: |P_t| <= mu P_n."""
    names = _row(s, scene, s.many(2, 3))
    stops = [_stop(s, scene, a, b) for a, b in itertools.pairwise(names)]
    for i in range(s.pick(1, 2)):
        slider = _body(s, scene, f"slider{i}", 0.0, s.random.choice([-1, 1]) * float(s.number(0.05, 3)))
        stop, mu = s.pick(*stops), s.number(0.1, 0.8)
        s.add(f"rub{i}", "Contact", curve=mu)
        s.join(_port(s, FLOOR), f"rub{i}.a")
        s.join(_port(s, slider), f"rub{i}.b")
        s.join(f"{stop.name}.force", f"rub{i}.normal")
        scene.rubs.append((slider, stop.name, float(mu)))


def _rest(s: Sketch, scene: Blow) -> None:
    """Friction under the bodies, forces that press them, and rigid links that carry on what they take."""
    sliders = {slider for slider, _, _ in scene.rubs}
    bodies = [name for name in scene.mass if name not in sliders]
    if s.maybe(0.4):
        host = s.pick(*bodies)
        text = s.parts[host]
        at, v = (text.split(f"{key}: ")[1].split(",")[0].rstrip("}") for key in ("position", "velocity"))
        mass = s.number(0.2, 5)
        s.add("tail", "Mass", mass=f"{mass} kg", position=at, velocity=v)
        s.add("gauge", "ForceSensor")
        s.join(f"{host}.flange", "gauge.a")
        s.join("tail.flange", "gauge.b")
        scene.mass["tail"] = float(mass)
        scene.links.append((host, "tail"))
    for name in bodies:
        if s.maybe(0.5):
            load = s.number(1e-3, 30)
            s.add(f"pad_{name}", "Contact", normal_force=f"{load} N", curve=s.curve())
            s.join(_port(s, FLOOR), f"pad_{name}.a")
            s.join(_port(s, name), f"pad_{name}.b")
        if s.maybe(0.4):
            s.add(f"push_{name}", "ForceSource", force=f"{s.random.choice([-1, 1]) * float(s.number(0.1, 10))} N")
            s.join(_port(s, name), f"push_{name}.flange")


KINDS = (_chain, _tree, _ring, _doubled, _rope, _kicked, _scraped)

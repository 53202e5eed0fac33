"""Random catches: bodies that slide until friction holds them: on the ground, on belts that jump, in clutches."""

from __future__ import annotations

import itertools

from tests.scenes.sketch import Sketch


def catch(seed: int) -> str:
    """The netlist of a scene in which contacts catch what slides. The seed says its kind as well."""
    s = Sketch("catch", seed)
    KINDS[seed % len(KINDS)](s)
    return s.text(friction="method: hold", run=f"stop: {s.number(0.6, 1.2)} s", every="10 ms")


def _floor(s: Sketch) -> str:
    return s.add("floor", "Ground") + ".flange"


def _thrown(s: Sketch, name: str, most: float = 2.0) -> str:
    """A body that has a speed at the start, and where it is joined."""
    speed = s.pick("", "-") + s.number(0.05, most)
    return s.add(name, "Mass", mass=f"{s.number(0.2, 5)} kg", velocity=f"{speed} m/s") + ".flange"


def _rub(s: Sketch, name: str, a: str, b: str) -> None:
    s.add(name, "Contact", normal_force=f"{s.number(3, 40)} N", curve=s.curve())
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _spring(s: Sketch, name: str, a: str, b: str) -> None:
    s.add(name, "SpringDamper", stiffness=f"{s.number(50, 5000)} N/m", damping=f"{s.number(0.1, 10)} N*s/m")
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _push(s: Sketch, bodies: list[str], size: float) -> None:
    for k in range(s.pick(0, 1, 2)):
        s.add(f"push{k}", "ForceSource", force=s.wave(size, "N"))
        s.join(s.pick(*bodies), f"push{k}.flange")


def _slide(s: Sketch) -> None:
    """Bodies thrown along the floor, tied in a row here and there: one comes to rest after the other."""
    bodies = [_thrown(s, f"block{i}") for i in range(s.many(1, 2, 4, 7))]
    for i, body in enumerate(bodies):
        _rub(s, f"pad{i}", _floor(s), body)
    for i, (a, b) in enumerate(itertools.pairwise(bodies)):
        if s.maybe(0.6):
            _spring(s, f"tie{i}", a, b)
    _push(s, bodies, 10.0)


def _pile(s: Sketch) -> None:
    """Plates on each other with speeds of their own: each is caught between two that may still slide."""
    bodies = [_thrown(s, f"plate{i}") for i in range(s.many(2, 3, 5))]
    for i, (a, b) in enumerate(zip([_floor(s), *bodies], bodies)):
        _rub(s, f"face{i}", a, b)
    _push(s, bodies, 15.0)


def _belt(s: Sketch) -> None:
    """A belt whose speed jumps tears loose what it carries, and catches it again."""
    speeds = [f"{s.pick('', '-')}{s.number(0.05, 1)}" for _ in range(2)]
    if s.maybe(0.6):
        speed = f"{{constant: {speeds[0]} m/s, step: {{to: {speeds[1]} m/s, at: {s.number(0.1, 0.4)} s}}}}"
    else:
        speed = s.wave(0.5, "m/s")
    s.add("belt", "MotionSource", velocity=speed)
    bodies = [_thrown(s, f"block{i}", 0.5) for i in range(s.many(1, 2, 3, 5))]
    below = "belt.flange"
    for i, body in enumerate(bodies):
        _rub(s, f"pad{i}", below if s.maybe(0.3) else "belt.flange", body)
        below = body
        if s.maybe(0.4):
            _spring(s, f"tie{i}", _floor(s), body)
    _push(s, bodies, 10.0)


def _clutches(s: Sketch) -> None:
    """Shafts of different speeds that clutches bring to one, with brakes here and there."""
    shafts = []
    for i in range(s.many(2, 2, 3, 5)):
        speed = f"{s.pick('', '-')}{s.number(0.5, 30)} rad/s"
        shafts.append(s.add(f"rotor{i}", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2", speed=speed) + ".shaft")
    for i, (a, b) in enumerate(itertools.pairwise(shafts)):
        name = s.add(f"clutch{i}", "Clutch", radius=f"{s.number(0.05, 0.2)} m", curve=s.curve(),
                     normal_force=f"{s.number(20, 300)} N")  # fmt: skip
        s.join(a, f"{name}.a")
        s.join(b, f"{name}.b")
    for i, shaft in enumerate(shafts):
        if s.maybe(0.3):
            name = s.add(f"brake{i}", "Brake", radius=f"{s.number(0.03, 0.1)} m", curve=s.curve(),
                         normal_force=f"{s.number(5, 100)} N")  # fmt: skip
            s.join(shaft, f"{name}.shaft")
    if s.maybe(0.6):
        s.add("motor", "TorqueSource", torque=s.wave(3, "N*m"))
        s.join(s.pick(*shafts), "motor.shaft")


def _taut(s: Sketch) -> None:
    """A body on the floor that a line draws along once it is taut: a catch that begins with a break-away."""
    hauler, load = _thrown(s, "hauler", 1.5), s.add("load", "Mass", mass=f"{s.number(0.2, 5)} kg") + ".flange"
    s.add("line", "Tether", stiffness=f"{s.number(1e3, 1e5)} N/m", length=f"{s.number(1, 50)} mm")
    s.join(hauler, "line.b")
    s.join(load, "line.a")
    _rub(s, "seat", _floor(s), load)
    if s.maybe(0.5):
        _rub(s, "skid", _floor(s), hauler)
    _push(s, [hauler], 20.0)


KINDS = (_slide, _pile, _belt, _clutches, _taut)

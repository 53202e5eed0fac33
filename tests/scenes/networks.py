"""Random networks: bodies that hang together by springs, ropes and contacts, pushed about by forces and motions."""

from __future__ import annotations

import itertools

from tests.scenes.sketch import METHODS, Sketch


def network(seed: int, size: int | None = None) -> str:
    """The netlist of a random network, of so many bodies if that is said.

    The seed says its kind as well, so that neighbours differ.
    """
    sketch = Sketch("network", seed, size)
    KINDS[seed % len(KINDS)](sketch)
    engine, accuracy = sketch.pick("rodas", "stepping", "auto"), sketch.pick("1e-4", "1e-5", "1e-6")
    run = f"stop: {sketch.number(0.6, 1.2)} s, accuracy: {accuracy}, engine: {engine}"
    return sketch.text(friction="method: hold", run=run, every="10 ms")


def _floor(s: Sketch) -> str:
    """The ground, which is there once something is joined to it."""
    return s.add("floor", "Ground") + ".flange"


def _body(s: Sketch, name: str, *, moving: float = 0.2) -> str:
    """A body, and where it is joined."""
    start = {"velocity": f"{s.number(0.05, 1)} m/s"} if s.maybe(moving) else {}
    return s.add(name, "Mass", mass=f"{s.number(0.2, 5)} kg", **start) + ".flange"


def _rub(s: Sketch, name: str, a: str, b: str, load: float = 20.0) -> None:
    """A contact between two bodies. One in seven treats sticking in another way than `hold`."""
    method = s.pick(*METHODS) if s.maybe(0.15) else None
    own = {"method": method} if method else {}
    if method in ("binding", "saturation", "tanh"):
        own["creep"] = f"{s.number(0.02, 0.15)} mm/s"
    s.add(name, "Contact", normal_force=f"{s.number(0.3 * load, 2 * load)} N", curve=s.curve(method), **own)
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _tie(s: Sketch, name: str, a: str, b: str, *kinds: str) -> None:
    """Something elastic between two bodies. A rope has some slack: one that just hangs straight is a tie."""
    kind = s.pick(*(kinds or ("Spring", "SpringDamper", "SpringDamper", "Tether")))
    more = {"damping": f"{s.number(0.5, 20)} N*s/m"} if kind == "SpringDamper" else {}
    more |= {"length": f"{s.number(0.5, 10)} mm"} if kind == "Tether" else {}
    s.add(name, kind, stiffness=f"{s.number(100, 2e4)} N/m", **more)
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _stop(s: Sketch, name: str, body: str) -> None:
    """Stops on either side of a body that starts between them."""
    way = {"lower": f"-{s.number(2, 50)} mm", "upper": f"{s.number(2, 50)} mm"}
    s.add(name, "EndStop", **way, stiffness=f"{s.number(1e3, 1e5)} N/m", damping=f"{s.number(0.1, 5)} s/m")
    s.join(_floor(s), f"{name}.a")
    s.join(body, f"{name}.b")


def _push(s: Sketch, bodies: list[str], size: float = 30.0) -> None:
    """One to three forces in time, and now and then a motion that pulls at a spring."""
    for k in range(s.pick(1, 1, 2, 3)):
        s.add(f"push{k}", "ForceSource", force=s.wave(size, "N"))
        s.join(s.pick(*bodies), f"push{k}.flange")
    if s.maybe(0.4):
        s.add("hand", "MotionSource", velocity=s.wave(0.2, "m/s"))
        _tie(s, "hook", s.pick(*bodies), "hand.flange", "Spring", "SpringDamper")


def _row(s: Sketch) -> None:
    """Bodies in a row on the floor."""
    bodies = [_body(s, f"block{i}") for i in range(s.many(3, 6, 12, 25))]
    for i, (a, b) in enumerate(itertools.pairwise(bodies)):
        _tie(s, f"spring{i}", a, b)
    for i, body in enumerate(bodies):
        if s.maybe(0.8):
            _rub(s, f"pad{i}", _floor(s), body)
    if s.maybe(0.4):
        _stop(s, "stop", s.pick(*bodies))
    _push(s, bodies)


def _stack(s: Sketch) -> None:
    """Plates on each other, each pressed by what lies on it, some tied to the floor."""
    count = s.many(2, 4, 7, 10)
    bodies = [_body(s, f"plate{i}") for i in range(count)]
    for i, (a, b) in enumerate(zip([_floor(s), *bodies], bodies)):
        _rub(s, f"face{i}", a, b, 8.0 * (count - i))
    for i, body in enumerate(bodies):
        if s.maybe(0.3):
            _tie(s, f"tie{i}", _floor(s), body)
    _push(s, bodies, 40.0)


def _tree(s: Sketch) -> None:
    """Each body is tied to one of the three before it."""
    bodies = [_body(s, f"body{i}") for i in range(s.many(4, 9, 16, 30))]
    for i in range(1, len(bodies)):
        _tie(s, f"branch{i}", bodies[s.random.randrange(max(0, i - 3), i)], bodies[i])
    for i, body in enumerate(bodies):
        if i == 0 or s.maybe(0.6):
            _rub(s, f"foot{i}", _floor(s), body)
    for i in range(s.pick(0, 1, 2)):
        _stop(s, f"stop{i}", s.pick(*bodies))
    _push(s, bodies)


def _ring(s: Sketch) -> None:
    """A row whose ends are tied, with dampers to the floor here and there."""
    bodies = [_body(s, f"bead{i}") for i in range(s.many(3, 5, 8, 14))]
    for i, a in enumerate(bodies):
        _tie(s, f"link{i}", a, bodies[(i + 1) % len(bodies)], "Spring", "SpringDamper")
        if s.maybe(0.6):
            _rub(s, f"shoe{i}", _floor(s), a)
        elif s.maybe(0.5):
            s.add(f"oil{i}", "Damper", damping=f"{s.number(0.5, 20)} N*s/m")
            s.join(_floor(s), f"oil{i}.a")
            s.join(a, f"oil{i}.b")
    _push(s, bodies)


def _net(s: Sketch) -> None:
    """A tree with contacts across: bodies that hold each other in cycles."""
    bodies = [_body(s, f"stone{i}") for i in range(s.many(3, 5, 8, 12))]
    everywhere = [_floor(s), *bodies]
    for i, body in enumerate(bodies):
        _rub(s, f"seat{i}", s.pick(*everywhere[: i + 1]), body)
    for i in range(len(bodies) // 2):
        a, b = s.random.sample(everywhere, 2)
        _rub(s, f"cross{i}", *((b, a) if b == everywhere[0] else (a, b)))
    for i, body in enumerate(bodies):
        if s.maybe(0.4):
            _tie(s, f"band{i}", _floor(s), body)
    _push(s, bodies, 40.0)


def _belt(s: Sketch) -> None:
    """Blocks on a moving belt, held back by springs and by each other."""
    drive = s.wave(0.2, "m/s") if s.maybe(0.5) else f"{s.number(0.05, 0.4)} m/s"
    s.add("belt", "MotionSource", velocity=drive)
    bodies = [_body(s, f"block{i}", moving=0.0) for i in range(s.many(1, 2, 4, 8))]
    for i, body in enumerate(bodies):
        _rub(s, f"pad{i}", "belt.flange", body)
        before = _floor(s) if i == 0 or s.maybe(0.4) else bodies[i - 1]
        _tie(s, f"spring{i}", before, body, "Spring", "SpringDamper")
    if s.maybe(0.5):
        _push(s, bodies, 10.0)


def _shafts(s: Sketch) -> None:
    """Shafts with clutches, gears, brakes and bearings; the last one may draw a block by a rack."""
    shafts = []
    for i in range(s.many(2, 3, 5, 7)):
        start = {"speed": f"{s.number(0.5, 20)} rad/s"} if s.maybe(0.3) else {}
        shafts.append(s.add(f"rotor{i}", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2", **start) + ".shaft")
    for i, (a, b) in enumerate(itertools.pairwise(shafts)):
        _couple(s, i, a, b)
    for i, shaft in enumerate(shafts):
        if s.maybe(0.4):
            _slow(s, i, shaft)
    s.add("motor", "TorqueSource", torque=s.wave(5, "N*m"))
    s.join(shafts[0], "motor.shaft")
    if s.maybe(0.5):
        s.add("pinion", "Rack", radius=f"{s.number(0.05, 0.3)} m")
        s.join(shafts[-1], "pinion.pinion")
        s.join(_body(s, "sledge", moving=0.0), "pinion.rack")
        _rub(s, "way", _floor(s), "sledge.flange")


def _couple(s: Sketch, i: int, a: str, b: str) -> None:
    """One shaft to the next."""
    kind = s.pick("TorsionSpring", "TorsionSpring", "Clutch", "Clutch", "Backlash")
    if kind == "TorsionSpring":
        numbers = {"stiffness": f"{s.number(10, 1000)} N*m/rad", "damping": f"{s.number(0.01, 1)} N*m*s/rad"}
    elif kind == "Clutch":
        numbers = {"radius": f"{s.number(0.05, 0.2)} m", "curve": s.curve(), "normal_force": f"{s.number(20, 200)} N"}
    else:
        numbers = {"stiffness": f"{s.number(100, 1e4)} N*m/rad", "play": f"{s.number(0.001, 0.05)} rad"}
    name = s.add(f"joint{i}", kind, **numbers)
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _slow(s: Sketch, i: int, shaft: str) -> None:
    """What slows a shaft."""
    if s.maybe(0.3):
        s.add(f"drag{i}", "RotationalDamper", damping=f"{s.number(0.01, 0.5)} N*m*s/rad")
        s.join(s.add("case", "Housing") + ".shaft", f"drag{i}.a")
        s.join(shaft, f"drag{i}.b")
        return
    name = s.add(f"rub{i}", s.pick("Brake", "Bearing"), radius=f"{s.number(0.02, 0.1)} m", curve=s.curve(),
                 normal_force=f"{s.number(10, 100)} N")  # fmt: skip
    s.join(shaft, f"{name}.shaft")


KINDS = (_row, _stack, _tree, _ring, _net, _belt, _shafts)

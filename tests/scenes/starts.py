"""Random start speeds: given at some bodies of what is held together, so that the others follow."""

from __future__ import annotations

import itertools

from tests.scenes.sketch import Sketch


def start(seed: int) -> str:
    """The netlist of a scene that starts moving. The seed says its kind as well."""
    s = Sketch("start", seed)
    KINDS[seed % len(KINDS)](s)
    return s.text(friction="method: hold", run=f"stop: {s.number(0.3, 0.8)} s", every="10 ms")


def _speed(s: Sketch, unit: str) -> dict[str, str]:
    key = "speed" if unit == "rad/s" else "velocity"
    return {key: f"{s.pick('', '-')}{s.number(0.1, 10)} {unit}"}


def _shafts(s: Sketch) -> None:
    """Shafts joined by sensors, gears with losses and clutches; one of each rigid run of them has a speed."""
    count = s.many(2, 3, 4, 6)
    joints = [s.pick("TorqueSensor", "Gearbox", "Gear", "Clutch", "TorsionSpring") for _ in range(count - 1)]
    runs, first = [], 0
    for i, joint in enumerate([*joints, "Clutch"]):
        if joint in ("Clutch", "TorsionSpring"):
            runs.append(s.random.randrange(first, i + 1))
            first = i + 1
    shafts = []
    for i in range(count):
        given = _speed(s, "rad/s") if i in runs and s.maybe(0.8) else {}
        shafts.append(s.add(f"rotor{i}", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2", **given) + ".shaft")
    for i, (a, b) in enumerate(itertools.pairwise(shafts)):
        more = {
            "TorqueSensor": {}, "Gear": {"ratio": f"{s.pick('', '-')}{s.number(0.3, 3)}"},
            "Gearbox": {"ratio": s.number(0.3, 3), "efficiency": s.number(0.7, 0.98)},
            "Clutch": {"radius": "0.1 m", "normal_force": f"{s.number(20, 200)} N", "curve": s.curve()},
            "TorsionSpring": {"stiffness": f"{s.number(10, 500)} N*m/rad", "damping": "0.1 N*m*s/rad"},
        }[joints[i]]  # fmt: skip
        s.add(f"joint{i}", joints[i], **more)
        s.join(a, f"joint{i}.a")
        s.join(b, f"joint{i}.b")
    if s.maybe(0.4):
        s.add("brake", "Brake", radius="0.1 m", normal_force=f"{s.number(5, 100)} N", curve=s.curve())
        s.join(s.pick(*shafts), "brake.shaft")
    if s.maybe(0.5):
        s.add("motor", "TorqueSource", torque=s.wave(3, "N*m"))
        s.join(s.pick(*shafts), "motor.shaft")


def _train(s: Sketch) -> None:
    """Bodies coupled by force sensors and springs, of which some have speeds, on pads."""
    count = s.many(2, 3, 5)
    joints = [s.pick("ForceSensor", "ForceSensor", "SpringDamper", "Spring") for _ in range(count - 1)]
    bodies, free = [], True
    for i in range(count):
        given = _speed(s, "m/s") if free and s.maybe(0.8) else {}
        free = (i < count - 1 and joints[i] != "ForceSensor") or (free and not given)
        bodies.append(s.add(f"car{i}", "Mass", mass=f"{s.number(0.2, 5)} kg", **given) + ".flange")
    for i, (a, b) in enumerate(itertools.pairwise(bodies)):
        more = {} if joints[i] == "ForceSensor" else {"stiffness": f"{s.number(200, 5000)} N/m"}
        more |= {"damping": f"{s.number(0.5, 10)} N*s/m"} if joints[i] == "SpringDamper" else {}
        s.add(f"joint{i}", joints[i], **more)
        s.join(a, f"joint{i}.a")
        s.join(b, f"joint{i}.b")
    for i, body in enumerate(bodies):
        if s.maybe(0.5):
            s.add(f"pad{i}", "Contact", normal_force=f"{s.number(3, 30)} N", curve=s.curve())
            s.join(s.add("floor", "Ground") + ".flange", f"pad{i}.a")
            s.join(body, f"pad{i}.b")
    if s.maybe(0.5):
        s.add("push", "ForceSource", force=s.wave(15, "N"))
        s.join(s.pick(*bodies), "push.flange")


def _hauled(s: Sketch) -> None:
    """A drum, its rope and a block: the speed is given at the one end or at the other."""
    at = s.pick("drum", "block", "both")
    radius, speed = float(s.number(0.05, 0.5)), float(s.number(0.1, 5))
    s.add("drum", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2",
          **({"speed": f"{speed / radius!r} rad/s"} if at != "block" else {}))  # fmt: skip
    s.add("block", "Mass", mass=f"{s.number(0.2, 5)} kg", **({"velocity": f"{speed!r} m/s"} if at != "drum" else {}))
    s.add("rim", "Rack", radius=f"{radius!r} m")
    s.join("drum.shaft", "rim.pinion")
    if s.maybe(0.5):
        s.add("gauge", "ForceSensor")
        s.join("rim.rack", "gauge.a")
        s.join("gauge.b", "block.flange")
    else:
        s.join("rim.rack", "block.flange")
    s.add("floor", "Ground")
    s.add("pad", "Contact", normal_force=f"{s.number(3, 60)} N", curve=s.curve())
    s.join("floor.flange", "pad.a")
    s.join("block.flange", "pad.b")
    s.add("brake", "Brake", radius="0.1 m", normal_force=f"{s.number(3, 60)} N", curve=s.curve())
    s.join("drum.shaft", "brake.shaft")
    if s.maybe(0.6):
        s.add("motor", "TorqueSource", torque=s.wave(5, "N*m"))
        s.join("drum.shaft", "motor.shaft")


KINDS = (_shafts, _train, _hauled)

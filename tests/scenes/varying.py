"""Random friction limits that vary: normal forces in time, of a line's tension, of a gear's load; pads that lift."""

from __future__ import annotations

import itertools

from tests.scenes.sketch import Sketch


def varying(seed: int) -> str:
    """The netlist of a scene whose friction limits vary. The seed says its kind as well."""
    s = Sketch("varying", seed)
    KINDS[seed % len(KINDS)](s)
    return s.text(friction="method: hold", run=f"stop: {s.number(0.6, 1.2)} s", every="10 ms")


def _floor(s: Sketch) -> str:
    return s.add("floor", "Ground") + ".flange"


def _body(s: Sketch, name: str, share: float = 0.3) -> str:
    start = {"velocity": f"{s.pick('', '-')}{s.number(0.05, 1)} m/s"} if s.maybe(share) else {}
    return s.add(name, "Mass", mass=f"{s.number(0.2, 5)} kg", **start) + ".flange"


def _rub(s: Sketch, name: str, a: str, b: str) -> str:
    """A contact whose normal force is told; its input."""
    s.add(name, "Contact", curve=s.curve())
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")
    return f"{name}.normal"


def _press(s: Sketch, name: str, size: float) -> str:
    """A normal force in time: it swings about a mean, goes up or down, or comes and goes."""
    low, high, f = s.number(0.2 * size, 0.6 * size), s.number(0.8 * size, 2 * size), s.number(1, 40)
    at = [float(s.number(0.05, 0.2)) for _ in range(3)]
    wave = s.pick(
        f"{{sine: {{amplitude: {low}, frequency: {f} Hz, offset: {high}}}}}",
        f"{{ramp: {{from: {low}, to: {high}, start: {at[0]:.4g} s, over: {at[1]:.4g} s}}}}",
        f"{{ramp: {{from: {high}, to: {low}, start: {at[0]:.4g} s, over: {at[1]:.4g} s}}}}",
        f"{{step: {{from: {high}, to: {low}, at: {at[0]:.4g} s}}}}",
        f"{{trapezoid: {{from: {s.pick('0', low)}, to: {high}, start: {at[0]:.4g} s, rise: {at[1]:.4g} s,"
        f" stay: {at[2]:.4g} s, fall: {at[1]:.4g} s}}}}",
    )
    s.add(name, "SignalSource", value=wave)
    return f"{name}.signal"


def _push(s: Sketch, bodies: list[str], size: float) -> None:
    for k in range(s.pick(1, 1, 2)):
        s.add(f"push{k}", "ForceSource", force=s.wave(size, "N"))
        s.join(s.pick(*bodies), f"push{k}.flange")


def _tie(s: Sketch, name: str, a: str, b: str) -> None:
    s.add(name, "SpringDamper", stiffness=f"{s.number(100, 5000)} N/m", damping=f"{s.number(0.5, 10)} N*s/m")
    s.join(a, f"{name}.a")
    s.join(b, f"{name}.b")


def _blocks(s: Sketch) -> None:
    """Blocks in a row, each pad pressed in time."""
    bodies = [_body(s, f"block{i}") for i in range(s.many(1, 2, 3, 6))]
    for i, body in enumerate(bodies):
        s.join(_press(s, f"press{i}", 20.0), _rub(s, f"pad{i}", _floor(s), body))
    for i, (a, b) in enumerate(itertools.pairwise(bodies)):
        _tie(s, f"tie{i}", a, b)
    _push(s, bodies, 15.0)


def _pile(s: Sketch) -> None:
    """Plates on each other under one press."""
    bodies = [_body(s, f"plate{i}") for i in range(s.many(2, 3, 4))]
    inputs = [_rub(s, f"face{i}", a, b) for i, (a, b) in enumerate(zip([_floor(s), *bodies], bodies))]
    s.join(_press(s, "press", 20.0), *inputs)
    _push(s, bodies, 15.0)


def _engaged(s: Sketch) -> None:
    """Shafts whose clutch is pressed in time."""
    shafts = []
    for i in range(s.many(2, 2, 3)):
        speed = {"speed": f"{s.number(0.5, 20)} rad/s"} if s.maybe(0.5) else {}
        shafts.append(s.add(f"rotor{i}", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2", **speed) + ".shaft")
    for i, (a, b) in enumerate(itertools.pairwise(shafts)):
        s.add(f"clutch{i}", "Clutch", radius=f"{s.number(0.05, 0.2)} m", curve=s.curve())
        s.join(a, f"clutch{i}.a")
        s.join(b, f"clutch{i}.b")
        s.join(_press(s, f"press{i}", 80.0), f"clutch{i}.normal")
    s.add("motor", "TorqueSource", torque=s.wave(4, "N*m"))
    s.join(shafts[0], "motor.shaft")


def _line(s: Sketch) -> None:
    """A line presses the brake of its own load: the limit follows the tension."""
    hand = s.pick("push", "hand")
    load = _body(s, "load", 0.2)
    puller = _body(s, "puller", 0.3)
    s.add("line", "Tether", stiffness=f"{s.number(500, 2e4)} N/m", length=f"{s.number(1, 20)} mm")
    s.join(load, "line.a")
    s.join(puller, "line.b")
    s.join("line.tension", _rub(s, "band", _floor(s), load))
    if s.maybe(0.5):
        s.join(_press(s, "press", 10.0), _rub(s, "skid", _floor(s), puller))
    if hand == "push":
        _push(s, [puller], 20.0)
    else:
        s.add("hand", "MotionSource", velocity=s.wave(0.3, "m/s"))
        _tie(s, "hook", puller, "hand.flange")


def _geared(s: Sketch) -> None:
    """A gearbox whose losses follow its load, between two shafts."""
    shafts = [s.add(f"rotor{i}", "Inertia", moment=f"{s.number(0.01, 0.5)} kg*m^2") + ".shaft" for i in range(2)]
    s.add("box", "Gearbox", ratio=s.number(0.2, 4), efficiency=s.number(0.5, 0.98))
    s.join(shafts[0], "box.a")
    s.join(shafts[1], "box.b")
    s.add("motor", "TorqueSource", torque=s.wave(4, "N*m"))
    s.join(shafts[0], "motor.shaft")
    if s.maybe(0.7):
        s.add("drag", "RotationalDamper", damping=f"{s.number(0.05, 1)} N*m*s/rad")
        s.join(s.add("case", "Housing") + ".shaft", "drag.a")
        s.join(shafts[1], "drag.b")
    if s.maybe(0.5):
        s.add("brake", "Brake", radius="0.1 m", curve=s.curve())
        s.join(s.pick(*shafts), "brake.shaft")
        s.join(_press(s, "press", 20.0), "brake.normal")


KINDS = (_blocks, _pile, _engaged, _line, _geared)

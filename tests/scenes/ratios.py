"""Random machines whose ratios move: cranks, cams and pendulums, driven or free, with friction at what they move."""

from __future__ import annotations

from pathlib import Path

from tests.scenes.sketch import Sketch

LIBRARY = str(Path(__file__).with_name("linkages.py"))


def ratio(seed: int) -> str:
    """The netlist of a machine, which needs LIBRARY. The seed says its kind as well."""
    s = Sketch("ratio", seed)
    KINDS[seed % len(KINDS)](s)
    return s.text(friction="method: hold", run=f"stop: {s.number(0.5, 1)} s", every="10 ms")


def _wheel(s: Sketch, name: str = "wheel") -> str:
    """A wheel somewhere, turning or not."""
    speed = s.pick("0", f"{s.pick('', '-')}{s.number(0.5, 20)}")
    angle = f"{s.pick('', '-')}{s.number(0.05, 3)}"
    s.add(name, "Inertia", moment=f"{s.number(0.003, 0.3)} kg*m^2", angle=f"{angle} rad", speed=f"{speed} rad/s")
    return f"{name}.shaft"


def _torque(s: Sketch, shaft: str) -> None:
    s.add("drive", "TorqueSource", torque=s.wave(s.pick(0.5, 2.0, 5.0), "N*m"))
    s.join(shaft, "drive.shaft")


def _pad(s: Sketch, name: str, body: str, size: float = 10.0) -> None:
    s.add("wall", "Ground")
    s.add(name, "Contact", normal_force=f"{s.number(0.1 * size, 2 * size)} N", curve=s.curve())
    s.join("wall.flange", f"{name}.a")
    s.join(body, f"{name}.b")


def _piston(s: Sketch, name: str) -> str:
    return s.add(name, "Mass", mass=f"{s.number(0.2, 5)} kg") + ".flange"


def _rod(s: Sketch, name: str) -> None:
    radius = float(s.number(0.01, 0.1))
    offset = radius * float(s.number(0.01, 0.15)) * s.pick(0, 1, -1)
    s.add(name, "Crank", radius=f"{radius} m", rod=f"{radius * float(s.number(1.3, 6)):.4g} m",
          offset=f"{offset:.4g} m")  # fmt: skip


def _crank(s: Sketch) -> None:
    """A crank with friction at its slider, and a spring or a brake now and then."""
    shaft, piston = _wheel(s), _piston(s, "piston")
    _rod(s, "crank")
    s.join(shaft, "crank.shaft")
    s.join("crank.slider", piston)
    if s.maybe(0.8):
        _pad(s, "pad", piston)
    if s.maybe(0.7):
        _torque(s, shaft)
    if s.maybe(0.3):
        s.add("wall", "Ground")
        s.add("spring", "Spring", stiffness=f"{s.number(50, 2000)} N/m", free_length=f"{s.number(0.05, 0.3)} m")
        s.join("wall.flange", "spring.a")
        s.join(piston, "spring.b")
    if s.maybe(0.3):
        s.add("brake", "Brake", radius="0.05 m", normal_force=f"{s.number(1, 30)} N", curve=s.curve())
        s.join(shaft, "brake.shaft")


def _engine(s: Sketch) -> None:
    """Pistons on one wheel, with gears between here and there, each rubbing."""
    shaft = _wheel(s)
    for i in range(s.pick(2, 3)):
        turned = s.add(f"gear{i}", "Gear", ratio=s.pick("-1", "2", "1", s.number(0.5, 2))) + ".b"
        s.join(shaft, f"gear{i}.a")
        _rod(s, f"crank{i}")
        s.join(turned, f"crank{i}.shaft")
        piston = _piston(s, f"piston{i}")
        s.join(f"crank{i}.slider", piston)
        _pad(s, f"pad{i}", piston, 5.0)
    _torque(s, shaft)


def _driven(s: Sketch) -> None:
    """A crank turned at a given speed."""
    speed = s.pick(f"{s.pick('', '-')}{s.number(0.1, 2)} m/s", s.wave(1.0, "m/s"))
    s.add("drive", "MotionSource", velocity=speed, origin=f"{s.number(0.01, 0.2)} m")
    s.add("rim", "Rack", radius="0.1 m")
    s.join("drive.flange", "rim.rack")
    _rod(s, "crank")
    s.join("rim.pinion", "crank.shaft")
    piston = _piston(s, "piston")
    s.join("crank.slider", piston)
    load = _piston(s, "load")
    s.add("link", "SpringDamper", stiffness=f"{s.number(200, 1e4)} N/m", damping=f"{s.number(0.5, 20)} N*s/m",
          free_length=f"{s.number(0.05, 0.3)} m")  # fmt: skip
    s.join(piston, "link.a")
    s.join("link.b", load)
    _pad(s, "pad", load)
    if s.maybe(0.5):
        _pad(s, "guide", piston)


def _cam(s: Sketch) -> None:
    """A cam lifts a follower against a spring and friction."""
    shaft, follower = _wheel(s), _piston(s, "follower")
    s.add("cam", "Cam", lift=f"{s.number(0.005, 0.05)} m", share=s.pick("0", s.number(0.05, 0.9)))
    s.join(shaft, "cam.shaft")
    s.join("cam.follower", follower)
    s.add("wall", "Ground")
    s.add("spring", "Spring", stiffness=f"{s.number(100, 5000)} N/m", free_length=f"{s.number(0.001, 0.1)} m")
    s.join("wall.flange", "spring.a")
    s.join(follower, "spring.b")
    if s.maybe(0.7):
        _pad(s, "pad", follower)
    if s.maybe(0.7):
        _torque(s, shaft)


def _pendulum(s: Sketch) -> None:
    """A pendulum of one or two rods on a cart that rubs, or on a fixed point."""
    count, cart = s.pick(1, 1, 2), s.maybe(0.6)
    s.add("wall", "Ground")
    if cart:
        s.add("cart", "Mass", mass=f"{s.number(0.5, 5)} kg", position="0 m", velocity="0 m/s")
        _pad(s, "pad", "cart.flange", 20.0)
        before = ("cart.flange", "wall.flange")
    else:
        before = ("wall.flange", "wall.flange")
    for i in range(count):
        mass, angle, length = float(s.number(0.2, 2)), float(s.number(0.1, 2.5)) * s.pick(1, -1), s.number(0.2, 1)
        place = _hangs(before, s, float(length), angle)
        for axis, at in zip("xy", place):
            s.add(f"{axis}{i}", "Mass", mass=f"{mass} kg", position=f"{at!r} m", velocity="0 m/s")
        s.add(f"weight{i}", "ForceSource", force=f"{-9.81 * mass!r} N")
        s.join(f"y{i}.flange", f"weight{i}.flange")
        s.add(f"rod{i}", "Rod", length=f"{length} m")
        for port, what in zip(("x1", "y1", "x2", "y2"), (*before, f"x{i}.flange", f"y{i}.flange")):
            s.join(what, f"rod{i}.{port}")
        before = (f"x{i}.flange", f"y{i}.flange")
    if s.maybe(0.4):
        s.add("push", "ForceSource", force=s.wave(5.0, "N"))
        s.join("cart.flange" if cart else "x0.flange", "push.flange")


def _hangs(above: tuple[str, str], s: Sketch, length: float, angle: float) -> tuple[float, float]:
    """Where the next point is, at an angle to the line down."""
    from math import cos, sin

    at = []
    for port in above:
        text = s.parts[port.removesuffix(".flange")]
        at.append(float(text.split("position: ")[1].split(" ")[0]) if "position: " in text else 0.0)
    return at[0] + length * sin(angle), at[1] - length * cos(angle)


KINDS = (_crank, _engine, _driven, _cam, _pendulum)

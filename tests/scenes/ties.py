"""Random symmetric scenes: what is mirrored or may be exchanged reaches its limits, its stops and its rest together."""

from __future__ import annotations

import itertools

from tests.scenes.sketch import Sketch

Twins = dict[str, tuple[str, int]]
"""Body -> the body that must move as it does, and +1; or as its mirror image does, and -1."""


def tie(seed: int) -> tuple[str, Twins]:
    """The netlist of a symmetric scene, its parts in a random order, and its twins. The seed says its kind as well."""
    s = Sketch("tie", seed)
    twins = KINDS[seed % len(KINDS)](s)
    order = list(s.parts)
    s.random.shuffle(order)
    s.parts = {name: s.parts[name] for name in order}
    s.random.shuffle(s.joins)
    return s.text(friction="method: hold", run=f"stop: {s.number(0.6, 1.2)} s", every="10 ms"), twins


def _mirror(names: list[str]) -> Twins:
    """The first is the mirror image of the last, and so on; one in the middle is its own."""
    return {a: (b, -1) for a, b in zip(names, reversed(names))}


def _load(s: Sketch, size: float, unit: str) -> tuple[str, str]:
    """A load in time, and its opposite."""
    a, at, over, f = s.number(0.5 * size, 2 * size), s.number(0.02, 0.2), s.number(0.05, 0.3), s.number(0.5, 4)
    shape = s.pick(
        "SIGN{a} {u}", "{{step: {{to: SIGN{a} {u}, at: {at} s}}}}",
        "{{ramp: {{to: SIGN{a} {u}, over: {over} s, start: {at} s}}}}",
        "{{sine: {{amplitude: SIGN{a} {u}, frequency: {f} Hz}}}}",
        "{{trapezoid: {{to: SIGN{a} {u}, start: {at} s, rise: {over} s, stay: {over} s, fall: {over} s}}}}",
    ).format(a=a, u=unit, at=at, over=over, f=f)  # fmt: skip
    return shape.replace("SIGN", ""), shape.replace("SIGN", "-")


def _shafts(s: Sketch) -> Twins:
    """Shafts in a row between clutches, turned against each other from both ends."""
    count = s.many(2, 3, 4, 5, 7)
    names = [f"rotor{i}" for i in range(count)]
    moments = [s.number(0.05, 0.5) for _ in names]
    for i, name in enumerate(names):
        s.add(name, "Inertia", moment=f"{moments[min(i, count - 1 - i)]} kg*m^2")
    loads = [(s.number(30, 150), s.curve()) for _ in names]
    for i, (a, b) in enumerate(itertools.pairwise(names)):
        pressed, curve = loads[min(i, count - 2 - i)]
        s.add(f"clutch{i}", "Clutch", radius="0.1 m", normal_force=f"{pressed} N", curve=curve)
        s.join(f"{a}.shaft", f"clutch{i}.a")
        s.join(f"clutch{i}.b", f"{b}.shaft")
    for name, torque in zip((names[0], names[-1]), _load(s, 6, "N*m")):
        s.add(f"drive_{name}", "TorqueSource", torque=torque)
        s.join(f"drive_{name}.shaft", f"{name}.shaft")
    return _mirror(names)


def _row(s: Sketch) -> Twins:
    """Blocks in a row on pads, pulled from both ends or thrown apart; springs between them."""
    count = s.many(2, 3, 4, 6, 9)
    names = [f"block{i}" for i in range(count)]
    half = (count + 1) // 2
    masses, pads = [s.number(0.3, 3) for _ in range(half)], [(s.number(5, 30), s.curve()) for _ in range(half)]
    thrown = float(s.number(0.1, 1)) if s.maybe(0.4) else 0.0
    s.add("floor", "Ground")
    for i, name in enumerate(names):
        j, sign = min(i, count - 1 - i), -1 if i < count - 1 - i else 1
        speed = {"velocity": f"{sign * thrown!r} m/s"} if thrown and j == 0 and 2 * i != count - 1 else {}
        s.add(name, "Mass", mass=f"{masses[j]} kg", **speed)
        normal, curve = pads[j]
        s.add(f"pad{i}", "Contact", normal_force=f"{normal} N", curve=curve)
        s.join("floor.flange", f"pad{i}.a")
        s.join(f"{name}.flange", f"pad{i}.b")
    springs = [s.number(100, 5000) for _ in names]
    for i, (a, b) in enumerate(itertools.pairwise(names)):
        s.add(f"spring{i}", "Spring", stiffness=f"{springs[min(i, count - 2 - i)]} N/m")
        s.join(f"{a}.flange", f"spring{i}.a")
        s.join(f"{b}.flange", f"spring{i}.b")
    for name, force in zip((names[-1], names[0]), _load(s, 20, "N")):
        s.add(f"pull_{name}", "ForceSource", force=force)
        s.join(f"pull_{name}.flange", f"{name}.flange")
    return _mirror(names)


def _alike(s: Sketch) -> Twins:
    """Equal blocks on one cart, which is pushed: all break away, and are caught, at one instant."""
    names = [f"rider{i}" for i in range(s.many(2, 3, 5, 10))]
    s.add("cart", "Mass", mass=f"{s.number(1, 10)} kg")
    mass, normal, curve = s.number(0.3, 3), s.number(3, 30), s.curve()
    for name in names:
        s.add(name, "Mass", mass=f"{mass} kg")
        s.add(f"pad_{name}", "Contact", normal_force=f"{normal} N", curve=curve)
        s.join("cart.flange", f"pad_{name}.a")
        s.join(f"{name}.flange", f"pad_{name}.b")
    s.add("push", "ForceSource", force=_load(s, 40, "N")[0])
    s.join("push.flange", "cart.flange")
    if s.maybe(0.6):
        s.add("floor", "Ground")
        s.add("under", "Contact", normal_force=f"{s.number(3, 30)} N", curve=s.curve())
        s.join("floor.flange", "under.a")
        s.join("cart.flange", "under.b")
    return {a: (b, 1) for a, b in itertools.pairwise(names)}


def _met(s: Sketch) -> Twins:
    """Bodies run from both sides into one between them, with friction under all."""
    sides, gap, speed = s.pick(1, 1, 2), float(s.number(0.02, 0.3)), float(s.number(0.3, 4))
    names = [f"ball{i}" for i in range(2 * sides + 1)]
    masses, pads = [s.number(0.3, 3) for _ in names], [(s.number(0.5, 10), s.curve()) for _ in names]
    rubs, share = s.maybe(0.6), s.pick(0.0, 0.5, 1.0, float(s.number(0.1, 0.9)))
    s.add("floor", "Ground")
    for i, name in enumerate(names):
        j, way = abs(i - sides), (i > sides) - (i < sides)
        s.add(name, "Mass", mass=f"{masses[j]} kg", position=f"{gap * (i - sides)!r} m",
              velocity=f"{-way * speed * (1 + 0.3 * (j - 1))!r} m/s")  # fmt: skip
        if rubs:
            s.add(f"pad{i}", "Contact", normal_force=f"{pads[j][0]} N", curve=pads[j][1])
            s.join("floor.flange", f"pad{i}.a")
            s.join(f"{name}.flange", f"pad{i}.b")
    for i, (a, b) in enumerate(itertools.pairwise(names)):
        s.add(f"stop{i}", "RigidStop", restitution=f"{share!r}")
        s.join(f"{a}.flange", f"stop{i}.a")
        s.join(f"{b}.flange", f"stop{i}.b")
    if not rubs:
        del s.parts["floor"]
    return _mirror(names)


KINDS = (_shafts, _row, _alike, _met)

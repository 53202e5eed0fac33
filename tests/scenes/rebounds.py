"""Random impacts with restitution: balls in rows, between walls, on springs, and bodies that bounce until they lie."""

from __future__ import annotations

import itertools

from tests.scenes.blows import FLOOR, Blow, Stop
from tests.scenes.sketch import Sketch


def rebound(seed: int) -> tuple[Blow, float]:
    """A random scene whose stops all give back one share of the speed at which they meet, and this share."""
    s, scene = Sketch("rebound", seed), Blow()
    share = s.pick(1.0, 0.0, *(float(s.number(0.1, 0.95)) for _ in range(4)))
    KINDS[seed % len(KINDS)](s, scene, share)
    scene.text = s.text(friction="method: hold", run=f"stop: {s.number(0.6, 1.2)} s", every="10 ms")
    return scene, share


def _body(s: Sketch, scene: Blow, name: str, at: float, speed: float) -> str:
    mass = s.number(0.2, 5)
    s.add(name, "Mass", mass=f"{mass} kg", position=f"{at!r} m", velocity=f"{speed!r} m/s")
    scene.mass[name] = float(mass)
    return name


def _stop(s: Sketch, scene: Blow, a: str, b: str, length: float, share: float) -> None:
    if FLOOR in (a, b):
        s.add(FLOOR, "Ground")
    stop = Stop(f"stop{len(scene.stops)}", a, b, length)
    s.add(stop.name, "RigidStop", length=f"{length!r} m", restitution=f"{share!r}")
    s.join(f"{a}.flange", f"{stop.name}.a")
    s.join(f"{b}.flange", f"{stop.name}.b")
    scene.stops.append(stop)


def _force(s: Sketch, name: str, size: float) -> None:
    s.add(f"push_{name}", "ForceSource", force=f"{size:.4g} N")
    s.join(f"{name}.flange", f"push_{name}.flange")


def _row(s: Sketch, scene: Blow, share: float) -> None:
    """Balls with gaps between two walls."""
    at, names = 0.0, []
    for i in range(s.many(2, 3, 5)):
        speed = s.pick(-1, 1) * float(s.number(0.2, 3)) if s.maybe(0.6) else 0.0
        names.append(_body(s, scene, f"ball{i}", at, speed))
        at += float(s.number(0.03, 0.4))
    for a, b in itertools.pairwise(names):
        _stop(s, scene, a, b, 0.0, share)
    if s.maybe(0.6):
        _stop(s, scene, FLOOR, names[0], -float(s.number(0.05, 0.5)), share)
        _stop(s, scene, names[-1], FLOOR, -at - float(s.number(0.05, 0.5)), share)


def _bounce(s: Sketch, scene: Blow, share: float) -> None:
    """Balls that fall, one on the other, until they lie."""
    below, at = FLOOR, 0.0
    for i in range(s.many(1, 1, 2)):
        at += float(s.number(0.05, 0.5))
        name = _body(s, scene, f"ball{i}", at, 0.0)
        _stop(s, scene, below, name, 0.0, share)
        _force(s, name, -9.81 * scene.mass[name])
        below = name


def _hung(s: Sketch, scene: Blow, share: float) -> None:
    """A body on a spring that swings against a wall, rubbing on the way."""
    at, speed = float(s.number(0.01, 0.2)), s.pick(-1, 1) * float(s.number(0.1, 3))
    name = _body(s, scene, "bob", at, speed)
    s.add("spring", "SpringDamper", stiffness=f"{s.number(20, 2000)} N/m", damping=f"{s.number(0.01, 2)} N*s/m")
    _stop(s, scene, FLOOR, name, -float(s.number(0.005, 0.1)), share)
    s.join(f"{FLOOR}.flange", "spring.a")
    s.join(f"{name}.flange", "spring.b")
    if s.maybe(0.6):
        s.add("pad", "Contact", normal_force=f"{s.number(0.3, 20)} N", curve=s.curve())
        s.join(f"{FLOOR}.flange", "pad.a")
        s.join(f"{name}.flange", "pad.b")


def _pushed(s: Sketch, scene: Blow, share: float) -> None:
    """A force drives one body into another that friction holds, again and again."""
    into = _body(s, scene, "into", 0.0, float(s.number(0.1, 2)))
    other = _body(s, scene, "other", float(s.number(0.02, 0.3)), 0.0)
    _stop(s, scene, into, other, 0.0, share)
    _force(s, into, float(s.number(1, 15)))
    s.add(FLOOR, "Ground")
    s.add("pad", "Contact", normal_force=f"{s.number(1, 40)} N", curve=s.curve())
    s.join(f"{FLOOR}.flange", "pad.a")
    s.join(f"{other}.flange", "pad.b")


KINDS = (_row, _bounce, _hung, _pushed)

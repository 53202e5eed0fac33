"""Random stacks, trees and rings of bodies that friction holds, until the forces on some of them jump."""

from __future__ import annotations

from tests.scenes.sketch import Sketch

AT = 0.1
"""When the forces jump, s."""


def jump(seed: int, how: str, engine: str, stop: str = "0.1001 s") -> str:
    """The netlist of a scene; its bodies are b1, b2, ...

    `how` the forces go over: "step", or a time such as "10 us" that they take for it. Four contacts in five have a
    stiction above their sliding friction. The seed decides everything else.
    """
    s = Sketch("jump", seed)
    count = s.many(2, 3, 4, 5, 6, 7)
    shape, bodies = s.pick("stack", "tree", "ring"), [f"b{i}" for i in range(1, count + 1)]
    s.add("floor", "Ground")
    for body in bodies:
        s.add(body, "Mass", mass=f"{s.number(0.3, 3)} kg")
    places = ["floor", *bodies]
    pairs = [(places[s.random.randrange(i) if shape == "tree" else i - 1], places[i]) for i in range(1, count + 1)]
    if shape == "ring":
        pairs += [tuple(s.random.sample(places, 2)) for _ in range(s.pick(1, 2, 3))]
    for k, (a, b) in enumerate(pairs):
        sliding, ratio = float(s.number(0.1, 0.6)), float(s.number(1.0, 1.6)) if s.maybe(0.8) else 1.0
        curve = f"{{curve: coulomb, coulomb: {sliding}, stiction: {sliding * ratio:.8g}}}"
        s.add(f"c{k}", "Contact", normal_force=f"{s.number(5, 50)} N", curve=curve)
        s.join(f"{a}.flange", f"c{k}.a")
        s.join(f"{b}.flange", f"c{k}.b")
    for k, body in enumerate(s.random.sample(bodies, min(s.pick(1, 2, 3), count))):
        before = s.number(0.1, 3) if s.maybe(0.5) else "0"
        to = f"{s.pick('', '-')}{s.number(2, 20)} N"
        goes = f"step: {{to: {to}, at: {AT} s}}" if how == "step" else f"ramp: {{to: {to}, over: {how}, start: {AT} s}}"
        s.add(f"f{k}", "ForceSource", force=f"{{constant: {before} N, {goes}}}")
        s.join(f"f{k}.flange", f"{body}.flange")
    return s.text(friction="method: hold", run=f"stop: {stop}, accuracy: 1e-6, engine: {engine}", every="10 us")

"""Rows whose contacts jump as they let go, many in one step of `stepping`: each once, and right to the accuracy."""

import math
from pathlib import Path

import numpy as np
import pytest

import fairlead

CURVE = "{curve: coulomb, stiction: 1.3, coulomb: 1.0}"


def row(unequal, pull, stop):
    """Fifty blocks on a floor, tied by springs, stiction 1.3 times what they slide with, pulled at the last."""
    n, parts, joins = 50, ["  ground: {type: Ground}"], []
    for i in range(n):
        mass, normal = 0.2 * (1 + unequal * math.sin(2.9 * i)), 1 + 0.3 * math.sin(1.7 * i + 0.3)
        parts += [
            f"  b{i}: {{type: Mass, mass: {mass} kg}}",
            f"  g{i}: {{type: Contact, normal_force: {normal} N, curve: {CURVE}}}",
        ]
        joins += [f"  - [b{i}.flange, g{i}.b]", f"  - [ground.flange, g{i}.a]"]
        if i:
            parts.append(f"  s{i}: {{type: SpringDamper, stiffness: 5e4 N/m, damping: 100 N*s/m}}")
            joins += [f"  - [b{i - 1}.flange, s{i}.a]", f"  - [b{i}.flange, s{i}.b]"]
    return "\n".join([
        "components:", *parts, "  hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}",
        f"  hand: {{type: MotionSource, velocity: {pull}}}", "connections:", *joins,
        f"  - [b{n - 1}.flange, hook.a]", "  - [hook.b, hand.flange]",
        f"run: {{stop: {stop} s}}", "record: {every: 20 ms, signals: ['b*.x']}",
    ])  # fmt: skip


@pytest.mark.parametrize(
    ("unequal", "pull", "stop"),
    [(0.0, "0.02 m/s", 1.5), (0.8, "0.02 m/s", 1.5), (0.4, "{sine: {amplitude: 0.08 m/s, frequency: 0.5 Hz}}", 2.0)],
    ids=["equal", "unequal", "to and fro"],
)
def test_steps_with_many_jumps_are_as_right_as_those_without(unequal, pull, stop, scene):
    text = row(unequal, pull, stop)
    exact = scene(text, **{"run.engine": "rodas", "run.accuracy": "1e-6"}).run(out=None)
    times = np.arange(0.0, stop, 0.02)
    right = np.stack([exact.at(name, times) for name in exact.match("b*.x")])
    for accuracy in (1e-3, 1e-5):
        found = scene(text, **{"run.engine": "stepping", "run.accuracy": repr(accuracy)}).run(out=None)
        off = np.stack([found.at(name, times) for name in found.match("b*.x")]) - right
        assert np.abs(off).max() < 6 * accuracy * np.abs(right).max()
        if not pull.startswith("{"):  # nobody is caught who merely slows down
            assert max(np.unique([event.component for event in found.events], return_counts=True)[1]) == 1


@pytest.mark.slow
def test_a_line_whose_normal_force_follows_its_tension_jumps_inside_steps(tmp_path):
    """The bend of the bundled model with stiction above sliding: as right as at one level, beside `rodas`."""
    model = Path(__file__).parents[2] / "models" / "single_bend.yaml"
    for curve in ("0.35", "{curve: coulomb, stiction: 0.45, coulomb: 0.35}"):
        text = model.read_text(encoding="utf-8").replace('friction: "{mu}"', f"friction: {curve}")
        assert curve in text
        (tmp_path / "bend.yaml").write_text(text, encoding="utf-8")
        found = {}
        for engine, accuracy in (("rodas", "1e-5"), ("stepping", "1e-3")):
            told = {"run.engine": engine, "run.accuracy": accuracy, "run.stop": "6 s"}
            result = fairlead.load(tmp_path / "bend.yaml", set=told).run(out=None)
            found[engine] = np.stack(
                [result.at(name, np.arange(0, 6, 0.05)) for name in result.match("line.hose_node[*].x")]
            )
        assert np.abs(found["stepping"] - found["rodas"]).max() < 1e-3 * np.ptp(found["rodas"], axis=1).max()

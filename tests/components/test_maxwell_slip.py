"""Maxwell slip against play operators, Masing's loops and the closed form of its lag, on every engine."""

import numpy as np
import pytest

import fairlead

NORMAL, MU, PRESLIDING = 10.0, 0.5, 0.1
YIELDS = PRESLIDING * np.arange(1, 5) / 4
SCENE = """schema: 1
name: pad
components:
  ground: {type: Ground}
  pad: {type: Contact, method: maxwell_slip, presliding: 0.1 m, normal_force: 10 N, curve: CURVE}
  drive: {type: MotionSource, velocity: VELOCITY}
connections: [[ground.flange, pad.a], [pad.b, drive.flange]]
run: {stop: 5 s, accuracy: 1e-7}
record: {every: 5 ms}
"""
PATH = {"t": [0, 0.999, 1.001, 1.999, 2.001, 2.499, 2.501, 2.799, 2.801, 5],
        "y": [0.16, 0.16, -0.3, -0.3, 0.1, 0.1, -0.1, -0.1, 0.12, 0.12]}  # fmt: skip
"""Forward through break-away, back through it, and forward with an inner loop."""


def run(tmp_path, curve, velocity, **values):
    (tmp_path / "scene.yaml").write_text(SCENE.replace("CURVE", str(curve)).replace("VELOCITY", str(velocity)))
    result = fairlead.load(tmp_path / "scene.yaml", set=values).run(out=None)
    assert result.ok, result.run["sentence"]
    return result


def place(t, path):
    """The integral of a speed that goes in straight lines."""
    ends = np.concatenate([[0.0], np.cumsum(np.diff(path["t"]) * (np.array(path["y"])[1:] + path["y"][:-1]) / 2)])
    k = np.clip(np.searchsorted(path["t"], t, side="right") - 1, 0, len(path["t"]) - 2)
    t0, v0 = np.array(path["t"])[k], np.array(path["y"])[k]
    slope = (np.diff(path["y"]) / np.diff(path["t"]))[k]
    return ends[k] + v0 * (t - t0) + slope * (t - t0) ** 2 / 2


def played(x, yields, level):
    """The force of springs of equal shares that give in at their yields: one play operator each."""
    bent, force, before = np.zeros(len(yields)), [], 0.0
    for now in x:
        bent = np.clip(bent + now - before, -yields, yields)
        before = now
        force.append(level * (bent / yields).mean())
    return np.array(force)


def turns(path):
    """Times at which the speed is zero on its straight lines."""
    t, v = np.array(path["t"]), np.array(path["y"])
    k = np.flatnonzero(v[:-1] * v[1:] < 0)
    return t[k] + v[k] / (v[k] - v[k + 1]) * (t[k + 1] - t[k])


@pytest.mark.parametrize(("engine", "shape"), [("rodas", 1.0), ("rodas", 2.5), ("stepping", 2.5), ("ida", 2.5)])
def test_friction_is_that_of_four_play_operators(tmp_path, engine, shape):
    result = run(tmp_path, MU, {"table": PATH}, **{"run.engine": engine, "pad.shape": shape})
    times = np.union1d(result.t, turns(PATH))  # play is exact from turn to turn
    expected = played(place(times, PATH), PRESLIDING * (np.arange(1, 5) / 4) ** shape, MU * NORMAL)
    at = np.searchsorted(times, result.t)
    np.testing.assert_allclose(result["pad.friction"], expected[at], atol=1e-5)  # ida locates to its accuracy


def test_an_inner_loop_closes_and_is_forgotten(tmp_path):
    """From 2.5 s to 2.8 s the path goes back; where it is there again the force is what it was."""
    result = run(tmp_path, MU, {"table": PATH})
    begins = turns(PATH)[2]
    target = place(begins, PATH)
    ends = 2.801 + (target - place(2.801, PATH)) / 0.12
    assert place(ends, PATH) == pytest.approx(target, abs=1e-12)
    first, second = result.at("pad.friction", np.array([begins, ends]))
    assert result.at("pad.friction", 2.8) < first - 1
    assert second == pytest.approx(first, abs=1e-5)


def test_a_cycle_costs_the_area_of_masings_loop(tmp_path):
    """Of each spring 4 k y (X - y) where the swing X is beyond its y: 7 cm are beyond the first two."""
    swing, frequency = 0.07, 0.5
    speed = {"sine": {"amplitude": 2 * np.pi * frequency * swing, "frequency": f"{frequency} Hz", "phase": np.pi / 2}}
    result = run(tmp_path, MU, speed, **{"run.stop": "4.5 s"})
    cycles = (result.t >= 0.5) & (result.t <= 4.5)  # from turn to turn
    power = result["pad.friction"][cycles] * result["pad.slip"][cycles]
    lost = sum(MU * NORMAL * (swing - y) for y in YIELDS if swing > y)
    assert np.trapezoid(power, result.t[cycles]) == pytest.approx(2 * lost, rel=1e-4)  # rows are 5 ms apart


def test_sliding_follows_the_curve_with_its_lag(tmp_path):
    """After a jump of the speed the force nears the curve as exp(-t/lag), and is on it in the end."""
    lag, v1, v2 = 0.05, 0.1, 0.4
    curve = "{curve: stribeck, stiction: 0.5, coulomb: 0.3, velocity: 0.2 m/s}"
    speed = {"table": {"t": [0, 3, 3.0001, 5], "y": [v1, v1, v2, v2]}}
    result = run(tmp_path, curve, speed, **{"pad.lag": f"{lag} s"})
    level = [NORMAL * (0.3 + 0.2 * np.exp(-((v / 0.2) ** 2))) for v in (v1, v2)]
    after = result.t > 3.001
    expected = level[1] + (level[0] - level[1]) * np.exp(-(result.t[after] - 3.00005) / lag)
    np.testing.assert_allclose(result["pad.friction"][after], expected, atol=2e-3)  # the jump takes 0.2 % of lag
    assert result.at("pad.friction", 2.9) == pytest.approx(level[0], rel=1e-5)


def test_a_surface_with_a_nap_bears_less_the_other_way(tmp_path):
    curve = "{curve: table, points: [[0, 0.6], [1, 0.6]], backward: [[0, 0.3], [1, 0.3]]}"
    for sign, level in ((1, 6.0), (-1, -3.0)):
        result = run(tmp_path, curve, sign * 0.1)
        assert result["pad.friction"][-1] == pytest.approx(level, rel=1e-6)

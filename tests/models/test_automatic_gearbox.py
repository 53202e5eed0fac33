"""An automatic gearbox with three gears: clutches and brakes round two planetary gears that are pressed in turn.

All contacts together would hold more than moves, and how they would share it no law says; they never hold at once.

Closed form, ratio 2.4 of both planetary gears (sun + 2.4 ring = 3.4 carrier): the turbine turns 5.8/2.4, 3.4/2.4 and 1
times as fast as the output; in the last gear all of it is one body.
"""

from __future__ import annotations

import pytest
from scipy.integrate import solve_ivp

SIMPSON = """
    components:
      {engine}: {{type: TorqueSource, torque: 150 N*m}}
      {turb}: {{type: Inertia, moment: 0.3 kg*m^2, speed: 0}}
      {hs}: {{type: Housing}}
      {c_fwd}: {{type: Clutch, radius: 0.08 m, faces: 8,
               curve: {{curve: stribeck, stiction: 0.14, coulomb: 0.12, velocity: 0.5 m/s}}}}
      {c_dir}: {{type: Clutch, radius: 0.08 m, curve: 0.12, faces: 8}}
      {b_2}: {{type: Brake, radius: 0.1 m, curve: 0.12, faces: 4}}
      {b_1}: {{type: OneWayClutch}}
      {p1}: {{type: Planetary, ratio: 2.4}}
      {p2}: {{type: Planetary, ratio: 2.4}}
      {r1}: {{type: Inertia, moment: 0.02 kg*m^2, speed: 0}}
      {sun}: {{type: Inertia, moment: 0.03 kg*m^2, speed: 0}}
      {pc2}: {{type: Inertia, moment: 0.02 kg*m^2, speed: 0}}
      {out}: {{type: Inertia, moment: 6 kg*m^2, speed: 0}}
      {load}: {{type: ShaftLoad, quadratic: 0.01 N*m*s^2/rad^2, linear: 0.3 N*m*s/rad}}
      {road}: {{type: ShaftFriction, sliding: 60 N*m}}
      {n_f}: {{type: SignalSource, value: {{table: {{t: [0, 0.2, 12], y: [0, 3000, 3000]}}}}}}
      {n_d}: {{type: SignalSource, value: {{table: {{t: [0, 7, 7.3, 12], y: [0, 0, 3500, 3500]}}}}}}
      {n_2}: {{type: SignalSource,
             value: {{table: {{t: [0, 3, 3.3, 7, 7.1, 12], y: [0, 0, 4000, 4000, 0, 0]}}}}}}
    connections:
      - [{engine}.shaft, {turb}.shaft, {c_fwd}.a, {c_dir}.a]
      - [{c_fwd}.b, {r1}.shaft, {p1}.ring]
      - [{c_dir}.b, {sun}.shaft, {p1}.sun, {p2}.sun, {b_2}.shaft]
      - [{p1}.carrier, {p2}.ring, {out}.shaft, {load}.shaft, {road}.b]
      - [{p2}.carrier, {pc2}.shaft, {b_1}.b]
      - [{hs}.shaft, {b_1}.a, {road}.a]
      - [{n_f}.signal, {c_fwd}.normal]
      - [{n_d}.signal, {c_dir}.normal]
      - [{n_2}.signal, {b_2}.normal]
    run: {{stop: 12 s}}
"""
PARTS = (
    "engine", "turb", "hs", "c_fwd", "c_dir", "b_2", "b_1", "p1", "p2", "r1", "sun", "pc2", "out", "load", "road",
    "n_f", "n_d", "n_2",
)  # fmt: skip
NAMES = {name: name for name in PARTS}
OTHERS = {name: f"x{(7 * k) % len(PARTS)}" for k, name in enumerate(PARTS)}


def at(result, names, part, t):
    return float(result.at(f"{names[part]}.speed", t))


@pytest.mark.parametrize(("names", "method"), [(NAMES, "hold"), (OTHERS, "hold"), (NAMES, "karnopp")])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_it_shifts_through_its_gears(simulate, engine, names, method):
    settings = {"run.engine": engine, "friction.method": method}
    result = simulate(SIMPSON.format(**names), **settings)
    for t, ratio in ((2.0, 5.8 / 2.4), (6.0, 3.4 / 2.4), (11.0, 1.0)):
        assert at(result, names, "turb", t) == pytest.approx(ratio * at(result, names, "out", t), rel=1e-3), t

    def slopes(_, y):
        return [(150 - 60 - 0.3 * y[0] - 0.01 * y[0] ** 2) / 6.37]

    begins = at(result, names, "out", 9.0)
    ends = solve_ivp(slopes, (9, 12), [begins], rtol=1e-9).y[0, -1]
    assert at(result, names, "out", 12.0) == pytest.approx(ends, rel=1e-4)
    assert result.run["energy"]["closure"] < 1e-3


def test_treatments_of_friction_agree(simulate):
    times = [1.0, 2.5, 4.0, 6.5, 9.0, 12.0]
    ends = [simulate(SIMPSON.format(**NAMES), **{"friction.method": method}).at("out.speed", times)
            for method in ("hold", "binding", "tanh")]  # fmt: skip
    assert ends[0] == pytest.approx(ends[1], rel=1e-3)
    assert ends[0] == pytest.approx(ends[2], rel=1e-3)


def test_brakes_that_are_always_pressed_hold_too_much(scene):
    """At rest all three hold, and nothing says how they share: that is refused by name."""
    text = """
        components:
          engine: {type: TorqueSource, torque: 30 N*m}
          s: {type: Inertia, moment: 0.3 kg*m^2}
          r: {type: Inertia, moment: 0.3 kg*m^2}
          c: {type: Inertia, moment: 1 kg*m^2}
          p: {type: Planetary, ratio: 2}
          bs: {type: Brake, radius: 0.1 m, curve: 0.3, normal_force: 300 N}
          br: {type: Brake, radius: 0.1 m, curve: 0.3, normal_force: 400 N}
          bc: {type: Brake, radius: 0.1 m, curve: 0.3, normal_force: 500 N}
        connections:
          - [engine.shaft, s.shaft, p.sun, bs.shaft]
          - [r.shaft, p.ring, br.shaft]
          - [c.shaft, p.carrier, bc.shaft]
        run: {stop: 1 s}
    """
    with pytest.raises(Exception, match="how they share is not known"):
        scene(text).run(out=None)


def test_signals_that_press_all_of_them_at_once_end_the_run_with_their_names(scene):
    parts = "\n".join(
        f"          n{k}: {{type: SignalSource, value: {{constant: {force}}}}}\n"
        f"          b{k}: {{type: Brake, radius: 0.1 m, curve: 0.3}}"
        for k, force in ((1, 300), (2, 400), (3, 500))
    )
    text = f"""
        components:
          engine: {{type: TorqueSource, torque: {{ramp: {{to: 60 N*m, over: 2 s}}}}}}
          s: {{type: Inertia, moment: 0.3 kg*m^2}}
          r: {{type: Inertia, moment: 0.3 kg*m^2}}
          c: {{type: Inertia, moment: 1 kg*m^2}}
          p: {{type: Planetary, ratio: 2}}
{parts}
        connections:
          - [engine.shaft, s.shaft, p.sun, b1.shaft]
          - [r.shaft, p.ring, b2.shaft]
          - [c.shaft, p.carrier, b3.shaft]
          - [n1.signal, b1.normal]
          - [n2.signal, b2.normal]
          - [n3.signal, b3.normal]
        run: {{stop: 2 s}}
    """
    result = scene(text).run(out=None, check=False)
    assert result.status == "failed"
    assert "If all of b1.contact, b2.contact, b3.contact hold" in result.run["sentence"]
    assert "write method: binding for one of them" in result.run["sentence"]

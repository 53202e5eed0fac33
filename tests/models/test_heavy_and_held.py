"""Heavy bodies that two contacts hold while, anywhere in the scene, a very short step is taken.

A contact whose normal force is ramped to zero lifts a picosecond before the corner of the ramp, and the step that is
left is that long. All that the forces of contacts do to a heavy body in it is far below its speed: still they are known
by that alone. Nothing may happen to what is held.
"""

import pytest

ENGINES = ["rodas", "stepping", "ida"]
CAR = """
components:
  g: {{type: Ground}}
  {car}: {{type: Mass, mass: {mass} kg, position: 0, velocity: 0}}
  {c1}: {{type: Contact, normal_force: {press} N, curve: 0.3}}
  {c2}: {{type: Contact, normal_force: {press} N, curve: 0.3}}
  load: {{type: ForceSource, force: {load} N}}
  free: {{type: Mass, mass: 20 kg, position: 0, velocity: 1}}
  pad: {{type: Contact, curve: 0.3}}
  p: {{type: SignalSource, value: {{ramp: {{from: {press}, to: 0, start: 1 s, over: {over} s}}}}}}
connections:
  - [g.flange, {c1}.a, {c2}.a, pad.a]
  - [{car}.flange, {c1}.b, {c2}.b, load.flange]
  - [free.flange, pad.b]
  - [p.signal, pad.normal]
run: {{stop: 2 s}}
"""
DRUM = """
components:
  drum: {{type: Inertia, moment: {moment}, angle: 0, speed: 0}}
  b1: {{type: Brake, radius: 0.5, curve: 0.3, normal_force: 300 kN}}
  b2: {{type: Brake, radius: 0.5, curve: 0.3, normal_force: 210 kN}}
  t: {{type: TorqueSource, torque: 15 kN*m}}
  d2: {{type: Inertia, moment: 100, angle: 0, speed: 1}}
  b3: {{type: Brake, radius: 0.3, curve: 0.3}}
  p: {{type: SignalSource, value: {{ramp: {{from: 300000, to: 0, start: 1 s, over: {over} s}}}}}}
connections:
  - [drum.shaft, b1.shaft, b2.shaft, t.shaft]
  - [d2.shaft, b3.shaft]
  - [p.signal, b3.normal]
run: {{stop: 2 s}}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("over", [0.05, 0.1, 0.5])
@pytest.mark.parametrize("mass", [1e4, 1e5, 1e6])
def test_a_car_that_two_contacts_hold_stays(simulate, mass, over, engine):
    """Each takes half of the load, of which each could hold six times as much."""
    load = 0.3 * mass
    text = CAR.format(mass=mass, press=3 * mass, load=load, over=over, car="car", c1="c1", c2="c2")
    result = simulate(text, **{"run.engine": engine})
    assert result.at("car.x", 2.0) == pytest.approx(0.0, abs=1e-9)
    for name in ("c1", "c2"):
        assert abs(result.at(f"{name}.friction", 2.0)) == pytest.approx(load / 2, rel=1e-6)


def test_names_and_order_do_not_matter(simulate):
    for names in (("z", "y", "x"), ("a", "q", "b")):
        given = dict(zip(("car", "c1", "c2"), names, strict=True))
        result = simulate(CAR.format(mass=1e5, press=3e5, load=3e4, over=0.1, **given))
        assert result.at(f"{names[0]}.x", 2.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("over", [0.1, 0.2])
@pytest.mark.parametrize("moment", [50, 773, 1000, 1e5])
def test_a_drum_that_two_brakes_hold_stays(simulate, moment, over, engine):
    result = simulate(DRUM.format(moment=moment, over=over), **{"run.engine": engine})
    assert result.at("drum.angle", 2.0) == pytest.approx(0.0, abs=1e-9)
    held = result.at("b1.torque", 2.0) + result.at("b2.torque", 2.0)
    assert abs(held) == pytest.approx(15e3, rel=1e-6)


CRANK = """
components:
  brk: {{type: Brake, radius: 0.2, curve: {{curve: coulomb, stiction: 0.35, coulomb: 0.3}}}}
  ck: {{type: Inertia, moment: 0.05725957212001965, angle: 1.3734784802181383, speed: 8.136895356534456}}
  crk: {{type: Crank, radius: 0.04101301887600105, rod: 0.18499793079426546}}
  ram: {{type: Mass, mass: 26.797170429921064}}
  gd: {{type: Contact, curve: 0.1157497161027665, normal_force: 262.88}}
  g: {{type: Ground}}
  wk: {{type: Spring, stiffness: 993.4787031635541, free_length: 0.02031777375472285}}
  bed: {{type: FixedPoint, position: 0.20506509438000525}}
  pb: {{type: SignalSource, value: {{ramp: {{to: {press}, start: 0.1898521645332492, over: 0.06193251470211391}}}}}}
connections:
  - [ck.shaft, brk.shaft, crk.shaft]
  - [crk.slider, ram.flange, gd.b, wk.a]
  - [g.flange, gd.a]
  - [pb.signal, brk.normal]
  - [bed.flange, wk.b]
run: {{stop: 0.6 s, max_steps: 20000}}
"""


@pytest.mark.parametrize("accuracy", [1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7])
def test_a_braked_crank_comes_to_rest_with_its_slider(simulate, accuracy):
    """Both contacts come to rest at one instant: growth that is told by two roundings took steps of no length."""
    result = simulate(CRANK.format(press=167.20927173741933), **{"run.accuracy": accuracy})
    rest = result.at("ck.angle", 0.4)
    assert result.at("ck.angle", 0.6) == pytest.approx(rest, abs=1e-9)
    assert result.at("ck.speed", 0.6) == pytest.approx(0.0, abs=1e-9)

"""One body held by several rigid one-sided parts to motions that are given: it follows the one that leads.

Where the given motions differ no two parts can hold; the one that would have to pull opens. That is so when they begin
to differ in acceleration only, whatever the load, the inertia and the names. Closed forms: the largest of the speeds.
"""

import math

import pytest

ENGINES = ["rodas", "stepping", "ida"]
FREEWHEELS = """
    components:
      MA: {type: SpeedSource, speed: 10 rad/s}
      MB: {type: SpeedSource, speed: {ramp: {to: 20 rad/s, over: 2 s}}}
      FA: {type: OneWayClutch}
      FB: {type: OneWayClutch}
      shaft: {type: Inertia, moment: MOMENT kg*m^2, angle: 0, speed: 10 rad/s}
      load: {type: ShaftLoad, linear: LOAD N*m*s/rad}
    connections: [[MA.shaft, FA.a], [MB.shaft, FB.a], [FA.b, FB.b, shaft.shaft, load.shaft]]
    run: {stop: 2.5 s, engine: ENGINE, accuracy: ACCURACY}
    record: {signals: [shaft.speed, FA.slip, FB.slip, FB.torque]}
"""


def freewheels(engine, moment=1e-3, load=1.0, accuracy=1e-4, names=("m1", "m2", "f1", "f2")):
    text = FREEWHEELS.replace("ENGINE", engine).replace("MOMENT", repr(moment)).replace("LOAD", repr(load))
    for old, new in zip(("MA", "MB", "FA", "FB"), names, strict=True):
        text = text.replace(old, new)
    return text.replace("ACCURACY", repr(accuracy))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("moment", "load"), [(1e-3, 1.0), (1e-2, 1.0), (1e-6, 1e3), (10.0, 1e-3), (1e-3, 1e6)])
def test_a_shaft_follows_the_faster_of_two_motors(simulate, engine, moment, load):
    result = simulate(freewheels(engine, moment, load))
    for t in (0.5, 1.01, 1.05, 1.5, 2.2):
        assert result.at("shaft.speed", t) == pytest.approx(max(10.0, min(10.0 * t, 20.0)), rel=1e-4)
    assert result.at("f2.torque", 1.5) == pytest.approx(15.0 * load + 10.0 * moment, rel=1e-3)
    assert result["f2.slip"].min() > (-2e-2 if engine == "ida" else -1e-2)  # until the other opens


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("accuracy", [1e-2, 1e-3, 1e-6])
def test_at_every_accuracy_and_under_other_names(simulate, engine, accuracy):
    first = simulate(freewheels(engine, accuracy=accuracy))
    second = simulate(freewheels(engine, accuracy=accuracy, names=("z1", "a1", "y", "b")))
    assert first.at("shaft.speed", 1.5) == pytest.approx(15.0, rel=accuracy)
    assert second.at("shaft.speed", 1.5) == first.at("shaft.speed", 1.5)


@pytest.mark.parametrize("engine", ENGINES)
def test_motions_that_part_smoothly_are_told_apart_all_the_same(simulate, engine):
    """2 - 2 cos of 0.5, 0.7 and 0.6 Hz: from rest, with one acceleration at first; the lead goes over at 5/6 s."""
    result = simulate(f"""
        components:
          m1: {{type: SpeedSource, speed: {{sine: {{amplitude: 2, offset: 2, frequency: 0.5 Hz, phase: -90 deg}}}}}}
          m2: {{type: SpeedSource, speed: {{sine: {{amplitude: 2, offset: 2, frequency: 0.7 Hz, phase: -90 deg}}}}}}
          m3: {{type: SpeedSource, speed: {{sine: {{amplitude: 2, offset: 2, frequency: 0.6 Hz, phase: -90 deg}}}}}}
          f1: {{type: OneWayClutch}}
          f2: {{type: OneWayClutch}}
          f3: {{type: OneWayClutch}}
          shaft: {{type: Inertia, moment: 0.01 kg*m^2, angle: 0, speed: 0 rad/s}}
          load: {{type: ShaftLoad, linear: 1 N*m*s/rad}}
        connections: [[m1.shaft, f1.a], [m2.shaft, f2.a], [m3.shaft, f3.a], [f1.b, f2.b, f3.b, shaft.shaft, load.shaft]]
        run: {{stop: 1 s, engine: {engine}}}
        record: {{signals: [shaft.speed]}}
    """)
    for t in (0.02, 0.1, 0.4, 0.78, 0.9, 0.99):
        leads = max(2.0 - 2.0 * math.cos(2.0 * math.pi * f * t) for f in (0.5, 0.6, 0.7))
        assert result.at("shaft.speed", t) == pytest.approx(leads, abs=4e-4)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("torque", [0.5, 50.0, 500.0])
def test_a_ratchet_with_a_backstop_starts_at_once(simulate, engine, torque):
    result = simulate(f"""
        components:
          drive: {{type: SpeedSource, speed: {{ramp: {{to: 5 rad/s, over: 1.5 s}}}}}}
          house: {{type: Housing}}
          freewheel: {{type: OneWayClutch}}
          backstop: {{type: OneWayClutch}}
          wheel: {{type: Inertia, moment: 0.01 kg*m^2, angle: 0, speed: 0}}
          load: {{type: TorqueSource, torque: {-torque} N*m}}
        connections: [[drive.shaft, freewheel.a], [house.shaft, backstop.a],
                      [freewheel.b, backstop.b, wheel.shaft, load.shaft]]
        run: {{stop: 2 s, engine: {engine}}}
        record: {{signals: [wheel.angle, wheel.speed]}}
    """)
    assert result["wheel.angle"][-1] == pytest.approx(5.0 * 0.75 + 2.5, rel=1e-5)
    assert result.at("wheel.speed", 0.003) == pytest.approx(0.01, rel=1e-2)


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_box_that_a_fork_lifts_off_the_floor_goes_with_the_fork(simulate, engine, restitution):
    result = simulate(f"""
        components:
          floor: {{type: Ground}}
          fork: {{type: MotionSource, velocity: {{table: [[0 s, 0], [0.5 s, 0], [1 s, 0.5 m/s], [2 s, 0.5 m/s]]}}}}
          box: {{type: Mass, mass: 20 kg, position: 0, velocity: 0}}
          weight: {{type: ForceSource, force: -196 N}}
          rests: {{type: RigidStop, restitution: {restitution}}}
          lifts: {{type: RigidStop, restitution: {restitution}}}
        connections: [[floor.flange, rests.a], [fork.flange, lifts.a],
                      [rests.b, lifts.b, box.flange, weight.flange]]
        run: {{stop: 2 s, engine: {engine}}}
        record: {{signals: [box.v, lifts.gap, rests.force]}}
    """)
    for t in (0.502, 0.51, 0.7, 1.5):
        assert result.at("box.v", t) == pytest.approx(min(t - 0.5, 0.5), abs=1e-4)
    assert result["lifts.gap"].max() < 1e-6


@pytest.mark.parametrize("engine", ENGINES)
def test_a_shaft_between_two_claws_that_drift_apart_ends_the_run_by_name(scene, engine):
    model = scene(f"""
        components:
          m1: {{type: SpeedSource, speed: 10 rad/s}}
          m2: {{type: SpeedSource, speed: {{table: [[0 s, 10], [1 s, 10], [2 s, 12]]}}}}
          d1: {{type: DogClutch, synchronised: 0.5 rad/s}}
          d2: {{type: DogClutch, synchronised: 0.5 rad/s}}
          on: {{type: SignalSource, value: 1}}
          shaft: {{type: Inertia, moment: 1e-3 kg*m^2, angle: 0, speed: 10 rad/s}}
        connections: [[m1.shaft, d1.a], [m2.shaft, d2.a], [d1.b, d2.b, shaft.shaft], [on.signal, d1.engage, d2.engage]]
        run: {{stop: 2 s, engine: {engine}}}
    """)
    result = model.run(out=None, check=False)
    assert result.status == "failed"
    assert result.t[-1] == pytest.approx(1.0, abs=0.02)
    assert "motions that are given move apart" in result.run["sentence"]
    assert any(name in result.run["sentence"] for name in ("d1.", "d2."))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("holds", ["backstop", "brake"])
def test_a_carrier_that_a_second_drive_takes_over_frees_the_ring(simulate, engine, holds):
    """12 rad/s at the sun, the ring held: the carrier turns at 3 until the ramp gets there; then ring = (4 c - 12)/3.

    Load, carrier and ring: torque 5 c + 0.5 c' + (4/3) 0.1 (4/3) c', and (4/3) of what a brake of 20 N*m takes.
    """
    part = {
        "backstop": "{type: OneWayClutch}",
        "brake": "{type: Clutch, radius: 0.1 m, normal_force: 400 N, curve: 0.5}",
    }[holds]
    result = simulate(f"""
        components:
          first: {{type: SpeedSource, speed: 12 rad/s}}
          second: {{type: SpeedSource, speed: {{ramp: {{to: 10 rad/s, over: 2 s}}}}}}
          gear: {{type: Planetary, ratio: 3}}
          ring: {{type: Inertia, moment: 0.1 kg*m^2, angle: 0, speed: 0}}
          carrier: {{type: Inertia, moment: 0.5 kg*m^2, angle: 0, speed: 3 rad/s}}
          house: {{type: Housing}}
          load: {{type: ShaftLoad, linear: 5 N*m*s/rad}}
          holds: {part}
          takes: {{type: OneWayClutch}}
        connections: [[first.shaft, gear.sun], [gear.ring, ring.shaft, holds.b], [house.shaft, holds.a],
                      [second.shaft, takes.a], [gear.carrier, carrier.shaft, takes.b, load.shaft]]
        run: {{stop: 2 s, engine: {engine}}}
        record: {{signals: [carrier.speed, ring.speed, takes.torque]}}
    """)
    for t in (0.3, 0.602, 0.7, 1.0, 1.9):
        speed = max(3.0, 5.0 * t)
        assert result.at("carrier.speed", t) == pytest.approx(speed, rel=1e-4)
        assert result.at("ring.speed", t) == pytest.approx((4.0 * speed - 12.0) / 3.0, abs=1e-3)
    friction = 0.0 if holds == "backstop" else 4.0 / 3.0 * 20.0
    assert result.at("takes.torque", 1.0) == pytest.approx(25.0 + 2.5 + (16.0 / 9.0) * 0.5 + friction, rel=1e-4)

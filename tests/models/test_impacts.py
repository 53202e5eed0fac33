"""Impacts by impulse: a rigid stop takes what it must, friction under a finite force takes nothing.

Closed forms are those of bodies that go on together after a blow: momentum is kept, the rest of the energy is lost.
"""

import pytest

from fairlead.errors import ModelError

LIBRARY = '''
class RigidStop(Component):
    """Keeps a from passing b, without rebound."""

    a = Translational("the one behind")
    b = Translational("the one in front")
    push = Unknown("N", "Force that keeps them apart.")
    force = Output("N", "The same.")
    zones = Zones("free", "touching")

    @zone("free")
    def apart(p, a, b, push):
        """Nothing touches."""
        return Law(a=0, b=0, push=push, force=0)

    @zone("touching")
    def together(p, a, b, push):
        """One speed."""
        return Law(a=push, b=-push, push=hold(b.v - a.v), force=push)

    @guard("free", to="touching", unit="m")
    def meets(p, a, b):
        """The gap is closed."""
        return a.x - b.x

    @guard("touching", to="free", unit="N")
    def parts(p, push):
        """It would have to pull."""
        return -push
'''
BLOW = """
    components:
      one: {type: Mass, mass: 1 kg, position: 0 m, velocity: 10 m/s}
      two: {type: Mass, mass: 3 kg, position: 1 m, velocity: 0 m/s}
      stop: {type: RigidStop}
      ground: {type: Ground}
      pad: {type: Contact, normal_force: 0.001 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
    connections:
      - [one.flange, stop.a]
      - [two.flange, stop.b, pad.b]
      - [ground.flange, pad.a]
    run: {stop: 0.3 s, accuracy: 1e-6}
    record: {signals: ["*"]}
"""
ENGINES = ("rodas", "ida")


@pytest.fixture
def blow(simulate, library):
    stop = library(LIBRARY)

    def run(text, **overrides):
        return simulate(text, (stop,), **overrides)

    return run


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", ["hold", "karnopp", "binding"])
def test_a_blow_through_a_held_contact_moves_what_the_contact_holds(blow, engine, method) -> None:
    """1 kg at 10 m/s meets 3 kg that rest with a millinewton of friction: 2.5 m/s, and 37.5 J are lost."""
    result = blow(BLOW, **{"friction.method": method, "run.engine": engine})
    for name in ("one.v", "two.v"):
        assert result[name][-1] == pytest.approx(2.5 - 5e-4 / 4 * 0.2, abs=1e-5)
    assert result.run["energy"]["dissipated"] == pytest.approx(37.5, abs=1e-2)
    assert result.run["energy"]["closure"] < 1e-6


def test_a_blow_goes_through_bodies_that_touch(blow) -> None:
    """The third is touched by the second: all three go on at a third of the speed."""
    text = """
    components:
      one: {type: Mass, mass: 1 kg, position: -1 m, velocity: 9 m/s}
      two: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      three: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      first: {type: RigidStop}
      second: {type: RigidStop}
      push: {type: ForceSource, force: 1 N}
      ground: {type: Ground}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
    connections:
      - [one.flange, first.a]
      - [two.flange, first.b, second.a, push.flange]
      - [three.flange, second.b, pad.b]
      - [ground.flange, pad.a]
    run: {stop: 0.112 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = blow(text)
    at = 1 / 9
    after = 3.0 + (1.0 - 5.0) / 3.0 * (0.112 - at)
    for name in ("one.v", "two.v", "three.v"):
        assert result[name][-1] == pytest.approx(after, abs=1e-5)


def test_a_stop_that_would_have_to_pull_opens(blow) -> None:
    """The second is struck away from the third, which only touches it from behind and stays."""
    text = """
    components:
      one: {type: Mass, mass: 1 kg, position: -1 m, velocity: 10 m/s}
      two: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      three: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      first: {type: RigidStop}
      second: {type: RigidStop}
      pull: {type: ForceSource, force: -1 mN}
      pushed: {type: ForceSource, force: 1 mN}
    connections:
      - [one.flange, first.a]
      - [two.flange, first.b, second.b, pull.flange]
      - [three.flange, second.a, pushed.flange]
    run: {stop: 0.2 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = blow(text)
    assert result["one.v"][-1] == pytest.approx(5.0, abs=1e-3)
    assert result["two.v"][-1] == pytest.approx(5.0, abs=1e-3)
    assert result["three.v"][-1] == pytest.approx(0.0, abs=1e-3)


def test_a_wall_that_moves_gives_the_energy_it_gives(blow) -> None:
    """1 kg at 10 m/s meets a wall at 4 m/s: 18 J are lost, and the wall takes (10 - 4) * 4 = 24 J."""
    text = """
    components:
      one: {type: Mass, mass: 1 kg, position: -6 m, velocity: 10 m/s}
      wall: {type: MotionSource, velocity: 4 m/s, origin: 0 m}
      stop: {type: RigidStop}
      push: {type: ForceSource, force: 1 mN}
    connections: [[one.flange, stop.a, push.flange], [wall.flange, stop.b]]
    run: {stop: 1.5 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = blow(text)
    assert result["one.v"][-1] == pytest.approx(4.0, abs=1e-9)
    energy = result.run["energy"]
    assert energy["dissipated"] == pytest.approx(18.0, abs=1e-2)
    assert energy["supplied"] == pytest.approx(-24.0, abs=2e-2)
    assert energy["closure"] < 1e-6
    assert result.run["lost"] == {"stop": pytest.approx(18.0, abs=1e-2)}


@pytest.mark.parametrize(("across", "mu", "stays"), [(2.0, 0.3, False), (2.0, 0.5, True), (-2.0, 0.3, False)])
def test_friction_under_an_impulsive_normal_force_takes_mu_times_the_impulse(blow, across, mu, stays) -> None:
    """A body that strikes a wall at 5 m/s and slides along it: P_n = 5 N s, so P_t is at most 5 mu."""
    text = f"""
    components:
      into: {{type: Mass, mass: 1 kg, position: -1 m, velocity: 5 m/s}}
      along: {{type: Mass, mass: 1 kg, position: 0 m, velocity: {across} m/s}}
      wall: {{type: Ground}}
      side: {{type: Ground}}
      stop: {{type: RigidStop}}
      press: {{type: ForceSource, force: 10 mN}}
      rub: {{type: Contact, curve: {{curve: coulomb, stiction: {mu}, coulomb: {mu}}}}}
    connections:
      - [into.flange, stop.a, press.flange]
      - [wall.flange, stop.b]
      - [side.flange, rub.a]
      - [along.flange, rub.b]
      - [stop.force, rub.normal]
    run: {{stop: 0.2001 s, accuracy: 1e-6}}
    record: {{signals: ["*"]}}
    """
    result = blow(text)
    left = 0.0 if stays else across - (1 if across > 0 else -1) * mu * 5.0
    assert result["along.v"][-1] == pytest.approx(left, abs=1e-3)


def test_a_run_tells_which_start_values_did_not_hold(blow) -> None:
    """Two bodies that touch and run into each other at the start: an impulse begins the run, and is told."""
    text = """
    components:
      one: {type: Mass, mass: 1 kg, position: 0 m, velocity: 4 m/s}
      two: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
      stop: {type: RigidStop}
      push: {type: ForceSource, force: 1 mN}
    connections: [[one.flange, stop.a, push.flange], [two.flange, stop.b]]
    run: {stop: 0.1 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = blow(text)
    assert result["two.v"][-1] == pytest.approx(2.0, abs=1e-3)
    told = {one["name"]: (one["given"], one["became"]) for one in result.run["changed_starts"]}
    assert told == {"one.v": (4.0, pytest.approx(2.0)), "two.v": (0.0, pytest.approx(2.0))}


GEAR = """
components:
  rotor: {{type: Inertia, moment: 1 kg*m^2, speed: 10 rad/s}}
  box: {{type: {kind}}}
  drum: {{type: Inertia, moment: 2 kg*m^2{speed}}}
  brake: {{type: Brake, radius: 0.1 m, normal_force: 1 N, curve: 0.5}}
connections:
  - [rotor.shaft, box.a]
  - [box.b, drum.shaft, brake.shaft]
run: {{stop: 1 ms, accuracy: 1e-6}}
record: {{signals: ["*"]}}
"""


@pytest.mark.parametrize(
    ("kind", "ratio"), [("Gearbox, ratio: 0.5", 0.5), ("TorqueSensor", 1.0), ("Gear, ratio: -2", -2.0)]
)
def test_a_speed_that_nobody_gave_follows_from_what_it_is_joined_to(simulate, kind, ratio) -> None:
    text = GEAR.format(kind=kind, speed="")
    result = simulate(text)
    assert result["rotor.speed"][0] == pytest.approx(10.0, abs=1e-9)
    assert result["drum.speed"][0] == pytest.approx(ratio * 10.0, abs=1e-9)
    assert result.run["changed_starts"] == []


@pytest.mark.parametrize("kind", ["Gearbox, ratio: 0.5", "TorqueSensor"])
def test_speeds_that_contradict_each_other_are_refused_with_both_ends(scene, kind) -> None:
    text = GEAR.format(kind=kind, speed=", speed: 3 rad/s")
    with pytest.raises(ModelError, match=r"rotor.*drum.* at 3 rad/s"):
        scene(text).check()


def test_a_start_speed_below_that_with_which_a_contact_lands_is_listed(scene) -> None:
    """1e-7 m/s is below stick_speed, 1e-6 m/s, and far below the weight of a speed: the block begins held."""
    text = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg, velocity: 1e-7 m/s}
      pad: {type: SlideFriction, sliding: 1e-12 N}
    connections: [[ground.flange, pad.a], [block.flange, pad.b]]
    run: {stop: 1 s}
    """
    (told,) = scene(text).run(out=None).run["changed_starts"]
    assert (told["name"], told["given"], told["became"]) == ("block.v", 1e-7, 0.0)

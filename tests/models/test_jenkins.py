"""Nodes without inertia between springs and contacts: Jenkins' element, Iwan's chains, jumps; and in gears."""

import numpy as np
import pytest

from fairlead.errors import ModelError, UsageError
from tests.reference.jenkins import force, turns_of_sine

AMPLITUDE, PACE, STOP = 0.04, 2 * np.pi * 1.1, 2.0
DRIVE = "hand: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.1 Hz}}}"


def scene(*parts, joins, stop=STOP, accuracy="1e-6", method="hold", engine="auto", more=""):
    components = "\n".join(f"      {part}" for part in parts)
    return f"""
    components:
      floor: {{type: Ground}}
{components}
    connections: [{joins}]
    friction: {{method: {method}}}
    run: {{stop: {stop} s, accuracy: {accuracy}, engine: {engine}}}
    {more}
    """


def element(k, stiffness, limit, curve="1.0"):
    return (f"s{k}: {{type: Spring, stiffness: {stiffness} N/m}}",
            f"p{k}: {{type: Contact, normal_force: {limit} N, curve: {curve}}}")  # fmt: skip


def driven(t, stiffness, limit):
    """Force of an element at the sine of DRIVE."""
    turns = turns_of_sine(PACE, STOP)
    return force(t, AMPLITUDE * np.sin(PACE * t), AMPLITUDE * np.sin(PACE * turns), turns, stiffness, limit)


SINGLE = {"joins": "[floor.flange, p0.a], [hand.flange, s0.a], [s0.b, p0.b]"}


@pytest.mark.parametrize(
    ("engine", "accuracy"),
    [("rodas", "1e-3"), ("rodas", "1e-6"), pytest.param("ida", "1e-5", marks=pytest.mark.slow)],
)
def test_the_element_follows_the_play_operator(simulate, engine, accuracy):
    """Elastic up to its limit, then at it, in every half turn; two switches in each."""
    result = simulate(scene(DRIVE, *element(0, 500, 2), **SINGLE, engine=engine, accuracy=accuracy))
    exact = driven(result.t, 500, 2)
    assert -result["s0.tension"] == pytest.approx(exact, abs=5 * float(accuracy))  # of 2 N
    assert result.run["counters"]["switches"] == 9  # four turns, the first from rest
    assert result.run["energy"]["closure"] < 10 * float(accuracy)


def test_elements_side_by_side_add_up_to_masings_loops(simulate):
    """Rising limits: a backbone of straight pieces, and branches twice its size."""
    sizes = [(500, 1.0), (400, 3.0), (300, 6.0)]
    parts = [part for k, size in enumerate(sizes) for part in element(k, *size)]
    joins = ("[floor.flange, p0.a, p1.a, p2.a], [hand.flange, s0.a, s1.a, s2.a], "
             "[s0.b, p0.b], [s1.b, p1.b], [s2.b, p2.b]")  # fmt: skip
    result = simulate(scene(DRIVE, *parts, joins=joins))
    total = -sum(result[f"s{k}.tension"] for k in range(3))
    assert total == pytest.approx(sum(driven(result.t, *size) for size in sizes), abs=2e-5)


@pytest.mark.parametrize(("one", "two"), [(2.0, 3.0), (3.0, 2.0)])
def test_spring_contact_spring_contact_is_one_element_of_the_weaker(simulate, one, two):
    """In a row: 1/k = 1/500 + 1/400. Where the second slides, the nodes of the first move as one, on nothing else."""
    parts = [*element(0, 500, one), *element(1, 400, two)]
    joins = "[hand.flange, s0.a], [s0.b, p0.b], [p0.a, s1.a], [s1.b, p1.b], [p1.a, floor.flange]"
    result = simulate(scene(DRIVE, *parts, joins=joins))
    assert -result["s0.tension"] == pytest.approx(driven(result.t, 500 * 400 / 900, min(one, two)), abs=2e-5)
    assert -result["s1.tension"] == pytest.approx(-result["s0.tension"], abs=1e-6)


def ladder(t_of, steps):
    """Two nodes on the floor, a spring from the drive to the first and one on: least energy, step by step."""
    k, limits, x, found = (500.0, 400.0), (2.0, 3.0), np.zeros(2), []
    for h in t_of(np.arange(steps + 1) / steps * STOP):
        for _ in range(200):  # each node in turn to where it costs least; convex, so that this comes to the end
            for i in range(2):
                stiffness = k[0] + k[1] if i == 0 else k[1]
                free = (k[0] * h + k[1] * x[1]) / stiffness if i == 0 else x[0]
                before = found[-1][i] if found else 0.0
                give = limits[i] / stiffness
                x[i] = before + np.sign(free - before) * max(abs(free - before) - give, 0.0)
        found.append(x.copy())
    return np.array(found)


def test_a_chain_on_the_floor_slides_link_by_link(simulate):
    """Oracle: of all rate-independent motions the one of least energy and dissipation at every step of 4 ms."""
    joins = "[floor.flange, p0.a, p1.a], [hand.flange, s0.a], [s0.b, p0.b, s1.a], [s1.b, p1.b]"
    text = scene(DRIVE, *element(0, 500, 2), *element(1, 400, 3), joins=joins, more="record: {every: 4 ms}")
    result = simulate(text)
    nodes = ladder(lambda t: AMPLITUDE * np.sin(PACE * t), 500)
    grid = np.searchsorted(result.t, np.arange(501) * 4e-3 - 1e-9)
    assert -result["s1.tension"][grid] == pytest.approx(400 * (nodes[:, 0] - nodes[:, 1]), abs=4e-3)  # of 3 N, at turns


@pytest.mark.slow
def test_an_oscillator_with_an_element_agrees_with_a_little_mass_between(simulate):
    text = scene("body: {type: Mass, mass: 1 kg, velocity: 1 m/s}", "main: {type: Spring, stiffness: 300 N/m}",
                 *element(0, 500, 2), "JOINED",
                 joins="[floor.flange, p0.a, main.a], [body.flange, s0.a, main.b], [s0.b, p0.b]")  # fmt: skip
    none = simulate(text.replace("      JOINED\n", ""))
    grain = text.replace("JOINED", "grain: {type: Mass, mass: 1e-6 kg}")
    some = simulate(grain.replace("p0.b]]", "p0.b, grain.flange]]"))
    times = np.linspace(0, STOP, 40)
    for name in ("body.x", "s0.tension"):
        # the grain rings at 3.6 kHz, at sqrt(m k) v = 0.02 N at most
        within = {"body.x": 2e-5, "s0.tension": 3e-2}[name]
        assert none.at(name, times) == pytest.approx(some.at(name, times), abs=within)
    assert none.run["energy"]["closure"] < 1e-6


RAMP = "hand: {type: MotionSource, velocity: 0.01 m/s}"
FALLS = "{curve: coulomb, stiction: 0.3, coulomb: 0.2}"


@pytest.mark.slow
@pytest.mark.parametrize("method", ["hold", "karnopp", "binding"])
def test_where_friction_falls_the_node_jumps_and_what_that_takes_is_booked(simulate, method):
    """k 500, 3 N to let go, 2 N to slide: at 0.6 s the node jumps by 2 mm; (3 - 2)^2/(2 k) is lost beside friction."""
    text = scene(RAMP, *element(0, 500, 10, FALLS), **SINGLE, method=method, more="record: {every: 10 ms}")
    result = simulate(text)
    exact = np.where(result.t < 0.6, 5 * result.t, 2.0)
    near = np.abs(result.t - 0.6) < 5e-3  # binding creeps by 0.03 mm before
    assert -result["s0.tension"][~near] == pytest.approx(exact[~near], abs={"binding": 2e-2}.get(method, 1e-6))
    spent = 3**2 / 1000 + 2 * 0.01 * 1.4 - 2**2 / 1000
    assert result["energy.dissipated"][-1] == pytest.approx(spent, abs={"binding": 5e-5}.get(method, 1e-8))


@pytest.mark.parametrize("method", ["tanh", "dahl", "reset_integrator", "arctan"])
def test_contacts_that_creep_or_bend_slide_on_such_a_node(simulate, method):
    """After break-away the spring carries 2 N; arctan comes within a hundredth of it at 64 times its creep."""
    result = simulate(scene(RAMP, *element(0, 500, 2), **SINGLE, method=method))
    assert -result["s0.tension"][-1] == pytest.approx(2.0, rel={"arctan": 1e-2}.get(method, 1e-4))


@pytest.mark.slow
def test_friction_that_grows_with_the_slip_gives_the_speed_by_itself(simulate):
    curve = "{curve: viscous, coulomb: 0.2, rate: 0.5 s/m}"
    result = simulate(scene(RAMP, *element(0, 500, 10, curve), **SINGLE))
    late = result.t > 0.4
    exact = 2.05 - 0.05 * np.exp(-100 * (result.t - 0.4))  # 5 N s/m behind 500 N/m
    assert -result["s0.tension"][late] == pytest.approx(exact[late], abs=1e-6)


def test_a_normal_force_in_time_is_followed_while_it_slides_and_holds_where_it_outruns_the_spring(simulate):
    """Limit 2 + sin(2 pi t) N, drive 20 mm/s: k v = 10 N/s is more than the limit grows by, 6.3 N/s."""
    load = "load: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 1 Hz, offset: 2}}}"
    parts = (RAMP.replace("0.01", "0.02"), load, "s0: {type: Spring, stiffness: 500 N/m}",
             "p0: {type: Contact, curve: 1.0}")  # fmt: skip
    result = simulate(scene(*parts, joins=SINGLE["joins"] + ", [load.signal, p0.normal]"))
    limit = 2 + np.sin(2 * np.pi * result.t)
    slides = result["p0.slip"] > 0
    assert -result["s0.tension"][slides] == pytest.approx(limit[slides], abs=1e-5)
    rate = 2 * np.pi * np.cos(2 * np.pi * result.t)
    assert result["p0.slip"][slides] == pytest.approx((0.02 - rate / 500)[slides], abs=1e-5)
    assert result.run["counters"]["switches"] == 1


def test_nodes_that_a_contact_holds_to_each_other_alone_are_as_one_spring(simulate):
    """Two bodies, a spring, a contact, a spring: as with one spring of 500*400/900 N/m and the contact on the body."""
    bodies = ("one: {type: Mass, mass: 1 kg, velocity: 0.4 m/s}", "two: {type: Mass, mass: 2 kg, velocity: 0 m/s}",
              "m1: {type: Spring, stiffness: 300 N/m}", "m2: {type: Spring, stiffness: 200 N/m}",
              "pad: {type: Contact, normal_force: 2 N, curve: 1.0}")  # fmt: skip
    rest = "[floor.flange, m1.a, m2.a], [one.flange, m1.b, s1.a]"
    springs = ("s1: {type: Spring, stiffness: 500 N/m}", "s2: {type: Spring, stiffness: 400 N/m}")
    apart = simulate(scene(*bodies, *springs, joins=rest + ", [two.flange, m2.b, s2.a], [s1.b, pad.a], [s2.b, pad.b]"))
    single = f"s1: {{type: Spring, stiffness: {500 * 400 / 900!r} N/m}}"
    joined = simulate(scene(*bodies, single, joins=rest + ", [two.flange, m2.b, pad.b], [s1.b, pad.a]"))
    times = np.linspace(0, STOP, 40)
    for name in ("one.x", "two.x"):
        assert apart.at(name, times) == pytest.approx(joined.at(name, times), abs=2e-7)
    assert len(apart.events) == len(joined.events) > 4


def test_a_clutch_on_a_spring_without_inertia_turns_as_its_line_slides(simulate):
    """The same element, turning: radius 0.1 m, limits times 0.1, stiffness times 0.01."""
    pad = "[floor.flange, p0.a, main.a], [body.flange, s0.a, main.b], [s0.b, p0.b]"
    line = simulate(scene("body: {type: Mass, mass: 1 kg, velocity: 1 m/s}", "main: {type: Spring, stiffness: 300 N/m}",
                          *element(0, 500, 2), joins=pad))  # fmt: skip
    turning = (
        "house: {type: Housing}", "rotor: {type: Inertia, moment: 0.01 kg*m^2, speed: 10 rad/s}",
        "main: {type: TorsionSpring, stiffness: 3 N*m/rad}", "s0: {type: TorsionSpring, stiffness: 5 N*m/rad}",
        "grip: {type: Clutch, normal_force: 2 N, radius: 0.1 m, curve: 1.0}",
    )  # fmt: skip
    joins = "[house.shaft, grip.a, main.a], [rotor.shaft, s0.a, main.b], [s0.b, grip.b]"
    shaft = simulate(without_floor(scene(*turning, joins=joins)))
    times = np.linspace(0, STOP, 40)
    assert 0.1 * shaft.at("rotor.angle", times) == pytest.approx(line.at("body.x", times), abs=1e-6)
    assert len(shaft.events) == len(line.events) > 4


def without_floor(text):
    return text.replace("      floor: {type: Ground}\n", "")


PLANET = '''
from fairlead.component import Component, Law, Parameter, Rotational, Unknown, hold


class Planet(Component):
    """sun + ratio ring = (1 + ratio) carrier, in speeds."""

    sun, ring, carrier = Rotational(), Rotational(), Rotational()
    ratio = Parameter("1", "Teeth of the ring over those of the sun.", above=0)
    torque = Unknown("N*m", "Torque on the sun.")

    def law(p, sun, ring, carrier, torque):
        slip = sun.speed + p.ratio * ring.speed - (1 + p.ratio) * carrier.speed
        return Law(sun=torque, ring=p.ratio * torque, carrier=-(1 + p.ratio) * torque, torque=hold(slip), dissipated=0)
'''


def planet(simulate, tmp_path, *parts, carrier):
    (tmp_path / "planet.py").write_text(PLANET, encoding="utf-8")
    joins = f"[sun.shaft, gear.sun], [ring.shaft, gear.ring], [gear.carrier, {carrier}"
    text = scene("house: {type: Housing}", "gear: {type: Planet, ratio: 2}",
                 "sun: {type: Inertia, moment: 0.1 kg*m^2, speed: 3 rad/s}",
                 "ring: {type: Inertia, moment: 0.3 kg*m^2, speed: 0 rad/s}", *parts, joins=joins,
                 accuracy="1e-7")  # fmt: skip
    return simulate(without_floor(text), libraries=(tmp_path / "planet.py",))


def test_a_gear_of_three_ports_gives_the_speed_of_a_carrier_without_inertia(simulate, tmp_path):
    """The carrier on a spring of 20 N m swings at w^2 = k/9 (1/J_s + 4/J_r); the sun turns by what its torque does."""
    spring = "spring: {type: TorsionSpring, stiffness: 20 N*m/rad}"
    result = planet(simulate, tmp_path, spring, carrier="spring.b], [spring.a, house.shaft]")
    w = np.sqrt(20 / 9 * (1 / 0.1 + 4 / 0.3))
    assert result["spring.torque"] == pytest.approx(20 * np.sin(w * result.t) / w, abs=1e-5)
    turned = 3 * result.t - 20 / (0.3 * w**2) * (result.t - np.sin(w * result.t) / w)
    assert result["sun.angle"] == pytest.approx(turned, abs=1e-6)


@pytest.mark.slow
def test_what_cannot_be_is_refused_with_the_way_out(simulate):
    stribeck = "{curve: stribeck, stiction: 0.3, coulomb: 0.2, velocity: 10 mm/s}"
    refused = r"(?s)node \{p0.b, s0.b\} has no mass .* varies with its slip.*Add a Mass"
    with pytest.raises(ModelError, match=refused) as told:
        simulate(scene(RAMP, *element(0, 500, 10, stribeck), **SINGLE))
    assert "(coulomb)" in str(told.value)
    with pytest.raises(UsageError, match=r"stepping does not take .* \(p0\).*run.engine: rodas"):
        simulate(scene(RAMP, *element(0, 500, 10, "0.2"), **SINGLE, engine="stepping"))

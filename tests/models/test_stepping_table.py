"""What `stepping` does with a class of scenes is what its table says: refused by name, landed on, or inside steps."""

import contextlib
import math

import pytest

from fairlead.analysis.treatments.stepping_table import (
    EVERY_SWITCH,
    FEW,
    INSIDE,
    LANDED,
    REFUSED,
    TABLE,
    handling,
    most_located,
)
from fairlead.engine import engine_of
from fairlead.errors import ModelError, RunWarning, UsageError
from fairlead.integrate import Run

MANY = FEW + 5
LEVEL, FALLING = "curve: 0.3", "curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}"
RELAY = "relay: {type: Relay, upper: 1, lower: 0.5, on: 6, off: 2}"
SWING = "source: {type: SignalSource, value: {sine: {amplitude: 2, frequency: 500 Hz, offset: 10}}}"


def row(count, contact, engine="stepping", more="", joined=""):
    """Blocks on a floor, each with a contact."""
    parts = "".join(
        f"  m{k}: {{type: Mass, mass: 1 kg}}\n  rub{k}: {{type: Contact, normal_force: 10 N, {contact}}}\n"
        for k in range(count)
    )
    joins = "".join(f"  - [floor.flange, rub{k}.a]\n  - [rub{k}.b, m{k}.flange]\n" for k in range(count))
    return (
        f"components:\n  floor: {{type: Ground}}\n{parts}{more and f'  {more}'}\n"
        f"connections:\n{joins}{joined and f'  - {joined}'}\nrun: {{stop: 0.1 s, engine: {engine}}}\n"
    )


@pytest.mark.parametrize(
    ("count", "contact", "more", "joined", "way", "named"),
    [
        (1, LEVEL, "", "", LANDED, ""),
        (FEW, FALLING, "", "", LANDED, "rub0"),
        (MANY, LEVEL, "", "", INSIDE, ""),
        (MANY, FALLING, "", "", INSIDE, "rub0"),
        (MANY, f"{LEVEL}, method: karnopp", "", "", LANDED, "rub0"),
        (MANY, f"{LEVEL}, method: binding", "", "", LANDED, "rub0"),
        (MANY, f"{LEVEL}, method: tanh", "", "", INSIDE, ""),
        (MANY, LEVEL, SWING, "[source.signal, rub3.normal]", LANDED, "rub3"),
        (MANY, LEVEL, RELAY, "[m5.v, relay.value]\n  - [relay.signal, rub3.normal]", LANDED, "rub3"),
    ],
)
def test_a_class_is_known_by_its_facts(count, contact, more, joined, way, named, scene):
    model = scene(row(count, contact, more=more, joined=joined))
    found = handling(model.system, model.netlist.run)
    assert found.way == way
    assert found.parts[:1] == ((named,) if named else ())
    located = most_located(model.system, model.netlist.run)
    assert located == (EVERY_SWITCH if way == LANDED else FEW)


@pytest.mark.parametrize(("engine", "told"), [("stepping", True), ("rodas", False), ("auto", False)])
def test_what_is_done_less_exactly_is_told_with_the_way_out(engine, told, scene):
    found = scene(row(MANY, FALLING, engine)).check()
    assert bool(found) == told
    assert all("the friction of rub0" in fault.what and "run.engine: rodas" in fault.way_out for fault in found)



def test_what_is_refused_is_refused_by_check_and_by_the_run(scene, library, tmp_path):
    text = """
    components:
      wall: {type: Ground}
      load: {type: Mass, mass: 1 kg, velocity: 1 m/s}
      joint: {type: Joint}
    connections: [[wall.flange, joint.a], [joint.b, load.flange]]
    run: {stop: 0.1 s, engine: stepping}
    """
    joint = """
    class Joint(Component):
        '''A stop that takes any impulse.'''

        a, b = Translational(), Translational()
        pull = Unknown("N")
        zones = Zones("free", "met")

        @zone("free")
        def free(p, a, b, pull):
            return Law(a=0, b=0, pull=pull)

        @zone("met")
        def met(p, a, b, pull):
            return Law(a=-pull, b=pull, pull=hold(b.v - a.v))

        @guard("free", to="met", unit="m")
        def meets(p, a, b):
            return b.x - a.x - 0.01

        @guard("met", to="free", unit="N")
        def leaves(p, pull):
            return -pull
    """
    model = scene(text, libraries=(library(joint),))
    with pytest.raises(ModelError, match=r"(?s)a rigid stop \(joint\).*rodas"):
        model.check()
    with pytest.raises(UsageError, match=r"(?s)a rigid stop \(joint\).*rodas"):
        model.run(out=tmp_path / "run")


def test_the_engine_lands_by_itself_on_the_switches_of_as_many_machines():
    assert Run(stop=1.0).most_located == FEW


def test_every_refusal_has_a_reason_for_auto_and_names_its_parts():
    assert all(one.auto and "{}" in one.why and "rodas" in one.way_out for one in TABLE if one.way == REFUSED)


COUNTS = (pytest.param(90, marks=pytest.mark.slow), 99, 100, pytest.param(110, marks=pytest.mark.slow))


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize(("contact", "serves"), [(LEVEL, True), (FALLING, False)])
def test_auto_takes_stepping_from_a_hundred_contacts_on_where_switches_may_be_inside(count, contact, serves, scene):
    model = scene(row(count, contact, "auto"))
    engine, _ = engine_of(model.netlist.run, model.system)
    assert engine == ("stepping" if serves and count >= 100 else "rodas")


@pytest.mark.parametrize(("engine", "told"), [("stepping", True), ("rodas", False)])
def test_what_follows_time_at_once_is_told_to_be_a_mean(engine, told, simulate):
    """The current through a resistor at an alternating voltage: no accuracy makes the steps of `stepping` shorter."""
    said = pytest.warns(RunWarning, match=r"(?s)load\.plus\.voltage.*rodas")
    with said if told else contextlib.nullcontext():
        simulate(f"""
        components:
          mains: {{type: VoltageSource, voltage: {{sine: {{amplitude: 20 V, frequency: 50 Hz}}}}}}
          load: {{type: Resistor, resistance: 10 ohm}}
          earth: {{type: Earth}}
        connections: [[mains.plus, load.plus], [mains.minus, load.minus, earth.terminal]]
        run: {{stop: 0.1 s, engine: {engine}}}
        """)


def test_the_current_of_a_stiff_source_beside_many_contacts_is_that_of_its_load(simulate):
    """1 mohm inside multiplies what a mean over a step misses of a voltage by a thousand: steps end at every switch."""
    more = (
        "mains: {type: VoltageSource, inner: 1 mohm, voltage: {sine: {amplitude: 20 V, frequency: 50 Hz}}}\n"
        "  load: {type: Resistor, resistance: 10 ohm}\n  earth: {type: Earth}"
    )
    joined = "[mains.plus, load.plus]\n  - [mains.minus, load.minus, earth.terminal]"
    text = row(MANY, LEVEL, "stepping", more, joined)
    with pytest.warns(RunWarning, match="means over steps"):
        result = simulate(text + "record: {every: 1 ms}\n")
    assert result["mains.current"] == pytest.approx(result["load.current"], abs=0.01 * 2)
    assert result.at("load.current", 0.045) == pytest.approx(2.0, rel=1e-3)


def test_a_node_without_inertia_at_a_given_motion_has_the_tension_of_its_neighbours(simulate):
    """Two springs in series: their tensions are equal, also beside many contacts."""
    more = (
        "wave: {type: MotionSource, velocity: {sine: {amplitude: 0.1 m/s, frequency: 1 Hz}}}\n"
        "  stiff: {type: SpringDamper, stiffness: 1e6 N/m, damping: 10 N*s/m}\n"
        "  soft: {type: SpringDamper, stiffness: 500 N/m, damping: 1 N*s/m}"
    )
    joined = "[wave.flange, stiff.a]\n  - [stiff.b, soft.a]\n  - [soft.b, floor.flange]"
    result = simulate(row(MANY, LEVEL, "stepping", more, joined).replace("stop: 0.1 s", "stop: 1 s"))
    most = 500 * 0.1 / 3.14  # N: the amplitude of the motion times the soft spring
    for t in (0.13, 0.4, 0.77, 0.95):
        assert result.at("stiff.tension", t) == pytest.approx(result.at("soft.tension", t), abs=0.02 * most)


BESIDE = {
    "oil": ("volume: {type: Volume, volume: 1 l}\n  leak: {type: Leak, conductance: 1e-10 m^3/s/Pa}\n"
            "  tank: {type: Tank}", "[volume.port, leak.a]\n  - [leak.b, tank.port]"),
    "a relay": (f"{RELAY}", "[m5.v, relay.value]"),
    "an integral": ("sum: {type: Integrator}", "[m5.v, sum.value]"),
    "a sensor": ("sensor: {type: MotionSensor}", "[m5.flange, sensor.flange]"),
}  # fmt: skip


@pytest.mark.parametrize(("what", "serves"), [("oil", False), ("a relay", False), ("an integral", False),
                                               ("a sensor", True)])  # fmt: skip
def test_auto_takes_stepping_for_bodies_springs_and_contacts_alone(what, serves, scene):
    more, joined = BESIDE[what]
    model = scene(row(100, LEVEL, "auto", more, joined))
    assert engine_of(model.netlist.run, model.system)[0] == ("stepping" if serves else "rodas")


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_a_pressure_whose_integral_is_kept_has_an_error_of_its_own(accuracy, simulate):
    """A volume empties through a leak, p = p0 + (p1 - p0) exp(-t/T), beside contacts at rest that allow any step."""
    more = (
        "volume: {type: Volume, volume: 1 l, pressure: 11 bar, fluid: {fluid: oil, bulk_modulus: 1e9 Pa}}\n"
        "  leak: {type: Leak, conductance: 1e-11 m^3/s/Pa}\n  tank: {type: Tank}"
    )
    text = row(MANY, LEVEL, "stepping", more, "[volume.port, leak.a]\n  - [leak.b, tank.port]")
    result = simulate(text.replace("stop: 0.1 s", "stop: 0.5 s"), **{"run.accuracy": accuracy})
    last = 1e-3 / 1e9 / 1e-11  # s, T
    for t in (0.05, 0.13, 0.3, 0.5):
        assert result.at("volume.pressure", t) == pytest.approx(1e5 + 1e6 * math.exp(-t / last), abs=accuracy * 1.1e6)

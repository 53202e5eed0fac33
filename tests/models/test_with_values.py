"""`model.with_values(...)` is bit by bit the model that `load(path, set=...)` gives, and says if it shares nothing."""

import concurrent.futures
import dataclasses
import itertools
import pickle
import random

import numpy as np
import pytest
from fairlead.components.friction.coulomb import Coulomb
from fairlead.components.route.bend import Bend

import fairlead
from fairlead.component.alike import agree
from fairlead.component.parameters import make
from fairlead.errors import ModelError
from fairlead.kernels import layout
from fairlead.netlist.files import bundled_models
from fairlead.netlist.load import load
from fairlead.quantities import NUMBER
from fairlead.system.arrays.working import CHANGED
from fairlead.system.compiled.context import ADDRESSES

SEED, SAMPLE = 20261123, 3
LONG = {"long_deployment", "long_route", "guidance_route", "guidance_route_electric", "guidance_route_ideal",
        "slack_start", "weak_clamp"}  # fmt: skip


def settings_of(name):
    """Every parameter of a bundled model that is a number, with another value: {path: value}."""
    netlist = load(name)
    found = {name: other(value.content) for name, value in netlist.parameters.items()}
    for entry in netlist.components.values():
        for parameter, value in entry.parameters.items():
            found |= inside(f"{entry.name}.{parameter}", value)
    for block in ("friction", "initial", "nominal", "limits", "effects"):
        for parameter, value in getattr(netlist, block).items():
            found |= inside(f"{block}.{parameter}", value) if "[" not in parameter and "." not in parameter else {}
    found |= {"run.stop": "0.07 s", "run.start": "0.01 s", "run.accuracy": 1e-5}
    return {path: value for path, value in found.items() if value is not None}


def inside(path, value):
    """The numbers in a value, however deep."""
    if value.entries:
        each = ((f"{path}.{name}", one) for name, one in value.entries.items())
    elif isinstance(value.content, list):
        each = ((f"{path}[{k}]", one) for k, one in enumerate(value.content))
    else:
        return {path: other(value.content)}
    return dict(itertools.chain.from_iterable(inside(*one).items() for one in each))


def other(content):
    """Another value like this one: a number a little larger, a switch turned; None for what is no number."""
    if isinstance(content, bool) or content is None:
        return None
    if isinstance(content, int | float):
        return content + 1 if isinstance(content, int) and content > 3 else content * 1.0625
    match = NUMBER.match(content)
    if match is None:
        return {"on": "off", "off": "on"}.get(content)
    return f"{float(match[0]) * 1.0625!r}{content[match.end() :]}"


def same(one, two):
    """Assert that two compiled models are the same to the last bit, addresses apart."""
    assert one.flat.nodes == two.flat.nodes
    assert one.flat.groups == two.flat.groups
    for a, b in zip(one.flat.instances, two.flat.instances, strict=True):
        assert (a.path, a.variant) == (b.path, b.variant)
        assert agree(a.values, b.values), (a, b)
    assert one.numbering == two.numbering
    for name in ("initial", "timed", "zones", "differential", "quadrature", "stiff", "guard_machine", "guard_inertia",
                 "holder", "limit_guard", "kink_guard", "accuracy", "start", "linear", "machine_names", "guard_names",
                 "machine_zones", "signals", "pattern", "mass_pattern"):  # fmt: skip
        assert plain(getattr(one, name)) == plain(getattr(two, name)), name
    for name in ("nominal", "follows", "creep", "width", "rounding"):
        assert plain(getattr(one.scales, name)) == plain(getattr(two.scales, name)), name
    for a, b in zip(one.blocks, two.blocks, strict=True):
        assert [i.path for i in a.instances] == [i.path for i in b.instances]
        for array in dataclasses.fields(a):
            if array.name not in ("kernel", "instances"):
                assert plain(getattr(a, array.name)) == plain(getattr(b, array.name)), (a.kernel.variant, array.name)
    same_memory(one, two)
    tables = [[(t.path, t.machine, t.base, plain(t.polynomial.rows)) for t in s.timed_tables] for s in (one, two)]
    assert tables[0] == tables[1]
    owners = [[(b.instances[i].path, i) for b, i in s.machine_owners] for s in (one, two)]
    assert owners[0] == owners[1]


def same_memory(one, two):
    assert one.memory.keys() == two.memory.keys()
    for name, array in one.memory.items():
        mine, other = array.copy(), two.memory[name].copy()
        if name == "context":
            apart = [getattr(layout, each.upper()) for each in (*ADDRESSES, *CHANGED)]
            mine[apart], other[apart] = 0, 0
        if name == "blocks":
            mine[:, : layout.D_SIGNALS], other[:, : layout.D_SIGNALS] = 0, 0
        assert plain(mine) == plain(other), name
    assert one.working.places == two.working.places
    begin = [{name: plain(array) for name, array in s.working.begin.items()} for s in (one, two)]
    assert begin[0] == begin[1]
    for system in (one, two):  # every address is that of an array of its own
        for name in ADDRESSES:
            assert system.memory["context"][getattr(layout, name)] == system.memory[name.lower()].ctypes.data, name
        for row, block in zip(system.memory["blocks"], system.blocks, strict=True):
            assert row[layout.PAR] == block.parameters.ctypes.data
            assert row[layout.IN_OFFSET] == block.in_offset.ctypes.data
            assert row[layout.TABLE_BASE] == block.table_base.ctypes.data


def plain(value):
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    return tuple(map(plain, value)) if isinstance(value, tuple) else value


def mistakes(call):
    """What a call refuses; nothing if it does not. Each call says of what is wrong by which of them it came."""
    try:
        call()
    except ModelError as error:
        return [str(fault).replace("Model.with_values: ", "set: ") for fault in error.faults]
    return []


def compare(model, path, value):
    """Another value by both ways, compared; None if it was refused, by both alike, else why it was rebuilt."""
    made_fresh = []
    refused = mistakes(lambda: made_fresh.append(fairlead.load(model.netlist.path, set={path: str(value)})))
    refused = refused or mistakes(lambda: made_fresh[0].system)
    if refused:
        assert mistakes(lambda: model.with_values(**{path: value})) == refused
        return None
    (fresh,) = made_fresh
    want = fresh.system
    made = model.with_values(**{path: value})
    assert made.netlist == fresh.netlist
    same(made.system, want)
    return made.rebuilt


MODELS = {}


def model_of(name):
    if name not in MODELS:
        MODELS[name] = fairlead.load(name)
    return MODELS[name]


def sampled():
    rng = random.Random(SEED)
    for name in sorted(set(bundled_models()) - LONG):
        settings = settings_of(name)
        for path in rng.sample(sorted(settings), min(SAMPLE, len(settings))):
            yield pytest.param(name, path, settings[path], id=f"{name}-{path}")


@pytest.mark.parametrize(("name", "path", "value"), [*sampled()])
def test_another_value_of_a_bundled_model_is_that_of_a_fresh_one(name, path, value):
    compare(model_of(name), path, value)


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(bundled_models()))
def test_every_other_value_of_a_bundled_model_is_that_of_a_fresh_one(name):
    model = model_of(name)
    for path, value in settings_of(name).items():
        compare(model, path, value)


CRANKED = """
schema: 1
name: cranked
components:
  g: {type: Ground}
  wheel: {type: Inertia, moment: 0.1 kg*m^2, speed: 3 rad/s}
  crank: {type: Crank, radius: 0.1 m, rod: 0.5 m}
  slider: {type: Mass, mass: 1 kg}
  spring: {type: Spring, stiffness: 100 N/m}
connections: [[wheel.shaft, crank.shaft], [crank.slider, slider.flange, spring.a], [spring.b, g.flange]]
run: {stop: 0.2 s}
"""
JENKINS = """
schema: 1
name: jenkins
components:
  g: {type: Ground}
  body: {type: Mass, mass: 2 kg, velocity: 1 m/s}
  spring: {type: Spring, stiffness: 100 N/m}
  pad: {type: Contact, normal_force: 4 N, curve: 0.5}
connections: [[g.flange, pad.a], [pad.b, spring.a], [spring.b, body.flange]]
run: {stop: 0.2 s}
"""


@pytest.mark.parametrize("text", [CRANKED, JENKINS], ids=["relation of positions", "node without inertia"])
def test_every_value_beside_what_has_unknowns_of_its_own(text, tmp_path):
    """Where an acceleration is an unknown the mass stands in another row, and was not made anew."""
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    settings, model = settings_of(path), fairlead.load(path)
    assert len(settings) > 5
    for name, value in settings.items():
        compare(model, name, value)
    heavier = {name: value for name, value in settings.items() if name in ("slider.mass", "wheel.moment", "body.mass")}
    one, two = model.with_values(**heavier).run(out=None), fairlead.load(path, set=heavier).run(out=None)
    assert one.run["counters"] == two.run["counters"]


@pytest.mark.parametrize(("name", "path", "value"), [
    ("long_route", "mu", 0.5), ("single_bend", "line.bulkhead_friction.stiction", 0.6),
    ("belt", "pad.normal_force", "12 N"), ("belt", "run.start", "0.1 s"), ("sandwich", "creep", "1e-4 m/s"),
])  # fmt: skip
def test_a_new_friction_shares_the_structure(name, path, value):
    assert compare(model_of(name), path, value) == ""


@pytest.mark.parametrize(("name", "path", "value", "why"), [
    ("hundred_blocks", "blocks", 101, "other components"),
    ("single_bend", "method", "binding", "of another kind"),
    ("single_bend", "element", "0.5 m", "other components"),
    ("belt", "effects.energy", "off", "energy is not counted now"),
    ("guidance_route_ideal", "route.stations[0].radius", "0.6 m", "moves with other bodies, or otherwise"),
])  # fmt: skip
def test_what_changes_the_structure_is_said_to_be_rebuilt(name, path, value, why):
    assert why in compare(model_of(name), path, value)


@pytest.mark.parametrize("wrong", [
    {"nothing": 1}, {"mu": "1 kg"}, {"pad.normal_force": "-3 N"}, {"pad.normal": 3}, {"run.stop": -1},
    {"spring.stiffness": "{mu"},
])  # fmt: skip
def test_mistakes_are_those_of_load(wrong):
    want = mistakes(lambda: fairlead.load("belt", set={name: str(value) for name, value in wrong.items()}).check())
    assert want
    assert mistakes(lambda: model_of("belt").with_values(**wrong)) == want


def test_a_start_that_a_given_motion_contradicts_is_told_also_where_all_is_made_anew():
    """The rope starts at 1 m. With an origin the motion is of another kind, so that nothing is shared."""
    with pytest.raises(ModelError, match=r"rope.inboard.x starts at 1 m; .* starts at 3 m"):
        model_of("capstan").with_values({"haul.origin": "3 m"})
    why = model_of("capstan").with_values({"haul.origin": "1 m"}).rebuilt
    assert "haul is of another kind (a MotionSource with origin now)" in why


def test_a_start_at_minus_zero_is_that_of_a_fresh_model():
    assert compare(model_of("belt"), "block.position", "-0.0 m") == ""
    assert np.signbit(model_of("belt").with_values({"block.position": "-0.0 m"}).system.initial).any()


@pytest.mark.parametrize(("name", "values"), [
    ("belt", {"pad.normal_force": "12 N"}), ("single_bend", {"mu": 0.6}), ("guidance_route_ideal", {"mu": 0.5}),
])  # fmt: skip
def test_it_runs_to_the_same_rows(name, values):
    model = fairlead.load(name, set={"run.stop": "0.05 s"})
    given = {key: str(value) for key, value in values.items()}
    fresh = fairlead.load(name, set={"run.stop": "0.05 s", **given}).run(out=None)
    before = model.run(out=None).columns()
    made = model.with_values(**values).run(out=None)
    assert made.run["digest"] == fresh.run["digest"]
    assert made.events == fresh.events
    assert np.array_equal(made.columns(), fresh.columns(), equal_nan=True)
    assert np.array_equal(model.run(out=None).columns(), before, equal_nan=True)  # the first is what it was


def test_parts_made_again_are_not_counted_as_more_parts_of_the_scene():
    model = model_of("single_bend")
    made = model.with_values(mu=0.4).with_values(mu=0.5)
    assert made.rebuilt == ""
    assert made.assembly.scene.tally.parts <= model.assembly.scene.tally.parts


def test_values_add_up_along_a_chain_of_models():
    chain = model_of("single_bend").with_values(method="binding")
    chain = chain.with_values(mu=0.5).with_values(creep="0.2 mm/s").with_values(mu=0.4)
    same(chain.system, fairlead.load("single_bend", set={"method": "binding", "mu": "0.4", "creep": "0.2 mm/s"}).system)


@pytest.mark.slow
def test_the_first_model_stays_as_it_was():
    model = fairlead.load("single_bend")
    assert model.system.n > 0
    for path, value in (("mu", 0.6), ("line.start", "1.6 m"), ("haul.velocity.ramp.over", "2 s")):
        model.with_values(**{path: value})
    same(model.system, fairlead.load("single_bend").system)


OWN = """
class Pusher(Component):
    flange = Translational("what is pushed")
    force = Parameter("N", "What it pushes with.")

    def law(p, flange):
        return Law(flange=-p.force, supplied=p.force * flange.v)
"""
PUSHED = """
parameters: {push: 3 N}
components:
  body: {type: Mass, mass: 2 kg}
  pusher: {type: Pusher, force: "{push}"}
connections: [[pusher.flange, body.flange]]
run: {stop: 0.2 s}
"""


def test_a_component_of_a_library_takes_other_values(scene, library):
    libraries = (library(OWN),)
    model = scene(PUSHED, libraries)
    made = model.with_values(push="4 N")
    assert made.rebuilt == ""
    same(made.system, fairlead.load(model.netlist.path, {"push": "4 N"}, libraries).system)


RUBBED = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  damper: {type: Damper, damping: 50 N*s/m}
  belt: {type: MotionSource, velocity: 0.2 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, coulomb: 0.6}}
connections:
  - [wall.flange, spring.a, damper.a]
  - [spring.b, damper.b, pad.b]
  - [belt.flange, pad.a]
run: {stop: 2 s}
"""


@pytest.mark.parametrize("chain", [("0", "50"), ("50", "25", "0")])
def test_damping_that_comes_or_goes_at_a_node_without_mass_is_another_structure(scene, chain):
    """The node slides under 6 N, which the spring takes at once, or by and by:  6 N (1 - exp(-k t/d))."""
    model = scene(RUBBED, **{"damper.damping": chain[0]})
    assert model.system.numbering.rated.keys() == ({1} if chain[0] == "0" else set())
    for before, now in itertools.pairwise(chain):
        model = model.with_values({"damper.damping": now})
        assert bool(model.rebuilt) == ((before == "0") != (now == "0"))
        same(model.system, fairlead.load(model.netlist.path, {"damper.damping": now}).system)
        held = 6.0 * (1 - (np.exp(-100 * 2.0 / float(now)) if now != "0" else 0.0))
        assert model.run(out=None)["spring.tension"][-1] == pytest.approx(held, rel=1e-4)


REMEMBERS = """
class Thermostat(Component):
    \"\"\"Heats below 0 degC and not above 20 degC; between them it goes on as it came there.\"\"\"
    room = Input("1", "Temperature in degC.", signed=True)
    before = Parameter("1", "Temperature it comes from in degC.")
    signal = Output("1", "1 while it heats.")
    zones = Zones("off", "on")

    def begins_in(p):
        return "on" if p.before < 10 else "off"

    @zone("off", "on")
    def heats(p, zone):
        return Law(signal=1.0 if zone == "on" else 0.0)

    @guard("off", to="on", unit="1")
    def cold(p, room):
        return 0.0 - room

    @guard("on", to="off", unit="1")
    def warm(p, room):
        return room - 20.0
"""
ROOM = """
components:
  room: {type: SignalSource, value: 15}
  heater: {type: Thermostat, before: 25}
  lag: {type: SignalLag, lag: 1 s}
connections: [[room.signal, heater.room], [heater.signal, lag.value]]
run: {stop: 10 ms}
"""


def test_a_number_may_say_in_which_zone_a_part_begins(scene, library):
    """Nothing else follows it: no table, no start value and no code."""
    libraries = (library(REMEMBERS),)
    model = scene(ROOM, libraries)
    assert set(model.run(out=None)["heater.signal"]) == {0.0}
    for before, heats in ((5, 1.0), (25, 0.0)):
        model = model.with_values({"heater.before": before})
        assert model.rebuilt == ""
        same(model.system, fairlead.load(model.netlist.path, {"heater.before": before}, libraries).system)
        assert set(model.run(out=None)["heater.signal"]) == {heats}


def test_a_station_that_works_out_a_curve_of_its_own_is_not_passed_over(monkeypatch):
    def rubs(p):
        return make(Coulomb, coulomb=2 * p.friction.coulomb)

    monkeypatch.setattr(Bend, "rubs", rubs)
    model = fairlead.load("capstan")
    friction = next(path for path in settings_of("capstan") if path.endswith("friction") or path == "mu")
    made = model.with_values(**{friction: 0.123})
    same(made.system, fairlead.load("capstan", set={friction: "0.123"}).system)


@pytest.mark.slow
def test_models_made_in_threads_are_those_made_one_by_one():
    model, frictions = fairlead.load("single_bend"), [0.2, 0.3, 0.4, 0.5]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        made = list(pool.map(lambda mu: model.with_values(mu=mu), frictions))
    for one, mu in zip(made, frictions, strict=True):
        same(one.system, fairlead.load("single_bend", set={"mu": str(mu)}).system)


def test_it_pickles_with_its_values():
    made = pickle.loads(pickle.dumps(model_of("belt").with_values(**{"pad.normal_force": "12 N"})))
    same(made.system, fairlead.load("belt", set={"pad.normal_force": "12 N"}).system)

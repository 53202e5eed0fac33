"""`fairlead effects`: what it says of an effect that has a closed form, and that its advice holds when followed.

A lag q' = (x - q)/tau between a shaken mount and a spring: at the frequency w its output is smaller by
1/sqrt(1 + (w tau)^2) and late by atan(w tau), so without it the output differs, at worst over a cycle, by the
magnitude of 1 - 1/(1 + i w tau) times the amplitude: w tau / sqrt(1 + (w tau)^2).
"""

import json
import math
import pathlib
from dataclasses import replace

import fairlead.models
import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.analysis.effects import effects
from fairlead.analysis.sameness import same
from fairlead.analysis.switches import all_off, switches
from fairlead.cli import app
from fairlead.system.structure import Structure

LIBRARY = '''
    class Direct(Component):
        """Shows the position of its end."""
        a = Translational()
        tau = Parameter("s", above=0)
        shown = Output("m")
        def law(p, a):
            return Law(a=0, shown=a.x)

    class Lagging(Component):
        """Shows the position of its end, late."""
        a = Translational()
        tau = Parameter("s", above=0)
        q = State("m", start=0.0)
        shown = Output("m")
        lag = Effect("What is shown lags behind.", off=Direct)
        def law(p, a, q):
            return Law(a=0, q=(a.x - q) / p.tau, shown=q)
'''
OMEGA = 2 * math.pi
SCENE = """
    components:
      hand: {type: MotionSource, position: {sine: {amplitude: 10 mm, frequency: 1 Hz}}}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg}
      gauge: {type: Lagging, tau: TAU}
    connections: [[hand.flange, spring.a, gauge.a], [spring.b, block.flange]]
    run: {stop: 6 s, accuracy: 1e-6}
    record: {signals: [gauge.shown, block.x]}
"""


@pytest.fixture
def lagging(scene, library):
    """lagging(tau) -> a loader of the scene, as analysis wants it."""
    parts = (library(LIBRARY),)

    def make(tau):
        path = scene(SCENE.replace("TAU", tau), parts).netlist.path
        return lambda more: fairlead.load(path, set=more, libraries=parts)

    return make


def the(found, label):
    return next(row for row in found.rows if row.switch.label == label)


def test_the_change_is_that_of_the_closed_form(lagging):
    row = the(effects(lagging("0.05 s")), "lag off")
    late = OMEGA * 0.05
    assert row.most.name == "gauge.shown"
    expected = 10e-3 * late / math.hypot(1, late) / math.sqrt(2)  # rms over whole cycles, after the start has died away
    assert row.most.rms == pytest.approx(expected, rel=0.03)
    assert row.size.unknowns == lagging("0.05 s")({}).system.n - 1


def test_the_advice_holds_when_it_is_followed(lagging, tmp_path):
    """A lag of 0.05 ms is said to change little; without it the scene is smaller and the outputs change no more."""
    load = lagging("0.05 ms")
    found = effects(load)
    row = the(found, "lag off")
    assert row.change < 1e-3
    within, without = (load(settings).run(out=tmp_path / name) for settings, name in
                       (({}, "on"), (row.switch.settings, "off")))  # fmt: skip
    t = np.linspace(0, 6, 601)
    d = within.at("gauge.shown", t) - without.at("gauge.shown", t)
    assert np.sqrt(np.mean(d**2)) < 1e-3 * np.ptp(within.at("gauge.shown", t))
    assert load(row.switch.settings).system.n == load({}).system.n - 1


def test_an_effect_that_matters_is_not_advised_away(lagging):
    assert "it matters" in the(effects(lagging("0.05 s")), "lag off").sentence


def test_the_energy_ledger_changes_nothing(lagging):
    row = the(effects(lagging("0.05 s")), "energy off")
    assert row.change <= 1e-6
    assert row.size.unknowns < lagging("0.05 s")({}).system.n


def test_a_scene_is_switched_in_every_way_it_can_be():
    labels = {switch.label for switch in switches(fairlead.load("single_bend", {"method": "binding"}))}
    assert {"hose_core_slip off", "tension_only_core off", "gravity off", "meters on", "energy off"} <= labels
    assert {"friction hold", "friction tanh"} <= labels


def test_a_component_with_a_word_of_its_own_is_switched_too(lagging):
    model = lagging("0.05 s")({"gauge.effects.lag": "off"})
    (lag,) = [switch for switch in switches(model) if switch.name == "lag"]
    assert dict(lag.settings) == {"effects.lag": "on", "gauge.effects.lag": "on"}


def test_laws_that_are_compiled_on_the_way_are_not_counted(lagging):
    """As in the first study on a machine, where nothing comes from the cache."""
    load = lagging("0.05 s")

    def compiling(more):
        model = load(more)
        for block in model.system.blocks:
            object.__setattr__(block.kernel.native, "cached", False)
        return model

    assert the(effects(compiling), "lag off").change > 0


def test_a_switch_that_changes_no_equation_is_told_and_not_run():
    """Coulomb friction without exponents has no term for load and temperature, whatever is on."""
    found = effects(lambda more: fairlead.load("belt", set={"run.stop": "1 s", **more}))
    assert {"load_dependence off", "temperature_dependence off"} <= set(found.untouched)
    assert not {"load_dependence", "temperature_dependence"} & {row.switch.name for row in found.rows}


def test_all_effects_off_names_none_of_a_component_that_went_with_another():
    """Without friction of the motor there is no contact left, so its own effects cannot be switched any more."""
    def load(more):
        return fairlead.load("winch_drive", set=more)

    together = all_off(load, switches(load({})))
    assert "effects.motor_friction" in together.settings
    assert "effects.load_dependence" not in together.settings
    assert load(together.settings).check() == []


ALIKE = {"long_deployment", "long_route", "slack_start", "weak_clamp", "guidance_route_ideal",
         "guidance_route_electric"}  # and slow
BUNDLED = {path.stem for path in pathlib.Path(next(iter(fairlead.models.__path__))).glob("*.yaml")} - ALIKE


@pytest.mark.parametrize("name", sorted(BUNDLED))
def test_every_effect_of_a_bundled_model_can_be_switched_off_and_all_together(name):
    def load(more):
        return fairlead.load(name, set=more)

    found = switches(load({}))
    off = [one for one in found if one.kind == "effect" and one.then == "off"]
    for one in [*off, all_off(load, found)]:
        assert one is not None
        assert load(one.settings).flat.instances


def test_the_command_prints_a_sentence_for_each(tmp_path):
    words = ["effects", "belt", "--set", "run.stop=1 s", "--budget", "60s", "--fresh", "--out", str(tmp_path)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    assert "energy off" in done.output
    record = json.loads((tmp_path / "effects.json").read_text())
    assert {row["name"] for row in record["rows"]} >= {"energy", "friction"}
    assert all(row["sentence"] in done.output.replace("\n", " ") or row["sentence"] for row in record["rows"])


def test_a_law_just_traced_is_the_same_as_that_from_the_cache():
    """What is read back has lists where what was traced has tuples."""
    model = fairlead.load("belt", set={"run.stop": "1 s"})
    off = next(one for one in switches(model) if one.label == "load_dependence off")
    other = fairlead.load("belt", set={"run.stop": "1 s", **off.settings}).system
    for k, block in enumerate(other.blocks):
        facts = {n: tuple(v) if isinstance(v, list) else v for n, v in vars(block.kernel.structure).items()}
        other.blocks[k] = replace(block, kernel=replace(block.kernel, structure=Structure(**facts)))
    assert same(model.system, other)

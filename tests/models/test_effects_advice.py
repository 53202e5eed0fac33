"""`fairlead effects`: what it says of an effect that has a closed form, and that its advice holds when followed.

A lag q' = (x - q)/tau between a shaken mount and a spring: at the frequency w its output is smaller by
1/sqrt(1 + (w tau)^2) and late by atan(w tau), so without it the output differs, at worst over a cycle, by the
magnitude of 1 - 1/(1 + i w tau) times the amplitude: w tau / sqrt(1 + (w tau)^2).
"""

import functools
import json
import math
import pathlib
import textwrap
from dataclasses import replace

import fairlead.models
import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
import fairlead.analysis.effects.effects as within
from fairlead.analysis.cost.kept_runs import KeptRuns
from fairlead.analysis.cost.timed_run import Timed
from fairlead.analysis.effects.changes import changes, floors, worst_of
from fairlead.analysis.effects.effect_row import Row
from fairlead.analysis.effects.effects import effects as within_budget
from fairlead.analysis.effects.sameness import same
from fairlead.analysis.effects.switches import Switch, all_off, switches
from fairlead.analysis.effects.weights import by_weight
from fairlead.cli import app
from fairlead.errors import UsageError
from fairlead.kernels.structure import Structure

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
effects = functools.partial(within_budget, budget=1e6)
"""A budget [s] that decides nothing, however slow the machine."""
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


@pytest.fixture(scope="module")
def lagging(tmp_path_factory):
    """lagging(tau) -> a loader of the scene, as analysis wants it."""
    folder = tmp_path_factory.mktemp("lagging")
    classes = folder / "classes.py"
    classes.write_text("from fairlead.component import *\n" + textwrap.dedent(LIBRARY), encoding="utf-8")

    def make(tau):
        path = folder / f"{tau}.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(SCENE.replace("TAU", tau)), encoding="utf-8")
        return lambda more: fairlead.load(path, set=more, libraries=(str(classes),))

    return make


@pytest.fixture(scope="module")
def of_a_twentieth(lagging):
    """What is said of all effects of the scene with a lag of 0.05 s, which several tests read."""
    return effects(lagging("0.05 s"))


def the(found, label):
    return next(row for row in found.rows if row.switch.label == label)


def test_the_change_is_that_of_the_closed_form(lagging, of_a_twentieth):
    row = the(of_a_twentieth, "lag off")
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


@pytest.mark.parametrize(
    ("now", "then", "says"),
    [("hold", "tanh", "the scene has hold."), ("on", "off", "the scene has it."),
     ("off", "on", "the scene leaves it out.")],
)  # fmt: skip
def test_what_the_scene_has_is_told_by_its_name(now, then, says):
    t = np.linspace(0, 1, 101)
    (change,) = changes(["x"], ["1"], 1.5 * np.sin(OMEGA * t)[:, None], np.sin(OMEGA * t)[:, None])
    row = Row(Switch("friction", now, then, {}), Timed("finished"), saved=0.0, changes=[change])
    assert row.sentence.endswith(f"it matters, and {says}")


def test_a_time_that_is_the_same_is_no_saving_in_the_table():
    from fairlead.cli.effects import _cells

    for saved, told in ((-0.53, "same"), (0.9, "90 %")):
        timed = Timed("finished", scatter=0.6)
        row = Row(Switch("lag", "on", "off", {}), timed, saved=saved)
        assert told in _cells(row)
        assert ("takes the same time" in row.sentence) == (told == "same")


def test_an_effect_that_matters_is_not_advised_away(of_a_twentieth):
    assert "it matters" in the(of_a_twentieth, "lag off").sentence


@pytest.mark.slow
def test_the_advice_goes_by_the_worst_of_end_rms_and_peak(lagging):
    """All three in closed form, of a hand shaken by 10 mm that is at 0 and going up at 6 s.

    What lags has the amplitude 1/sqrt(1 + (w tau)^2), is off by w tau/sqrt(1 + (w tau)^2) of the hand's at worst, and
    by w tau/(1 + (w tau)^2) when the hand is at 0.
    """
    load = lagging("0.1 s")
    late = OMEGA * 0.1
    row = the(effects(load, signals=["gauge.shown"]), "lag off")
    (change,) = row.changes
    peak = 1 - 1 / math.hypot(1, late)
    assert change.peak == pytest.approx(peak, rel=0.02)
    assert change.rms == pytest.approx(late / math.hypot(1, late) / math.sqrt(2) / 2, rel=0.03)  # of a range of 20 mm
    assert change.end == pytest.approx(late / (1 + late**2) / 2, rel=0.02)
    assert row.change == max(change.peak, change.rms, change.end)
    assert row.worst.measure == max(("rms", "end", "peak"), key=lambda one: getattr(change, one))


def test_a_peak_alone_is_enough_to_matter():
    """As with the friction of a gear: an rms of 0.2 % and an end of nothing, but a peak that is 5 % higher."""
    t = np.linspace(0, 1, 1001)
    base = np.sin(OMEGA * t)
    switched = base.copy()
    switched[250] = 1.05  # at its highest
    (change,) = changes(["drive.level"], ["1"], switched[:, None], base[:, None])
    assert change.rms < 1e-3
    assert change.end == 0
    assert change.peak == pytest.approx(0.05 / 1.05)
    row = Row(Switch("gear_friction", "off", "on", {}), Timed("finished"), saved=0.0, changes=[change])
    assert row.worst.measure == "peak"
    assert "4.8 % at its peaks" in row.sentence
    assert "it matters" in row.sentence


def test_the_lowest_value_is_a_peak_too():
    """The compression of a hose, far below its largest tension."""
    base = np.linspace(-80, 400, 101)[:, None]
    (change,) = changes(["hose"], ["N"], np.where(base < -79, -120, base), base)
    assert change.peak == pytest.approx(40 / 400)


def test_the_elements_of_a_line_are_judged_together():
    """That the peak is in the neighbour is no change; that it is higher is."""
    base = np.array([[0.0, 0.0], [10.0, 0.0], [0.0, 5.0], [0.0, 0.0]])
    names, units = ["line.hose[3].tension", "line.hose[4].tension"], ["N", "N"]
    (moved,) = changes(names, units, base[:, ::-1], base)
    assert moved.name == "line.hose[*].tension"
    assert moved.peak == 0
    assert moved.rms > 0.1
    (higher,) = changes(names, units, 1.1 * base, base)
    assert higher.peak == pytest.approx(0.1 / 1.1)


def test_what_a_more_exact_run_changes_as_much_is_no_change():
    """Output by output: one that is sensitive does not hide what happens to another."""
    base = np.stack([np.arange(11.0), np.arange(11.0)], axis=1)
    names, units = ["a.x", "b.x"], ["m", "m"]
    exact, switched = base + np.array([0.5, 0.0]), base + np.array([0.6, 0.1])
    found = worst_of(changes(names, units, switched, base), floors(changes(names, units, exact, base)))
    assert found.change.name == "b.x"
    assert worst_of(changes(names, units, exact, base), floors(changes(names, units, exact, base))) is None


@pytest.mark.slow
def test_a_window_is_the_users_and_what_was_before_is_told_apart(scene, library):
    """A hand that moves in the first second only: the lag is seen before 2 s, and no more after it has died away."""
    parts = (library(LIBRARY),)
    brief = "velocity: {trapezoid: {to: 0.1 m/s, rise: 0.3 s, stay: 0.3 s, fall: 0.3 s}}"
    text = SCENE.replace("TAU", "0.05 s").replace("position: {sine: {amplitude: 10 mm, frequency: 1 Hz}}", brief)
    path = scene(text, parts).netlist.path

    def judged(window):
        def load(more):
            return fairlead.load(path, set=more, libraries=parts)

        return effects(load, signals=["gauge.shown"], window=window)

    after, in_it = judged(("2 s", "6 s")), judged((0.2, 0.9))
    assert after.begin == 2.0
    assert the(after, "lag off").change < 1e-6
    assert the(after, "lag off").worst_starting.value > 0.03
    assert "(before t = 2 s gauge.shown by" in the(after, "lag off").sentence
    assert in_it.span == (0.0, 0.9)
    assert the(in_it, "lag off").change > 0.05


@pytest.mark.parametrize("window", [(3.0, 2.0), (0.0, 7.0), (5.99, 6.0), (2.0, 2.0)])
def test_a_window_that_is_none_is_refused_with_what_to_write(lagging, window):
    with pytest.raises(UsageError, match=r"--from, --to: (.|\n)*Write "):
        effects(lagging("0.05 s"), window=window)


@pytest.mark.slow
def test_what_matters_most_is_judged_first():
    """By how much of the scene knows it: friction of the devices on a line before the leak of a motor."""
    model = fairlead.load("guidance_route")
    order = [one.label for one in by_weight(model, switches(model))]
    assert set(order) == {one.label for one in switches(model)}
    first = ["friction binding", "hose_core_slip off", "leakage off", "line.ruck_force absent", "air on"]
    assert [one for one in order if one in first] == first


@pytest.mark.slow
def test_what_the_budget_leaves_is_named_from_the_end_of_the_order():
    def load(more):
        return fairlead.load("belt", set={"run.stop": "2 s", **more})

    found = within_budget(load, budget=1.0)
    order = [one.label for one in by_weight(load({}), switches(load({})))]
    judged = {row.switch.label for row in found.rows} | set(found.untouched)
    assert {*judged, *found.left_out} >= set(order)
    assert [one for one in found.left_out if one in order] == [one for one in order if one not in judged]


def test_the_energy_ledger_changes_nothing(lagging, of_a_twentieth):
    row = the(of_a_twentieth, "energy off")
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
    load, touched = lagging("0.05 s"), []

    def compiling(more):
        model = load(more)
        for native in (block.kernel.native for block in model.system.blocks):
            touched.append((native, native.cached))
            object.__setattr__(native, "cached", False)
        return model

    try:
        assert the(effects(compiling), "lag off").change > 0
    finally:
        for native, cached in reversed(touched):  # other tests share the kernels
            object.__setattr__(native, "cached", cached)


def test_a_switch_that_changes_no_equation_is_told_and_not_run():
    """Coulomb friction without exponents has no term for load and temperature, whatever is on."""
    found = effects(lambda more: fairlead.load("belt", set={"run.stop": "1 s", **more}))
    assert {"load_dependence off", "temperature_dependence off"} <= set(found.untouched)
    assert not {"load_dependence", "temperature_dependence"} & {row.switch.name for row in found.rows}


@pytest.mark.slow
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


NEEDED = {("capstan", "line_stretch"), ("crustacean", "line_stretch")}


@pytest.mark.parametrize("name", sorted(BUNDLED))
def test_every_effect_of_a_bundled_model_can_be_switched_off_and_all_together(name):
    """Or it is refused by its name: a rope whose motion is given must stretch."""
    def load(more):
        return fairlead.load(name, set=more)

    found = switches(load({}))
    off = [one for one in found if one.kind == "effect" and one.then == "off"]
    for one in off:
        if (name, one.name) in NEEDED:
            with pytest.raises(fairlead.ModelError, match=f"{one.name} is off and its motion is given"):
                load(one.settings).flat  # noqa: B018
        else:
            assert load(one.settings).flat.instances
    together = all_off(load, found)
    assert together is not None
    assert load(together.settings).flat.instances


def test_the_command_prints_a_sentence_for_each(tmp_path):
    words = ["effects", "belt", "--set", "run.stop=1 s", "--budget", "1e6 s", "--fresh", "--out", str(tmp_path)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    assert "energy off" in done.output
    record = json.loads((tmp_path / "effects.json").read_text())
    assert {row["name"] for row in record["rows"]} >= {"energy", "friction"}
    assert all(row["sentence"] in done.output.replace("\n", " ") or row["sentence"] for row in record["rows"])


@pytest.mark.slow
def test_a_law_just_traced_is_the_same_as_that_from_the_cache():
    """What is read back has lists where what was traced has tuples."""
    model = fairlead.load("belt", set={"run.stop": "1 s"})
    off = next(one for one in switches(model) if one.label == "load_dependence off")
    other = fairlead.load("belt", set={"run.stop": "1 s", **off.settings}).system
    for k, block in enumerate(other.blocks):
        facts = {n: tuple(v) if isinstance(v, list) else v for n, v in vars(block.kernel.structure).items()}
        other.blocks[k] = replace(block, kernel=replace(block.kernel, structure=Structure(**facts)))
    assert same(model.system, other)


def test_a_budget_that_is_short_for_all_switches_does_not_shorten_the_run_to_nothing(monkeypatch):
    """Ten thousand switches leave 60 us each; a line is still run for a fiftieth of the budget."""
    caps = []

    def run(self, settings, cap, made=None, allowed=math.inf):
        caps.append(cap)
        return Timed("finished", values=np.zeros((1, 0)))

    monkeypatch.setattr(within, "timed_run", lambda *_: Timed("budget"))
    monkeypatch.setattr(within._Runner, "run", run)
    runner = within._Runner(lambda _: None, KeptRuns(None), "", (), [], (0.0, 50.0), math.inf, 0.0)
    runner.base(100.0, 10_000, given=False)
    assert caps == [pytest.approx(100.0 / 50)]

"""How often the loop returns to Python, and how much its buffers hold, changes nothing: not a bit of any row."""

from importlib.util import find_spec

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate, parts, prepare, underway
from tests.integrate.problems import belt_block, falling_ball
from tests.integrate.test_budgets import chattering_machine
from tests.models.lost_pivots import PAIR, lost_pivots
from tests.models.test_active_subsystem_at_random import network
from tests.models.test_names_say_nothing import pads
from tests.models.test_positions import engine as engine_of
from tests.unit.test_controllers import COUNTING, PULLER, SCENE

CUTS = [(10**8, None), (1, None), (7, 6), (64, 7), (10**8, 7)]
"""Trial steps of a slice, and rows that the buffer holds; None: as many as usual. Else few zone changes too."""
BUFFERS = {name: getattr(prepare, name) for name in ("LEAST_ROWS", "MOST_ROWS", "EVENTS")}
OFTEN = {"LEAST": 1, "LOOK_COST": 0, "LOOK_BASE": 3, "MOST": 0.97, "MARGIN": 3}
"""Parts are looked for every third step: the rest wakes often, and is cut out again."""
MODELS = {"single_bend": 0.1, "guidance_route_electric": 0.02, "winch_drive": 0.1, "torsion": 0.05}  # s
"""Contacts by the hundred; a part and sampled control; hydraulics; circles and carried line."""
ENGINES = ["rodas", "stepping", *(["ida"] if find_spec("sksundae") else [])]


def told(outcome):
    """All that a run leaves."""
    counts = {name: value for name, value in vars(outcome.counters).items() if isinstance(value, int)}
    kept = outcome.times, outcome.values, outcome.sides, outcome.events, outcome.y
    return outcome.sentence, outcome.chattering, counts, *(array.tobytes() for array in kept)


@pytest.fixture
def all_cuts(monkeypatch):
    """A function that runs a problem made anew with every cut, and returns what each run leaves."""
    def run(make, settings):
        found = []
        for attempts, rows in CUTS:
            monkeypatch.setattr(underway, "FIRST_ATTEMPTS", attempts)
            monkeypatch.setattr(underway, "next_attempts", lambda *_, attempts=attempts: attempts)
            for name, usual in BUFFERS.items():
                monkeypatch.setattr(prepare, name, rows or usual)
            found.append(told(integrate(make(), settings)))
        return found

    return run


def all_the_same(found):
    """True if all runs left the same, and something switched or bounced."""
    counts = found[0][2]
    return counts["switches"] + counts["located"] > 0 and all(each == found[0] for each in found)


@pytest.mark.parametrize("reaction", ["warn", "hold"])
def test_switches_that_do_not_advance_count_once(all_cuts, reaction):
    """A relay that toggles within the floor of progress is held for a dwell after five of them, not sooner."""
    settings = Run(stop=0.502, step_floor=1e-8, dwell=1e-4, on_chatter=reaction)
    assert all_the_same(all_cuts(chattering_machine, settings))


@pytest.mark.parametrize("pads", [0, 60])
def test_what_circles_and_is_held_is_logged_alike(scene, monkeypatch, pads):
    """Two relays without hysteresis at their levels, alone and beside enough contacts to have the log emptied first."""
    parts, joins = [], []
    for k in range(2):
        parts += [f"level{k}: {{type: Integrator, initial: {-0.2 - 0.1 * k}}}",
                  f"relay{k}: {{type: Relay, upper: 0, on: -0.7, off: 0.5}}"]  # fmt: skip
        joins += [f"level{k}.signal, relay{k}.value", f"relay{k}.signal, level{k}.value"]
    for k in range(pads):
        parts += [f"m{k}: {{type: Mass, mass: 1 kg}}", f"g{k}: {{type: Ground}}",
                  f"c{k}: {{type: Contact, normal_force: 1 N, curve: 0.3}}"]  # fmt: skip
        joins += [f"m{k}.flange, c{k}.a", f"g{k}.flange, c{k}.b"]
    lines = [*(f"  {one}" for one in parts), "connections:", *(f"  - [{one}]" for one in joins), "run: {stop: 1.5 s}"]
    text, found = "\n".join(["components:", *lines]), []
    monkeypatch.setattr(prepare, "EVENTS", 256)
    for attempts in (1, 7, 64, 10**8):
        monkeypatch.setattr(underway, "FIRST_ATTEMPTS", attempts)
        monkeypatch.setattr(underway, "next_attempts", lambda *_, attempts=attempts: attempts)
        settings = Run(stop=1.5, dwell=1e-3, on_chatter="hold", every=1.0)
        found.append(told(integrate(scene(text).system, settings)))
    assert all_the_same(found)


@pytest.mark.parametrize(("make", "engine"), [(falling_ball, "rodas"), *((belt_block, each) for each in ENGINES)])
def test_textbook_problems_take_the_same_path(all_cuts, make, engine):
    assert all_the_same(all_cuts(make, Run(stop=1.0, every=0.05, engine=engine)))


@pytest.mark.parametrize("cylinders", [1, 4])
def test_what_is_brought_back_to_relations_of_positions_takes_the_same_path(scene, all_cuts, cylinders):
    system = scene(engine_of(cylinders)).system
    for every in (None, 0.01):
        assert all_the_same(all_cuts(lambda: system, Run(stop=0.5, every=every, accuracy=1e-6)))


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("seed", [1, 4])
def test_networks_of_which_parts_are_cut_out_and_wake_take_the_same_path(tmp_path, monkeypatch, all_cuts, engine, seed):
    for name, value in OFTEN.items():
        monkeypatch.setattr(parts, name, value)
    (tmp_path / "network.yaml").write_text(f"schema: 1\nname: network\n{network(seed)}", encoding="utf-8")
    system = fairlead.load(tmp_path / "network.yaml").system
    found = all_cuts(lambda: system, Run(stop=0.6, every=0.01, engine=engine))
    assert all_the_same(found)
    assert found[0][2]["partial_steps"] > 0


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("name", MODELS)
def test_bundled_models_take_the_same_path(all_cuts, name, engine):
    model = fairlead.load(name)
    start, span = model.netlist.run.start, MODELS[name]
    settings = Run(start=start, stop=start + span, every=span / 20, engine=engine)
    assert all_the_same(all_cuts(lambda: model.system, settings))


def test_a_run_that_chooses_fresh_pivots_on_its_way_takes_the_same_path(scene, library, all_cuts):
    model = scene(lost_pivots(), (library(PAIR),))
    found = all_cuts(lambda: model.system, Run(stop=1.0, every=0.02))
    assert all_the_same(found)
    assert found[0][2]["replans"] > 0


def test_controllers_in_plain_python_see_the_same(scene, library, all_cuts):
    model = scene(SCENE, (library(PULLER + COUNTING),))
    found = all_cuts(lambda: model.system, Run(stop=1.0, every=0.01))
    assert found[0][2]["time_events"] > 15
    assert all(each == found[0] for each in found)


def test_what_a_run_leaves_on_its_grid_is_the_same_however_it_is_handed_over(tmp_path, monkeypatch):
    (tmp_path / "pads.yaml").write_text(pads("abcd"), encoding="utf-8")
    model = fairlead.load(tmp_path / "pads.yaml", set={"record.every": "0.1 s"})
    found = []
    for attempts in (1, 7, 64, 10**8):
        monkeypatch.setattr(underway, "FIRST_ATTEMPTS", attempts)
        monkeypatch.setattr(underway, "next_attempts", lambda *_, attempts=attempts: attempts)
        result = model.run(out=None)
        kept = [result.t.tobytes(), *(np.asarray(result[signal.name]).tobytes() for signal in result.signals)]
        found.append((len(result.t), kept, result.events, result.run["jumps"], result.run["counters"]))
    assert found[0][0] > 40  # rows of the grid, and of events
    assert all(each == found[0] for each in found)

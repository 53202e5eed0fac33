"""A System is compiled once: no run changes it, whatever its accuracy, start and record, in whatever thread."""

import hashlib
import threading

import numpy as np
import pytest

import fairlead
import fairlead.system.compile as stage
from fairlead.integrate import Run, integrate
from tests.integrate.problems import belt_block
from tests.models.test_two_runs import IDLE
from tests.unit.test_controllers import COUNTING, PULLER, SCENE

NAMES = {"belt": 3.0, "sandwich": 0.1, "winch_drive": 0.05, "torsion": 0.05}
"""Seconds of models that are run: switches, circles of contacts, samples, tables in time."""
ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping"])


def told(outcome):
    """All that a run leaves."""
    assert outcome.ok, outcome.sentence
    rows = (outcome.times, outcome.sides, outcome.values, outcome.events, outcome.y, outcome.problem.zones)
    return [row.tobytes() for row in rows] + [outcome.counters.steps, outcome.counters.switches]


def content(system):
    """Digest of every number in a System."""
    arrays = [*system.memory.values(), system.zones, system.initial, *(block.parameters for block in system.blocks)]
    return hashlib.sha256(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)).hexdigest()


@ENGINES
@pytest.mark.parametrize("name", NAMES)
def test_a_second_run_of_a_system_is_the_first_again(name, engine):
    """After a run to another accuracy that records something else, too: what each did to a fresh system."""
    system = fairlead.load(name).system
    before, loose = content(system), {"accuracy": 1e-3, "record": ["energy.*"]}
    runs = {kind: Run(stop=NAMES[name], engine=engine, **given) for kind, given in (("as it is", {}), ("loose", loose))}
    once, again = ([told(integrate(system, run)) for run in runs.values()] for _ in range(2))
    assert once == again
    assert content(system) == before
    assert told(integrate(fairlead.load(name).system, runs["loose"])) == once[1] != once[0]


@ENGINES
@pytest.mark.parametrize("compiled", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_a_second_run_of_a_textbook_problem_is_the_first_again(engine, compiled):
    problem = belt_block(compile=compiled)
    outcomes = [integrate(problem, Run(stop=2.5, engine=engine)) for _ in range(2)]  # ends while it slides
    assert outcomes[0].counters.switches % 2 == 1
    assert told(outcomes[0]) == told(outcomes[1])


def in_threads(*jobs):
    """What each job returns, all run at once."""
    found, gate = [None] * len(jobs), threading.Barrier(len(jobs))

    def work(k):
        gate.wait()
        found[k] = jobs[k]()

    threads = [threading.Thread(target=work, args=(k,)) for k in range(len(jobs))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


@pytest.mark.slow
@ENGINES
def test_threads_that_run_one_system_at_once_do_not_meet(tmp_path, engine):
    """Three runs in turn and at once, a part of the problem cut out of each on the way."""
    path = tmp_path / "idle.yaml"
    path.write_text(IDLE.replace("blocks: 1000", "blocks: 250"), encoding="utf-8")
    system = fairlead.load(path).system
    runs = [Run(stop=3.0, engine=engine, accuracy=accuracy) for accuracy in (1e-4, 1e-4, 1e-3)]
    outcomes = in_threads(*(lambda run=run: integrate(system, run) for run in runs))
    assert [told(outcome) for outcome in outcomes] == [told(integrate(system, run)) for run in runs]
    assert outcomes[0].counters.partial_steps > 0


def test_threads_that_sample_do_not_meet(scene, library):
    """Each has a controller of its own, in plain Python and in compiled code."""
    plain, sampled = scene(SCENE, (library(PULLER + COUNTING),)).system, fairlead.load("winch_drive").system
    runs = [(plain, Run(stop=1.0)), (sampled, Run(stop=0.2))] * 2
    outcomes = in_threads(*(lambda given=given: integrate(*given) for given in runs))
    assert [told(outcome) for outcome in outcomes] == [told(integrate(*given)) for given in runs]
    assert len({id(outcome.problem.controllers[0]) for outcome in outcomes[::2]}) == 2


def test_a_model_that_runs_again_is_not_compiled_again(tmp_path, monkeypatch):
    """To another accuracy, from another start: as a fresh model would."""
    model = fairlead.load("block_and_spring")
    model.run(out=tmp_path / "first", stop=1.0)
    changed = {"accuracy": 1e-3, "start": 0.25, "stop": 1.0}
    fresh = fairlead.load("block_and_spring").run(out=tmp_path / "fresh", **changed)
    monkeypatch.setattr(stage, "compile", None)
    again = model.run(out=tmp_path / "again", **changed)
    assert again.t.tolist() == fresh.t.tolist()
    assert all(again[name].tolist() == fresh[name].tolist() for name in ("block.x", "pad.friction"))


def test_a_run_from_a_later_start_begins_in_the_pieces_that_hold_then(scene):
    """A source that steps at 1 s is above from the start of a run from 2 s on, and samples are counted from there."""
    text = """
        components:
          source: {type: SignalSource, value: {step: {from: 0, to: 5, at: 1 s}}}
        run: {stop: 1 s}
    """
    system = scene(text).system
    outcomes = [integrate(system, Run(start=start, stop=3.0)) for start in (0.0, 2.0)]
    assert [outcome.values[0, 0] for outcome in outcomes] == [0.0, 5.0]

"""The state of a run is its arena: copied back it takes the run back, copied to another run that goes on from there."""

import threading

import numpy as np
import pytest

import fairlead
from fairlead.errors import UsageError
from fairlead.integrate import Run
from fairlead.integrate.underway import Underway
from tests.integrate.problems import belt_block
from tests.models.lost_pivots import PAIR, lost_pivots
from tests.models.test_two_runs import IDLE
from tests.unit.test_controllers import COUNTING, PULLER, SCENE

ENGINES = pytest.mark.parametrize("engine", ["rodas", "stepping"])
NAMES = {"belt": 2.0, "torsion": 0.5, "winch_drive": 0.2}  # circles of contacts; samples


class Told:
    """Notes of what a run records."""

    def __init__(self):
        self.blocks = []

    def __call__(self, block):
        self.blocks.append(block)

    def since(self, count):
        """All from that block on, as bytes."""
        kinds = zip(*((b.t, b.values, b.side, b.events) for b in self.blocks[count:]), strict=True)
        return [np.concatenate(kind).tobytes() for kind in kinds]


def begin(problem, run):
    told = Told()
    return Underway(problem, run, told), told


def to_the_end(going, told, attempts=7):
    """What is recorded from here on, and the end."""
    count = len(told.blocks)
    while going.served:
        going.go_on(attempts)
    assert going.status == 0, going.status
    whole = going.active.finish()
    return [*told.since(count), whole.array["y"].tobytes(), int(whole.number["steps"])]


def taken_back_and_cloned(problem, run, slices, attempts=7):
    """A run goes on from where it was: once, taken back, and as another run, whose arena lies elsewhere; the first."""
    going, told = begin(problem, run)
    for _ in range(slices):
        going.go_on(attempts)
    assert going.served
    saved = going.save()
    once = to_the_end(going, told)
    going.restore(saved)
    assert to_the_end(going, told) == once
    other, notes = begin(problem, run)
    assert other.active.memory.address != going.active.memory.address
    other.restore(saved)
    going.restore(saved)
    found = [None, None]

    def work(k, *run):
        found[k] = to_the_end(*run)

    threads = [threading.Thread(target=work, args=(k, *each)) for k, each in enumerate([(going, told), (other, notes)])]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [once, once]
    return going


@ENGINES
@pytest.mark.parametrize("name", NAMES)
def test_a_run_goes_on_from_a_copy_of_its_arena(name, engine):
    taken_back_and_cloned(fairlead.load(name).system, Run(stop=NAMES[name], engine=engine), slices=3)


@ENGINES
def test_so_does_a_textbook_problem(engine):
    taken_back_and_cloned(belt_block(), Run(stop=2.0, engine=engine), slices=3)


@ENGINES
def test_so_does_a_run_with_controllers_in_plain_python(scene, library, engine):
    """What they remember is copied with it: this one counts, and pushes by all it has seen."""
    system = scene(SCENE, (library(PULLER + COUNTING),)).system
    going = taken_back_and_cloned(system, Run(stop=1.0, engine=engine), slices=1)
    assert going.active.problem.controllers[0].known()[0].history


@ENGINES
def test_so_does_a_run_of_which_a_part_moves(tmp_path, engine):
    """The part in force goes along; it wakes, and another one is cut, before the end."""
    path = tmp_path / "idle.yaml"
    path.write_text(IDLE.replace("blocks: 1000", "blocks: 250"), encoding="utf-8")
    system, run = fairlead.load(path).system, Run(stop=3.0, engine=engine, every=0.1)
    slices, (going, _) = 0, begin(system, run)
    while going.active.part is None:
        going.go_on(7)
        slices += 1
    going = taken_back_and_cloned(system, run, slices=slices + 2)
    assert going.active.whole.number["partial_steps"] > 0


@pytest.mark.parametrize("after", [0, 1])
def test_so_does_a_run_that_has_chosen_or_is_to_choose_fresh_pivots(scene, library, after):
    """Saved before the replan, which is taken twice; and behind it, where its pivots go along."""
    system, run = scene(lost_pivots(), (library(PAIR),)).system, Run(stop=1.0)
    slices, (going, _) = 0, begin(system, run)
    while going.served and going.active.whole.number["replans"] == 0:
        going.go_on(3)
        slices += 1
    assert going.served
    going = taken_back_and_cloned(system, run, slices=slices if after else slices - 2, attempts=3)
    assert going.active.whole.number["replans"] == 1


def test_there_is_no_address_in_an_arena():
    """Two runs of a problem that have come to the same point have the same bytes, wherever they lie."""
    system, arenas = fairlead.load("belt").system, []
    for _ in range(2):
        going, _ = begin(system, Run(stop=2.0))
        for _ in range(3):
            going.go_on(10)
        arenas.append(going.save().active.whole.arena)
    assert arenas[0].tobytes() == arenas[1].tobytes()


def test_the_engine_ida_says_that_it_cannot_be_saved():
    pytest.importorskip("sksundae")
    going, _ = begin(belt_block(), Run(stop=2.0, engine="ida"))
    with pytest.raises(UsageError, match=r"SUNDIALS.*rodas or stepping"):
        going.save()

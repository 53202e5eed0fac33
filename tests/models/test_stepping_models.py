"""The stepping engine on models: order, agreement with `rodas`, holding, repeatability, the choice of auto."""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate

BLOCKS = 40
KINDS = ("x", "slip", "bound")  # recorded, block after block
SCALE = 0.1  # m, what errors of the chain are referred to


def chain(blocks=BLOCKS, accuracy=1e-4, **settings):
    model = fairlead.load("hundred_blocks", set={"blocks": str(blocks), "run.accuracy": str(accuracy)})
    signals = ["rod.block[*].x", "rod.guide[*].slip", "rod.guide[*].bound"]
    outcome = integrate(model.system, Run(stop=1.5, every=0.01, record=signals, **settings))
    assert outcome.ok, outcome.sentence
    return outcome


def columns(outcome, kind):
    """What was recorded of all blocks or guides [rows, BLOCKS]."""
    return outcome.values[:, KINDS.index(kind) :: len(KINDS)][:, :BLOCKS]


def on_grid(outcome):
    rows = np.searchsorted(outcome.times, np.arange(0, 1.5001, 0.01) - 1e-9)
    return columns(outcome, "x")[rows]


@pytest.fixture(scope="module")
def reference():
    return on_grid(chain(accuracy=1e-7))


def error(outcome, reference):
    difference = on_grid(outcome) - reference
    return max(np.abs(difference[-1]).max(), np.sqrt((difference**2).mean())) / SCALE


def test_fronts_of_stick_and_slip_leave_the_order_at_two(reference):
    errors = [error(chain(engine="stepping", fixed_step=h), reference) for h in (4e-3, 1e-3)]
    assert np.log2(errors[0] / errors[1]) / 2 == pytest.approx(2.0, abs=0.4)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5])
def test_the_error_follows_the_accuracy(reference, accuracy):
    assert error(chain(accuracy=accuracy, engine="stepping"), reference) < 3 * accuracy


def test_nothing_creeps_while_it_holds():
    outcome = chain(engine="stepping")
    slip, bound = columns(outcome, "slip"), columns(outcome, "bound")
    still = (bound == 1) & (outcome.sides == 0)[:, None]
    assert still.sum() > 1000
    assert np.abs(slip[still]).max() < 1e-12


PULLED = """
schema: 1
name: pulled
components:
  rod: {type: RodOnGuides, blocks: 20, mass: 10 kg, axial_stiffness: 1000 N, damping_time: 0.002 s, friction: 50 N}
  pull: {type: ForceSource, force: {ramp: {to: 30 N, over: 1 s}}}
connections:
  - [pull.flange, rod.end]
friction: {method: hold}
run: {stop: 1 h, engine: stepping}
"""


def test_a_chain_that_is_pulled_and_holds_stands_still_for_an_hour(tmp_path):
    path = tmp_path / "pulled.yaml"
    path.write_text(PULLED, encoding="utf-8")
    system = fairlead.load(path).system
    outcome = integrate(system, Run(stop=3600.0, every=60.0, engine="stepping", record=["rod.block[*].x"]))
    assert outcome.ok, outcome.sentence
    assert outcome.values[-1, 19] > 1e-3  # it moved before it held
    held = outcome.values[outcome.times > 59, :20]
    assert np.abs(held - held[0]).max() < 1e-12


def test_two_runs_are_the_same_to_the_last_bit():
    one, other = chain(engine="stepping"), chain(engine="stepping")
    assert one.values.tobytes() == other.values.tobytes()


@pytest.mark.parametrize(("model", "signal"), [("single_bend", "line.hose_node[30].x"), ("capstan", "rope.node[40].x")])
def test_a_line_whose_normal_force_follows_its_tension_agrees_with_rodas(model, signal):
    ends = []
    for engine in ("rodas", "stepping"):
        system = fairlead.load(model, set={"friction.method": "hold", "run.accuracy": "1e-4"}).system
        outcome = integrate(system, Run(stop=2.0, every=0.1, engine=engine, record=[signal]))
        assert outcome.ok, outcome.sentence
        ends.append(outcome.values[-1, 0])
    assert ends[1] == pytest.approx(ends[0], abs=1e-3)  # m, of some metres hauled


@pytest.mark.slow
def test_auto_takes_stepping_for_many_contacts_and_says_so(tmp_path):
    short = {"run.stop": "10 ms", "record.every": "5 ms"}
    many = fairlead.load("hundred_blocks", set={"blocks": "100", **short}).run(out=tmp_path / "many")
    few = fairlead.load("hundred_blocks", set={"blocks": "99", **short}).run(out=tmp_path / "few")
    assert (many.run["engine"], few.run["engine"]) == ("stepping", "rodas")
    assert many.run["engine_reason"] == "auto: 100 contacts that hold exactly, laws linear between switches"

"""States of stepped runs that are pickled: they go on in another process as here, or are refused by a sentence."""

import copy
import pickle
import subprocess
import sys

import pytest

import fairlead
from fairlead.errors import FairleadError, UsageError

PUSHED = """
schema: 1
name: pushed
parameters: {mu: 0.5}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: "{mu}", coulomb: "{mu}"}}
  push: {type: ForceActuator}
  command: {type: SignalInput}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, push.flange]
  - [command.signal, push.force]
run: {stop: 1 s}
interface: {inputs: {pull: command.value}}
"""
COUNTS = """
from fairlead.component import Controller, Input, Output, Parameter

class Counts(Controller):
    "Counts its samples."
    seen = Input("1")
    out = Output("1")

    def begin(self):
        self.n, self.{attribute} = 0, {value}

    def sample(self, seen):
        self.n += 1
        return float(self.n)
"""
CONTROLLED = PUSHED.replace(
    "  block:", "  counts: {type: Counts, period: 10 ms}\n  one: {type: SignalSource, value: 1}\n  block:", 1
)
GOES_ON = """
import pickle, sys
import fairlead
path, engine, library, state = sys.argv[1:]
run = fairlead.load(path, libraries=[library] if library else []).start(tunable=["mu"], engine=engine)
with open(state, "rb") as file:
    run.restore(pickle.load(file))
print(run.t.hex())
run.advance(0.7)
print(run.get("block.x").hex(), run.get("pad.friction").hex())
"""


def write(folder, text, name="pushed.yaml"):
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def under_way(model, engine="rodas"):
    """A run that slides, at 0.31 s, with another friction since 0.2 s."""
    run = model.start(tunable=["mu"], engine=engine)
    run.set("pull", 9)
    run.advance(0.2)
    run.set("mu", 0.25)
    run.advance(0.31)
    return run


def elsewhere(folder, path, state, engine="rodas", library=""):
    (folder / "state").write_bytes(pickle.dumps(state))
    asked = [sys.executable, "-c", GOES_ON, str(path), engine, str(library), str(folder / "state")]
    return subprocess.run(asked, capture_output=True, text=True, check=False, timeout=300)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_pickled_state_goes_on_in_another_process_bit_for_bit(tmp_path, engine):
    path = write(tmp_path, PUSHED)
    run = under_way(fairlead.load(path), engine)
    run.set("mu", 0.75)  # holds from the next step on
    run.set("pull", 4)
    done = elsewhere(tmp_path, path, run.save(), engine)
    assert done.returncode == 0, done.stderr
    run.advance(0.7)
    here = [(0.31).hex(), f"{run.get('block.x').hex()} {run.get('pad.friction').hex()}"]
    assert done.stdout.splitlines() == here


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_value_that_was_set_and_is_no_other_leaves_no_trace_in_a_pickled_state(tmp_path, engine):
    """A run begins anew where a value changes, with small steps; one that is the same is no event."""
    run = fairlead.load(write(tmp_path, PUSHED)).start(tunable=["mu"], engine=engine)
    run.set("pull", 9)
    run.advance(0.2)
    run.set("mu", 0.5)
    run.advance(0.31)
    again = fairlead.load(tmp_path / "pushed.yaml").start(tunable=["mu"], engine=engine)
    again.restore(pickle.loads(pickle.dumps(run.save())))
    for one in (run, again):
        one.advance(0.7)
    assert again.standing()[1].tolist() == run.standing()[1].tolist()
    assert again._memory.number["steps"] == run._memory.number["steps"]


def test_what_a_controller_in_python_knows_goes_along(tmp_path):
    library = write(tmp_path, COUNTS.format(attribute="more", value="[1]"), "counts.py")
    text = CONTROLLED.replace("connections:", "connections:\n  - [one.signal, counts.seen]", 1)
    path = write(tmp_path, text.replace("run:", "record: {signals: [block.x, pad.friction, counts.out]}\nrun:"))
    run = under_way(fairlead.load(path, libraries=[library]))
    done = elsewhere(tmp_path, path, run.save(), library=library)
    assert done.returncode == 0, done.stderr
    again = fairlead.load(path, libraries=[library]).start(tunable=["mu"])
    again.restore(pickle.loads(pickle.dumps(run.save())))
    assert again.advance(0.4) == run.advance(0.4)
    assert again.get("counts.out") == run.get("counts.out") == 41


def test_what_cannot_be_pickled_of_a_controller_is_named(tmp_path):
    library = write(tmp_path, COUNTS.format(attribute="more", value="lambda: 1"), "counts.py")
    path = write(tmp_path, CONTROLLED.replace("connections:", "connections:\n  - [one.signal, counts.seen]", 1))
    state = under_way(fairlead.load(path, libraries=[library])).save()
    with pytest.raises(TypeError, match=r"counts knows something that cannot be pickled"):
        pickle.dumps(state)


@pytest.mark.parametrize(
    ("text", "settings", "says"),
    [
        (PUSHED.replace("2 kg", "3 kg"), {}, "block.mass = 2 kg; this run has block.mass = 3 kg"),
        (PUSHED.replace("block", "body"), {}, "saved with block: Mass, no body; this run has no block, body: Mass"),
        (PUSHED, {"accuracy": 1e-7}, "it was saved with run.accuracy = 0.0001; this run has run.accuracy = 1e-07"),
        (PUSHED, {"engine": "stepping"}, "it was saved with run.engine = rodas; this run has run.engine = stepping"),
        (PUSHED.replace("inputs: {pull: command.value}", ""), {}, "it was saved with inputs pull; this run has inputs"),
    ],
)
def test_a_state_that_does_not_fit_is_refused_with_why(tmp_path, text, settings, says):
    state = pickle.loads(pickle.dumps(under_way(fairlead.load(write(tmp_path, PUSHED))).save()))
    run = fairlead.load(write(tmp_path, text, "other.yaml")).start(tunable=["mu"], **{"engine": "rodas", **settings})
    with pytest.raises(UsageError) as caught:
        run.restore(state)
    assert says in str(caught.value)
    assert run.t == 0


def test_a_state_of_another_fairlead_is_refused(tmp_path):
    model = fairlead.load(write(tmp_path, PUSHED))
    state = pickle.loads(pickle.dumps(under_way(model).save()))
    with pytest.raises(UsageError, match=r"it was saved by fairlead 0\.0\.9, in which a run has another memory"):
        model.start(tunable=["mu"], engine="rodas").restore(state._replace(fairlead=("0.0.9", "")))


def test_other_settings_are_refused_within_a_process_too(tmp_path):
    model = fairlead.load(write(tmp_path, PUSHED))
    state = under_way(model).save()
    with pytest.raises(UsageError, match=r"saved with run\.engine = rodas; this run has run\.engine = stepping"):
        model.start(tunable=["mu"], engine="stepping").restore(state)
    model.start(tunable=["mu"], engine="rodas", stop=3).restore(state)


def test_a_state_may_be_copied_and_a_run_says_how_it_is_kept(tmp_path):
    run = under_way(fairlead.load(write(tmp_path, PUSHED)))
    state = run.save()
    assert copy.deepcopy(state) is state is copy.copy(state)
    assert repr(state) == "<State of pushed at t = 0.31 s>"
    for copied in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(FairleadError, match=r"(?s)cannot be copied or pickled\..*run\.save\(\)"):
            copied(run)
        assert run.advance(0.31) == 0.31


def test_a_compiled_model_says_that_its_model_is_what_pickles():
    model = fairlead.load("belt")
    for copied in (pickle.dumps, copy.deepcopy):
        with pytest.raises(TypeError, match=r"a System holds compiled code.*[Pp]ickle its Model"):
            copied(model.system)

"""A machine of states against the times that its levels give, and against the same logic in samples."""

import pathlib

import numpy as np
import pytest
from fairlead.components.signals.state_machine import automaton

import fairlead
from fairlead.errors import ModelError
from fairlead.testing import contract

SCENE = pathlib.Path(__file__).parents[2] / "models" / "single_parts" / "state_machine.yaml"
SAMPLED = '''
from fairlead.component import Controller, Input, Output


class Filler(Controller):
    """The same logic, in samples."""

    level, button = Input("1", signed=True), Input("1", signed=True)
    state, valve, lamp = Output("1"), Output("1"), Output("1")

    def begin(self):
        self.now = "draining"

    def sample(self, level, button):
        if self.now == "draining":
            self.now = "filling" if level < 0.2 else "stopped" if button > 0.5 else self.now
        elif self.now == "filling":
            stops = button > 0.5 and level > 0.3
            self.now = "draining" if level > 0.8 else "stopped" if stops else self.now
        number = ["draining", "filling", "stopped"].index(self.now)
        return {"state": number, "valve": number == 1, "lamp": number}
'''


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_machine_changes_its_state_where_its_conditions_come_to_hold(engine):
    """The level falls at 0.1/s and rises at 0.4/s, between 0.2 and 0.8; stopped from 10.6 s on, but above 0.3 only."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = fairlead.load(SCENE, set={"run.engine": engine}).run(out=None)
    changes = [(event.t, event.zone_to) for event in result.events if event.component == "filler.machine"]
    assert [state for _, state in changes] == ["filling", "draining", "filling", "stopped"]
    assert [t for t, _ in changes] == pytest.approx([3, 4.5, 10.5, 10.75], abs=1e-4)
    assert (result["filler.lamp"][-1], result["filler.valve"][-1], result["filler.state"][-1]) == (2, 0, 2)


def test_a_machine_agrees_with_its_logic_in_samples(tmp_path):
    """Samples of 1 ms are late by up to one: 0.4/s for 1 ms at each of four changes."""
    (tmp_path / "filler.py").write_text(SAMPLED, encoding="utf-8")
    text = SCENE.read_text(encoding="utf-8")
    begin, end = text.index("    type: StateMachine"), text.index("connections:")
    text = f"{text[:begin]}    {{type: Filler, period: 1 ms}}\n{text[end:]}"
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    sampled = fairlead.load(tmp_path / "scene.yaml", libraries=[tmp_path / "filler.py"]).run(out=None)
    result = fairlead.load(SCENE).run(out=None)
    at = np.arange(0.005, 14, 0.01)  # rows of jumps beside
    one, two = (each.at("level.signal", at) for each in (result, sampled))
    assert np.abs(one - two).max() < 4 * 0.4 * 2e-3
    assert sampled["filler.state"][-1] == 2


def test_a_state_that_is_left_at_once_is_passed_and_units_are_heeded(simulate):
    """The first condition holds from the start; the second where the force is above 2 kN, at 0.2 s."""
    result = simulate("""
        components:
          pull: {type: SignalSource, value: {ramp: {to: 10000, over: 1 s}}}
          logic:
            type: StateMachine
            inputs: {f: N}
            states: {first: {}, second: {go: 1}, third: {go: 2}}
            transitions: {first: {second: "f > -(1 N)"}, second: {third: "f/2 > k or -f > (9 kN)"}}
            constants: {k: 1 kN}
          memory: {type: Integrator}
          block: {type: Mass, mass: 1 kg}
          push: {type: ForceActuator}
        connections: [[pull.signal, logic.f, push.force], [logic.go, memory.value], [push.flange, block.flange]]
        run: {stop: 1 s, accuracy: 1e-6}
    """)
    changes = [(event.t, event.zone_to) for event in result.events if event.component == "logic.machine"]
    assert [t for t, state in changes if state == "third"] == pytest.approx([0.2], abs=1e-5)
    assert result["memory.signal"][-1] == pytest.approx(0.2 * 1 + 0.8 * 2, abs=1e-4)


def test_the_automaton_of_a_machine_keeps_the_contract():
    states = (("off", (0.0,)), ("on", (1.0,)))
    ways = (("off", "on", ("condition_0", "condition_1"), "1"), ("on", "off", ("condition_2",), "1"))
    contract(automaton(("power",), states, ways))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ("states: {a: {x: 1}}, transitions: {}", "logic.states: there are 1 states"),
        ("states: {a: {x: 1}, b: 2}, transitions: {}", "logic.states: b is no map of outputs"),
        ("states: {a: {x: high}, b: {}}, transitions: {}", "logic.states: a.x is 'high', and no number"),
        ("states: {a: {state: 1}, b: {}}, transitions: {}", "logic.states: 'state' cannot be the name of an output"),
        ("states: {a: {}, b: {}}, transitions: {a: {c: u > 1}}", "logic.transitions: there is no state c"),
        ("states: {a: {}, b: {}}, transitions: {a: {a: u > 1}}", "logic.transitions: a leads to itself"),
        ("states: {a: {}, b: {}}, transitions: {a: u > 1}", "logic.transitions: a leads to no map"),
        ("states: {a: {}, b: {}}, transitions: {a: {b: u}}", "logic.transitions: u: u is no comparison"),
        ("states: {a: {}, b: {}}, transitions: {a: {b: u == 1}}", "logic.transitions: u == 1 compares by something"),
        ("states: {a: {}, b: {}}, transitions: {a: {b: 0 < u < 1}}", "logic.transitions: 0 < u < 1: .* is no comp"),
        ("states: {a: {}, b: {}}, transitions: {a: {b: u > open('f')}}", "there is no function open|is not arithmetic"),
        ("states: {a: {u: 1}, b: {}}, transitions: {a: {b: u > 1}}", "logic.inputs: u is an output and an input"),
        ("states: {a: {}, b: {}}, transitions: {a: {b: u > (1 m)}}", "are not of one kind"),
    ],
)  # fmt: skip
def test_a_machine_that_is_none_is_told(given, says, tmp_path):
    text = f"""
schema: 1
components:
  step: {{type: SignalSource, value: 1}}
  logic: {{type: StateMachine, {given}}}
connections: [[step.signal, logic.u]]
run: {{stop: 1 s}}
"""
    (tmp_path / "scene.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=f"(?s){says}"):
        fairlead.load(tmp_path / "scene.yaml").check()

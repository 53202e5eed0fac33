"""A sample at the instant at which what it reads switches: it is from before that instant, on every engine."""

from __future__ import annotations

import pytest

SCENE = """
    components:
      {machine}:
        type: StateMachine
        states: {{haul: {{go: 1}}, stopped: {{go: 0}}}}
        transitions: {{haul: {{stopped: "t > {when}"}}, stopped: {{}}}}
      {clock}: {{type: SignalSource, value: {{ramp: {{to: 10, over: 10 s}}}}}}
      {s}: {{type: SampledSensor, period: 10 ms}}
    connections: [[{clock}.signal, {machine}.t], [{machine}.go, {s}.value]]
    run: {{stop: 4.1 s, accuracy: 1e-5}}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("when", [0.3, 1.1, 2.0, 3.7, 4.0])
@pytest.mark.parametrize("names", [("machine", "clock", "s"), ("z", "y", "a")])
def test_what_is_sampled_at_a_switch_is_from_before_it(simulate, engine, when, names):
    machine, clock, s = names
    result = simulate(SCENE.format(machine=machine, clock=clock, s=s, when=when), **{"run.engine": engine})
    gone = result.t[result[f"{s}.signal"] == 0]
    assert gone[0] == pytest.approx(when + 0.01, abs=1e-9)

"""A run, and one that is stepped, refuse the mistakes of a netlist that `check` refuses, in the same words."""

import pytest

import fairlead
from fairlead.errors import ModelError

SLIDER = """
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  pad: {type: Contact, normal_force: 1 N, curve: 0.3}
  block: {type: Mass, mass: 1 kg}
  command: {type: SignalInput}
  push: {type: ForceActuator}
connections:
  - [wall.flange, spring.a, pad.a]
  - [spring.b, block.flange, pad.b, push.flange]
  - [command.signal, push.force]
run: {stop: 0.1 s}
"""
WRONG = [
    "interface: {inputs: {a: nothing.value}}",
    "interface: {inputs: {a: {of: command.value, nominal: -1}}}",
    "interface: {outputs: {a: nothing.x}}",
    "interface: {outputs: {a: {of: block.x, unit: N}}}",
    "interface: {outputs: {a: {of: block.x, nominal: 1 N}}}",
    "interface: {tunable: {a: pad.nothing}}",
    "interface: {tunable: {a: {of: pad.normal_force, unit: m}}}",
    "interface: {tunable: {a: {of: pad.normal_force, nominal: -1}}}",
    "interface: {tunable: {a: pad.normal_force}, outputs: {a: block.x}}",
    "interface: {outputs: {a: nothing.x}, tunable: {b: pad.nothing}}",
    "limits: {nothing.x: {above: 1 m}}",
    "limits: {block.x: {above: 1 N}}",
    "limits: {block.x: {above: 2 m, below: 1 m}}",
    "record: {signals: [nothing.x]}",
    "record: {plots: [{title: one, signals: [block.x], along: nothing.x}]}",
    "initial: {nothing.x: 1 m}",
    "nominal: {block.x: 1 N}",
    "effects: {nothing: off}",
    "friction: {nothing: 3}",
]


def told(call):
    with pytest.raises(ModelError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize("block", WRONG)
def test_what_check_refuses_is_refused_by_run_and_start(tmp_path, block):
    file = tmp_path / "slider.yaml"
    file.write_text(f"schema: 1\n{SLIDER}{block}\n", encoding="utf-8")
    said = told(lambda: fairlead.load(file).check())
    assert told(lambda: fairlead.load(file).run(out=None)) == said
    assert told(lambda: fairlead.load(file).start()) == said

"""`check` tells mistakes of all blocks that say nothing of what the model is made of in one go."""

import pytest

import fairlead
from fairlead.errors import ModelError

SCENE = """schema: 1
name: many
components:
  wall: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  spring: {type: Spring, stiffness: 400 N/m}
connections:
  - [wall.flange, spring.a]
  - [spring.b, block.flange]
run: {stop: STOP}
initial: {block.x: 3 s, block.zz: 3}
nominal: {block.q: 1}
interface: {inputs: {b: {of: spring.tension}}, outputs: {c: {of: blok.x}}, tunable: {d: block.mas}}
record: {signals: [spring.tenson]}
limits: {block.v: {belw: 3}}
"""
TOLD = ("initial.block.x = 3 s is a time", "initial.block.zz: no unknown", "nominal.block.q: no unknown",
        "interface.inputs.b", "interface.outputs.c", "interface.tunable.d", "no signal has the name spring.tenson",
        "limits.block.v.belw")  # fmt: skip


def check(tmp_path, text) -> str:
    (tmp_path / "many.yaml").write_text(text)
    with pytest.raises(ModelError) as caught:
        fairlead.load(tmp_path / "many.yaml").check()
    return str(caught.value)


@pytest.mark.parametrize("stop", ["2 s", "-2 s"])
def test_mistakes_of_the_start_and_the_border_do_not_wait_for_those_of_the_record(stop, tmp_path) -> None:
    said = check(tmp_path, SCENE.replace("STOP", stop))
    for one in TOLD:
        assert said.count(one) == 1, (one, said)
    assert ("run.stop" in said) == (stop == "-2 s")


@pytest.mark.parametrize(("old", "new"), [("mass: 2 kg", "mass: 2 m"), ("type: Spring", "type: Sprong"),
                                          ("[spring.b, block.flange]", "[spring.b, block.flang]")])  # fmt: skip
def test_where_the_model_is_not_known_nothing_is_made_up(old, new, tmp_path) -> None:
    said = check(tmp_path, SCENE.replace("STOP", "2 s").replace(old, new))
    assert "initial." not in said
    assert new.split()[-1].strip("[],") in said


def test_a_broken_component_beside_a_wrong_run_is_no_reason_for_more(tmp_path) -> None:
    said = check(tmp_path, SCENE.replace("STOP", "-2 s").replace("type: Mass", "type: Mass, mass: 1 kg, mass: 3"))
    assert "initial." not in said

"""Recorded signals that stay below their error weight are told, with the accuracy that shows them."""

import json

import numpy as np
import pytest

from fairlead.cli.summary import summary_rows

PRESLIDING = """
components:
  ground: {{type: Ground}}
  block: {{type: Mass, mass: 1 kg}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
  push: {{type: ForceSource, force: {{sine: {{amplitude: {force} N, frequency: 5 Hz}}}}}}
connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
friction: {{method: {method}}}
run: {{stop: 0.4 s, accuracy: {accuracy}}}
record: {{signals: [block.x, block.v, pad.slip]}}
"""


@pytest.mark.slow
def test_presliding_far_below_the_weight_of_a_position_is_told_and_gone_with_the_accuracy_proposed(scene, tmp_path):
    """The bristles, 0.5*10 N over 20 um, give by 0.1 mN/(250 kN/m) = 0.4 nm each way; 1e-4 of 20 um is 2 nm."""
    out = tmp_path / "run"
    run = scene(PRESLIDING.format(force=1e-4, method="lugre", accuracy=1e-4)).run(out=out).run
    (position,) = (one for one in run["below_weight"] if one["signal"] == "block.x")
    assert position["size"] == pytest.approx(8e-10, rel=0.1)
    assert position["weight"] == pytest.approx(2e-9)
    assert {"block.x", "block.v", "pad.slip"} == {one["signal"] for one in run["below_weight"]}
    (said,) = json.loads((out / "run.json").read_text())["remarks"]
    assert "block.x moves by 8e-10 m, its error weight is 2e-09" in said
    assert "run.accuracy: 1e-09 (it was 0.0001), or tell its size under `nominal`" in said
    assert any(name == "below its weight" and "block.x" in value for name, value in summary_rows(run, out))
    fine = scene(PRESLIDING.format(force=1e-4, method="lugre", accuracy=1e-9)).run(out=None).run
    assert fine["below_weight"] == []
    assert fine["remarks"] == []


@pytest.mark.parametrize(
    ("force", "method"), [(8.0, "lugre"), (8.0, "hold"), (0.01, "hold"), (0.01, "binding"), (0.0, "lugre")]
)
def test_what_is_larger_or_at_rest_is_not_told(force, method, scene):
    """Under `binding` a block at rest creeps, which is told as the worst creep."""
    run = scene(PRESLIDING.format(force=force, method=method, accuracy=1e-4)).run(out=None).run
    assert run["below_weight"] == []
    assert run["remarks"] == []


CHAIN = """
components:
  wall: {{type: Ground}}
  rest: {{type: Mass, mass: 1 kg}}
  spring: {{type: SpringDamper, stiffness: 1 kN/m, damping: 60 N*s/m}}
  push: {{type: ForceSource, force: {force} N}}
connections: [[wall.flange, spring.a], [spring.b, rest.flange, push.flange]]
run: {{stop: 1 s, accuracy: 1e-4}}
record: {{signals: [rest.x, spring.tension]}}
"""


@pytest.mark.parametrize(("force", "told"), [(5e-4, True), (2e-3, False)])
def test_a_position_is_judged_by_its_way_and_a_force_not_at_all(force, told, scene):
    """It moves by force over stiffness, 0.5 or 2 um, and the weight is 1 um."""
    run = scene(CHAIN.format(force=force)).run(out=None).run
    assert [one["signal"] for one in run["below_weight"]] == (["rest.x"] if told else [])


def test_a_family_is_judged_by_the_member_that_moves_most():
    from fairlead.analysis.record.below_weight import BelowWeight

    names = ["line.core[0].v", "line.core[1].v", "tail[0].v", "tail[1].v", "lone.v"]
    watch = BelowWeight(names, ["m/s"] * 5, np.arange(5), np.full(5, 1e-5), np.zeros(5, dtype=bool), 1e-4)
    watch.watch(np.array([[0.0, 0.0, 0.0, 0.0, 0.0], [1e-7, 1.0, -2e-6, 1e-7, np.nan]]))
    assert [(one["signal"], one["size"]) for one in watch.summary()] == [("tail[*].v", 2e-6)]

"""Creep as a user says it: a speed, or the load that may be lost; and what is told when it is too wide."""

import json
import math

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import ModelError

LOADED = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 0.4 kg, position: 0 m}
      spring: {type: Spring, stiffness: 1e4 N/m, free_length: -4 mm}
      pad: {type: Contact, method: METHOD, normal_force: 100 N, curve: 0.5, LEAK}
    connections: [[ground.flange, pad.a, spring.a], [pad.b, block.flange, spring.b]]
    run: {stop: 10 s, accuracy: 1e-8}
    record: {every: 1 s}
"""
LEAK = "leak: {share: 1.5 %, time: 10 s, stiffness: 10 kN/m}"


@pytest.mark.slow
@pytest.mark.parametrize("method", ["binding", "saturation"])
@pytest.mark.parametrize("curve", ["0.5", "{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 20 mm/s}"])
def test_a_contact_loses_just_the_share_of_load_it_may(simulate, method: str, curve: str):
    result = simulate(LOADED.replace("METHOD", method).replace("LEAK", LEAK).replace("curve: 0.5", f"curve: {curve}"))
    kept = result["spring.tension"][-1] / result["spring.tension"][0]
    assert kept == pytest.approx(1 - 0.015, rel=1e-6)


def test_the_widths_of_the_prism_follow_from_the_leak(scene):
    """Physics 1.5: 50 N on 1e4 N/m, 10 s and 0.2 % want a creep of 1.25 share F_s/(k t), to first order."""
    text = LOADED.replace("METHOD", "binding").replace("LEAK", LEAK.replace("1.5 %", "0.2 %"))
    values = scene(text).assembly.instances["pad"].values
    assert values.creep == pytest.approx(1.25 * 0.002 * 50 / (1e4 * 10), rel=2e-3)
    assert values.creep == pytest.approx(-1.25 * math.log1p(-0.002) * 50 / (1e4 * 10), rel=1e-9)
    assert (values.v_m, values.v_n) == pytest.approx((2 * values.creep, 4 * values.creep))


def test_a_leak_may_be_that_of_the_whole_scene(scene):
    text = LOADED.replace("METHOD", "binding").replace(", LEAK", "") + f"    friction: {{{LEAK}}}\n"
    assert scene(text).assembly.instances["pad"].values.creep == pytest.approx(9.45e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ((LEAK, LEAK + ", creep: 1 mm/s"), "both leak and creep are given"),
        (("normal_force: 100 N, ", ""), "Give leak.normal_force, at which this shall hold"),
        (("share: 1.5 %", "share: 150 %"), "Allowed: below 1"),
        (("time: 10 s, ", ""), "pad.leak.time is missing"),
    ],
)
def test_a_leak_that_says_too_much_or_too_little_is_refused(scene, change, says: str):
    text = LOADED.replace("METHOD", "binding").replace("LEAK", LEAK)
    if "normal_force" in change[0]:  # pressed by a signal instead
        text = text.replace("connections: [", "connections: [[spring.tension, pad.normal], ")
    with pytest.raises(ModelError) as caught:
        scene(text.replace(*change)).check()
    assert says in str(caught.value)


DRAGGED = """
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad:
        type: Contact
        method: METHOD
        normal_force: 10 N
        creep: CREEP
        curve: {curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}
      spring: {type: Spring, stiffness: 100 N/m}
      pull: {type: MotionSource, velocity: {ramp: {to: 2 mm/s, over: 1 s}}}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, spring.a], [spring.b, pull.flange]]
    run: {stop: 0.1 s}
"""


@pytest.mark.parametrize(
    ("method", "creep", "said"),
    [
        ("binding", "0.04 mm/s", []),  # v_n 0.16 mm/s: under a tenth of the drive's 2 mm/s
        ("binding", "0.1 mm/s", [("0.4 mm/s on (creep = 0.1 mm/s)", "slowest drive (pull), 2 mm/s", "0.05 mm/s")]),
        (
            "binding",
            "0.2 mm/s",
            [
                ("0.8 mm/s on (creep = 0.2 mm/s)", "the curve's velocity, 5 mm/s", "0.12 mm/s"),
                ("0.8 mm/s on (creep = 0.2 mm/s)", "slowest drive (pull), 2 mm/s", "0.05 mm/s"),
            ],
        ),
        ("tanh", "0.1 mm/s", [("0.265 mm/s on (creep = 0.1 mm/s)", "slowest drive (pull), 2 mm/s", "0.076 mm/s")]),
        ("saturation", "0.19 mm/s", []),
    ],
)
def test_a_creep_too_wide_for_the_scene_is_remarked_with_the_numbers(scene, method, creep, said):
    remarks = scene(DRAGGED.replace("METHOD", method).replace("CREEP", creep)).check()
    assert len(remarks) == len(said)
    for remark, (width, beside, most) in zip(remarks, said, strict=True):
        assert width in remark.what
        assert beside in remark.what
        assert f"at most {most} would do" in remark.way_out


def test_the_remark_on_a_contact_that_may_never_slide_says_so(scene):
    (_, remark) = scene(DRAGGED.replace("METHOD", "binding").replace("CREEP", "1 mm/s")).check()
    assert remark.way_out.endswith("the contact may never come to slide.")


def test_a_run_keeps_and_prints_what_check_remarks(scene, tmp_path):
    model = scene(DRAGGED.replace("METHOD", "binding").replace("CREEP", "0.1 mm/s"))
    said = CliRunner().invoke(app, ["run", str(model.netlist.path), "--out", str(tmp_path / "run"), "-q"])
    assert said.exit_code == 0
    assert "warning: " in said.output
    assert "slowest drive (pull), 2 mm/s" in said.output.replace("\n", " ")
    (kept,) = json.loads((tmp_path / "run" / "run.json").read_text())["remarks"]
    assert "slowest drive" in kept


@pytest.mark.parametrize("model", ["belt", "block_and_spring", "sandwich", "hundred_blocks", "single_bend"])
def test_the_bundled_models_give_no_cause_for_remarks(model: str):
    assert fairlead.load(model).check() == []

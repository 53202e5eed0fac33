"""`fairlead friction`, `compare` and `new friction`: what they print, draw and write."""

import json
import math
import pathlib
import re
import shlex
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from fairlead.cli import app

SCENE = """
schema: 1
components:
  ground: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  pad: {type: Contact, method: my_law, normal_force: 10 N, curve: 0.5}
  push: {type: ForceSource, force: {ramp: {to: 4 N, over: 1 s}}}
connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
run: {stop: 2 s, accuracy: 1e-6}
"""
TUSTIN = "{curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}"


@pytest.fixture
def answer(tmp_path, monkeypatch):
    """answer(*words) -> what the command says, run in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(app, list(words))


def record(said):
    assert said.exit_code == 0, said.output
    return json.loads(said.output)


@pytest.mark.slow
def test_friction_of_a_scene_uses_its_numbers(answer, tmp_path):
    (pad,) = record(answer("friction", "block_and_spring", "--json"))
    assert pad["contacts"] == "pad"
    assert pad["normal force"] == "10 N"
    assert pad["holding capacity"] == "5 N"  # robust binding is capped at stiction
    assert (pad["f_m"], pad["v_m"], pad["v_n"]) == ("5e+04 N*s/m", "0.0002 m/s", "0.0004 m/s")
    assert (tmp_path / "results" / "friction.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "creep"),
    [("binding", 0.99e-4 / 1.25), ("saturation", 0.99e-4), ("tanh", 2.6467e-4), ("root", 7.018e-4), ("hold", 0.0)],
)
def test_friction_tells_the_creep_of_the_formula(answer, method, creep):
    """With a constant coefficient: af/g0, af/F v_c, v_c atanh 0.99, v_c 0.99/sqrt(1 - 0.99^2), nothing."""
    (found,) = record(answer("friction", "0.4", "--method", method, "--normal", "100 N", "--json"))
    assert found["breakaway"] == "40 N"
    told = float(found["creep"].split(", ")[1].split(" ")[0])
    assert told == pytest.approx(creep, rel=0.02)  # three digits, and a capacity met only to 0.02 %


@pytest.mark.slow
def test_bristles_tell_their_stiffness(answer):
    (found,) = record(answer("friction", TUSTIN, "--method", "lugre", "--normal", "10 N", "--json"))
    assert found["stiffness"] == "2.5e+05 N/m (bristles)"  # 5 N in 20 um


LOADED = "{curve: tustin, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s, load_exponent: 0.8, load_reference: 20 N}"


@pytest.mark.parametrize(
    ("method", "name", "value"),
    [("hold", "holding capacity", 0), ("karnopp", "breakaway", 0), ("lugre", "stiffness", 1 / 2e-5),
     ("binding", "breakaway", 0), ("binding", "f_m", 1 / 1e-4)],
)  # fmt: skip
def test_friction_tells_what_counts_of_the_normal_force(answer, method, name, value):
    """mu_s N_ref (N/N_ref)^n = 0.5 20 5^0.8 = 36.24 N, in 20 um of bristles or 0.1 mm/s of creep; not 50 N."""
    (found,) = record(answer("friction", LOADED, "--method", method, "--normal", "100 N", "--json"))
    told = float(found[name].split(" ")[0])
    assert told == pytest.approx(0.5 * 20 * 5**0.8 * (value or 1), rel=1e-3)
    assert found["normal force"] == "100 N"


@pytest.mark.parametrize(
    ("method", "level"), [("hold", "5 N"), ("reset_integrator", "5 N"), ("lugre", "3 N"), ("maxwell_slip", "3 N"),
                          ("saturation", "3 N")])  # fmt: skip
def test_friction_tells_stiction_only_of_a_method_that_has_it(answer, method, level):
    """Of a curve that falls at once, what is smooth in the slip sees the sliding level alone."""
    curve = "{curve: coulomb, stiction: 0.5, coulomb: 0.3}"
    (found,) = record(answer("friction", curve, "--method", method, "--normal", "10 N", "--json"))
    assert found["breakaway"] == found["holding capacity"] == level


NAP = """
schema: 1
components:
  ground: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  pad:
    type: Contact
    method: METHOD
    normal_force: 50 N
    curve: {coulomb: 0.3, stiction: 0.4, backward: [[0, 0.2], [1 m/s, 0.1]], load_exponent: 0.5, load_reference: 100 N,
            softening: 0.01 1/K}
connections: [[ground.flange, pad.a], [pad.b, block.flange]]
run: {stop: 1 s, accuracy: 1e-6}
"""


def test_friction_tells_and_draws_both_directions(answer, tmp_path, monkeypatch):
    """0.4 and 0.2 times 100 N sqrt(50/100), at the temperature that the coefficients hold for."""
    from fairlead.report import friction_figure

    drawn = []
    monkeypatch.setattr(friction_figure, "draw", lambda found, path, title: drawn.append(found) or path)
    (tmp_path / "nap.yaml").write_text(NAP.replace("METHOD", "hold"), encoding="utf-8")
    (found,) = record(answer("friction", "nap.yaml", "--json"))
    assert found["breakaway"] == found["holding capacity"] == "28.28 N forward, 14.14 N backward"
    (one,) = drawn
    assert (one.capacity, one.capacity_backward) == pytest.approx((40 * 0.5**0.5, 20 * 0.5**0.5), rel=1e-12)
    assert one.branches["forward"][1].max() == pytest.approx(30 * 0.5**0.5, rel=1e-12)
    (tmp_path / "nap.yaml").write_text(NAP.replace("METHOD", "saturation"), encoding="utf-8")
    (found,) = record(answer("friction", "nap.yaml", "--json"))
    assert found["holding capacity"] == "21.21 N forward, 14.14 N backward"


TURNING = """
schema: 1
components:
  house: {type: Housing}
  one: {type: Inertia, moment: 1}
  two: {type: Inertia, moment: 1}
  plates: {type: Clutch, radius: 0.1 m, faces: 4, normal_force: 100 N, method: lugre, curve: 0.35}
  seal: {type: ShaftFriction, sliding: 3 N*m, breakaway: 5 N*m, method: hold}
connections: [[one.shaft, plates.a], [two.shaft, plates.b, seal.b], [house.shaft, seal.a]]
run: {stop: 1 s}
"""


def test_friction_of_shafts_is_a_torque_pressed_as_in_the_scene(answer, tmp_path):
    """4 faces of 100 N at 0.35 and 0.1 m: 14 N m, in bristles of 20 um, or 0.2 mrad; a seal as it is given."""
    (tmp_path / "turning.yaml").write_text(TURNING, encoding="utf-8")
    plates, seal = record(answer("friction", "turning.yaml", "--json"))
    assert (plates["normal force"], plates["breakaway"]) == ("400 N", "14 N*m")
    assert plates["stiffness"] == f"{14 / 2e-4:.4g} N*m/rad (bristles)"
    assert "rad/s at 50%" in plates["creep"]
    assert seal["breakaway"] == "5 N*m"
    said = answer("friction", "turning.yaml").output
    assert "of no scene" not in said
    refused = answer("friction", "turning.yaml", "--normal", "5 N")
    assert refused.exit_code == 2
    assert "has a normal force of its own" in " ".join(refused.output.replace("│", " ").split())


def test_friction_of_a_curve_refuses_what_it_would_not_heed(answer):
    for words, says in ((("--normal", "-3 N"), "pressed with more than 0 N"),
                        (("--set", "creep=1e-3"), "--set creep=1e-3 is for a netlist")):  # fmt: skip
        refused = answer("friction", "0.4", *words)
        assert refused.exit_code == 2
        assert says in " ".join(refused.output.replace("│", " ").split())
    assert "(of no scene; set it with --normal)" in answer("friction", "0.4").output
    assert "of no scene" not in answer("friction", "0.4", "--normal", "3 N").output


@pytest.mark.slow
def test_a_curve_needs_no_braces(answer):
    with_braces, without = (
        record(answer("friction", curve, "--method", "binding", "--normal", "10 N", "--json"))
        for curve in ("{curve: viscous, coulomb: 0.3, rate: 1}", "curve: viscous, coulomb: 0.3, rate: 1")
    )
    assert with_braces == without


def test_a_text_that_is_no_curve_and_a_method_that_is_none_are_usage_errors(answer):
    lacking = answer("friction", "{curve: tustin}")
    assert lacking.exit_code == 1
    assert "curve.stiction is missing; curve tustin needs it.\n    Coefficient at rest." in lacking.output
    treatment = answer("friction", "hold")
    assert treatment.exit_code == 2
    assert "--method hold" in treatment.output
    wrong = answer("friction", "0.4", "--method", "bindng")
    assert wrong.exit_code == 2
    assert "binding" in wrong.output


@pytest.mark.slow
def test_compare_shows_error_creep_and_cost_and_failures_with_their_reason(answer, tmp_path):
    vary = "pad.method=hold,binding,naive_zone"
    found = record(answer("compare", "block_and_spring", "--vary", vary, "--set", "run.stop=3", "--json", "--out", "c"))
    hold, binding, naive = found["rows"]
    assert hold["error"] < 1e-4 < binding["error"] < 0.1
    assert hold["creep"] < 1e-12 < binding["creep"] <= 1e-4
    assert hold["steps"] > 0
    assert naive["status"] in ("failed", "budget")  # at one instant, or from instant to instant
    assert naive["error"] is None
    assert "use method hold, or binding" in naive["reason"]
    assert (tmp_path / "c" / "compare.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_compare_prints_a_table(answer):
    said = answer("compare", "block_and_spring", "--vary", "pad.method=hold,tanh", "--set", "run.stop=2 s")
    assert said.exit_code == 0, said.output
    assert "treatment" in said.output
    assert "error against hold at accuracy 1e-07" in said.output
    assert answer("compare", "block_and_spring", "--vary", "pad.method=hold,,tanh").exit_code == 2
    assert answer("compare", "block_and_spring", "--vary", "pad.method=nonsense,none", "--json").exit_code == 1


def test_a_new_law_is_short_keeps_the_contract_unedited_and_runs(answer, tmp_path):
    assert answer("new", "friction", "my_law").exit_code == 0
    file = tmp_path / "my_law.py"
    assert len(file.read_text(encoding="utf-8").splitlines()) < 30
    # In a process of its own: a law once loaded is a member of the family for as long as Python runs.
    script = """
from my_law import MyLaw
from fairlead.testing import checks, contract
curves = {check.chosen.get("curve") for check in checks(MyLaw)}
assert {"coulomb", "viscous", "stribeck", "tustin", "hump", "table"} <= curves, curves
contract(MyLaw)
"""
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True, timeout=600)
    (tmp_path / "scene.yaml").write_text(SCENE, encoding="utf-8")
    command = [sys.executable, "-m", "fairlead", "run", "scene.yaml", "--library", "my_law.py", "--json"]
    said = subprocess.run(command, cwd=tmp_path, check=True, timeout=600, capture_output=True, text=True).stdout
    outcome = json.loads(said)
    assert outcome["status"] == "finished"
    # Held at 0.8 of its level it creeps at creep*atanh(0.8), which is what it was told to report.
    assert outcome["worst_creep"]["value"] == pytest.approx(1e-4 * math.atanh(0.8) * (1 - 0.8**8), rel=1e-3)


def test_new_refuses_what_is_there_and_what_is_no_name(answer, tmp_path):
    (tmp_path / "my_law.py").write_text("mine\n", encoding="utf-8")
    assert answer("new", "friction", "my_law").exit_code == 2
    assert (tmp_path / "my_law.py").read_text(encoding="utf-8") == "mine\n"
    assert answer("new", "friction", "hold").exit_code == 2
    assert answer("new", "friction", "MyLaw").exit_code == 2
    assert answer("new", "friction", "../law").exit_code == 2


def test_every_command_of_the_page_on_friction_ends_well(answer):
    page = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "friction.md").read_text(encoding="utf-8")
    lines = [line for block in re.findall(r"```sh\n(.*?)```", page, flags=re.DOTALL) for line in block.splitlines()]
    assert len(lines) >= 5
    # The last one loads a user's law into this process for good; the test of `new` does that in its own.
    for line in [line for line in lines if "my_law.py" not in line]:
        said = answer(*shlex.split(line)[1:])
        assert said.exit_code == 0, said.output
    assert all(f"figures/{name}.png" in page for name in ("binding", "compare"))


@pytest.mark.parametrize(("vary", "said"), [
    ("pad.metod=hold,tanh", "--vary: pad.metod: Contact"),
    ("friction.method=hold,foo", "--vary: friction.method: there is no method foo"),
    ("pda.method=hold,tanh", "--vary: pda.method: there is no component or block pda"),
    ("run.stop=3,soon", "--vary: run.stop = soon is not a quantity"),
    ("nosuch=1,2", "--vary: nosuch: there is no parameter nosuch"),
])  # fmt: skip
def test_a_mistake_in_what_is_varied_is_told_before_anything_runs(answer, tmp_path, vary, said):
    told = answer("compare", "block_and_spring", "--vary", vary, "--out", "c")
    assert told.exit_code == 1
    assert said in told.output
    assert not (tmp_path / "c").exists()


def test_the_name_of_a_curve_alone_is_told_with_what_it_needs(answer):
    said = answer("friction", "tustin")
    assert said.exit_code == 2
    told = " ".join(said.output.replace("│", " ").split())
    assert "{curve: tustin, stiction: ..., coulomb: ..., velocity: ...}" in told

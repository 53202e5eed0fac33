"""What a run says in the end of its friction and of its lines: who chose the treatment; whether a line rucks."""

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.analysis.margins.ruck import sentence, verdicts
from fairlead.analysis.treatments.friction_record import sentence as of_friction
from fairlead.cli import app

RUCK = 160.0  # N, as the model says
PAD = """
components:
  wall: {{type: Ground}}
  block: {{type: Mass, mass: 1 kg}}
  pull: {{type: ForceSource, force: 1 N}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.5{more}}}
connections: [[wall.flange, pad.a], [pad.b, block.flange, pull.flange]]
run: {{stop: 10 ms}}
"""


@pytest.fixture(scope="module")
def rucking(bundled):
    return bundled("single_bend", {"mu": 0.6, "run.stop": "8 s"})


def test_the_demo_shows_the_default_and_the_law_of_the_paper_by_one_word():
    shown, paper = (fairlead.load("single_bend", set=given) for given in ({}, {"method": "binding"}))
    kinds = [{one.type.word for one in model.flat.instances if hasattr(one.type, "word")} for model in (shown, paper)]
    assert "hold" in kinds[0]
    assert "binding" not in kinds[0]
    assert "binding" in kinds[1]
    assert "hold" not in kinds[1]


def test_where_a_line_rucks_first_is_told_by_its_tensions(rucking):
    """Independently, from the recorded tensions: the first row in which an element is beyond the ruck force."""
    (found,) = verdicts(rucking)
    tensions = rucking.elements("line.hose[*].tension")
    first = int((tensions.values < -RUCK).any(axis=1).argmax())
    assert found["rucks"]
    assert found["t"] == pytest.approx(float(tensions["time"][first]), abs=0.011)  # recorded every 10 ms
    assert found["element"] == int(tensions["element"][tensions.values[first].argmin()])
    assert found["along"] == 0.25 * (found["element"] + 0.5)
    assert 3.0 <= found["place"] <= 3.0 + np.pi / 2  # on the bend
    assert found["station"] == "bend"
    assert found["margin"] == pytest.approx(RUCK / -tensions.values.min(), rel=2e-3)
    assert sentence(found).startswith(f"line rucks: beyond 160 N first at t = {found['t']:.3g} s, element")


@pytest.mark.slow
def test_a_line_that_does_not_ruck_is_told_its_margin(bundled):
    (found,) = verdicts(bundled("single_bend", {"run.stop": "4 s"}))
    assert not found["rucks"]
    assert found["margin"] > 40  # it stays below 4 N of compression, docs/validation.md
    assert sentence(found).startswith("line does not ruck: margin ")
    assert sentence(found).endswith("; an element rucks beyond 160 N")


@pytest.mark.slow
def test_without_recorded_tensions_the_zones_of_the_hose_tell(tmp_path):
    netlist = fairlead.load("single_bend").netlist.path.read_text(encoding="utf-8")
    begin = netlist.index("record:")
    path = tmp_path / "bend.yaml"
    path.write_text(netlist[:begin] + "record: {every: 1 s, signals: [haul.force]}\n", encoding="utf-8")
    rucks, sound = "line rucks: beyond 160 N first at t = ", "line does not ruck: no element was compressed by 160 N"
    for mu, stop, said in ((0.6, 8, rucks), (0.35, 2, sound)):
        (found,) = verdicts(fairlead.load(path, set={"mu": mu, "run.stop": stop}).run(out=None))
        assert sentence(found).startswith(said)


@pytest.mark.slow
def test_a_line_that_nobody_watches_gets_no_verdict(bundled):
    assert verdicts(bundled("single_bend", {"run.stop": "0.1 s", "line.ruck_force": "null"})) == []
    assert len(bundled("single_bend", {"run.stop": "0.1 s", "line.ruck_force": "null"}).rucks()) == 0


def test_a_verdict_says_the_same_when_the_run_is_opened_again(rucking):
    again = fairlead.Result.open(rucking.path)
    assert again.rucks().notes == rucking.rucks().notes
    assert again.rucks()["rucks"] == [True]


def test_a_verdict_read_from_json_knows_what_was_never_compressed():
    found = {"line": "line", "ruck_force": 160.0, "rucks": False, "margin": None, "compressed": 0.0}
    assert sentence(found) == "line does not ruck: it was never compressed"


@pytest.mark.parametrize(
    ("more", "settings", "says"),
    [
        ("", {}, "hold: stuck contacts do not move. The default: nobody chose another"),
        (", method: hold", {},
         "hold: stuck contacts do not move. The default, which is also the choice of scene0.yaml:8"),
        ("", {"friction.method": "tanh"},
         "tanh: stuck contacts creep, by 0.0001 m/s at their limit. Not the default: the choice of set"),
        (", method: binding, creep: 1 mm/s", {},
         "binding: stuck contacts creep, by 0.001 m/s at their limit. Not the default: the choice of scene0.yaml:8"),
    ],
)  # fmt: skip
def test_who_chose_the_treatment_of_friction_is_told(scene, more, settings, says):
    result = scene(PAD.format(more=more), **settings).run(out=None)
    assert of_friction(result.run["friction"]) == says


def test_a_scene_parameter_that_was_set_is_the_choice_of_who_set_it(scene):
    text = "parameters: {how: hold}\nfriction: {method: '{how}'}\n" + PAD.format(more="").replace("\n", "\n", 1)
    assert of_friction(scene(text).run(out=None).run["friction"]).endswith("the choice of scene0.yaml:3")
    assert of_friction(scene(text, how="tanh").run(out=None).run["friction"]).endswith("the choice of set")


def test_a_scene_without_contacts_says_nothing_of_friction():
    result = fairlead.load("power_unit", set={"run.stop": "10 ms"}).run(out=None)
    assert result.run["friction"] is None
    assert of_friction(None) == ""


@pytest.mark.slow
def test_the_closing_table_and_the_page_have_both(tmp_path):
    out = tmp_path / "run"
    words = ["run", "single_bend", "--set", "run.stop=0.5 s", "--out", str(out), "--report"]
    said = " ".join(CliRunner().invoke(app, words).output.split())
    page = (out / "report.html").read_text(encoding="utf-8")
    for text in (said, page):
        assert "hold: stuck contacts do not move. The default, which is also the choice of single_bend.yaml" in text
        assert "line does not ruck: " in text

"""The parts of a study of cost, by themselves: errors, meshes, kept runs, settings files."""

import numpy as np
import pytest

import fairlead
from fairlead.analysis.cost.choice import choose
from fairlead.analysis.cost.compared_outputs import recorded, recorded_of_meshes
from fairlead.analysis.cost.deviation import OutputError, output_errors, scales, switching
from fairlead.analysis.cost.kept_runs import KeptRuns, key_of
from fairlead.analysis.cost.ladder import Equations, Ladder, Rung, other_equations
from fairlead.analysis.cost.meshes import correspondence, meshes
from fairlead.analysis.cost.study import Reference, Row, Study
from fairlead.analysis.cost.timed_run import Timed
from fairlead.analysis.treatments.treatments import treatment
from fairlead.errors import ModelError, UsageError
from fairlead.netlist.settings_file import read_settings, write_settings
from fairlead.results.signal import family

T = np.linspace(0.0, 1.0, 1001)


def errors(mine, theirs, name="a.x", unit="m"):
    return output_errors([name], [unit], np.reshape(mine, (-1, 1)), np.reshape(theirs, (-1, 1)))


def test_a_sine_out_of_phase_has_the_error_of_the_closed_form():
    """sin(w t + p) - sin(w t) has the magnitude 2 sin(p/2), over whole cycles the rms sqrt(2) sin(p/2)."""
    phase = 0.01
    (found,) = errors(np.sin(2 * np.pi * T + phase), np.sin(2 * np.pi * T))
    assert found.rms == pytest.approx(np.sqrt(2) * np.sin(phase / 2), rel=1e-3)
    assert found.worst == pytest.approx(2 * np.sin(phase / 2), rel=1e-3)
    assert found.end == pytest.approx(np.sin(phase), rel=1e-3)
    assert found.relative == pytest.approx(found.rms / 2, rel=1e-3)
    assert found.statistical < found.relative / 50  # mean and spread of the two are the same


def test_a_constant_output_is_not_compared_and_a_flag_neither():
    assert errors(np.ones(1001), np.ones(1001)) == []
    assert errors(np.round(T), np.round(T), unit="1") == []


def test_what_varies_by_rounding_only_is_not_compared():
    """The slip of a contact that holds is 1e-16 m/s of noise in both runs, beside one that slips by 0.1 m/s."""
    noise = 1e-16 * np.random.default_rng(0).standard_normal((2, len(T)))
    mine, theirs = (np.stack([0.1 * T, one], axis=1) for one in noise)
    assert [one.name for one in output_errors(["a.slip", "b.slip"], ["m/s", "m/s"], mine, theirs)] == ["a.slip"]


def test_what_is_constant_in_one_of_two_is_wrong_by_all_of_its_range():
    (found,) = errors(T, np.zeros(1001))
    assert found.worst / found.scale == 1.0


def test_elements_that_hardly_move_are_measured_by_their_family():
    values = np.stack([T, 1e-9 * T], axis=1)
    _, still = output_errors(["l.node[0].x", "l.node[1].x"], ["m", "m"], values + 1e-9, values)
    assert still.relative == pytest.approx(1e-9, rel=1e-3)


def test_switches_are_paired_by_component_zones_and_order():
    mine = [(0.1, "pad", "stuck", "slip"), (0.5, "pad", "slip", "stuck"), (0.7, "pad", "stuck", "slip")]
    theirs = [(0.11, "pad", "stuck", "slip"), (0.5, "pad", "slip", "stuck"), (0.2, "other", "a", "b")]
    found = switching(mine, theirs)
    assert (found.mine, found.theirs, found.paired) == (3, 3, 2)
    assert found.worst == pytest.approx(0.01)


def test_nodes_and_elements_of_two_meshes_are_matched():
    """Node i is node 2 i; element i is the mean of elements 2 i and 2 i + 1."""
    coarse = [f"l.node[{i}].x" for i in range(4)] + [f"l.rod[{i}].tension" for i in range(3)]
    fine = [f"l.node[{i}].x" for i in range(7)] + [f"l.rod[{i}].tension" for i in range(6)]
    found = correspondence([*coarse, "haul.force"], [*fine, "haul.force"])
    assert found["l.node[3].x"] == ["l.node[6].x"]
    assert found["l.rod[2].tension"] == ["l.rod[4].tension", "l.rod[5].tension"]
    assert found["haul.force"] == ["haul.force"]


def test_what_belongs_to_one_element_is_not_compared_across_meshes(tmp_path):
    text = fairlead.load("capstan").netlist.path.read_text(encoding="utf-8")
    (tmp_path / "every.yaml").write_text(text.replace("rope.outer[*].slip", "rope.*"), encoding="utf-8")
    model = fairlead.load(tmp_path / "every.yaml")
    every, kept = recorded(model), recorded_of_meshes(model)
    left_out = {family(name)[0] for name in every} - {family(name)[0] for name in kept}
    assert left_out == {"rope.outer[*].friction", "rope.outer_load[*].force"}
    assert {"rope.line[*].tension", "rope.outer[*].slip", "haul.force"} <= {family(name)[0] for name in kept}


def test_a_finer_mesh_is_one_of_smaller_elements_or_of_more_blocks():
    (coarse, fine) = meshes(fairlead.load("capstan"), [0.5, 2])
    assert (dict(coarse.settings), dict(fine.settings)) == ({"element": "0.25"}, {"element": "0.0625"})
    (more,) = meshes(fairlead.load("hundred_blocks"), [2])
    assert dict(more.settings) == {"blocks": "200"}
    assert meshes(fairlead.load("belt"), [2]) == []


def test_a_graded_line_is_made_finer_at_every_place(scene):
    """Its `element` decides nothing."""
    text = """
        components:
          rope: {type: Cable, length: 6 m, element: 1 m, graded: [[0 m, 0.5 m], [3 m, SIZE]], mass: 1 kg/m,
                 stiffness: 1 kN}
          route: {type: Route, stations: [{type: Straight, length: 9 m}]}
        connections: [[rope.path, route.path]]
        run: {stop: 1 s}
    """.replace("\n        ", "\n    ")
    (fine,) = meshes(scene(text.replace("SIZE", "0.2 m")), [2])
    assert dict(fine.settings) == {"rope.graded.0.1": "0.25", "rope.graded.1.1": "0.1"}
    counts = []
    for settings in ({}, fine.settings):
        made = scene(text.replace("SIZE", "0.2 m"), **settings).assembly.instances
        counts.append(sum("line[" in path for path in made))
    assert counts[1] == pytest.approx(2 * counts[0], abs=1)


def test_a_run_is_kept_whole_or_not_at_all(tmp_path):
    kept = KeptRuns(tmp_path)
    timed = Timed("finished", cpu=0.5, values=np.eye(2), events=((0.1, "pad", "stuck", "slip"),))
    kept.put("one", timed)
    again = kept.get("one", 1.0)
    assert np.array_equal(again.values, timed.values)
    assert (again.events, again.cpu) == (timed.events, 0.5)
    (tmp_path / "one.npz").write_bytes((tmp_path / "one.npz").read_bytes()[:100])
    assert kept.get("one", 1.0) is None
    assert [file.name for file in tmp_path.iterdir()] == ["one.npz"]


def test_a_run_under_the_name_of_another_is_not_taken(tmp_path):
    kept = KeptRuns(tmp_path)
    kept.put("one", Timed("finished", cpu=0.5))
    kept.put("two", Timed("finished", cpu=0.7))
    (tmp_path / "two.npz").replace(tmp_path / "one.npz")
    assert kept.get("one", 1.0) is None


def test_a_run_that_was_cut_off_is_made_again_when_there_is_more_time(tmp_path):
    kept = KeptRuns(tmp_path)
    kept.put("slow", Timed("budget", cap=2.0))
    assert kept.get("slow", 1.0) is not None
    assert kept.get("slow", 5.0) is None


def test_another_netlist_setting_or_library_is_another_run(tmp_path):
    library = tmp_path / "own.py"
    library.write_text("a = 1")
    keys = [key_of("d", ["a"]), key_of("e", ["a"]), key_of("d", ["b"]), key_of("d", ["a"], [str(library)])]
    library.write_text("a = 2")
    keys.append(key_of("d", ["a"], [str(library)]))
    assert len(set(keys)) == 5
    assert key_of("d", ["a"]) == keys[0]


def test_settings_that_are_written_are_read_again(tmp_path):
    settings = {"run.accuracy": "0.001", "run.engine": "rodas", "pad.normal_force": "12 N", "pad.creep": "null"}
    file = write_settings(tmp_path / "chosen.yaml", settings, "Made by hand.\nTwice.")
    assert read_settings(file) == settings
    assert fairlead.load("belt", set=read_settings(file)).netlist.run.accuracy == 1e-3


CREEPING = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 10 N, curve: 0.4, method: binding, creep: 1 mm/s, form: literal}
    connections: [[floor.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s}
"""


def test_another_treatment_takes_away_what_a_contact_says_of_its_own(scene):
    settings = treatment(scene(CREEPING), "hold")
    assert settings == {"friction.method": "hold", "pad.method": "hold", "pad.creep": "null", "pad.form": "null"}
    assert scene(CREEPING, **settings).check() == []
    assert treatment(scene(CREEPING), "tanh")["pad.form"] == "null"
    assert "pad.creep" not in treatment(scene(CREEPING), "tanh")


def test_a_creep_asked_of_a_scene_that_holds_is_tried_with_binding():
    (found,) = other_equations(fairlead.load("belt"), Ladder(treatments=(), creeps=(1e-3,)))
    assert found.label == "binding, creep 1 mm/s"
    assert found.settings == {"friction.method": "binding", "friction.creep": "0.001"}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("run:\n  accuracy: 1e-3\n", r"2:3: run: a map of 1 is not a value\n    .*run.accuracy: 1e-3"),
        ("- 1\n", "1:1: a list of 1 is not a map of settings"),
        ("run.acuracy: 1e-3\n", r"1:\d+: .*acuracy"),
        ("pd.normal_force: 3 N\n", r"1:\d+: pd.normal_force: there is no component or block pd\n.*Did you mean pad\?"),
    ],
)
def test_a_wrong_settings_file_is_told_by_line(tmp_path, text, told):
    file = tmp_path / "chosen.yaml"
    file.write_text(text)
    with pytest.raises(ModelError, match=told):
        fairlead.load("belt", set=read_settings(file)).check()


def test_a_settings_file_that_is_not_there_is_told(tmp_path):
    with pytest.raises(UsageError, match="No such file"):
        read_settings(tmp_path / "none.yaml")


def test_what_moves_by_rounding_alone_has_no_range():
    """A block that is held creeps by 1e-18 m: no difference of two runs is a share of that."""
    values = np.stack([1e-18 * T, 2.5 * T, 5.0 + 1e-14 * T, 1e-9 * T], axis=1)
    assert scales(["block.x", "pad.friction", "far.x", "slow.x"], values) == pytest.approx([0.0, 2.5, 0.0, 1e-9])


def test_of_a_sensitive_scene_no_line_is_chosen_that_is_only_known_to_be_below_more_than_the_target():
    """Tight runs of its equations scatter by 1.4 %: a line of 0.8 % says no more than one of 1.4 % does."""

    def line(equations, accuracy, size, cpu):
        error = [OutputError("a.x", "m", 1.0, end=size, rms=size, worst=size, mean=size, deviation=size)]
        return Row(Rung(equations, "rodas", accuracy), Timed("finished", cpu=cpu), numerical=error, modelling=error)

    scene, other = Equations("", exact=True), Equations("binding", {"friction.method": "binding"}, "treatment")
    sizes = ((1e-2, 0.017, 0.1), (1e-3, 0.008, 0.2), (1e-4, 0.008, 0.3), (1e-5, 0.014, 0.4))
    rows = [*(line(scene, *one) for one in sizes), line(other, 1e-4, 0.005, 0.5)]
    tight = Reference("tight", Timed("finished"), spread=0.0074, sensitive=True)
    study = Study("a", (0.0, 1.0), whole=True, reference=tight, rows=rows)
    assert choose(study, 0.01).row is rows[-1]
    assert choose(study, 0.05).row is rows[0]
    study.rows = rows[:-1]
    assert choose(study, 0.01).row is None

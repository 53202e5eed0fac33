"""Netlists that mean no good, and plain slips that could be taken for a mistake of ours: each is told at a place."""

import json
import os
import pathlib
import re

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component import scene
from fairlead.errors import ModelError, printable

ROD = """\
schema: 1
components:
  rod: {type: RodOnGuides, blocks: BLOCKS, mass: 1 kg, axial_stiffness: 1 kN, friction: 1 N}
  hand: {type: ForceSource, force: 1 N}
connections: [[hand.flange, rod.end]]
run: {stop: 1 s}
"""
LINE = """\
schema: 1
components:
  cable: {type: Cable, length: 40 m, element: 1 m, mass: 5 kg/m, stiffness: 500 kN, MORE}
  route: {type: Route, stations: STATIONS}
  hand: {type: ForceSource, force: FORCE}
connections:
  - [cable.path, route.path]
  - [hand.flange, cable.outboard]
run: {stop: 1 s}
record: {signals: ["SIGNALS"], plots: [{signals: [hand.force], file: "PLOT"}]}
"""
USUAL = {
    "MORE": "tension: 1 N", "STATIONS": "[{type: Guide, length: 60 m, friction: 0.3}]", "FORCE": "1 N",
    "SIGNALS": "hand.*", "PLOT": "pull.png",
}  # fmt: skip


def refused(folder, text, overrides=None):
    """What `check` says of a netlist, with the folder's name taken out."""
    (folder / "a.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as caught:
        fairlead.load(folder / "a.yaml", set=overrides).check()
    assert all(fault.where for fault in caught.value.faults)
    return str(caught.value).replace(f"{folder}{os.sep}", "")


def line(**other):
    text = LINE
    for name, usual in USUAL.items():
        text = text.replace(name, other.get(name.lower(), usual))
    return text


def check(*given):
    return CliRunner().invoke(app, ["check", *map(str, given)])


@pytest.mark.parametrize(("stations", "said"), [
    ("[Guide]", "a.yaml:4:35: route.stations[0].friction is missing; type Guide needs it"),
    ("[3]", "a.yaml:4:35: route.stations[0] = 3 is not a map.\n    Write a map with type, one of "),
    ("[null]", "route.stations[0] = nothing"),
    ("[[a]]", "route.stations[0] = a list of 1"),
    ("[{type: Pulley, angle: 45 deg, radius: 1 m, friction: 0.3, bearing: }]", "stations[0].bearing = nothing is not a "
     "map.\n    Write it as {friction, radius} with values, or leave bearing out."),
    ("[{}]", "route.stations[0] = an empty map"),
    ("[{type: {a: 1}}]", "route.stations[0]"),
    ("[{type: [Guide]}]", "route.stations[0]"),
    ("Guide", "route.stations = Guide"),
    ("{type: Guide}", "route.stations"),
    ("[{type: Guide, length: 60 m, friction: 0.3}, Guide]", "route.stations[1].length is missing; type Guide needs it"),
])  # fmt: skip
def test_a_station_of_the_wrong_kind_is_named(tmp_path, stations, said):
    assert said in refused(tmp_path, line(stations=stations))


@pytest.mark.parametrize("word", ["{a: 1}", "[hold]", "3", "true", ".nan", "''"])
def test_a_method_that_is_no_word_is_named(tmp_path, word):
    pad = "{type: Contact, normal_force: 1 N, curve: 0.3, method: " + word + "}"
    text = "schema: 1\ncomponents:\n  pad: " + pad + "\nrun: {stop: 1 s}\n"
    assert "a.yaml:3:63: pad.method" in refused(tmp_path, text)
    pad = "{type: Contact, normal_force: 1 N, curve: 0.3}"
    text = f"schema: 1\ncomponents:\n  pad: {pad}\nfriction: {{method: {word}}}\nrun: {{stop: 1 s}}\n"
    assert "a.yaml:4:20: friction.method" in refused(tmp_path, text)


def test_a_table_file_that_is_a_link_to_itself_is_a_mistake_at_its_place(tmp_path):
    (tmp_path / "loop.csv").symlink_to("loop.csv")
    said = refused(tmp_path, line(force="{table: {file: loop.csv}}"))
    assert said.startswith("a.yaml:5:51: hand.force.table.file = loop.csv cannot be read")


def test_a_fault_inside_a_table_file_names_the_row(tmp_path):
    (tmp_path / "pull.csv").write_text("t,F\n0,1\n1,2,3\n")
    said = refused(tmp_path, line(force="{table: {file: pull.csv}}"))
    assert "a.yaml:5:51: hand.force.table.file = pull.csv, row 3: 3 columns; a table has two." in said


@pytest.mark.parametrize(("name", "said"), [
    ("../pull.png", "../pull.png is not a plain file name"),
    ("a/b.png", "a/b.png is not a plain file name"),
    (".png", ".png is not a plain file name"),
    ("..", ".. is not a plain file name"),
    ("x" * 300 + ".png", "(304 characters) is no name for a file"),
    ("ü" * 120 + ".png", "(124 characters) is no name for a file"),
    ("a\\u0007.png", "is no name for a file"),
    ("pull.pdf", "pull.pdf is no figure that can be drawn\n    Figures are PNG: write pull.png."),
])  # fmt: skip
def test_a_figure_that_could_not_be_written_is_refused_before_the_run(tmp_path, name, said):
    found = refused(tmp_path, line(plot=name))
    assert "a.yaml:10:69: record.plots[0].file = " in found
    assert said in found


@pytest.mark.parametrize("signals", ["*" * 30 + "!", "*?" * 200 + "!", "*" * 5000])
def test_a_pattern_of_many_stars_is_one_that_no_signal_has(tmp_path, signals):
    assert "record: no signal has the name *" in refused(tmp_path, line(signals=signals))


def test_too_many_parts_are_refused_before_they_take_room(tmp_path, monkeypatch):
    assert "a.yaml:3:36: rod.blocks = 1000000 is out of range" in refused(tmp_path, ROD.replace("BLOCKS", "1000000"))
    monkeypatch.setattr(scene, "MOST_PARTS", 50)
    said = refused(tmp_path, ROD.replace("BLOCKS", "100"))
    assert said.startswith("a.yaml:3:3: rod: the scene has more than 50 parts with it.\n    Make fewer of what is")
    assert said.count("more than") == 1
    monkeypatch.setattr(scene, "MOST_PARTS", 110)
    weighty = line(more="weight: 20 N/m")
    assert "a.yaml:7:6: cable.path -- route.path: the scene has more than 110 parts" in refused(tmp_path, weighty)


@pytest.mark.parametrize(("more", "said"), [
    ("modules: 1000000", "is longer than the line of 4e-05 m"),
    ("graded: [[0 m, 1e-9 m], [40 m, 1e-9 m]]", "cable.graded: its lengths make more than 20000 elements."),
    ("graded: [[0 m, 1 m], [20 m, 0 m], [40 m, 1 m]]", "cable.graded: "),
    ("graded: [[0 m, -1 m], [40 m, -1 m]]", "cable.graded: an element at 0 m would be -1 m long."),
])  # fmt: skip
def test_a_mesh_without_end_is_refused(tmp_path, more, said):
    assert said in refused(tmp_path, line(more=more))


def test_bulkheads_closer_than_elements_are_one_at_every_node():
    from fairlead.components.line.mesh import bulkheads, cut

    mesh = cut(10.0, 0.5, modules=2)
    assert bulkheads(mesh, 1e-12) == bulkheads(mesh, None)  # and at once


def test_what_is_not_utf_8_is_told_with_line_and_column(tmp_path):
    (tmp_path / "a.yaml").write_bytes("schema: 1\nname: bél\n".encode("latin-1"))
    said = check(tmp_path / "a.yaml")
    assert said.exit_code == 1
    assert "a.yaml:2:8: not a text in UTF-8: byte 0xe9" in said.output.replace("\n", "")


def test_a_recording_grid_beyond_all_measure_is_told_at_its_place(tmp_path):
    text = ROD.replace("BLOCKS", "2") + "record: {every: 1e-12 s}\n"
    assert refused(tmp_path, text).startswith("a.yaml:7:17: record.every = 1e-12 s makes 1e+12 rows in 1 s.")
    said = refused(tmp_path, text, {"record.every": "1 ns"})
    assert said.startswith("set: record.every = 1e-09 s makes 1e+09 rows")


def test_a_recording_grid_longer_than_the_run_is_remarked(tmp_path):
    (tmp_path / "a.yaml").write_text(ROD.replace("BLOCKS", "2") + "record: {every: 2 s}\n")
    (remark,) = fairlead.load(tmp_path / "a.yaml").check()
    assert str(remark.where).endswith("a.yaml:7:17")
    assert remark.what.startswith("record.every = 2 s is longer than the run of 1 s")


def test_bytes_that_are_no_text_are_mistakes_of_the_command(tmp_path):
    odd = os.fsdecode(b"odd\xff.yaml")
    (tmp_path / odd).write_text(ROD.replace("BLOCKS", "2"))
    said = check(tmp_path / odd)
    assert (said.exit_code, "this is not the name of a file in UTF-8" in said.output) == (1, True)
    for setting in ("run.stop=\udcff", "run.\udcff=1", "\udcff=1"):
        said = check("belt", "--set", setting)
        assert (said.exit_code, "is not a text in UTF-8" in said.output) == (1, True), setting


@pytest.mark.parametrize("given", [{"block.mass": "{1/0} kg"}, {"block.mass": "{nosuch} kg"}, {"block.mass": "{1/0}"}])
def test_an_expression_from_outside_that_has_no_value_is_told_once(tmp_path, given):
    """It stood for 0 afterwards, and `block.mass = 0 is out of range` was told before it."""
    parts = "{block: {type: Mass, mass: 1 kg}, other: {type: Mass, mass: MASS}}"
    text = f"schema: 1\ncomponents: {parts}\nrun: {{stop: 1 s}}\n"
    said = refused(tmp_path, text.replace("MASS", "1 kg"), given)
    assert said.count("block.mass") == 1
    assert "out of range" not in said
    said = refused(tmp_path, text.replace("MASS", "0 kg"), given)
    assert "other.mass = 0 kg is out of range" in said


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
@pytest.mark.parametrize("to", ["a.yaml", "nowhere.yaml"])
def test_a_link_to_no_file_is_told_as_one(tmp_path, monkeypatch, to):
    """`Did you mean a.yaml?` was all that was said of a.yaml."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.yaml").symlink_to(to)
    with pytest.raises(ModelError, match=f"a.yaml: this is a link to {to}, where no file is"):
        fairlead.load("a.yaml")
    (tmp_path / "b.yaml").write_text("schema: 1\ninclude: [a.yaml]\nrun: {stop: 1 s}\n")
    with pytest.raises(ModelError, match=r"b.yaml:2:11: a.yaml(: this is a link to nowhere| is not a usable path)"):
        fairlead.load("b.yaml")


def test_an_include_that_is_a_folder_is_told_as_no_file(tmp_path):
    (tmp_path / "part.yaml").mkdir()
    said = refused(tmp_path, "schema: 1\ninclude: [part.yaml]\nrun: {stop: 1 s}\n")
    assert "a.yaml:2:11: part.yaml is not a regular file" in said


def test_a_comma_in_a_number_that_may_be_either_is_told_both_ways(tmp_path):
    text = "schema: 1\ncomponents: {block: {type: Mass, mass: 1,SOME kg}}\nrun: {stop: 1 s}\n"
    assert "1.000 kg or 1000 kg" in refused(tmp_path, text.replace("SOME", "000"))
    assert "not a decimal comma: 1.25 kg" in refused(tmp_path, text.replace("SOME", "25"))


def test_a_decimal_comma_is_named(tmp_path):
    said = refused(tmp_path, line(force="'1,5 kN'"))
    assert "a.yaml:5:36: hand.force = 1,5 kN is not a quantity." in said
    assert "\n    Write a decimal point, not a comma: 1.5 kN." in said
    said = refused(tmp_path, line(force="'{1,5*2} kN'"))
    assert "a.yaml:5:36: hand.force: {1,5*2}: a comma stands only between the arguments of a function" in said
    assert "\n    Write a decimal point, not a decimal comma." in said


def test_escapes_of_others_do_not_reach_the_terminal(tmp_path):
    (tmp_path / "a\x1b[31m.yaml").write_text("schema: 1\n")
    said = check(tmp_path / "a\x1b[31m.yaml")
    assert said.exit_code == 1
    assert "\x1b" not in said.output
    folder = tmp_path / "run"
    folder.mkdir()
    told = {"status": "failed", "name": "b\x1b[2Jelt\x1b]0;owned\x07", "sentence": "\x1b[8mhidden", "routes": []}
    (folder / "run.json").write_text(json.dumps(told))
    for given in (["margins", str(folder)], ["margins", str(folder), "--json"]):
        said = CliRunner().invoke(app, given)
        assert "\x1b" not in said.output, given


@pytest.mark.parametrize("typed", [
    ["ru\x1b[31mn\u202e"], ["run", "belt", "--fo\x1b[31mo\u202e"], ["friction", "{\x1b\u202e"],
    ["compare", "belt", "--vary", "a\x1b[8m\u202e"],
])  # fmt: skip
def test_what_was_typed_is_told_back_without_its_escapes(typed):
    said = CliRunner().invoke(app, typed)
    assert said.exit_code in (1, 2)
    assert said.output
    assert not {"\x1b", "\u202e"} & set(said.output)


SAMPLED = """schema: 1
components:
  given: {type: SignalSource, value: 1}
  eye: {type: SampledSensor, period: 1e-15 s}
connections: [[given.signal, eye.value]]
run: {stop: 10 s}
"""


@pytest.mark.parametrize(("setting", "told"), [
    ("run.max_step=1e-12 s", "run.max_step = 1e-12 s makes at least 4e+13 steps in 40 s."),
    ("record.every=1 ns", "record.every = 1e-09 s makes 4e+10 rows in 40 s."),
    ("run.max_steps=1e30", "run.max_steps = 1e+30 is above 1e+12"),
])  # fmt: skip
def test_counts_that_nobody_can_want_are_refused_before_the_run(setting, told):
    said = check("belt", "--set", setting)
    assert (said.exit_code, told in said.output) == (1, True), said.output


def test_a_sensor_that_samples_without_end_is_refused_before_the_run(tmp_path):
    (tmp_path / "a.yaml").write_text(SAMPLED)
    said = check(tmp_path / "a.yaml")
    assert said.exit_code == 1
    assert "a.yaml:4:3: eye is sampled every 1e-15 s, 1e+16 times in 10 s.\n    At most 1000000000" in said.output


def test_every_verb_prints_through_one_place():
    folder = pathlib.Path(fairlead.__file__).parent / "cli"
    direct = re.compile(r"typer\.(echo|secho)|click\.echo|(?<!\.)\bprint\(|\bConsole\(")
    others = [file for file in folder.glob("*.py") if file.name != "terminal.py"]
    assert not [file.name for file in others if direct.search(file.read_text())]


def test_what_cannot_be_seen_is_marked():
    assert printable("a\x1b[31mb\u202ec\udcff\r\n\td°é") == "a\ufffd[31mb\ufffdc\ufffd \n\td°é"


MANY = 1000
MASSES = "".join(f"  m{k}: {{type: Mass, mass: 1 kg}}\n" for k in range(3))


@pytest.mark.parametrize("mistakes", [
    "".join(f"  c{k}: {{type: Nope{k}}}\n" for k in range(MANY)),
    "".join(f"  c{k}: {{type: Mass, mas{k}: 1 kg}}\n" for k in range(MANY)),
    "connections: [" + ", ".join(f"[m0.flan{k}, m1.flan{k}]" for k in range(MANY)) + "]\n",
    "record: {signals: [" + ", ".join(f"m0.x{k}" for k in range(MANY)) + "]}\n",
    "limits: {" + ", ".join(f"m0.x{k}: {{above: 1}}" for k in range(MANY)) + "}\n",
    "initial: {" + ", ".join(f"m0.x{k}: 1" for k in range(MANY)) + "}\n",
    "effects: {" + ", ".join(f"m{k}: on" for k in range(MANY)) + "}\n",
    "friction: {" + ", ".join(f"m{k}: 1" for k in range(MANY)) + "}\n",
])  # fmt: skip
def test_of_many_mistakes_of_one_sort_some_are_told(tmp_path, mistakes):
    (tmp_path / "a.yaml").write_text(f"schema: 1\ncomponents:\n{MASSES}{mistakes}run: {{stop: 1 s}}\n")
    with pytest.raises(ModelError) as caught:
        fairlead.load(tmp_path / "a.yaml").check()
    assert len(caught.value.faults) < 900
    answer = check(tmp_path / "a.yaml", "--json").stdout
    assert len(json.loads(answer)["faults"]) == len(caught.value.faults)


def test_a_brace_left_open_is_told_where_it_opens(tmp_path):
    text = "schema: 1\ncomponents:\n  a: {type: Mass, mass: 1 kg\n  b: {type: Ground}\nrun: {stop: 1 s}\n"
    assert refused(tmp_path, text).startswith("a.yaml:3:6: not YAML: this { is not closed, as line 4 shows")
    text = "schema: 1\nconnections:\n  - [a.b, 'c].d'\n  - [c.d, e.f]\nrun: {stop: 1 s}\n"
    assert refused(tmp_path, text).startswith("a.yaml:3:5: not YAML: this [ is not closed, as line 4 shows")
    comma = "schema: 1\ncomponents:\n  a: {type: Mass,\n    mass: 1 kg\n    position: 1 m}\nrun: {stop: 1 s}\n"
    assert refused(tmp_path, comma).startswith("a.yaml:5:13: not YAML")  # closed, but for a comma


def test_a_misspelt_path_suggests_the_nearest_one(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "tow.yaml").write_text("schema: 1\ninclude: [secnes/part.yaml]\n")
    (tmp_path / "top.yaml").write_text("schema: 1\ninclude: [secnes/tow.yaml]\n")
    for asked in ("sceens/tow.yaml", "scenes/two.yaml", "sceens/twoo.yaml"):
        assert "Did you mean scenes/tow.yaml?" in check(asked).output, asked
    assert "Did you mean scenes/tow.yaml?" in check("top.yaml").output
    assert check("nowhere/at/all.yaml").exit_code == 1

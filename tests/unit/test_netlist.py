"""Loading a netlist: what the next stage is given."""

from pathlib import Path

import pytest

from fairlead.errors import Location, ModelError
from fairlead.netlist import EndPoint, bundled_models, load, survey
from fairlead.netlist.schema import Document

SCENE = """\
schema: 1
parameters: {mu: 0.35, speed: 0.3 m/s, twice: "{2*speed}", blocks: 3}
components:
  line:
    type: ArrayModule
    length: 15 m
    elements: "{blocks*20}"
    hose: {mass: 1.6 kg/m, stiffness: 8 kN}
  route:
    type: Route
    stations:
      - {name: bend, type: Bend, angle: 90 deg, friction: "{mu}"}
  haul: {type: MotionSource, velocity: {ramp: {to: "{-twice}", over: 1 s}}}
connections:
  - [haul.flange, line.inboard]
  - [line.path, route.bend3.path, "line.core[2].end"]
friction: {method: binding, creep: 0.1 mm/s}
effects: {inertia: on, torsion: false}
initial:
limits: {line.hose.tension: {above: -160 N}}
run: {stop: 20 s, accuracy: 1e-4, max_steps: 1e6}
record: {every: 10 ms, plots: [{title: "$F_{N}$", signals: [line.*]}]}
"""


@pytest.fixture
def scene(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(SCENE)
    return file


def test_parameters_are_worked_out_and_put_in_at_any_depth(scene):
    netlist = load(scene)
    assert {name: value.plain() for name, value in netlist.parameters.items()} == {
        "mu": 0.35, "speed": "0.3 m/s", "twice": "0.6 m/s", "blocks": 3,
    }  # fmt: skip
    line, route, haul = (netlist.components[name] for name in ("line", "route", "haul"))
    assert line.parameters["elements"].plain() == 60
    assert line.parameters["hose"].plain() == {"mass": "1.6 kg/m", "stiffness": "8 kN"}
    assert route.parameters["stations"].plain()[0]["friction"] == 0.35
    assert haul.parameters["velocity"].plain() == {"ramp": {"to": "-0.6 m/s", "over": "1 s"}}


def test_every_entry_knows_its_place(scene):
    netlist = load(scene)
    line = netlist.components["line"]
    file = line.where.file
    assert file.endswith("scene.yaml")
    assert (line.where, line.type_where) == (Location(file, 4, 3), Location(file, 5, 11))
    assert line.parameters["hose"].entries["stiffness"].where == Location(file, 8, 39)
    assert line.parameters["hose"].entries["stiffness"].key_where == Location(file, 8, 28)
    assert netlist.connections[0][1] == EndPoint("line.inboard", Location(file, 15, 19))
    assert (netlist.connections[1][1].component, netlist.connections[1][1].port) == ("route", "bend3.path")


def test_blocks_are_kept_as_written_and_settings_are_si(scene):
    netlist = load(scene)
    assert netlist.name == "scene"
    assert netlist.friction["creep"].plain() == "0.1 mm/s"
    assert {name: value.plain() for name, value in netlist.effects.items()} == {
        "inertia": "on",
        "torsion": False,
    }
    assert netlist.initial == {}
    assert netlist.limits["line.hose.tension"].plain() == {"above": "-160 N"}
    assert (netlist.run.stop, netlist.run.accuracy, netlist.run.engine) == (20.0, 1e-4, "auto")
    assert netlist.run.max_steps == 10**6
    assert (netlist.record.every, netlist.record.signals) == (0.01, ["*"])
    assert netlist.record.plots[0].title == "$F_{N}$"


def test_overrides_reach_parameters_components_lists_and_blocks(scene):
    overrides = {
        "mu": "0.6",
        "line.length": "20 m",
        "line.hose.mass": "{mu} kg/m",
        "line.new": "no",
        "route.stations.bend.angle": "45 deg",
        "route.stations[0].radius": "1 m",
        "run.stop": "5 s",
        "friction.method": "hold",
    }
    netlist = load(scene, overrides)
    line, route = netlist.components["line"], netlist.components["route"]
    assert line.parameters["length"].plain() == "20 m"
    assert line.parameters["hose"].plain() == {"mass": "0.6 kg/m", "stiffness": "8 kN"}
    assert line.parameters["new"].plain() == "no"
    assert str(line.parameters["length"].where) == "--set"
    station = route.parameters["stations"].plain()[0]
    assert station == {"name": "bend", "type": "Bend", "angle": "45 deg", "friction": 0.6, "radius": "1 m"}
    assert (netlist.run.stop, netlist.friction["method"].plain()) == (5.0, "hold")


def test_the_digest_depends_on_every_file_and_every_override(scene, tmp_path):
    first = load(scene).digest
    assert load(scene).digest == first
    assert load(scene, {"mu": "0.6"}).digest != first
    (tmp_path / "part.yaml").write_text("schema: 1\n")
    scene.write_text(SCENE + "include: [part.yaml]\n")
    with_part = load(scene).digest
    (tmp_path / "part.yaml").write_text("schema: 1  # changed\n")
    assert len({first, with_part, load(scene).digest}) == 3


def test_includes_add_components_connections_and_parameters(scene, tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "drive.yaml").write_text(
        "schema: 1\ninclude: [more/deep.yaml, ../shared.yaml]\nparameters: {gain: 2, mu: 0.1}\n"
        'components: {drive: {type: Motor, gain: "{gain*mu}"}}\nconnections: [[drive.shaft, line.end]]\n'
    )
    (tmp_path / "parts" / "more").mkdir()
    (tmp_path / "parts" / "more" / "deep.yaml").write_text(
        "schema: 1\ninclude: [../../shared.yaml]\ncomponents: {valve: {type: Valve}}\n"
    )
    (tmp_path / "shared.yaml").write_text("schema: 1\ncomponents: {ground: {type: Ground}}\n")
    scene.write_text(SCENE + "include: [parts/drive.yaml]\n")
    netlist = load(scene)
    assert set(netlist.components) == {"line", "route", "haul", "drive", "valve", "ground"}
    assert netlist.components["drive"].parameters["gain"].plain() == 2 * 0.35  # the including file's mu wins
    assert netlist.components["drive"].where.file.endswith(str(Path("parts/drive.yaml")))
    assert len(netlist.connections) == 3


def test_a_survey_keeps_what_is_sound_so_that_later_stages_can_add_their_mistakes(scene):
    scene.write_text(SCENE.replace("20 s", "20 kg").replace("haul.flange", "hual.flange") + "foo: 1\n")
    netlist, faults = survey(scene)
    assert len(faults) == 3
    assert set(netlist.components) == {"line", "route", "haul"}
    assert len(netlist.connections) == 1
    with pytest.raises(ModelError) as caught:
        load(scene)
    assert caught.value.faults == faults


def test_a_netlist_prints_itself(scene):
    text = str(load(scene))
    assert "line: ArrayModule(length = 15 m, elements = 60" in text
    assert "haul.flange -- line.inboard" in text


def test_windows_line_ends_and_a_byte_order_mark_are_welcome(scene):
    plain = load(scene)
    scene.write_bytes(b"\xef\xbb\xbf" + SCENE.replace("\n", "\r\n").encode())
    netlist = load(scene)
    assert netlist.components == plain.components
    assert netlist.connections == plain.connections


def test_a_file_that_shares_its_name_with_a_bundled_model_is_not_passed_over(tmp_path, monkeypatch):
    bundled = tmp_path / "bundled.yaml"
    bundled.write_text(SCENE)
    monkeypatch.setattr("fairlead.netlist.files.bundled_models", lambda: {"single_bend": bundled})
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    assert load("single_bend").path == bundled
    with pytest.raises(ModelError, match=r"no such file or bundled model\n    Did you mean single_bend\?"):
        load("singel_bend")
    (tmp_path / "here" / "single_bend.yaml").write_text(SCENE)
    with pytest.raises(ModelError, match=r"Write \./single_bend\.yaml"):
        load("single_bend")
    assert load("./single_bend.yaml").name == "single_bend"


@pytest.mark.parametrize(
    "name", ["single_parts/worm", "single_parts/worm.yaml", "hard/valve_shut", "single_parts/table_of_two"]
)
def test_a_small_netlist_is_found_by_the_name_of_its_folder_from_anywhere(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert load(name).path.stem == name.partition("/")[2].removesuffix(".yaml")
    assert name not in bundled_models()


def test_a_small_netlist_that_is_misspelt_is_told_and_one_beside_a_file_of_that_name_asks(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for asked in ("single_parts/wrom", "worm", "machines/worm"):
        with pytest.raises(ModelError, match=r"Did you mean single_parts/worm\?"):
            load(asked)
    (tmp_path / "single_parts").mkdir()
    (tmp_path / "single_parts" / "worm.yaml").write_text(SCENE)
    assert load("single_parts/worm.yaml").path == Path("single_parts/worm.yaml")
    with pytest.raises(ModelError, match=r"Write \./single_parts/worm\.yaml"):
        load("single_parts/worm")


def test_the_json_schema_of_a_netlist_accepts_the_scene_and_refuses_an_unknown_key():
    import jsonschema
    import yaml

    schema = Document.model_json_schema()
    scene = yaml.safe_load(SCENE.replace("inertia: on", "inertia: 'on'").replace("initial:\n", ""))
    scene["run"]["accuracy"], scene["run"]["max_steps"] = 1e-4, 10**6  # YAML 1.1 reads both as texts
    jsonschema.validate(scene, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**scene, "frictoin": {}}, schema)


@pytest.mark.parametrize("name", ["run", "record", "friction", "effects", "initial", "nominal", "limits", "parameters"])
def test_a_component_called_like_a_block_of_settings_is_refused(tmp_path, name):
    file = tmp_path / "scene.yaml"
    file.write_text(f"schema: 1\ncomponents:\n  {name}: {{type: Ground}}\nrun: {{stop: 1 s}}\n")
    with pytest.raises(ModelError) as caught:
        load(file)
    (fault,) = caught.value.faults
    assert (fault.where.line, fault.where.column) == (3, 3)
    assert fault.what == f"{name} is no name for a component: --set {name}.NAME means the block {name}"
    assert f"such as {name}_1" in fault.way_out


def test_a_device_without_a_name_is_set_by_that_of_its_type():
    """As its signals are called: `bend`, and where there are several `bend_1`, `bend_2`."""
    stations = load("single_bend", {"route.stations.bend.friction": "0.5"}).components["route"].parameters["stations"]
    assert stations.plain()[0]["friction"] == 0.5
    for name in ("bnd", "bend_1", "1"):
        with pytest.raises(ModelError, match=r"there is no item .*(?s:.*)Items go by number, 0 to 0, or by name: bend"):
            load("single_bend", {f"route.stations.{name}.friction": "0.5"})


def test_several_devices_of_a_type_are_numbered_as_their_signals_are(tmp_path):
    file = tmp_path / "scene.yaml"
    more = '\n      - {type: Bend}\n      - {type: Bend}\n      - {type: Pulley}'
    file.write_text(SCENE.replace('friction: "{mu}"}', 'friction: "{mu}"}' + more))
    set_ = {"route.stations.bend_2.angle": "1", "route.stations.bend_3.angle": "2", "route.stations.pulley.angle": "3"}
    stations = load(file, set_).components["route"].parameters["stations"].plain()
    assert [one.get("angle") for one in stations] == ["90 deg", 1, 2, 3]


@pytest.mark.parametrize(
    ("asked", "meant"),
    [("own.yml", "own.yaml"), ("belt.yml", "belt"), ("beltt.yaml", "belt"), ("ownn.yaml", "own.yaml")],
)
def test_a_file_is_not_meant_for_its_ending_alone(asked, meant, tmp_path, monkeypatch):
    """`w.yaml` shares most of its letters with `beltt.yaml`, and none of its name."""
    monkeypatch.chdir(tmp_path)
    for name in ("w.yaml", "own.yaml"):
        (tmp_path / name).write_text("schema: 1\n")
    with pytest.raises(ModelError) as caught:
        load(asked)
    assert caught.value.faults[0].way_out.startswith(f"Did you mean {meant}?")

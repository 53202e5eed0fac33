"""What docs/ shows works as printed: files are written, Python runs, commands end well, links lead somewhere.

A block below `<!-- file: NAME -->` is a file; other Python blocks run in the folder of these files, in the order
of the page; every line of an `sh` block is a command.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import warnings

import jsonschema
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.component.given import Waveform
from fairlead.component.registry import known_types
from fairlead.component.waveforms import TERMS, read_waveform
from fairlead.netlist.yaml12 import read_yaml
from fairlead.quantities import QuantityError, si

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
FENCE = re.compile(r"^(?:<!-- file: (\S+) -->\n)?```(\w*)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
MOST_LINES = 15  # of a component in a user's file

WALL = "wall: {type: Ground}, load: {type: Mass, mass: 1 kg}"
ENDS = "connections: [[wall.flange, part.a], [part.b, load.flange]]\nrun: {stop: 0.1 s}\n"
PARAMETERS = {
    "Bungee": "stiffness: 50 N/m", "Bumper": "stiffness: 50 N/m, reach: 1 mm", "Gap": "stiffness: 1 kN/m, play: 1 mm",
    "Chain": "links: 3, stiffness: 1 N/m",
    "Relaxing": "stiffness: 50 N/m, damping: 5 N*s/m",
}  # fmt: skip


def blocks(page: str) -> list[tuple[str, str, str]]:
    """(file name or "", language, text) of the blocks of a page."""
    return FENCE.findall((DOCS / f"{page}.md").read_text(encoding="utf-8"))


def files(page: str, folder: pathlib.Path) -> list[pathlib.Path]:
    """Write the files that a page shows."""
    shown = [(folder / name, text) for name, _, text in blocks(page) if name]
    for path, text in shown:
        path.write_text(text, encoding="utf-8")
    return [path for path, _ in shown]


def class_in(file: pathlib.Path) -> str:
    (name,) = re.findall(r"^class (\w+)", file.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return name


@pytest.mark.parametrize("page", ["components", "drives", "netlist", "routes"])
def test_every_command_shown_ends_well(page: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    files(page, tmp_path)
    lines = [line for _, language, text in blocks(page) if language == "sh" for line in text.splitlines()]
    assert lines
    for line in lines:
        answer = CliRunner().invoke(app, shlex.split(line)[1:])
        assert answer.exit_code == 0, answer.output


def test_the_page_on_python_runs_from_the_top(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    code = [text for name, language, text in blocks("python") if language == "python" and not name]
    assert len(code) >= 7
    with warnings.catch_warnings():
        exec("\n".join(code), {})
    assert not list(tmp_path.iterdir())


def test_the_page_on_coupling_runs_from_the_top(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    files("coupling", tmp_path)
    code = [text for name, language, text in blocks("coupling") if language == "python" and not name]
    assert len(code) == 3
    exec("\n".join(code), {})


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bungee.py", "bumper.py", "gap.py", "relaxing.py", "chain.py"])
def test_a_component_in_a_users_file_is_checked_described_in_the_schema_and_runs(
    name: str, tmp_path: pathlib.Path
) -> None:
    (library,) = [path for path in files("components", tmp_path) if path.name == name]
    lines = [line for line in library.read_text(encoding="utf-8").splitlines() if line.strip()]
    assert len(lines) <= MOST_LINES
    kind = class_in(library)
    components = f"{{{WALL}, part: {{type: {kind}, {PARAMETERS[kind]}}}}}"
    scene = tmp_path / "scene.yaml"
    scene.write_text(f"schema: 1\ncomponents: {components}\n{ENDS}", encoding="utf-8")
    model = fairlead.load(scene, libraries=[str(library)])
    assert model.check() == []
    assert kind in fairlead.describe_type(kind, [str(library)])
    tree, _ = read_yaml(scene.read_text(encoding="utf-8"), "scene.yaml")
    assert tree is not None
    jsonschema.Draft7Validator(fairlead.json_schema([str(library)])).validate(tree.plain())
    assert model.run(out=tmp_path / "results").run["status"] == "finished"


@pytest.mark.slow
def test_a_curve_in_a_users_file_is_known_to_every_contact(tmp_path: pathlib.Path) -> None:
    files("components", tmp_path)
    script = """
import fairlead
scene = '''
schema: 1
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: linear, stiction: 0.3, slope: 0.1 s/m}}
connections: [[floor.flange, pad.a], [block.flange, pad.b]]
run: {stop: 0.1 s}
'''
open('scene.yaml', 'w').write(scene)
fairlead.load('scene.yaml', libraries=['linear.py']).check()
assert 'stiction + slope*v' in fairlead.describe_type('Hold', ['linear.py'])
assert 'stiction + slope*v' in fairlead.describe_type('Bend', ['linear.py'])
"""
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True, timeout=600)


def test_python_shown_runs(tmp_path: pathlib.Path) -> None:
    files("components", tmp_path)
    script = "\n".join(text for name, language, text in blocks("components") if language == "python" and not name)
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=True, timeout=600)


def test_netlists_shown_fit_the_schema(tmp_path: pathlib.Path) -> None:
    (scene,) = files("netlist", tmp_path)
    tree, faults = read_yaml(scene.read_text(encoding="utf-8"), scene.name)
    assert tree is not None
    assert not faults
    jsonschema.Draft7Validator(fairlead.json_schema()).validate(tree.plain())


def test_waveforms_shown_are_all_there_are_and_can_be_read(tmp_path: pathlib.Path) -> None:
    (text,) = [text for name, language, text in blocks("netlist") if language == "yaml" and not name]
    tree, faults = read_yaml(text, "netlist.md")
    assert tree is not None
    assert not faults
    shown = tree.plain()
    assert set(shown) == set(TERMS)
    for term, settings in shown.items():
        read_waveform({term: settings}, Waveform("N"), tmp_path)


@pytest.mark.parametrize("page", ["components", "drives", "netlist", "integrator"])
def test_files_and_types_that_a_page_names_exist(page: str) -> None:
    text = (DOCS / f"{page}.md").read_text(encoding="utf-8")
    engine = ROOT / "src/fairlead/integrate"
    for name in re.findall(r"`((?:\w+/)*\w+\.py)`", text):
        assert any((base / name).exists() for base in (ROOT, ROOT / "src/fairlead", engine)), name
    for kind in re.findall(r"type: (\w+)", text):
        assert kind in known_types() or kind in PARAMETERS or kind == "TYPE", kind


BETWEEN_TWO = """
schema: 1
components:
  floor: {type: Ground}
  belt: {type: MotionSource, velocity: 1 m/s}
  p: {type: Contact, normal_force: 1 N, curve: 0.3}
  q: {type: Contact, normal_force: 1 N, curve: 0.3}
connections: [[floor.flange, p.a], [p.b, q.a], [q.b, belt.flange]]
run: {stop: 1 s}
"""


def test_messages_that_the_page_on_starting_explains_are_those_that_there_are(tmp_path: pathlib.Path) -> None:
    """Each stands in the source as it is, or is what a wrong scene or quantity is told."""
    text = (ROOT / "docs/howto/start.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?!Message|---)(.+?) \|", text, re.MULTILINE)
    assert len(rows) > 5
    (tmp_path / "between.yaml").write_text(BETWEEN_TWO)
    with pytest.raises(fairlead.ModelError) as caught:
        fairlead.load(tmp_path / "between.yaml").check()
    with pytest.raises(QuantityError) as other:
        si("3 N", "m")
    sources = [file.read_text(encoding="utf-8") for file in (ROOT / "src" / "fairlead").rglob("*.py")]
    known = " ".join([*sources, str(caught.value), str(other.value)])
    assert [one for one in rows if one.removesuffix(" ...") not in known] == []

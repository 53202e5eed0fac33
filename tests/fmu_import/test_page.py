"""What the page about FMUs in a model shows works as printed."""

import math
import pathlib
import re
import shlex

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "howto" / "foreign_fmu.md"
FENCE = re.compile(r"^(?:<!-- file: (\S+) -->\n)?```(\w*)\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
AXIS = [
    {"name": "axis.v", "ref": 0, "causality": "input", "start": 0, "unit": "m/s"},
    {"name": "axis.gain", "ref": 1, "causality": "parameter", "variability": "fixed", "start": -1},
    {"name": "F", "ref": 16, "causality": "output"},
]


def test_the_netlist_the_command_and_the_python_of_the_page_work(make, tmp_path, monkeypatch):
    """The FMU gives the speed as a force, so that v is multiplied by 1 + T/m at every point."""
    monkeypatch.chdir(tmp_path)
    shown = FENCE.findall(PAGE.read_text(encoding="utf-8"))
    make("feed", 3, AXIS, name="electronics").rename(tmp_path / "electronics.fmu")
    names: dict[str, object] = {}
    for name, language, text in shown:
        if name:
            (tmp_path / name).write_text(text, encoding="utf-8")
        elif language == "sh":
            answer = CliRunner().invoke(app, shlex.split(text)[1:])
            assert answer.exit_code == 0, answer.output
        elif language == "python":
            exec(text, names)
    speed = names["result"].at("cart.v", 0.995)
    assert math.isclose(speed, 1.005**99 * (1 + 0.005 / 2), rel_tol=1e-8)


@pytest.mark.slow
def test_the_netlist_with_arrays_works(make, tmp_path):
    """y = W u, of which the third is 5 m * 1 + 6 mm * 5."""
    text = next(text for name, _, text in FENCE.findall(PAGE.read_text(encoding="utf-8")) if name == "arrays.yaml")
    make("matrix", rich=True, name="mixer").rename(tmp_path / "mixer.fmu")
    (tmp_path / "arrays.yaml").write_text(text, encoding="utf-8")
    result = fairlead.load(tmp_path / "arrays.yaml", allow_fmu=True).run(out=None)
    assert result.at("mixer.sum", 0.5) == pytest.approx(5.03, rel=1e-15)

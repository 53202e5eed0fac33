"""A load runs into its tether and back: nothing is supplied, nothing is lost, and the trust figures must say so."""

import math

import pytest
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.errors import ModelError

STIFFNESS, MASS, SPEED, LENGTH = 1000.0, 10.0, 2.0, 1.0
SNAP = f"""
components:
  wall: {{type: Ground}}
  rope: {{type: Tether, stiffness: {STIFFNESS} N/m, length: {LENGTH} m}}
  load: {{type: Mass, mass: {MASS} kg, velocity: {SPEED} m/s}}
connections: [[wall.flange, rope.a], [rope.b, load.flange]]
run: {{stop: 2 s, accuracy: 1e-6}}
record: {{every: 1 ms}}
"""


def test_a_load_leaves_its_tether_as_fast_as_it_came(simulate):
    result = simulate(SNAP)
    assert result["rope.tension"].max() == pytest.approx(SPEED * math.sqrt(STIFFNESS * MASS), rel=1e-5)  # 1 ms grid
    assert result["load.v"][-1] == pytest.approx(-SPEED, rel=1e-6)
    taut, slack = (event.t for event in result.events if event.component == "rope")
    assert slack - taut == pytest.approx(math.pi * math.sqrt(MASS / STIFFNESS), rel=1e-6)


def test_the_energy_of_a_conservative_run_closes(simulate):
    """Closure is relative to the 20 J that go to and fro, though nothing is supplied or dissipated."""
    assert simulate(SNAP).run["energy"]["closure"] < 1e-7


def test_quiet_hides_the_table_and_not_what_went_wrong(tmp_path):
    netlist = tmp_path / "snap.yaml"
    netlist.write_text("schema: 1\nname: snap\n" + SNAP + "limits: {rope.tension: {below: 150 N}}\n", encoding="utf-8")
    said = CliRunner().invoke(app, ["run", str(netlist), "--out", str(tmp_path / "run"), "-q"])
    assert said.exit_code == 5
    assert said.stderr.startswith("limit broken: rope.tension")
    assert said.stdout == ""


def test_a_recording_grid_that_would_fill_the_disk_is_refused(scene):
    model = scene(SNAP.replace("every: 1 ms", "every: 1e-12 s"))
    for ask in (model.check, model.run, lambda: scene(SNAP, **{"record.every": "1e-12 s"})):
        with pytest.raises(ModelError, match=r"record.every = 1e-12 s makes 2e\+12 rows"):
            ask()


def test_a_library_that_ends_python_does_not_end_fairlead(scene, library):
    model = scene(SNAP, libraries=(library("raise SystemExit(0)"),))
    with pytest.raises(ModelError, match="cannot be loaded"):
        model.check()

"""Bundled models as FMUs beside `advance` at the same points, to the last bit, and beside a run that nobody cuts."""

import pathlib

import numpy as np
import pytest

import fairlead
from fairlead.fmu import export
from tests.fmu.exported import fmpy, needs_compiler, slave

pytestmark = pytest.mark.slow
EXAMPLES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"
SCENES = {
    "belt": ("belt", "block.*", 0.02, 100),
    "hundred_blocks": ("hundred_blocks", "rod.block[?].x", 0.05, 40),
    "single_bend": ("single_bend", "line.*_node[?].x", 0.05, 60),
    "guidance_route_ideal": ("guidance_route_ideal", "line.*_node[?].x", 0.05, 30),
    "clutch train": (EXAMPLES / "brake_and_clutch.yaml", "wheel.rate", 0.01, 400),
    "winch_drive": ("winch_drive", "drive.*", 0.05, 60),
    "valve_motor": ("valve_motor", "drive.*", 0.01, 100),
}
"""Netlist, outputs, communication step [s], steps."""
ACCURACIES = 10.0
"""By how many accuracies of its largest value a signal may differ from that of an uncut run."""


def both(file, folder, model, h, steps, **settings):
    """Rows of the FMU and of `advance`, and the names of the outputs."""
    start, native = model.netlist.run.start, model.start(**settings)
    rows, own = [], []
    with slave(file, folder, start=start) as one:
        one.fmu.exitInitializationMode()
        for _ in range(steps):
            one.step(h)
            native.advance(one.t)
            rows.append(one.get(*one.outputs))
            own.append([native.get(name) for name in one.outputs])
    return np.array(rows), np.array(own), one.outputs


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("scene", SCENES)
def test_a_bundled_model_goes_as_in_fairlead_to_the_last_bit(tmp_path, scene, engine):
    fmpy()
    needs_compiler()
    path, outputs, h, steps = SCENES[scene]
    model = fairlead.load(path)
    version = 2 + (engine == "rodas")
    try:
        native = model.start(engine=engine)
    except fairlead.FairleadError:
        pytest.skip(f"{engine} does not run {scene}")
    assert native.t == model.netlist.run.start
    file = export(model, tmp_path / "model.fmu", version=version, outputs=[outputs], engine=engine)
    rows, own, names = both(file, tmp_path / "unpacked", model, h, steps, engine=engine)
    assert len(names) > 0
    assert np.ptp(rows, axis=0).max() > 0
    assert rows.tobytes() == own.tobytes()


@pytest.mark.parametrize("scene", SCENES)
def test_it_stays_within_ten_accuracies_of_a_run_that_nobody_cuts(tmp_path, scene):
    """At every point, not only at the last; a jump of the uncut run at a point has a row on each side of it."""
    fmpy()
    needs_compiler()
    path, outputs, h, steps = SCENES[scene]
    model = fairlead.load(path, set={"record.every": h})
    file = export(model, tmp_path / "model.fmu", outputs=[outputs], engine="rodas")
    start, rows = model.netlist.run.start, []
    with slave(file, tmp_path / "unpacked", start=start) as one:
        one.fmu.exitInitializationMode()
        for _ in range(steps):
            one.step(h)
            rows.append(one.get(*one.outputs))
        names = one.outputs
    result = model.run(out=None, stop=start + h * steps, engine="rodas")
    recorded = {signal.name for signal in result.signals}
    compared = [(k, name) for k, name in enumerate(names) if name in recorded]
    assert len(compared) > 0
    for k, name in compared:
        largest = float(np.abs(result[name]).max())
        for step, row in enumerate(rows, 1):
            uncut = result[name][np.abs(result.t - start - h * step) < 1e-6 * h]
            assert np.abs(row[k] - uncut).min() <= ACCURACIES * model.netlist.run.accuracy * largest, (name, step)


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize(
    ("scene", "outputs", "h"), [("belt", "block.*", 0.02), ("single_bend", "line.*_node[?].x", 0.005)]
)
def test_an_fmu_made_for_real_time_takes_the_steps_that_advance_takes(tmp_path, scene, outputs, h, version):
    """Communication steps of a whole number of frames, and of none: a point that a master asks for ends a step."""
    fmpy()
    needs_compiler()
    model, every = fairlead.load(scene), {"engine": "auto", "real_time": "1 ms"}
    file = export(model, tmp_path / "model.fmu", version=version, outputs=[outputs], **every)
    for step in (h, 0.77 * h):
        rows, own, names = both(file, tmp_path / f"unpacked_{step}", model, step, 60, **every)
        assert len(names) > 0
        assert np.ptp(rows, axis=0).max() > 0
        assert rows.tobytes() == own.tobytes()

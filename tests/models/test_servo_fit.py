"""The measured servo: its records run as they are, and plain friction at the published values is off by what it is."""

import itertools
import shutil

import numpy as np
import pytest

import fairlead
from fairlead.component.tables import TableError, points
from fairlead.netlist.files import bundled_models
from fairlead.studies.fits.fit_file import Law, read_fit
from fairlead.studies.fits.search import errors, fit, prepared

FOLDER = bundled_models()["belt"].parent / "servo_fit"


@pytest.mark.slow
def test_every_law_of_the_servo_fits_its_model() -> None:
    asked = read_fit(FOLDER / "fit.yaml")
    for law in asked.laws:
        records, targets, _ = prepared(asked, law)
        assert [one.name for one in records] == ["sin_sin", "up_and_down", "lift_and_drop"]
        assert all(one.count == 1201 for one in targets)


@pytest.mark.slow
def test_fitted_coulomb_and_viscous_friction_is_better_than_the_published_values() -> None:
    asked = read_fit(FOLDER / "fit.yaml")
    records, targets, _ = prepared(asked, asked.laws[0])
    fitted = fit(asked, targets, asked.laws[0])
    for record in records:
        published = errors(record, {one.name: one.start for one in asked.sought})
        assert errors(record, fitted.values)["load.angle"].mean < published["load.angle"].mean, record.name


FITTED = {"dry": 0.0549, "viscous": 1e-4, "constant": 0.2, "resistance": 2.128, "armature": 0.00401, "hanging": -0.015}


def test_plain_friction_suits_two_records_within_30_and_25_mrad() -> None:
    """As good as plain friction is known to fit them; the values are those that the search ends at, to three digits."""
    asked = read_fit(FOLDER / "plain.yaml")
    assert asked.given.leave_out == ["lift_and_drop"]
    records, _, _ = prepared(asked, Law(""))
    for record, most in zip(records, (0.0305, 0.025), strict=False):
        assert errors(record, FITTED)["load.angle"].mean < most, record.name


PUBLISHED = {"resistance": 4.0, "constant": 0.387, "armature": 0.0018, "dry": 0.0128, "viscous": 0.00366}
GAIN, MASS, ARM, GRAVITY = 100 * 4096 / (2 * np.pi) / (256 * 885), 0.49, 0.1, 9.80665
ANGLE, SMALLER = 5e-4, 20  # rad: a third of a step of the encoder; time steps of the script in one of the record


def turned(record: np.ndarray) -> np.ndarray:
    """The angle of the pendulum at the times of a record, stepped by hand: half-implicit, friction as a limit."""
    p, moment = PUBLISHED, MASS * ARM**2 + PUBLISHED["armature"]
    angle, speed = record["angle_rad"][0], 0.0
    found = [angle]
    for row, later in itertools.pairwise(record):
        h = (later["time_s"] - row["time_s"]) / SMALLER
        for k in range(SMALLER):
            part = (k + 0.5) / SMALLER
            goal, supply, on = (row[n] + part * (later[n] - row[n]) for n in ("goal_rad", "supply_V", "torque_on"))
            duty = np.clip(GAIN * (goal - angle), -1, 1)
            current = on * (duty * supply - p["constant"] * speed) / p["resistance"]
            torque = p["constant"] * current - MASS * GRAVITY * ARM * np.sin(angle)
            free = (speed + h * torque / moment) / (1 + h * p["viscous"] / moment)
            speed = np.sign(free) * max(0.0, abs(free) - h * p["dry"] / moment)
            angle += h * speed
        found.append(angle)
    return np.array(found)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sin_sin", "up_and_down", "lift_and_drop"])
def test_the_servo_moves_as_in_a_script_of_its_equations(name: str) -> None:
    file = f"{name}_kp100.csv"
    record = np.genfromtxt(FOLDER / file, delimiter=",", names=True)
    columns = {f"drive.{column}.table.file": file for column in ("goal", "supply", "on")}
    model = fairlead.load(FOLDER / "servo.yaml", {**columns, "load.angle": float(record["angle_rad"][0])})
    run = model.run(out=None, stop=float(record["time_s"][-1]))
    assert np.abs(run.at("load.angle", record["time_s"]) - turned(record)).max() < ANGLE


def test_two_columns_of_a_file_are_named_by_its_header(tmp_path) -> None:
    shutil.copy(FOLDER / "sin_sin_kp100.csv", tmp_path / "servo.csv")
    asked = {"file": "servo.csv", "columns": ["time_s", "angle_rad"]}
    made = points(asked, "s", "rad", "t", tmp_path)
    rows = np.genfromtxt(tmp_path / "servo.csv", delimiter=",", names=True)
    assert made(rows["time_s"][777]) == pytest.approx(rows["angle_rad"][777], abs=1e-12)
    with pytest.raises(TableError, match="angel_rad is no column of it"):
        points({**asked, "columns": ["time_s", "angel_rad"]}, "s", "rad", "t", tmp_path)
    with pytest.raises(TableError, match="is no pair"):
        points({**asked, "columns": ["time_s"]}, "s", "rad", "t", tmp_path)

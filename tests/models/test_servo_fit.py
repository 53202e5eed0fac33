"""The measured servo: its records run as they are, and plain friction at the published values is off by what it is."""

import shutil

import numpy as np
import pytest

from fairlead.component.tables import TableError, points
from fairlead.netlist.files import bundled_models
from fairlead.studies.fits.fit_file import read_fit
from fairlead.studies.fits.search import errors, fit, prepared

FOLDER = bundled_models()["belt"].parent / "servo_fit"


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

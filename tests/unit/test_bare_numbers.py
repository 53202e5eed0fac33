"""A bare number for a parameter of the scene is in SI, in the dimension that the netlist gives the parameter."""

import math

import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.component.numbers import numbers_of_scene
from fairlead.errors import ModelError
from fairlead.fmu.tuned import row_of
from tests.studies.test_sensitivities import SLID, first_peak

pytestmark = pytest.mark.filterwarnings("error")


@pytest.fixture
def slid(tmp_path):
    file = tmp_path / "slid.yaml"
    file.write_text(SLID)
    return file


@pytest.mark.parametrize(
    ("written", "given", "value", "unit"),
    [
        ("2 kg", "3", 3.0, "kg"),
        ("5 km/h", "3", 3.0, "m/s"),
        ("30 deg", "0.5", 0.5, "rad"),
        ("10 bar", "1e5", 1e5, "kg/m/s^2"),
        ("50 %", "0.2", 0.2, ""),
        ("7", "3", 3.0, ""),
        ('"{(2 m)*(3 m)}"', "3", 3.0, "m^2"),
        ('"{other/(2 s)}"', "-1e-7", -1e-7, "m/s"),
        ("2 kg", "3 m", 3.0, "m"),
    ],
)
def test_a_bare_number_takes_the_unit_of_what_it_replaces(written, given, value, unit, slid) -> None:
    from fairlead.quantities import parse_unit

    slid.write_text(SLID.replace("parameters: {", f"parameters: {{p: {written}, other: 4 m, "))
    for given_as in ({"p": given}, {"p": float(given)} if " " not in given else {"p": given}):
        found = numbers_of_scene(fairlead.load(slid, set=given_as).netlist)["p"]
        assert found[0] == value
        assert parse_unit(found[1] or "1").dimension == parse_unit(unit or "1").dimension


def test_every_way_to_give_a_number_runs_the_same(slid) -> None:
    model = fairlead.load(slid)
    for changed in (fairlead.load(slid, set={"m": "3"}), model.with_values(m=3), model.with_values(m="3 kg"),
                    model.with_values(m="3000 g")):  # fmt: skip
        found = Cases(changed, {"peak": "peak(block.x)"}).row({}).figures
        assert found["peak"] == pytest.approx(first_peak(3), rel=1e-6)


def test_a_tunable_parameter_is_set_by_a_number(slid) -> None:
    run = fairlead.load(slid).start(tunable=["m"])
    run.set("m", 3)
    x = []
    for k in range(1, 60):
        run.advance(k / 100)
        x.append(run.get("block.x"))
    assert max(x) == pytest.approx(first_peak(3), rel=1e-3)  # of a grid: at the peak the motion is flat


def test_a_parameter_with_a_unit_is_laid_out_at_a_row_of_numbers_for_an_fmu(slid) -> None:
    """What `fmu export --tunable m` begins with; before, each of them was refused."""
    model = fairlead.load(slid)

    def lay(value):
        laid = model.with_values({"m": value})
        return type("Laid", (), {"links": 0, "shared": laid.system.initial, "model": laid})()

    row = row_of(2.0, lay, "m")
    loads = [one.model.assembly.entries["pad"].path("normal_force") for one in row.laid]
    assert loads == pytest.approx([9.81 * m for m in row.values])
    assert math.isclose(row.values.max(), 16.0)


def test_a_value_that_does_not_fit_is_told_with_the_parameter(slid) -> None:
    with pytest.raises(ModelError, match=r"block\.mass = -3 kg is out of range(.|\n)*It was given as m = -3"):
        fairlead.load(slid, set={"m": "-3"}).check()

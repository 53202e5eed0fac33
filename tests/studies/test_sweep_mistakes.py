"""Values of a sweep that the model does not have are told as the sweep's, not as those of `--set`."""

import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.cases.figures import read_figures
from fairlead.errors import Location, ModelError
from fairlead.studies.fits.measured import read_table
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.distributions import read_distribution
from fairlead.studies.sweeps.plan import Asked, figures_of_options
from fairlead.studies.sweeps.ranges import RangeError, read_range
from fairlead.studies.sweeps.sweep import sweep

pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[sweep]'")


def test_a_parameter_that_the_model_has_not_is_told_as_one_of_the_sweep(tmp_path) -> None:
    cases = Cases(fairlead.load("belt"), {"end": "end(block.x)"})
    with pytest.raises(ModelError) as raised:
        sweep(cases, Design(grid={"pad.normal_farce": ["8 N", "9 N"]}), tmp_path / "sweep", processes=0)
    told = str(raised.value)
    assert "sweep: pad.normal_farce" in told
    assert "normal_force" in told
    assert "--set" not in told
    assert not (tmp_path / "sweep").exists()


def test_two_figures_of_one_name_are_refused() -> None:
    """The second would take the column of the first without a word; the same one typed twice is one."""
    with pytest.raises(ModelError, match=r"--figure gives lo twice: lowest\(block\.x\) and peak\(block\.x\)"):
        figures_of_options(["lo=lowest(block.x)", "lo=peak(block.x)"], "--figure")
    assert figures_of_options(["lo=lowest(block.x)", "lo=lowest(block.x)"], "--figure") == {"lo": "lowest(block.x)"}


NINES = "9" * 5000
"""More digits than Python turns into a whole number."""


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("0:1e999999:1e-999999", "too large"),
        ("lin(0, 1e400, 3)", "too large"),
        ("log(1e-400, 1, 3)", "too small"),
        ("log(-1, 2, 3)", "above zero"),
        ("1..2:3:1", "not all are numbers"),
        ("lin(1 N, 2 m, 3)", "different units: N, m"),
        ("lin(x, 2, 3)", "x is no number"),
        (f"lin(0, 1, {NINES})", "how many values"),
    ],
)
def test_a_range_of_what_is_no_number_of_a_computer_is_refused(text, why) -> None:
    """A decimal may have any exponent and any length; a value of a case may not."""
    with pytest.raises(RangeError, match=why) as raised:
        read_range(text)
    assert raised.value.way_out


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("normal(1e400, 1)", "too large"),
        ("normal(0, -1)", "not above zero"),
        ("lognormal(-1, 1)", "above zero"),
        ("loguniform(0, 1)", "above zero"),
        ("uniform(2, 1)", "range is empty"),
        ("triangular(1, 5, 2)", "not between the ends"),
        ("choice()", "no words"),
        ("normal(1)", "2 or 4 numbers, not 1"),
        ("norml(1, 2)", "Did you mean normal"),
    ],
)
def test_a_distribution_that_there_is_not_is_refused(text, why) -> None:
    with pytest.raises(RangeError, match=why) as raised:
        read_distribution(text)
    assert raised.value.way_out


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("peak", "no figure"),
        ("peek(block.x)", "Did you mean peak"),
        ("peak()", "signal is missing"),
        ("end(*)", "takes one; peak, lowest, largest take several"),
        ("mean(block.x, 1 s)", "no time or two"),
        ("mean(block.x, 3 s, 1 s)", "from 3 s to 1 s is empty"),
        ("at(block.x, 99 s)", "not in the run"),
        ("at(block.x, 1 m)", "a length, not a time"),
        ("at(block.x, nan)", "not a quantity"),
        ("time(pad, held, 0)", "counted from 1"),
        (f"time(pad, held, {NINES})", "counted from 1"),
        ("time(pad, hald)", "Did you mean held"),
        ("time(spring)", "There are belt, pad"),
        ("switches(pad, belt)", "one component, or none"),
        ("energy(closur)", "Did you mean closure"),
        ("margin(ruck)", "no line on a route"),
        ("broken(pad)", "takes nothing"),
    ],
)
def test_a_figure_that_there_is_not_is_refused_with_what_there_is(text, why) -> None:
    with pytest.raises(ModelError, match=why) as raised:
        read_figures({"one": text}, fairlead.load("belt"))
    assert all(fault.way_out for fault in raised.value.faults)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("pad.normal_force;block.mass\n10;1\n", "separated by semicolons: pad.normal_force;block.mass"),
        ("pad.normal_force;block.mass\n10,5;1\n", "separated by semicolons"),
        ("pad.normal_force\tblock.mass\n10\t1\n", "separated by tabs"),
        ("pad.normal_force\n10,5\n", "numbers have a point"),
    ],
)
def test_cases_that_a_spreadsheet_parted_otherwise_are_told_so(tmp_path, text, told) -> None:
    (tmp_path / "cases.csv").write_text(text)
    asked = Asked()
    asked.read_csv(tmp_path / "cases.csv")
    (fault,) = asked.faults
    assert told in f"{fault.what} {fault.way_out}"
    assert not asked.listed


def test_a_record_for_a_fit_that_is_parted_by_semicolons_is_told_so(tmp_path) -> None:
    """It had one column with the name `time;x`."""
    (tmp_path / "record.csv").write_text("time;x [m]\n0;1\n1;2\n2;3\n3;4\n")
    table, (fault,) = read_table(tmp_path / "record.csv", Location("file"))
    assert table is None
    assert "separated by semicolons" in fault.what


@pytest.mark.parametrize(("of", "to", "told"), [
    ("peak(block.x)", [], "to: no parameter is named"), ("peak(block.x)", {}, "to: no parameter is named"),
    ([], "pad.normal_force", "of: no figure is named"),
])  # fmt: skip
def test_an_empty_list_is_not_taken_for_a_scene_without_numbers(of, to, told) -> None:
    with pytest.raises(ModelError, match=told):
        fairlead.sensitivity(fairlead.load("belt"), of, to)

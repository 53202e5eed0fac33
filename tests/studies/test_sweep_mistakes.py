"""Values of a sweep that the model does not have are told as the sweep's, not as those of `--set`."""

import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.errors import ModelError
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.plan import figures_of_options
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

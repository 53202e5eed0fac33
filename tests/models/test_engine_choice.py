"""The engine of a run: chosen in the netlist, stated in run.json, refused at once when its package is missing."""

import sys

import pytest

import fairlead
from fairlead.errors import UsageError


def test_ida_runs_from_a_netlist_and_run_json_says_so(tmp_path):
    pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    result = fairlead.load("belt", set={"run.engine": "ida", "run.stop": "2 s"}).run(out=tmp_path / "run")
    assert result.status == "finished"
    assert (result.run["engine"], result.run["engine_reason"]) == ("ida", "chosen by run.engine")
    assert [e.zone_to for e in result.events] == ["backward", "held", "backward", "held"]
    assert result.run["energy"]["closure"] < 1e-3


def test_ida_without_its_package_is_refused_before_a_directory_is_made(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "sksundae.ida", None)
    model = fairlead.load("belt", set={"run.engine": "ida"})
    with pytest.raises(UsageError, match=r"needs the package scikit-sundae.*\n.*pip install 'fairlead\[ida\]'"):
        model.run(out=tmp_path / "run")
    assert not (tmp_path / "run").exists()

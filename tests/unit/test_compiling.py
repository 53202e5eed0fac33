"""Each of several workers compiles a loop of its own before its first test, and reads other files first
(tests/compiling.py)."""

import importlib
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests import compiling


@pytest.mark.parametrize(
    ("worker", "workers", "tests", "expected"),
    [
        ("gw0", 2, compiling.MANY, ["first"]),
        ("gw1", 2, compiling.MANY, ["second", "third"]),
        ("gw2", 3, compiling.MANY, []),
        ("gw0", 1, compiling.MANY, []),
        ("gw1", 2, compiling.MANY - 1, []),
        (None, 0, compiling.MANY, []),
    ],
)
def test_a_worker_compiles_its_share_where_many_tests_are_run_by_several(
    monkeypatch, worker, workers, tests, expected
) -> None:
    compiled = []
    names = (("first",), ("second", "third"))
    shares = tuple(tuple(lambda name=name: compiled.append(name) for name in share) for share in names)
    monkeypatch.setattr(compiling, "SHARES", shares)
    config = SimpleNamespace()
    if worker is not None:
        config.workerinput = {"workerid": worker, "workercount": workers}
    compiling.compile_share(SimpleNamespace(config=config, items=[None] * tests))
    assert compiled == expected


@pytest.mark.parametrize(
    ("worker", "workers", "share"), [("gw0", 2, 0), ("gw1", 2, 1 / 2), ("gw2", 3, 1 / 3), ("gw0", 1, 0)]
)
def test_a_worker_reads_the_files_from_its_share_on_where_all_are_collected(monkeypatch, worker, workers, share):
    read = []
    monkeypatch.setattr(importlib, "import_module", read.append)
    tests = Path(compiling.__file__).parent
    files = sorted(tests.rglob("test_*.py"))
    config = SimpleNamespace(args=[str(tests)], workerinput={"workerid": worker, "workercount": workers})
    compiling.read_share(config)
    assert len(read) == pytest.approx(share * len(files), abs=1)
    assert not read or read[-1] == f"tests.{files[-1].parent.name}.{files[-1].stem}"
    config.args = [str(tests / "unit")]
    read.clear()
    compiling.read_share(config)
    assert read == []

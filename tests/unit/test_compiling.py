"""Each of several workers compiles a loop of its own before its first test (tests/compiling.py)."""

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

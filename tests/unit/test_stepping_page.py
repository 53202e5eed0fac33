"""The page of `stepping` names functions and constants that there are, and has every number of that room."""

import ast
import math
import pathlib
import re
from collections.abc import Iterator

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "stepping.md").read_text(encoding="utf-8")
NAMED = re.compile(r"`([a-z_]+)\.([A-Za-z_]+)`((?:, `[A-Za-z_]+`)*)")
FILES = {file.stem: file for file in sorted((ROOT / "src" / "fairlead" / "integrate").rglob("*.py"))}
ROOM = [file for file in FILES.values() if file.parent.name == "stepping"]
CODES = {"MET", "SMOOTH", "JUMPS_SOMEWHERE", "STAYED", "NO_LIMIT", "ROW", "CONSTANT", "OF_KIND", "SEARCHED", "GIVEN_UP"}
"""Numbers that say something, and measure nothing."""
PLAIN = (ast.Constant, ast.Name, ast.BinOp, ast.UnaryOp, ast.operator, ast.unaryop, ast.Load)


def defined(file: pathlib.Path) -> Iterator[tuple[str, ast.expr | None]]:
    """Names of the functions of a file, and of its constants with their values."""
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, None
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            yield node.targets[0].id, node.value
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple):
            assert isinstance(node.value, ast.Tuple)
            for target, value in zip(node.targets[0].elts, node.value.elts, strict=True):
                assert isinstance(target, ast.Name)
                yield target.id, value


def numbers(file: pathlib.Path) -> dict[str, float]:
    """The constants of a file that are made of numbers, and of other such constants."""
    found: dict[str, float] = {}
    for name, value in defined(file):
        if value is not None and all(isinstance(one, PLAIN) for one in ast.walk(value)):
            found[name] = eval(ast.unparse(value), {"pi": math.pi, **found})
    return found


def named() -> set[tuple[str, str]]:
    """(file, name) of all that the page names as `file.name`, or beside such a name."""
    found = set()
    for file, name, others in NAMED.findall(PAGE):
        if file in FILES and name != "py":
            found |= {(file, name), *((file, other) for other in re.findall(r"`(\w+)`", others))}
    return found


def tabled() -> Iterator[tuple[str, str, float]]:
    """(file, name, value) of each constant in the tables of the page; a row has one value for all, or one for each."""
    for row in re.search(r"^## The constants$(.*?)^## ", PAGE, flags=re.DOTALL | re.MULTILINE)[1].splitlines():
        if not row.startswith("| `"):
            continue
        names, shown, _ = row.strip("|").split("|")
        values = [read(one) for one in shown.split(",")]
        found = re.findall(r"`(?:([a-z_]+)\.)?([A-Z_]+)`", names)
        file = ""
        for (given, name), value in zip(found, values if len(values) > 1 else values * len(found), strict=True):
            file = given or file
            yield file, name, value


def read(number: str) -> float:
    """A number as a reader writes it: 1/40, 16 eps, 2^43 + 1, pi/4."""
    return float(eval(number.strip().replace(" eps", " * 2**-52").replace("^", "**"), {"pi": math.pi}))


def test_functions_and_constants_that_the_page_names_exist() -> None:
    there = {(file, name) for file in {file for file, _ in named()} for name, _ in defined(FILES[file])}
    assert len(named()) > 40
    assert named() <= there, named() - there


def test_every_number_of_the_room_has_its_reason_on_the_page() -> None:
    found = {(file.stem, name) for file in ROOM for name in numbers(file) if name not in CODES}
    assert {("repeated", "AT_PLACE"), ("limit_violation", "BEYOND"), ("history", "BLOCK")} <= found
    assert not found - {(file, name) for file, name, _ in tabled()}


def test_numbers_on_the_page_are_those_of_the_code() -> None:
    shown = list(tabled())
    assert len(shown) > 60
    for file, name, value in shown:
        assert numbers(FILES[file])[name] == pytest.approx(value, rel=1e-12), (file, name)

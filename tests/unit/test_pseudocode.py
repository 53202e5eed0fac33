"""Pseudocode of docs/ calls what the code calls, in the same order, and the page of `stepping` names what there is.

A block below `<!-- pseudocode: FILE FUNCTION -->` is that function of src/fairlead/integrate/. Whatever is written as a
call in the block is called in the function, in this order; what the function calls besides may be left out.
"""

import ast
import pathlib
import re
from collections.abc import Iterator

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^<!-- pseudocode: (\S+) (\w+) -->\n```text\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
CALL = re.compile(r"\b([a-z_]+)\(")
NAMED = re.compile(r"`([a-z_]+)\.([A-Za-z_]+)`((?:, `[A-Za-z_]+`)*)")
FILES = {file.stem: file for file in sorted((ROOT / "src" / "fairlead" / "integrate").rglob("*.py"))}
CODES = {"FREE"}  # a number that says "none"


def shown() -> list[tuple[str, str, str]]:
    """(file, function, block) of each block on the page of the integrator."""
    return BLOCK.findall((ROOT / "docs" / "integrator.md").read_text(encoding="utf-8"))


def calls(node: ast.AST) -> Iterator[str]:
    """Names of the functions that are called in a piece of code, in the order in which they are written."""
    found = [each for each in ast.walk(node) if isinstance(each, ast.Call) and isinstance(each.func, ast.Name)]
    for each in sorted(found, key=lambda call: (call.lineno, call.col_offset)):
        assert isinstance(each.func, ast.Name)
        yield each.func.id


def function(file: str, name: str) -> ast.FunctionDef:
    """The definition of a function of the integrator."""
    tree = ast.parse((ROOT / "src" / "fairlead" / "integrate" / file).read_text(encoding="utf-8"))
    return next(node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and node.name == name)


def first_missing(block: str, called: list[str]) -> str:
    """The first call of a block that is not among those called after the one before it; "" if all are."""
    rest = iter(called)
    return next((name for name in CALL.findall(block) if name not in rest), "")


@pytest.mark.parametrize(("file", "name", "block"), shown(), ids=lambda value: value if value.isidentifier() else "")
def test_pseudocode_calls_what_the_code_calls_in_its_order(file: str, name: str, block: str) -> None:
    called = list(calls(function(file, name)))
    missing = first_missing(block, called)
    assert not missing, f"{file}, {name}: {missing} is not called there, or earlier than written; it calls {called}"


def test_the_loop_a_trial_step_a_settlement_and_both_ways_of_stepping_are_shown() -> None:
    assert {"loop_of", "trial_of", "up_to_crossing", "settle", "attempt_stepping", "finish_inside",
            "finish_located", "find_error", "error_inside"} <= {name for _, name, _ in shown()}  # fmt: skip


def test_a_renamed_or_reordered_call_is_found() -> None:
    called = ["propose", "take", "judge"]
    assert first_missing("h = propose()\njudge(h)", called) == ""
    assert first_missing("judge()\ntake()", called) == "take"
    assert first_missing("propose()\nestimate()", called) == "estimate"


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


def is_measure(value: ast.expr) -> bool:
    """True of a number that is not whole: what is counted, or is a code, is."""
    return any(isinstance(one, ast.Constant) and isinstance(one.value, float) for one in ast.walk(value))


def named() -> set[tuple[str, str]]:
    """(file, name) of all that the page of `stepping` names as `file.name`, or beside such a name."""
    text = (ROOT / "docs" / "stepping.md").read_text(encoding="utf-8")
    found = set()
    for file, name, others in NAMED.findall(text):
        if file in FILES and name != "py":
            found |= {(file, name), *((file, other) for other in re.findall(r"`(\w+)`", others))}
    return found


def test_functions_and_constants_that_the_page_of_stepping_names_exist() -> None:
    there = {(file, name) for file in {file for file, _ in named()} for name, _ in defined(FILES[file])}
    assert len(named()) > 40
    assert named() <= there, named() - there


def test_every_measure_in_stepping_has_its_reason_on_the_page() -> None:
    room = [file for file in FILES.values() if file.parent.name == "stepping"]
    measures = {(file.stem, name) for file in room for name, value in defined(file) if value and is_measure(value)}
    assert {("repeated", "AT_PLACE"), ("limit_violation", "BEYOND")} <= measures
    missing = {one for one in measures - named() if one[1] not in CODES}
    assert not missing

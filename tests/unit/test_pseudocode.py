"""Pseudocode of docs/ calls what the code calls, in the same order.

A block below `<!-- pseudocode: FILE FUNCTION -->` is that function of src/fairlead/integrate/: its calls are those of
the function, all of them, in the order in which they are written there. Only what is in SMALL is left out.
"""

import ast
import pathlib
import re
from collections.abc import Iterator

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^<!-- pseudocode: (\S+) (\w+) -->\n```text\n(.*?)^```$", flags=re.DOTALL | re.MULTILINE)
CALL = re.compile(r"\b([a-z_]+)\(")
SMALL = {"isfinite", "keep_larger", "memory_at", "min", "rounded"}
"""What is done to numbers, or where the memory is; not shown."""


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


def written(block: str) -> list[str]:
    """What a block calls, in its order."""
    return CALL.findall(block)


@pytest.mark.parametrize(("file", "name", "block"), shown(), ids=lambda value: value if value.isidentifier() else "")
def test_pseudocode_calls_what_the_code_calls_in_its_order(file: str, name: str, block: str) -> None:
    assert written(block) == [each for each in calls(function(file, name)) if each not in SMALL], f"{file}, {name}"


def test_the_loop_a_trial_step_a_settlement_and_both_ways_of_stepping_are_shown() -> None:
    assert {name for _, name, _ in shown()} == {
        "loop_of", "trial_of", "up_to_crossing", "settle", "attempt_stepping", "take_theta_step", "finish_inside",
        "finish_located", "end_located", "find_error", "error_inside",
    }  # fmt: skip


def test_calls_are_read_in_the_order_in_which_they_are_written() -> None:
    code = ast.parse("h = propose(run)\nif judge(take(h)) and rest(h):\n    point.move()\n    reject(h)\n")
    assert list(calls(code)) == ["propose", "judge", "take", "rest", "reject"]
    assert written("h = propose()\ntake(h): judge(h), reject(h)   # a word (in brackets)") == [
        "propose", "take", "judge", "reject",
    ]  # fmt: skip


@pytest.mark.parametrize("page", ["integrator", "stepping"])
def test_no_heading_of_a_page_on_the_engine_covers_more_than_a_screen(page: str) -> None:
    """Of 50 lines; what a fence holds is no heading."""
    text = re.sub(r"^```.*?^```$", lambda block: "\n" * block[0].count("\n"), (ROOT / "docs" / f"{page}.md").read_text(
        encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)  # fmt: skip
    lengths = [section.count("\n") for section in re.split(r"^#+ ", text, flags=re.MULTILINE)]
    assert len(lengths) > 10
    assert max(lengths) < 50

"""Names of the engine say one thing each."""

import ast
import pathlib
import re
from collections import defaultdict
from collections.abc import Iterator

ROOT = pathlib.Path(__file__).resolve().parents[2] / "src" / "fairlead" / "integrate"
SAME_EVERYWHERE = {"METHOD"}
"""What every method has under this name."""
ADDRESS = re.compile(r"(^|[.(\s])at_\w+|shown_end|as_shown")
"""In an expression whose value is an address: another address, or a function that returns one."""


def trees() -> Iterator[tuple[str, ast.Module]]:
    """Every file of the engine, parsed."""
    for file in sorted(ROOT.rglob("*.py")):
        yield file.relative_to(ROOT).as_posix(), ast.parse(file.read_text(encoding="utf-8"))


def assigned(node: ast.AST) -> Iterator[tuple[str, ast.expr]]:
    """Name and value of each assignment, those of tuples one by one."""
    for each in ast.walk(node):
        if isinstance(each, ast.Assign):
            for target in each.targets:
                together = isinstance(target, ast.Tuple) and isinstance(each.value, ast.Tuple)
                pairs = zip(target.elts, each.value.elts, strict=True) if together else [(target, each.value)]
                yield from ((name.id, value) for name, value in pairs if isinstance(name, ast.Name))


def test_no_constant_has_another_value_or_meaning_elsewhere():
    places = defaultdict(list)
    for file, tree in trees():
        for node in tree.body:
            for name, _ in assigned(node) if isinstance(node, ast.Assign) else ():
                if re.fullmatch(r"[A-Z][A-Z_0-9]+", name) and name not in SAME_EVERYWHERE:
                    places[name].append(file)
    assert not {name: files for name, files in places.items() if len(files) > 1}


def test_names_that_begin_with_at_are_addresses():
    wrong = [
        f"{file}: {name} = {ast.unparse(value)}"
        for file, tree in trees()
        for name, value in assigned(tree)
        if name.startswith("at_") and name != "at_time_at" and not ADDRESS.search(ast.unparse(value))
    ]
    assert not wrong, "\n".join(wrong)


def test_a_jacobian_is_forgotten_by_one_function():
    found = [
        f"{file}: {name.name}"
        for file, tree in trees()
        for name in ast.walk(tree)
        if isinstance(name, ast.FunctionDef) and "rule.linearised = 0" in ast.unparse(name)
    ]
    assert found == ["stepping/row_cache.py: forget_jacobian"]

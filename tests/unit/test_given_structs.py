"""Compiled functions of the integrator are given the structs that they read; who needs many gets the whole memory."""

import ast
import pathlib
from collections.abc import Iterator

ROOT = pathlib.Path(__file__).resolve().parents[2] / "src" / "fairlead" / "integrate"
MANY = 4
CALLED_BY_THE_LOOP = {
    "attempt", "attempt_stepping", "arrive_by_equations", "arrive_with_zones", "nothing_kept", "begin_again",
    "length_by_control", "length_after", "not_bounded", "error_of_first", "take_step", "prepare_interpolant",
}  # fmt: skip
"""What a method is made of: each is given the memory, whatever it reads of it."""
BY_ANOTHER = {"judge_given", "take_piece", "find_left", "zones_inside", "balance_on", "go_further",
              "add_error_of_forces", "evaluate_inside", "state_off"}  # fmt: skip
"""Those that are left: they take it, and read four structs or fewer."""
ROOMS = {"linear", "events", "stepping"}


def takers() -> Iterator[tuple[str, set[str], bool]]:
    """(name, structs read, whether it hands the memory on) of each compiled function that takes the memory `m`."""
    for file in sorted(ROOT.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            compiled = isinstance(node, ast.FunctionDef) and "compiled" in map(ast.unparse, node.decorator_list)
            if isinstance(node, ast.FunctionDef) and compiled and "m" in [each.arg for each in node.args.args]:
                yield node.name, *read(node)


def read(node: ast.FunctionDef) -> tuple[set[str], bool]:
    """What a function reads of `m`, by struct, and whether it hands it on."""
    parents = {child: each for each in ast.walk(node) for child in ast.iter_child_nodes(each)}
    structs, on = set(), False
    for each in ast.walk(node):
        if isinstance(each, ast.Name) and each.id == "m":
            room = parents[each]
            if not isinstance(room, ast.Attribute):
                on = True
                continue
            struct = parents[room]
            inside = room.attr in ROOMS and isinstance(struct, ast.Attribute)
            structs.add(f"{room.attr}.{struct.attr}" if inside and isinstance(struct, ast.Attribute) else room.attr)
    whole = structs & ROOMS
    return {one for one in structs if one.partition(".")[0] not in whole or one in whole}, on


def test_who_reads_few_structs_is_given_these_and_not_the_whole_memory() -> None:
    few = {name for name, structs, on in takers() if not on and len(structs) <= MANY}
    assert few - CALLED_BY_THE_LOOP <= BY_ANOTHER, few - CALLED_BY_THE_LOOP - BY_ANOTHER
    assert few >= BY_ANOTHER, BY_ANOTHER - few

"""Exit codes: the page, the list and what the code raises are the same."""

import ast
import pathlib
import re

from fairlead import errors
from fairlead.cli import exit_codes
from fairlead.cli.run import EXIT_CODES

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROW = re.compile(r"^\| (\d+) \| (.+) \|$", flags=re.MULTILINE)


def test_the_table_of_the_page_is_the_list_of_the_code() -> None:
    page = (ROOT / "docs" / "netlist.md").read_text(encoding="utf-8").partition("## Exit codes")[2].partition("## ")[0]
    assert {int(code): meaning for code, meaning in ROW.findall(page)} == exit_codes.MEANINGS


def test_every_error_carries_a_code_of_the_list() -> None:
    named = [one for one in vars(errors).values() if isinstance(one, type)]
    kinds = [one for one in named if issubclass(one, errors.FairleadError)]
    assert len(kinds) > 4
    assert {kind.exit_code for kind in kinds} <= set(exit_codes.MEANINGS)
    pairs = [(errors.ModelError, "MODEL_ERROR"), (errors.UsageError, "USAGE"),
             (errors.NumericalError, "NUMERICAL_FAILURE")]  # fmt: skip
    for kind, name in pairs:
        assert kind.exit_code == getattr(exit_codes, name)


def test_no_verb_exits_with_a_number_of_its_own() -> None:
    """typer.Exit() takes a name of the list, an error's code or what a run came to; never a number."""
    folder = ROOT / "src" / "fairlead" / "cli"
    exits = [
        node
        for file in folder.glob("*.py")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("typer.Exit", "sys.exit")
    ]
    assert len(exits) > 6
    assert not [ast.unparse(node) for node in exits if any(isinstance(a, ast.Constant) for a in ast.walk(node))]
    assert set(EXIT_CODES.values()) <= set(exit_codes.MEANINGS)

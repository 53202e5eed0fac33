"""A file is as long as its idea, a function as a reader can follow: what is longer says why here.

Numbers warn; they do not judge. Who has a reason for a longer one writes it into ARGUED, and chops nothing for this.
"""

import ast
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST_FILE, LONGEST_FUNCTION = 400, 80
ARGUED = {
    "src/fairlead/cli/sweep.py: sweep": "one option of the command a line, all of which are arguments of one function",
    "src/fairlead/integrate/textbook.py: textbook": "what a problem may have is an argument each, a line each",
}


def longer() -> set[str]:
    """Files and functions of the package that are longer."""
    found = set()
    for file in sorted((*(ROOT / "src" / "fairlead").rglob("*.py"), *(ROOT / "components").rglob("*.py"))):
        text, name = file.read_text(encoding="utf-8"), str(file.relative_to(ROOT))
        if text.count("\n") > LONGEST_FILE:
            found.add(name)
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef) and (node.end_lineno or 0) - node.lineno >= LONGEST_FUNCTION:
                found.add(f"{name}: {node.name}")
    return found


def test_what_is_longer_than_a_file_or_a_function_should_be_has_its_reason() -> None:
    assert longer() == ARGUED.keys()

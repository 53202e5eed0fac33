"""What README.md and docs/start.md show works as printed; `test_pages_in_order.py` plays the commands."""

import pathlib
import re
import shlex

import fairlead

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = "\n".join((ROOT / page).read_text(encoding="utf-8") for page in ("README.md", "docs/start.md"))


def blocks(language: str) -> list[str]:
    """The fenced blocks of a language."""
    fenced = re.findall(r"^```(\w*)\n(.*?)^```$", README, flags=re.DOTALL | re.MULTILINE)
    return [text for word, text in fenced if word == language]


def commands() -> list[str]:
    """The lines of the command blocks that call fairlead, without their comments."""
    lines = [line.partition(" #")[0].strip() for block in blocks("") for line in block.splitlines()]
    return [line for line in lines if line.startswith("fairlead ")]


def test_the_netlist_has_no_mistakes(tmp_path: pathlib.Path) -> None:
    (netlist,) = blocks("yaml")
    (tmp_path / "belt.yaml").write_text(netlist)
    assert fairlead.load(tmp_path / "belt.yaml").check() == []


def test_the_component_can_be_used_from_a_users_file(tmp_path: pathlib.Path) -> None:
    (code,) = [block for block in blocks("python") if "class " in block]
    (tmp_path / "parts.py").write_text(code)
    (name,) = re.findall(r"class (\w+)", code)
    (tmp_path / "own.yaml").write_text(
        "schema: 1\nname: own\ncomponents:\n  wall: {type: Ground}\n  block: {type: Mass, mass: 1 kg}\n"
        f"  part: {{type: {name}, stiffness: 10 N/m}}\n"
        "connections:\n  - [wall.flange, part.a]\n  - [part.b, block.flange]\nrun: {stop: 1 s}\n"
    )
    assert fairlead.load(tmp_path / "own.yaml", libraries=[str(tmp_path / "parts.py")]).check() == []


def test_the_readme_shows_commands_of_every_verb() -> None:
    shown = {shlex.split(line)[1] for line in commands()}
    assert shown >= {"check", "run", "describe", "graph", "schema", "doctor"}

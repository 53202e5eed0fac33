"""Numbers on the pages of docs/ come out again when the command that prints them runs.

Replayed are those that take seconds. A page's number is taken to its last printed digit, or to the share that a test
states. Not replayed, for they take minutes to hours of processor time, or are times:

| page | what | command |
|---|---|---|
| accuracy.md | all tables | `benchmarks/accuracy.py`, `benchmarks/defaults.py`, `benchmarks/cost_kept.py` |
| benchmarks.md | all tables | `make bench`, `benchmarks/stiction_rows.py`, `benchmarks/against.py` |
| effects.md | two sentences; idle contacts | `fairlead effects winch_drive`, `benchmarks/idle_contacts.py` |
| friction.md | the published claim | `benchmarks/published_claim.py` |
| friction_levels.md | the page | `benchmarks/friction_levels.py` |
| routes.md | elements, line in the sea, idle line | `route_mesh.py`, `sea_forms.py`, `idle_line.py` of `benchmarks` |
| routes.md | hose and core, but for `single_bend` | `benchmarks/hose_estimates.py` |
| stability.md | the page | `make hard` |
| stepping.md | slip fronts | `benchmarks/slip_fronts.py` |
| studies.md | the study of the route; laws of the servo | `benchmarks/route_study.py`; `fairlead fit` |
| bend_tables.md | independent engines, robustness list | `benchmarks/bend_table.py`, `benchmarks/bend_variants.py` |

A row of each treatment of the sweep in bend_tables.md is replayed by `tests/models/test_bend_sweep.py`; what
studies.md says of the route, on fewer cases, by `tests/studies/test_route_study.py`.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))  # scripts that import each other by name

import hose_estimates
import real_time
import single_bend

import fairlead
from fairlead.cli import app

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w])")
WHEEL_SLIP = 1e-4  # m; what a held wheel leaks is known to its order of magnitude only


def page(name: str) -> str:
    return (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")


def table(name: str, head: str) -> list[list[str]]:
    """The cells of the rows below the head of a table that begins with `head`."""
    lines = page(name).partition(head)[2].partition("\n\n")[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def numbers(text: str) -> list[str]:
    return NUMBER.findall(text)


def digit(number: str) -> float:
    """What the last digit of a printed number is worth."""
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def same_to_the_last_digit(shown: list[str], found: list[str]) -> None:
    assert len(shown) == len(found), (shown, found)
    for one, other in zip(shown, found, strict=True):
        small = 0 < abs(float(one)) < WHEEL_SLIP
        within = abs(float(one)) if small else 1.001 * digit(one)
        assert float(other) == pytest.approx(float(one), abs=within), (one, other)


@pytest.mark.parametrize("row", table("drives", "| | unknowns |"), ids=lambda row: row[0])
def test_what_effects_change_in_the_winch_is_what_the_page_on_drives_shows(row: list[str]) -> None:
    name, unknowns, zones, steps, speed, dip = row
    names, _, word = name.rpartition(" ")
    settings = {} if name == "no change" else {f"effects.{one}": word for one in names.split(" and ")}
    result = fairlead.load("winch_drive", set=settings).run(out=None)
    late, v = (result.t >= 3) & (result.t < 4), result["line.v"]
    assert (result.run["unknowns"], result.run["machines"]) == (int(unknowns), int(zones))
    assert result.run["steps"] == pytest.approx(int(steps), rel=0.02)
    same_to_the_last_digit(
        [speed.split()[0], dip.split()[0]], [f"{v[late].mean():.4f}", f"{v[result.t >= 4].min():.4f}"]
    )


@pytest.mark.parametrize("name", real_time.MODELS)
def test_errors_of_steps_of_one_length_are_those_of_the_page_on_real_time(name: str) -> None:
    shown = [row for row in table("real_time", "| model | signals | step |") if row[0] == name]
    found = list(real_time.rows(name))
    assert [row[:3] for row in found] == [row[:3] for row in shown]
    same_to_the_last_digit([one for row in shown for one in row[3:]], [one for row in found for one in row[3:]])


def test_the_methods_side_by_side_are_those_of_the_page_on_friction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = {row[0]: row[1:] for row in table("friction", "| method | error | worst creep |")}
    monkeypatch.chdir(tmp_path)
    vary = f"method={','.join(shown)}"
    said = CliRunner().invoke(
        app, ["compare", "block_and_spring", "--set", "run.accuracy=1e-5", "--vary", vary, "--json"]
    )
    assert said.exit_code == 0, said.output
    found = {row["label"]: row for row in json.loads(said.stdout)["rows"]}
    for name, (error, _, steps, switches) in shown.items():
        row = found[name]
        if error.startswith("below"):
            assert row["error"] < float(error.split()[1])
        else:
            told = float(error.split()[0]) * (0.01 if error.endswith("%") else 1.0)
            assert row["error"] == pytest.approx(told, rel=0.1)
        assert row["steps"] == pytest.approx(int(steps), rel=0.05)
        assert row["switches"] == pytest.approx(int(switches), rel=0.02)


@pytest.fixture(scope="module")
def haul(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the netlist of the page on routes."""
    folder = tmp_path_factory.mktemp("haul")
    (text,) = re.findall(r"<!-- file: haul.yaml -->\n```yaml\n(.*?)```", page("routes"), flags=re.DOTALL)
    (folder / "haul.yaml").write_text(text, encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("block", "commands"),
    [
        ("haul: hauling at", [["statics", "haul.yaml"]]),
        (" station   lowest N", [["run", "haul.yaml", "-q"], ["margins", "results/haul"]]),
    ],
    ids=["statics", "margins"],
)
def test_the_tables_of_the_page_on_routes_are_those_of_its_commands(
    haul: Path, block: str, commands: list[list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(haul)
    said = [CliRunner().invoke(app, words, env={"COLUMNS": "120"}) for words in commands][-1]
    assert said.exit_code == 0, said.output
    shown = block + page("routes").partition(f"```\n{block}")[2].partition("```")[0]
    found = block + said.output.partition(block)[2]
    same_to_the_last_digit(numbers(shown), numbers(found))


HOSES = {tuple(row[:2]): row for row in table("routes", "| scene | mu | hose in steady motion N |")}


@pytest.mark.parametrize("mu", ["0.2", "0.35", "0.6"])
def test_what_statics_misses_in_the_single_bend_is_what_the_page_on_routes_says(mu: str) -> None:
    shown = HOSES["`single_bend`", mu]
    found = hose_estimates.row("single_bend", float(mu))
    assert [one for one in found if one == "-"] == [one for one in shown if one == "-"]
    same_to_the_last_digit(numbers(" | ".join(shown)), numbers(" | ".join(found)))


def test_the_page_on_routes_tells_by_how_much_statics_misses_the_compression_at_most() -> None:
    (told,) = re.findall(r"`single_bend` has ([\d.]+) times", page("routes"))
    shown = HOSES["`single_bend`", "0.6"]
    assert float(shown[5]) / float(shown[6]) == pytest.approx(float(told), abs=0.05)


@pytest.mark.parametrize("method", ["hold", "binding"])
def test_the_bend_that_holds_together_is_that_of_the_page_of_tables(method: str) -> None:
    begin = f"| rodas, {method}, accuracy 0.001 | 60 |"
    shown = begin + page("bend_tables").partition("\nmu 0.35\n")[2].partition(begin)[2].partition("\n")[0]
    found = single_bend.markdown(single_bend.run(0.35, method, 1e-3, 60))
    same_to_the_last_digit(numbers(shown), numbers(found))


GRID = np.linspace(0, 5, 501)
"""What the netlist records, without the rows of switches."""


def test_with_exact_hold_a_tight_accuracy_converges_up_to_5_s_where_the_hose_is_left_behind() -> None:
    ways = []
    for accuracy in ("1e-7", "1e-8"):
        settings = {"mu": "0.6", "method": "hold", "run.stop": "5 s", "run.accuracy": accuracy}
        result = fairlead.load("single_bend", set=settings).run(out=None)
        ways.append(np.array([result.at(name, GRID) for name in result.match("line.registration[*].d")]) * 1e3)
    apart = np.abs(ways[0] - ways[1]).max(axis=0)  # mm
    assert apart[GRID <= 3.5].max() < 1e-4
    assert apart.max() < 0.02

"""The page of a run: what it says, what it escapes, that no extreme is lost on it, and what odd folders become."""

from __future__ import annotations

import base64
import html
import json
import re
import zlib
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.report import page
from fairlead.report.measured import measured
from fairlead.report.page import packing
from fairlead.report.page.happened import happened, kinds_of
from fairlead.report.page.signals import first_panels, signal_data
from fairlead.report.page.slow import slow_data, slowest
from fairlead.report.page.verdict import verdict
from fairlead.report.page.write import library
from fairlead.report.page.zones import zone_data
from fairlead.results import Result, RunDirectory, Signal

EVIL = "</script><script>alert(1)</script>"
SIGNALS = (
    Signal("haul.force", "N", "pull of the haul"),
    Signal(f"{EVIL}.v", "m/s", f"speed of {EVIL}"),
    *(Signal(f"line.core[{i}].tension", "N", "pull in the core") for i in range(12)),
)
SCENE = {
    "files": {"bend.yaml": f"schema: 1\nname: {EVIL}\n"}, "set": {"mu": EVIL}, "parameters": {"mu": 0.35},
    "components": {EVIL: {"type": "Mass", "line": 3, "file": "bend.yaml", "fixed": False, "parameters": {"mass": EVIL}},
                   "wall": {"type": "Ground", "line": 4, "file": "bend.yaml", "fixed": True, "parameters": {}}},
    "connections": [{"ends": [f"{EVIL}.flange", "wall.flange"], "domain": "translational"}],
    "plots": [{"title": EVIL, "signals": ["haul.force"]}],
}  # fmt: skip


@pytest.fixture
def result(tmp_path: Path) -> Result:
    header = {"name": "bend <1>", "description": "A line & a bend.", "settings": {"accuracy": 1e-3}, "scene": SCENE,
              "zones": [{"family": "line.outer[*]", "zones": ["held", "forward"], "elements": [2, 3],
                         "start": [0, 1]}]}  # fmt: skip
    run = RunDirectory.create(tmp_path / "run", SIGNALS, header)
    t = np.linspace(0, 1, 50)
    run.append(t, np.outer(t, np.arange(len(SIGNALS))), np.zeros(50))
    run.event(0.5, "line.outer[2]", "held", "forward", "slides")
    run.event(0.6, EVIL, "idle", EVIL, "slides")
    run.finish("finished", {"steps": 99, "limits_broken": ["line.core[3].tension = 7 N is above 6 N"]})
    return Result.open(tmp_path / "run")


def text_of(result: Result) -> str:
    """The page without the script of the plotting package, which holds anything."""
    return page.write(result).read_text(encoding="utf-8").replace(library(), "")


def test_nothing_on_the_page_is_loaded_and_the_browser_is_told_to_refuse_it(result: Result) -> None:
    text = text_of(result)
    assert "default-src 'none'" in text
    addresses = re.findall(r'(?:src|href)="([^"]{0,12})', text)
    assert addresses
    assert all(address.startswith(("data:", "#")) for address in addresses)
    assert not re.search(r"@import|\burl\((?!data)", text)


def test_what_users_wrote_is_text_wherever_it_stands(result: Result) -> None:
    text = text_of(result)
    assert EVIL not in text
    assert "<h1>bend &lt;1&gt;</h1>" in text
    assert text.count(html.escape(EVIL)) > 3
    drawn = base64.b64decode(re.search(r"data:image/svg\+xml;base64,([^\"]+)", text)[1]).decode()
    assert EVIL not in drawn


def test_the_page_tells_limits_settings_and_extremes(result: Result) -> None:
    text = text_of(result)
    assert "line.core[3].tension = 7 N is above 6 N" in text
    assert '<th scope="row">settings accuracy</th><td class="given">0.001</td>' in text
    assert re.search(r'line\.core\[\*\]\.tension</th><td class="number">12</td><td>N</td>', text)


def test_the_page_of_a_run_without_signals_is_a_page(tmp_path: Path) -> None:
    RunDirectory.create(tmp_path / "run", (), {}).finish("failed", {"sentence": "t = 1 s: it stopped."})
    text = text_of(Result.open(tmp_path / "run"))
    assert "Not finished" in text
    assert "t = 1 s: it stopped." in text


def unpacked(chunk: packing.Chunk, signals: int, buckets: int) -> np.ndarray:
    """What the page makes of packed signals: (signals, kinds, rows)."""
    planes = np.frombuffer(zlib.decompress(chunk.data), np.uint8).reshape(2, -1).astype(np.int64)
    codes = np.cumsum((planes[0] + 256 * planes[1]).reshape(signals, -1), axis=1) % 65536
    values = np.array(chunk.low)[:, None] + codes * np.array(chunk.step)[:, None]
    return np.where(codes == packing.NAN, np.nan, values).reshape(signals, -1, buckets)


@pytest.mark.parametrize("k", [1, 7, 1000])
def test_packing_keeps_extremes_zeros_and_gaps(k: int) -> None:
    rng = np.random.default_rng(3)
    values = rng.normal(size=(5000, 3)) * [1.0, 1e-9, 1e12]
    values[::3] = 0.0
    values[1234], values[4321], values[77] = 40.0, -40.0, np.nan
    rows = -(-5000 // k)
    found = unpacked(packing.packed(values, k), 3, rows)
    step = np.ptp(np.nan_to_num(values), axis=0) / 65000
    for s in range(3):
        assert np.nanmax(found[s]) == pytest.approx(np.nanmax(values[:, s]), abs=step[s])
        assert np.nanmin(found[s]) == pytest.approx(np.nanmin(values[:, s]), abs=step[s])
        if k == 1:
            np.testing.assert_allclose(found[s, 0], values[:, s], atol=step[s])
            assert np.all(found[s, 0][values[:, s] == 0.0] == 0.0)
        else:  # every bucket has the extremes of its own rows
            for b in range(0, rows, 97):
                own = values[b * k : (b + 1) * k, s]
                assert found[s, 1, b] == pytest.approx(np.nanmin(own), abs=step[s])
                assert found[s, 2, b] == pytest.approx(np.nanmax(own), abs=step[s])


def test_signals_that_are_constant_or_never_known_come_back() -> None:
    values = np.column_stack([np.full(9, 7.5), np.full(9, np.nan)])
    found = unpacked(packing.packed(values, 1), 2, 9)[:, 0]
    np.testing.assert_array_equal(found, values.T)


def test_a_long_run_is_thinned_until_it_fits(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS[:1], {})
    noise = np.random.default_rng(0).normal(size=(20_000, 1))
    run.append(np.arange(20_000.0), noise, np.zeros(20_000))
    run.finish("finished", {})
    share = 20_000 / packing.MOST_BYTES
    data = signal_data(Result.open(tmp_path / "run"), share)
    assert data["bucket"] > 1
    assert len(base64.b64decode(data["families"][0]["b"])) <= 20_000
    assert (data["families"][0]["min"], data["families"][0]["max"]) == (noise.min(), noise.max())


def test_a_row_of_zones_begins_where_the_run_began(result: Result) -> None:
    data = zone_data(result)
    words = [one["name"] for one in data["words"]]
    (outer,) = [one for one in data["families"] if one["name"] == "line.outer[*]"]
    assert [words[k] for k in outer["start"]] == ["held", "forward"]
    assert outer["counts"] == [1, 0]
    assert [one["means"] for one in data["words"]][:2] == ["stuck", "forward"]


def test_runs_of_one_scene_bear_the_values_in_which_they_differ(tmp_path: Path) -> None:
    """Also the run that left a parameter as the netlist has it."""
    belt = {"pad.normal_force": "12 N"}
    runs = [fairlead.load("single_bend", set=given).run(out=tmp_path / str(k), stop=0.01)
            for k, given in enumerate(({"mu": "0.6"}, {}))]  # fmt: skip
    text = page.write(runs, tmp_path / "both.html").read_text(encoding="utf-8").replace(library(), "")
    assert "<h3>single_bend (mu = 0.6)</h3>" in text
    assert "<h3>single_bend (mu = 0.35)</h3>" in text
    runs = [fairlead.load("belt", set=given).run(out=tmp_path / f"belt{k}", stop=0.01)
            for k, given in enumerate((belt, {}))]  # fmt: skip
    text = page.write(runs, tmp_path / "belts.html").read_text(encoding="utf-8").replace(library(), "")
    assert "<h3>belt (pad.normal_force = 12 N)</h3>" in text
    assert "<h3>belt (as written)</h3>" in text


def test_several_runs_share_a_page_and_are_told_apart(result: Result, tmp_path: Path) -> None:
    text = page.write([result, result], tmp_path / "both.html").read_text(encoding="utf-8").replace(library(), "")
    data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL)[1])
    assert len(data["runs"]) == 2


def test_runs_of_two_models_have_each_their_own_description(tmp_path: Path) -> None:
    runs = [fairlead.load(name).run(out=tmp_path / name, stop=0.01) for name in ("belt", "block_and_spring")]
    text = page.write(runs, tmp_path / "both.html").read_text(encoding="utf-8").replace(library(), "")
    for run in runs:
        assert text.index(f"<h3>{run.run['name']}</h3>") < text.index(html.escape(run.run["description"]))
    assert text.index(html.escape(runs[0].run["description"])) > text.index('id="h-verdict"')


FOREIGN = '{"format": "x", "status": "y"}'


@pytest.mark.parametrize("contents", [{}, {"notes.txt": "x"}, {"run.json": "{"}, {"run.json": FOREIGN}])
def test_a_folder_that_is_no_run_gets_a_sentence(tmp_path: Path, contents: dict[str, str]) -> None:
    for name, text in contents.items():
        (tmp_path / name).write_text(text)
    answer = CliRunner().invoke(app, ["report", str(tmp_path)])
    assert answer.exit_code in (1, 2)
    assert "Traceback" not in answer.output
    assert str(tmp_path) in answer.output.replace("\n", "")


def test_a_truncated_series_gets_a_sentence(result: Result) -> None:
    series = result.path / "series.nc"
    series.write_bytes(series.read_bytes()[:3000])
    answer = CliRunner().invoke(app, ["report", str(result.path)])
    assert answer.exit_code in (1, 2)
    assert "series.nc" in answer.output.replace("\n", "")


def test_a_killed_run_has_a_page_that_says_so(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS[:1], {"name": "cut"})
    run.append([0.0, 1.0], [[1.0], [2.0]], [0, 0])
    run.flush(at_once=True)
    found = json.loads((tmp_path / "run" / "run.json").read_text())
    run.finish("finished", {})
    (tmp_path / "run" / "run.json").write_text(json.dumps({**found, "process": 2**22 + 1, "locked": False}))
    assert "The process was gone before the run ended" in text_of(Result.open(tmp_path / "run"))




def changed(folder: Path, *changes: tuple[str, str, str, int], steps: int = 40) -> Result:
    """A run in which parts went from one zone to another and back, so many times in all."""
    run = RunDirectory.create(folder / "run", SIGNALS[:1], {})
    run.append(np.linspace(0, 1, 3), np.zeros((3, 1)), np.zeros(3))
    for part, one, other, times in changes:
        for k in range(times):
            run.event(k / 100, part, *((one, other) if k % 2 == 0 else (other, one)), "changes")
    run.finish("finished", {"steps": steps})
    return Result.open(folder / "run")


def test_the_kind_that_made_a_run_slow_comes_before_the_contact_and_both_have_their_share(tmp_path: Path) -> None:
    hoses = [(f"line.hose[{k}]", "sound", "beyond", 6) for k in range(10)]
    pads = [(f"pad[{k}]", "held", "forward", 2) for k in range(19)]
    said = slowest(changed(tmp_path, *hoses, *pads, ("pad[19]", "held", "forward", 4)))
    assert said.startswith("By kind of part, line.hose[*] changed zone most: 59 % of 102 changes, then pad[*] with 41")
    assert "Of single contacts it is pad[19]: 4 times, 3.9 %; no contact stands out." in said
    assert "In a zone change a part begins or ceases to stick, slide or ruck." in said


def test_every_part_that_the_verdict_names_stands_in_the_table(tmp_path: Path) -> None:
    hoses = [(f"line.hose[{k}]", "sound", "beyond", 6) for k in range(30)]
    ran = changed(tmp_path, *hoses, ("pad[7]", "held", "forward", 4))
    said, rows = slowest(ran), {one["name"]: one["count"] for one in slow_data(ran)["parts"]}
    assert "Of single parts it is line.hose[0]: 6 times. Of single contacts it is pad[7]: 4 times" in said
    assert rows["line.hose[0]"] == 6
    assert rows["pad[7]"] == 4


def test_one_contact_that_made_a_run_slow_is_named_once(tmp_path: Path) -> None:
    said = slowest(changed(tmp_path, ("pad", "held", "forward", 7), ("stop", "free", "touching", 2)))
    assert said.startswith("By kind of part, pad changed zone most: 78 % of 9 changes, then stop with 22 %. In a zone")
    assert said.count("pad") == 1


def test_a_guard_that_leaves_the_zone_as_it_was_is_no_change(tmp_path: Path) -> None:
    said = slowest(changed(tmp_path, ("pad", "held", "forward", 6), ("bend", "inner", "inner", 40)))
    assert "bend" not in said
    assert "Only pad changed zone, 6 times" in said


def test_a_panel_that_nobody_asked_for_draws_none_flat_beside_another(tmp_path: Path) -> None:
    reaches = {"roll.left": 500.0, "roll.radius": 0.3, "edge.x": 260.0, "core.radius": 0.2, "web.x": 90.0, "rest.x": 0}
    run = RunDirectory.create(tmp_path / "run", [Signal(name, "m", "") for name in reaches], {})
    t = np.linspace(0, 1, 5)
    run.append(t, np.outer(t, list(reaches.values())), np.zeros(5))
    run.finish("finished", {})
    panels = first_panels(Result.open(tmp_path / "run"))
    assert panels == [
        {"title": "left, x (3 of 6; add others above)", "families": ["roll.left", "edge.x", "web.x"]}
    ]


def test_a_run_with_few_zone_changes_was_not_made_slow_by_them(tmp_path: Path) -> None:
    seldom = changed(tmp_path, ("drive.lands", "closed", "forward", 2), steps=400)
    assert slowest(seldom) == "No contact did: parts changed zone twice in 400 steps, in drive.lands."


def test_a_valve_that_opens_forward_neither_sticks_nor_slides(tmp_path: Path) -> None:
    said = slowest(changed(tmp_path, ("drive.lands", "closed", "forward", 9)))
    assert said.startswith("Only drive.lands changed zone, 9 times. In a zone change a part goes over to another")


def test_zones_of_ones_own_are_no_words_of_friction(tmp_path: Path) -> None:
    said = slowest(changed(tmp_path, ("catch", "aloof", "engaged", 3)))
    assert "In a zone change a part goes over to another branch of its law." in said
    assert "contact" not in said


@pytest.mark.parametrize("status", ["killed", "failed", "budget"])
def test_of_a_run_that_did_not_finish_that_comes_first_and_what_was_good_holds_so_far(tmp_path, status) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS[:1], {})
    run.append(np.linspace(0, 1, 3), np.zeros((3, 1)), np.zeros(3))
    near = ["haul.force", 4.0, 0.5]
    limit = {"signal": "haul.force", "text": "below 5 N", "bound": 5.0, "unit": "N", "nearest": near}
    kept = {"line": "line", "rucks": False, "margin": 9.0, "ruck_force": 160.0, "element": 3, "t": 1.0}
    run.finish(status, {"limits": [limit], "ruck": [kept | {"compressed": 17.0}]})
    first, *others = verdict(Result.open(tmp_path / "run"))
    assert (first.about, first.mood) == ("Not finished", "bad")
    told = {one.about: one.mood for one in others}
    assert told["No ruck so far"] == "plain"
    assert told["Limits kept so far"] == "plain"
    assert "good" not in told.values()


def told(folder: Path, zones: list[dict], *changes: tuple[float, str, str, str], end: float = 10.0) -> dict[str, str]:
    """What happened in a run with these zones at its start and these changes, by part."""
    run = RunDirectory.create(folder / "run", (Signal("pad.slip", "m/s", ""),), {"name": "told", "zones": zones})
    run.append(np.array([0.0, end]), np.zeros((2, 1)), np.zeros(2))
    for t, part, before, after in changes:
        run.event(t, part, before, after, "")
    run.finish("finished", {"steps": 40})
    points = [point for one in happened(Result.open(folder / "run")) for point in one.points]
    return {word: text.replace("\u00a0", " ") for word, text in points}


def of(name: str, zones: list[str], elements: list[int | None] | None = None) -> dict:
    numbers = elements or [None]
    return {"family": name, "zones": zones, "elements": numbers, "start": [0] * len(numbers)}


def test_the_verdict_tells_how_often_a_contact_slides_with_period_and_share_of_the_time(tmp_path: Path) -> None:
    sides = [(2.0 * k + 1.0 + part, "pad", *("held", "forward")[:: 1 if part == 0 else -1])
             for k in range(4) for part in (0, 0.5)]  # fmt: skip
    said = told(tmp_path, [of("pad", ["held", "forward"])], *sides)
    assert said["pad"] == ("It sticks at first. It slides 4 times, first from 1 s, then every 2 s; "
                           "20 % of the time.")  # fmt: skip


def test_a_contact_that_turns_round_slides_once(tmp_path: Path) -> None:
    changes = [(1.0, "held", "forward"), (2.0, "forward", "backward"), (3.0, "backward", "forward"),
               (4.0, "forward", "backward"), (5.0, "backward", "forward"), (6.0, "forward", "held")]  # fmt: skip
    said = told(tmp_path, [of("pad", ["held"])], *[(t, "pad", a, b) for t, a, b in changes])
    assert said["pad"] == "It sticks at first. It slides once, first from 1 s to 6 s; 50 % of the time."


@pytest.mark.parametrize("zones", [["forward", "backward", "closed"], ["linear", "forward", "backward"]])
def test_a_valve_that_is_open_either_way_does_not_slide(tmp_path: Path, zones: list[str]) -> None:
    """A servo valve, and a drive at its limits: they have words of a contact, but none for sticking or lifting off."""
    to_and_fro = ("forward", "backward")
    changes = [(k, "valve.lands", *to_and_fro[:: 1 if k % 2 else -1]) for k in range(1, 8)]
    has = [zones[-1], *zones[:-1]] if zones[0] == "linear" else zones
    said = told(tmp_path, [of("valve.lands", has)], *changes)["valve.lands"]
    assert "slide" not in said
    assert "is forward" in said or "is backward" in said


@pytest.mark.parametrize("zones", [["forward", "backward", "off"], ["held", "forward", "backward"]])
def test_a_contact_that_slides_to_and_fro_does(tmp_path: Path, zones: list[str]) -> None:
    changes = [(k, "pad", *("forward", "backward")[:: 1 if k % 2 else -1]) for k in range(1, 8)]
    assert "slides" in told(tmp_path, [of("pad", zones)], *changes)["pad"]


def test_a_state_machine_is_told_by_its_states_and_not_by_its_comparators(tmp_path: Path) -> None:
    said = told(tmp_path, [of("box.step", ["below"]), of("box.machine", ["draining"])],
                (1.0, "box.step", "below", "above"), (2.0, "box.step", "above", "below"),
                (3.0, "box.machine", "draining", "filling"), (4.0, "box.machine", "filling", "stopped"))  # fmt: skip
    assert said["box.machine"] == "Draining at first, filling from 3 s, stopped from 4 s."
    assert "box.step" not in said


def test_of_many_alike_parts_the_verdict_counts_how_many_at_once(tmp_path: Path) -> None:
    said = told(tmp_path, [of("rope[*]", ["taut", "slack"], [0, 1, 2])],
                (1.0, "rope[0]", "taut", "slack"), (2.0, "rope[2]", "taut", "slack"),
                (3.0, "rope[0]", "slack", "taut"))  # fmt: skip
    assert said["rope[*]"] == "2 of 3 go slack at some time, at most 2 at once (at 2 s); first rope[0] at 1 s."


def test_parts_that_differ_by_their_number_alone_are_one_kind() -> None:
    assert kinds_of(["pad_1", "pad_2", "pad_3", "valve_1", "valve_2"]) == {
        "pad_1": "pad_*", "pad_2": "pad_*", "pad_3": "pad_*", "valve_1": "valve_1", "valve_2": "valve_2"}  # fmt: skip


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(1.8e7, "Pa", "18 MPa"), (1.77e-4, "rad", "177 µrad"), (0.25, "m", "0.25 m"), (3.2e-8, "m", "32 nm"),
     (2e6, "m^2", "2.00e6 m^2"), (0.0, "N", "0 N"), (12.0, "1", "12"), (2.5e5, "N*m", "250 kN*m")],
)  # fmt: skip
def test_a_value_has_three_digits_and_a_prefix_where_its_unit_takes_one(value: float, unit: str, text: str) -> None:
    assert measured(value, unit).replace("\u00a0", " ") == text


def test_the_page_of_a_scene_without_a_line_has_no_words_about_lines(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS[:1], {"name": "plain"})
    run.append(np.array([0.0, 1.0]), np.zeros((2, 1)), np.zeros(2))
    run.finish("finished", {"steps": 3, "energy": {"supplied": 0.0, "dissipated": 0.0, "stored_change": 0.0}})
    text = text_of(Result.open(tmp_path / "run"))
    shown = re.sub(r"<(script|style).*?</\1>", "", text, flags=re.DOTALL)
    assert not re.search(r"\b(rucks?|hose|outboard|inboard|de-registration)\b", shown)
    assert 'href="#maps"' not in shown
    assert "No energy passed" in shown


HOME = "/home/somebody/secret project"


def of_somebody(folder: Path, status: str = "finished") -> Result:
    """A run whose netlist lies in a folder of its author, with included files, and messages that name them."""
    files = dict.fromkeys((f"{HOME}/scenes/bend.yaml", f"{HOME}/scenes/parts/pad.yaml", f"{HOME}/common.yaml"), "a: 1")
    header = {"name": "bend", "netlist": f"{HOME}/scenes/bend.yaml", "scene": {**SCENE, "files": files},
              "settings": {"accuracy": 1e-3, "profile": None}, "library": f"{HOME}/scenes/own.py",
              "remarks": [f"{HOME}/scenes/bend.yaml:5:20: pad.curve is odd. See {HOME}/common.yaml:3."]}  # fmt: skip
    run = RunDirectory.create(folder, SIGNALS, header)
    t = np.linspace(0, 1, 5)
    run.append(t, np.outer(t, np.arange(len(SIGNALS))), np.zeros(5))
    run.finish(status, {"steps": 9, "sentence": f"Own (in {HOME}/scenes/own.py:12) gave nan."})
    return Result.open(folder)


@pytest.mark.parametrize("status", ["finished", "failed"])
def test_a_page_that_goes_to_others_has_no_folder_of_the_author(tmp_path: Path, status: str) -> None:
    text = text_of(of_somebody(tmp_path / "run", status))
    assert HOME not in text
    for word in ("bend.yaml:5:20: pad.curve is odd", "parts/pad.yaml", "See common.yaml:3", ">bend.yaml<"):
        assert word in text
    assert ("own.py:12" in text) == (status == "failed")


def test_runs_of_one_name_are_told_apart_by_what_their_folders_do_not_share(tmp_path: Path) -> None:
    runs = [of_somebody(tmp_path / "deep" / name) for name in ("one", "two")]
    text = page.write(runs).read_text(encoding="utf-8").replace(library(), "")
    assert "bend in one" in text
    assert "bend in two" in text
    assert str(tmp_path) not in text

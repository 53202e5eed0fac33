"""What is typed at a prompt or ends a cell of a notebook fits on a screen, and its texts are escaped."""

import dataclasses
import json
import pickle

import pytest

import fairlead
from fairlead.results import Event, Signal
from fairlead.results.kept_lists import Events, RunRecord, Signals
from fairlead.results.table import Table

LINES, COLUMNS = 40, 120
NASTY = "<script>alert(1)</script>\x1b[2J"


def fits(thing):
    """Whether a repr fits on a screen."""
    shown = repr(thing)
    wrapped = sum(1 + len(line) // COLUMNS for line in shown.splitlines())
    assert wrapped <= LINES, f"{type(thing).__name__}: {len(shown)} characters, {wrapped} lines"
    return shown


@pytest.fixture(scope="module")
def model():
    return fairlead.load("guidance_route", set={"run.stop": "10 ms", "record.every": "5 ms"})


@pytest.fixture(scope="module")
def result(model):
    return model.run(out=None)


@pytest.mark.parametrize("stage", ["netlist", "assembly", "flattened", "flat", "system"])
def test_a_stage_of_a_large_route_shows_itself_in_a_line(model, stage):
    assert type(getattr(model, stage)).__name__ in fits(getattr(model, stage))


def test_what_the_stages_of_a_large_route_are_made_of_fits_on_a_screen(model):
    seen, waiting = set(), [model.assembly, model.flat, model.system]
    while waiting:
        thing = waiting.pop()
        if id(thing) in seen or not type(thing).__module__.startswith("fairlead"):
            continue
        seen.add(id(thing))
        fits(thing)
        if dataclasses.is_dataclass(thing):
            for name in vars(thing):
                value = getattr(thing, name)
                some = list(value.values()) if isinstance(value, dict) else value
                waiting += list(some)[:3] if isinstance(some, list | tuple) else [some]
    assert len(seen) > 30


def test_what_a_large_netlist_is_made_of_fits_on_a_screen(model):
    tree = model.sources.tree
    for thing in (model.sources, tree, *tree.entries.values(), *model.netlist.components.values()):
        fits(thing)


def test_statics_of_a_large_route_and_all_they_are_made_of_fit_on_a_screen(model):
    found = model.statics()
    seen, waiting = set(), [found, *found]
    while waiting:
        thing = waiting.pop()
        if id(thing) in seen or not (dataclasses.is_dataclass(thing) or isinstance(thing, list)):
            continue
        seen.add(id(thing))
        if type(thing).__module__.startswith(("fairlead.analysis", "fairlead.statics")):
            fits(thing)
            waiting += [value for name in vars(thing) for value in _members(getattr(thing, name))]
    assert len(seen) > 50


def _members(value):
    return list(value) if isinstance(value, tuple) else [value]


def test_a_result_of_many_signals_and_its_parts_fit_on_a_screen(result):
    assert len(result.signals) > 500
    for thing in (result, result.signals, result.events, result.run, result.run["routes"][0].keys()):
        fits(thing)
    many = Events(Event(0.1 * k, "pad", "held", "forward", "limit") for k in range(10000))
    assert "10000 zone changes" in fits(many)
    assert len(many.to_pandas()) == 10000


def test_model_result_and_statics_have_a_page_for_notebooks(model, result):
    assert "components" in model._repr_html_()
    assert "finished" in result._repr_html_()
    (line,) = model.statics()
    assert "<table>" in line._repr_html_()
    for thing in (model, result, line, model.statics(), result.events, result.signals, result.run):
        assert len(thing._repr_html_()) < 60_000


def test_texts_of_a_netlist_are_escaped_on_pages_and_printable_at_a_prompt(scene):
    text = f"""
    components: {{wall: {{type: Ground}}, block: {{type: Mass, mass: 1 kg}}, s: {{type: Spring, stiffness: 1 N/m}}}}
    connections: [[wall.flange, s.a], [s.b, block.flange]]
    description: "{NASTY.replace(chr(27), '')}"
    run: {{stop: 1 ms}}
    """
    model = scene(text)
    result = model.run(out=None)
    table = Table(NASTY, (NASTY,), ("",), ((NASTY,),))
    signals, record = Signals([Signal(NASTY, NASTY, NASTY)]), RunRecord({NASTY: NASTY})
    for thing in (model, result, table, signals, record):
        assert "<script>" not in thing._repr_html_()
    for thing in (table, signals, record):
        assert "\x1b" not in repr(thing)


def test_a_table_gives_columns_rows_and_a_frame_with_units():
    table = Table("forces", ("part", "force"), ("", "N"), (("spring", 2.5), ("pad", None)))
    assert table["force"] == [2.5, None]
    assert table[0] == {"part": "spring", "force": 2.5}
    assert [row["part"] for row in table] == ["spring", "pad"]
    assert len(table) == 2
    frame = table.to_pandas()
    assert list(frame.columns) == ["part", "force"]
    assert frame.attrs["units"] == {"part": "", "force": "N"}
    assert frame["force"][0] == 2.5
    assert "force [N]" in repr(table)
    assert "<th>force [N]</th>" in table._repr_html_()
    with pytest.raises(KeyError, match="frce: the columns are part, force"):
        table["frce"]


def test_a_long_table_says_how_much_is_left_out():
    table = Table("long", ("n", "text"), ("", ""), tuple((k, "x" * 500) for k in range(1000)))
    assert "976 more rows" in fits(table)
    assert "976 more rows" in table._repr_html_()
    assert len(table._repr_html_()) < 20_000
    wide = Table("wide", tuple(f"column{k}" for k in range(100)), ("",) * 100, (tuple(range(100)),) * 100)
    fits(wide)


def test_the_lists_of_a_result_are_lists_still(result):
    assert json.loads(json.dumps(result.run))["name"] == "guidance_route"
    assert result.run == dict(result.run)
    assert result.events == list(result.events)
    assert result.signals == tuple(result.signals)
    again = pickle.loads(pickle.dumps((result.run, result.events, result.signals)))
    assert again == (result.run, result.events, result.signals)


def test_the_tables_of_statics_hold_the_numbers_of_the_states(model):
    (line,) = model.statics()
    frame = line.to_pandas()
    state = line.moving[0]
    assert frame.attrs["units"]["inboard"] == "N"
    for one in state.passages:
        if one.device is not None and one.device.touches:
            row = frame[(frame["station"] == one.name) & (frame["speed"] == state.speed)].iloc[0]
            assert (row["inboard"], row["outboard"]) == (one.inboard, one.outboard)
    assert set(line.drives()["drive"]) == {drive.name for each in (*line.moving, *line.starts) for drive in each.drives}
    rest = line.at_rest()
    assert all(low <= high for low, high in zip(rest["inboard_least"], rest["inboard_most"], strict=True))
    assert list(model.statics().to_pandas()["line"].unique()) == [line.route.line.path]


@pytest.mark.parametrize(("table", "why"), [("margins", "no line"), ("rucks", "ruck_force"), ("limits", "no limits")])
def test_a_table_that_is_empty_says_why(table, why):
    result = fairlead.load("belt", set={"run.stop": "0.1 s"}).run(out=None)
    found = getattr(result, table)
    assert why in repr(found() if callable(found) else found)

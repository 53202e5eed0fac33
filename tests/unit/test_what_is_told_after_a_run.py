"""What is told of a run when it has ended, alone: against plain loops over its rows and its zone changes."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import networkx as nx
import numpy as np
import pytest

from fairlead.analysis.margins import limits_again, result_tables
from fairlead.analysis.margins.ruck_places import ruck_places
from fairlead.analysis.record.impacts import changed_starts, lost_in_impacts
from fairlead.analysis.record.never_closed import MOST_TOLD, NeverClosed
from fairlead.analysis.record.pushes import pushes
from fairlead.analysis.record.recorded_line import RecordedLine, numbers
from fairlead.analysis.record.released_together import ReleasedTogether
from fairlead.analysis.record.used_up import UsedUp
from fairlead.errors import UsageError
from fairlead.integrate.problem import EVENT
from fairlead.results import Event
from fairlead.results.damage import DamagedResultsError
from fairlead.system.arrays.pressing import Pressed

SEEDS = range(5)


class Rows:
    """As much of a Result as these read: times, signals by name, zone changes."""

    def __init__(self, t, signals=None, events=(), run=None):
        self.t, self._known, self.events, self.run = np.asarray(t, float), signals or {}, events, run or {}
        self.signals = [SimpleNamespace(name=name) for name in self._known]

    def columns(self, names):
        return np.column_stack([self._known[name] for name in names])

    def named(self, name):
        return name

    def __contains__(self, name):
        return name in self._known

    def __len__(self):
        return len(self._known)


def chunks(chance, count):
    """Where an engine hands over: borders of slices of so many rows."""
    cuts = np.sort(chance.integers(0, count + 1, 3)).tolist()
    return [slice(a, b) for a, b in itertools.pairwise([0, *cuts, count])]


# Contacts that let go together


def hung_together(chance, bodies, contacts):
    """A System of bodies and contacts: rows of contacts have the speeds of two bodies in them, or of one."""
    n = bodies + contacts
    pairs = [chance.choice(bodies, size=int(chance.integers(1, 3)), replace=False).tolist() for _ in range(contacts)]
    column_rows = [[bodies + k for k, pair in enumerate(pairs) if body in pair] for body in range(bodies)]
    rows = [[body, *of] for body, of in enumerate(column_rows)] + [[] for _ in range(contacts)]
    starts = np.cumsum([0, *map(len, rows)])
    holder = np.full(n, -1)
    holder[bodies:] = np.arange(contacts)
    system = SimpleNamespace(
        n=n, zones=np.zeros(contacts, np.int64), holder=holder, machine_names=[f"c{k}" for k in range(contacts)],
        mass_pattern=SimpleNamespace(rows=np.array([r for of in rows for r in of], np.int64), starts=starts),
        limit_guard=(chance.random(contacts) < 0.8).astype(int), falls=(chance.random(contacts) < 0.8).astype(int),
    )  # fmt: skip
    return system, pairs


@pytest.mark.parametrize("seed", SEEDS)
def test_contacts_let_go_together_in_one_pass_where_bodies_and_contacts_join_them(seed):
    """Of those whose friction falls, at their limit; sides that nothing joins have nothing to do with each other."""
    chance = np.random.default_rng(seed)
    system, pairs = hung_together(chance, 9, 8)
    graph = nx.Graph()
    for k, pair in enumerate(pairs):
        nx.add_path(graph, [("contact", k), *(("body", one) for one in pair)])
        graph.add_edges_from((("contact", k), ("body", one)) for one in pair)
    events = np.zeros(60, EVENT)
    events["t"] = np.sort(chance.integers(0, 6, 60)) / 10
    events["position"] = chance.integers(0, 3, 60)
    events = events[np.lexsort((events["position"], events["t"]))]
    events["machine"] = events["guard"] = chance.integers(0, 8, 60)
    events["guard"][chance.random(60) < 0.1] = -1
    events["after"] = chance.integers(0, 2, 60)
    watch = ReleasedTogether(system)
    watch.watch(events)
    wanted = {}
    for row in events.tolist():
        t, machine, before, after, guard, position = row
        if guard >= 0 and before != after and system.limit_guard[guard] and system.falls[machine]:
            part = min(k for kind, k in nx.node_connected_component(graph, ("contact", machine)) if kind == "contact")
            wanted.setdefault((t, position, part), []).append(f"c{machine}")
    wanted = [(t, names) for (t, _, _), names in wanted.items() if len(names) > 1]
    assert watch.plain()["count"] == len(wanted)
    assert [(one["t"], one["contacts"], one["of"]) for one in watch.first] == [
        (t, names[:10], len(names)) for t, names in wanted[:20]
    ]


# Contacts that were never closed


@pytest.mark.parametrize("seed", SEEDS)
def test_contacts_that_were_pressed_and_stayed_open_are_told_however_a_run_is_handed_over(seed):
    """Those that never left their open zone but before time began, below their lift all the time."""
    chance = np.random.default_rng(seed)
    contacts = [Pressed(f"c{k}", f"s{k}", 1.0) for k in range(12)]
    forces = np.abs(chance.normal(0, 0.35, (20, 12))) * chance.choice([0.0, 1.0], 12, p=[0.2, 0.8])
    forces[3, 0] = np.nan
    events = np.zeros(15, EVENT)
    events["t"] = np.sort(chance.choice([0.0, 0.0, 1.0, 2.0], 15))
    events["machine"] = chance.integers(0, 12, 15)
    events["after"] = chance.integers(0, 2, 15)  # 1 is open
    closed = dict.fromkeys(range(12), True)  # until a change at the start opens it
    for row in events:
        k = int(row["machine"])
        closed[k] = bool(row["after"] != 1) if row["t"] <= 0 else True
    watch = NeverClosed(contacts, np.arange(12), np.arange(12), np.ones(12, np.int64), 0.0)
    for rows, some in zip(chunks(chance, 20), chunks(chance, 15), strict=True):
        if rows.stop > rows.start:
            watch.watch(forces[rows], events[:0])
        watch.watch(forces[:1], events[some])
    told = [f"c{k}" for k in range(12) if not closed[k] and 0 < np.nanmax(forces[:, k]) < 1.0]
    found = watch.remarks()
    assert [one.partition(" ")[0] for one in found[:MOST_TOLD]] == told[:MOST_TOLD]
    assert len(found) == min(len(told), MOST_TOLD) + (len(told) > MOST_TOLD)


# Parts that are used up


@pytest.mark.parametrize("seed", SEEDS)
def test_a_run_ends_at_the_first_row_in_which_a_part_is_used_up(seed):
    """The parts of that row, each once; one that another listens to only beyond 1."""
    chance = np.random.default_rng(seed)
    t, rows = np.arange(30) / 10, chance.random((30, 4))
    rows[:, 1:] -= 1.2 * (chance.random((30, 1)) < 0.9)  # all but the first are used up at once
    rows[:, 1:] -= 1.2 * (chance.random((30, 3)) < 0.4)
    words = dict.fromkeys("abc", ("is gone", "Stop."))
    watch = UsedUp(["a", "b", "b", "c"], np.arange(4), np.array([1.0, 0, 0, 0]), words)
    found = watch.end(t, rows)
    empty = [[name for name, value in zip("bbc", row[1:], strict=True) if value > 0] for row in rows]
    first = next((k for k, names in enumerate(empty) if names), None)
    if first is None:
        assert found is None
        return
    names = tuple(dict.fromkeys(empty[first]))
    assert (found[0], found[2]) == (first, names)
    assert (" are gone, " in found[1]) == (len(names) > 1)


# What impulses did


def start_of(chance, n=12):
    """A problem with n unknowns of which every third is a speed, as it was given and as it began."""
    units = ["m/s" if k % 3 == 0 else "m" for k in range(n)]
    unknowns = [SimpleNamespace(name=f"p{k // 2}.u{k}", unit=unit) for k, unit in enumerate(units)]
    given = chance.choice([0.0, 1.0, -2.0, 3e-7], n)
    begun = given * chance.choice([1.0, 1.0 + 1e-9, 1.5, 1e-5], n) + chance.choice([0.0, 1e-9], n)
    problem = SimpleNamespace(
        initial=given, absolute=np.full(n, 1e-6), relative=np.full(n, 1e-6), cap=np.full(n, np.inf),
        differential=chance.random(n) < 0.8, quadrature=np.arange(n) == n - 1, stiff=np.arange(n) == n - 2,
        numbering=SimpleNamespace(unknowns=unknowns),
    )  # fmt: skip
    return problem, given, begun


@pytest.mark.parametrize("seed", range(8))
def test_start_values_that_settling_changed_are_told_with_what_they_became(seed):
    """By more than their weight; of a speed also that nothing is left."""
    problem, given, begun = start_of(np.random.default_rng(seed))
    wanted = []
    for k, unknown in enumerate(problem.numbering.unknowns):
        weight = 1e-6 + 1e-6 * max(abs(given[k]), abs(begun[k]))
        stopped = unknown.unit == "m/s" and abs(given[k]) > 1e-12 and abs(begun[k]) <= 1e-3 * abs(given[k])
        counts = problem.differential[k] and not problem.quadrature[k] and not problem.stiff[k]
        if counts and (abs(begun[k] - given[k]) > weight or stopped):
            wanted.append((unknown.name, given[k], begun[k]))
    assert [(one["name"], one["given"], one["became"]) for one in changed_starts(problem, begun)] == wanted
    assert changed_starts(problem, np.zeros(12)) == []  # it never began


def test_energy_lost_in_impacts_is_summed_by_component():
    unknowns = [SimpleNamespace(name=name) for name in ("a.x", "a.stop", "b.c.stop", "b.c.other", "d.v")]
    system = SimpleNamespace(numbering=SimpleNamespace(unknowns=unknowns))
    assert lost_in_impacts(system, np.array([0.0, 2.0, 3.0, 4.0, 0.0])) == {"a": 2.0, "b.c": 7.0}


@pytest.mark.parametrize("seed", SEEDS)
def test_the_largest_push_of_what_can_only_pull_is_told(seed):
    """Below zero by more than the accuracy of the largest pull among them."""
    chance = np.random.default_rng(seed)
    roles = ["pull" if pulls else "" for pulls in chance.random(9) < 0.6]
    recorded = [SimpleNamespace(name=f"l{k}.tension", unit="N", role=role) for k, role in enumerate(roles)]
    lowest, highest = -chance.choice([0.0, 0.04, 3.0, 8.0], 9), chance.uniform(10, 100, 9)
    extremes = SimpleNamespace(lowest=lowest, highest=highest, t_lowest=np.arange(9.0))
    mine = [k for k in range(9) if roles[k]]
    most = max((highest[k] for k in mine), default=0.0)
    wanted = [k for k in mine if lowest[k] < -1e-2 * most - 1e-6]
    found = pushes(extremes, recorded, 1e-2)
    if not wanted:
        assert found is None
        return
    assert (found["most"], found["count"]) == (max(-lowest[k] for k in wanted), len(wanted))
    worst = next(k for k in wanted if -lowest[k] == found["most"])
    assert (found["component"], found["t"], found["unit"]) == (f"l{worst}", float(worst), "N")


# Limits that are judged again


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_limit_is_judged_by_the_row_that_goes_furthest(monkeypatch, seed, sense):
    """Over all signals of its pattern; what the run kept of it goes before its rows."""
    chance = np.random.default_rng(seed)
    known = {f"line.e[{k}].tension": chance.uniform(-5, 5, 30).round(2) for k in range(4)}
    known["other.tension"] = np.full(30, 99.0 * sense)
    bound = float(chance.uniform(-8, 8))
    limit = {"signal": "line.e[*].tension", "text": "below it", "unit": "N", "bound": bound, "sense": sense}
    kept = limit | {"nearest": ["line.e[2].tension", bound + 0.5 * sense, 0.25]}
    monkeypatch.setattr(limits_again, "limits", lambda _path, _run: [limit, kept, limit | {"signal": "nobody"}])
    one, told = limits_again.judged(Rows(np.arange(30) / 10, known))
    worst = max((sense * value, -k, name, value, k) for name in list(known)[:4] for k, value in enumerate(known[name]))
    assert one.value == worst[3]
    assert known[one.signal][round(10 * one.t)] == worst[3]
    assert not (known[one.signal][: round(10 * one.t)] == worst[3]).any()  # for the first time
    assert one.broken == (sense * (worst[3] - bound) > 0)
    assert (told.signal, told.value, told.t, told.broken) == ("line.e[2].tension", bound + 0.5 * sense, 0.25, True)


# Tables of a result


@pytest.mark.parametrize("pattern", ["*", "a", "line.*"])
@pytest.mark.parametrize("seed", SEEDS)
def test_zone_changes_are_counted_by_component_and_zones(seed, pattern):
    """With the first and the last of each, the most frequent first."""
    chance = np.random.default_rng(seed)
    names, zones = ["a", "b", "line.c[0]", "line.c[1]"], ["stick", "slip", "off"]
    events = [
        Event(float(t), str(chance.choice(names)), *(str(one) for one in chance.choice(zones, 2, replace=False)), "g")
        for t in np.sort(chance.uniform(0, 1, 40))
    ]
    table = result_tables.switches(Rows([], events=events), pattern)
    picked = [one for one in events if pattern in ("*", one.component) or one.component.startswith(pattern[:-1] or "-")]
    wanted = []
    for key in {(one.component, one.zone_from, one.zone_to) for one in picked}:
        times = [one.t for one in picked if (one.component, one.zone_from, one.zone_to) == key]
        wanted.append((*key, len(times), min(times), max(times)))
    assert sorted(table.rows) == sorted(wanted)
    assert [row[3] for row in table.rows] == sorted((row[3] for row in wanted), reverse=True)


def test_a_name_that_changes_no_zone_is_refused_with_names_that_do():
    events = [Event(0.5, "clutch", "stick", "slip", "g")]
    run = {"zones": [{"family": "line.c[*]", "elements": [0, 3]}]}
    with pytest.raises(UsageError, match="No component of the name cluch"):
        result_tables.switches(Rows([], events=events, run=run), "cluch")
    with pytest.raises(UsageError, match="did not change zone in this run"):
        result_tables.switches(Rows([], events=events, run=run), "line.c[3]")


def test_energy_that_is_missing_is_what_was_not_stored_or_dissipated():
    """Nothing is missing where one of the three is not known."""
    ledger = {"supplied": 10.0, "dissipated": 6.5, "stored_change": 3.0, "closure": 0.05}
    rows = dict(result_tables.energy(Rows([], run={"energy": ledger, "lost": {"stop": 1.5}})).rows)
    assert rows == {
        "supplied": 10.0, "dissipated": 6.5, "stored": 3.0, "lost in impacts of stop": 1.5, "missing": -0.5,
    }  # fmt: skip
    assert "missing" not in dict(result_tables.energy(Rows([], run={"energy": ledger | {"dissipated": None}})).rows)


# Lines in results


@pytest.mark.parametrize("seed", SEEDS)
def test_a_line_is_put_together_from_its_elements(seed):
    """Tensions of two layers, nodes, and the middles between them; nothing of what was not recorded whole."""
    chance = np.random.default_rng(seed)
    nodes = int(chance.integers(3, 6))
    record = {"line": "w", "nodes": nodes, "layers": ["outer", "core"], "outer": "node"}
    known = {f"w.node[{k}].x": chance.uniform(0, 1, 7) + k for k in range(nodes)}
    elements = [f"{layer}[{k}]" for layer in record["layers"] for k in range(nodes - 1)]
    known |= {f"w.{one}.tension": chance.uniform(0, 9, 7) for one in elements}
    known |= {f"w.pad[{k}].force": chance.uniform(0, 9, 7) for k in range(0, nodes, 2)}
    line = RecordedLine(Rows(np.arange(7), known), record)
    for row in range(7):
        for k in range(nodes - 1):
            both = known[f"w.outer[{k}].tension"][row] + known[f"w.core[{k}].tension"][row]
            middle = (known[f"w.node[{k}].x"][row] + known[f"w.node[{k + 1}].x"][row]) / 2
            assert line.total[row, k] == pytest.approx(both)
            assert line.places[row, k] == pytest.approx(middle)
        for k in range(nodes):
            assert line.of_nodes("pad", "force")[row, k] == (known[f"w.pad[{k}].force"][row] if k % 2 == 0 else 0.0)
    assert line.some("nothing", "force") is None
    del known[f"w.core[{nodes - 2}].tension"]
    part = RecordedLine(Rows(np.arange(7), known), record)
    assert part.total is None
    assert part.nodes is not None


def test_a_signal_that_is_no_number_is_damage_of_the_results():
    with pytest.raises(DamagedResultsError, match=r"b = nan at t = 2 s"):
        numbers(Rows(np.arange(4), {"a": np.zeros(4), "b": np.array([0, 1, np.nan, np.inf])}), ["a", "b"])


def test_elements_begin_to_ruck_on_a_device_or_between_two():
    """By hand: a bend from 2 m to 3 m and a sea from 6 m; five nodes a metre apart that move outboard at 1 m/s."""
    record = {
        "line": "w", "nodes": 5, "outer": "node",
        "stations": [
            {"name": "bend", "type": "Bend", "begin": 2.0, "end": 3.0},
            {"name": "sea", "type": "Sea", "begin": 6.0, "end": None},
        ],
    }  # fmt: skip
    t = np.arange(0.0, 6.0)
    result = Rows(t, {f"w.node[{k}].x": k + t - 1.5 for k in range(5)})
    begins = [Event(at, f"w.outer[{k}]", "a", "b", "g") for at, k in ((0.0, 0), (1.2, 1), (2.0, 1), (4.9, 0), (5.0, 3))]
    found = ruck_places(result, record, begins)
    # element 0 at 0 s: -1.5 to -0.5; 1 at 1 s: 0.5 to 1.5; 1 at 2 s: 1.5 to 2.5; 0 at 4 s: 2.5 to 3.5; 3 at 5 s: 6.5 on
    assert [(one["elements"], one["t"], one["low"], one["high"]) for one in found] == [
        (2, 0.0, -1.5, 1.5), (2, 2.0, 1.5, 3.5), (1, 5.0, 6.5, 7.5),
    ]  # fmt: skip
    assert [one["where"].partition(" ")[0] for one in found] == ["inboard", "on", "on"]

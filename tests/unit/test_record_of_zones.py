"""What is told of zone changes after a run, alone: contacts held together, orders without end, parts with tables."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.record.chattering import MOST_NAMED, remark
from fairlead.analysis.record.gave_way import _Unions
from fairlead.analysis.record.rounded_off import ENOUGH, NO_LOAD, RoundedOff
from fairlead.analysis.record.went_round import MOST_TOLD, ROUNDS, WentRound
from fairlead.analysis.record.zone_changes import ZoneChanges
from fairlead.system.numbering.contact_cycles import REST, HeldPair

EVENT = np.dtype([("t", float), ("machine", int), ("before", int), ("after", int), ("guard", int), ("position", int)])


@pytest.mark.parametrize("seed", range(20))
def test_two_sides_are_held_together_where_no_motion_that_the_others_leave_is_a_slip(seed):
    """By rank: the row of the contact is a sum of those that hold, and of what is at rest."""
    rng = np.random.default_rng(seed)
    bodies, radius = 5, rng.uniform(0.5, 2.0, 5)

    def contact(k):
        one, other = rng.choice([*range(bodies), REST], 2, replace=False).tolist()
        pull = rng.uniform(0.5, 2.0)
        off = 1.3 if rng.random() < 0.2 else 1.0  # some agree only at rest
        ends = [(index, 1.0 if index == REST else sign * pull / radius[index])
                for index, sign in ((one, 1.0), (other, -off))]  # fmt: skip
        return HeldPair(f"c{k}", "force", (ends[0], ends[1]), 1.0)

    def row(pair):
        made = np.zeros(bodies)
        for index, coef in pair.ends:
            if index != REST:
                made[index] = coef
        return made

    pairs = [contact(k) for k in range(8)]
    holding = pairs[: rng.integers(0, 7)]
    unions, rows = _Unions(iter(holding)), np.array([row(pair) for pair in holding]).reshape(-1, bodies)
    for pair in pairs:
        alone = np.linalg.matrix_rank(rows, tol=1e-8) if len(rows) else 0
        together = np.linalg.matrix_rank(np.vstack([rows, row(pair)]), tol=1e-8) == alone
        assert unions.keep_together(pair) == together


def changes(*rows):
    """(t, machine) of changes between zones 0 and 1."""
    return np.array([(t, machine, 0, 1, -1, 0) for t, machine in rows], EVENT)


@pytest.mark.parametrize("cuts", [1, 7, 40])
def test_an_order_goes_round_where_one_contact_changes_again_and_again_at_one_instant(cuts):
    """Machine 1 does so at two of three instants, 0 has no friction that falls, 2 changes seldom enough."""
    system = SimpleNamespace(falls=np.array([0, 1, 1]), machine_names=["zero", "one", "two"])
    rows = [(t, m) for t, times in ((1.0, ROUNDS), (2.0, ROUNDS - 1), (3.0, ROUNDS + 5))
            for m, count in ((0, 3 * ROUNDS), (1, times), (2, ROUNDS - 1)) for _ in range(count)]  # fmt: skip
    watch = WentRound(system)
    for piece in np.array_split(changes(*rows), cuts):  # as they come in buffers
        watch.watch(piece)
    watch.finish()
    assert watch.plain() == {"count": 2, "first": [{"t": 1.0, "contacts": ["one"]}, {"t": 3.0, "contacts": ["one"]}]}
    assert "At t = 1 s (and at 1 other instants)" in watch.remarks()[0]
    for k in range(2 * MOST_TOLD):
        watch.watch(changes(*[(10.0 + k, 2)] * ROUNDS))
    watch.finish()
    assert (watch.count, len(watch.first)) == (2 + 2 * MOST_TOLD, MOST_TOLD)
    system.falls[:] = 0
    assert WentRound(system).remarks() == []


def test_of_tables_of_one_part_that_go_on_together_the_first_has_a_row():
    """Machines 0 and 1 are tables of the spring, 2 is one of another part, 3 a contact."""
    zones = {0: ["piece 0", "piece 1"], 1: ["piece 0", "piece 1"], 2: ["piece 0", "piece 1"], 3: ["held", "slides"]}
    system = SimpleNamespace(machine_names=["spring", "spring", "valve", "pad"], zone_names=zones.get,
                             guard_name=lambda guard, machine, before: f"{guard} {machine} {before}")  # fmt: skip
    rows = [(1.0, 1), (1.0, 0), (1.0, 2), (1.0, 3), (1.0, 3), (2.0, 0), (2.0, 1), (3.0, 1)]
    told = ZoneChanges(system)
    found = [(t, part) for block in np.array_split(changes(*rows), 3) for t, part, *_ in told.of(block)]
    assert found == [(1.0, "spring"), (1.0, "valve"), (1.0, "pad"), (1.0, "pad"), (2.0, "spring"), (3.0, "spring")]
    assert told.inside == 2
    idle = np.array([(4.0, 0, 1, 1, -1, 0), (4.0, 3, 1, 1, 5, 0)], EVENT)  # a guard fired, and nothing changed
    assert list(told.of(idle)) == [(4.0, "pad", "slides", "slides", "5 3 1")]


@pytest.mark.parametrize(("size", "told"), [(0.5 * NO_LOAD, False), (2 * NO_LOAD, True), (0.99 * ENOUGH, True),
                                            (1.01 * ENOUGH, False)])  # fmt: skip
def test_a_load_is_told_that_stays_small_beside_what_its_corner_is_rounded_over(size, told):
    """What is proposed is a power of ten, of a ten-thousandth to a thousandth of the load."""
    over = 1e-3
    part = SimpleNamespace(path="gear.loss", type=SimpleNamespace(declaration=SimpleNamespace(
        parameters={"round_off": SimpleNamespace(unit="N*m")})))  # fmt: skip
    signal = SimpleNamespace(name="gear.load", unit="N*m", rounded_by="round_off")
    watch = RoundedOff([signal], [part], np.array([1]), np.array([over]))
    watch.watch(np.array([[1e9, 0.1 * size * over], [1e9, -size * over], [1e9, np.nan]]))
    watch.watch(np.array([[1e9, 0.2 * size * over]]))
    assert watch.most.tolist() == [size * over]
    assert bool(watch.remarks()) == told
    if told:
        finer = float(watch.remarks()[0].rpartition("Give gear.round_off: ")[2].split()[0])
        assert 0.999e-4 * size * over <= finer <= 1.001e-3 * size * over


def test_what_chatters_is_told_by_family_those_that_did_so_most_first():
    names = ["a[1]", "b", "c[1]", "c[2]", "c[3]", "a[2]", "d", "e"]
    said = remark(names, 0.01, "warn")
    assert said.startswith("3 of c[*], 2 of a[*], b and 2 more switched to and fro, each time within 0.01 s")
    assert MOST_NAMED == 3
    assert "run.dwell: 1e+02 s" in said
    assert "Each was held for that time." in remark(names, 0.01, "hold")
    assert remark([], 0.01, "warn") == ""

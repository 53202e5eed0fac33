"""What is computed of four blocks in a row, of which the first slides: by hand, what is kept, and by which contacts."""

import numpy as np
import pytest

from fairlead.system.compiled.asking import call

MASSES = {"a": 1.0, "b": 2.0, "c": 3.0, "d": 4.0}
STIFFNESS = {"ab": 100.0, "bc": 200.0, "cd": 300.0}
ROW = """
    components:
      floor: {type: Ground}
      a: {type: Mass, mass: 1 kg}
      b: {type: Mass, mass: 2 kg}
      c: {type: Mass, mass: 3 kg}
      d: {type: Mass, mass: 4 kg}
      ab: {type: Spring, stiffness: 100 N/m}
      bc: {type: Spring, stiffness: 200 N/m}
      cd: {type: Spring, stiffness: 300 N/m}
      under_a: {type: Contact, normal_force: 10 N, curve: 0.5}
      under_b: {type: Contact, normal_force: 20 N, curve: 0.5}
      under_c: {type: Contact, normal_force: 30 N, curve: 0.5}
      under_d: {type: Contact, normal_force: 40 N, curve: 0.5}
    connections:
      - [floor.flange, under_a.a, under_b.a, under_c.a, under_d.a]
      - [under_a.b, a.flange, ab.a]
      - [under_b.b, b.flange, ab.b, bc.a]
      - [under_c.b, c.flange, bc.b, cd.a]
      - [under_d.b, d.flange, cd.b]
    friction: {method: hold}
    run: {stop: 1 s}
"""
LEDGER = {"energy.dissipated", "energy.supplied"}


@pytest.fixture
def row(scene):
    """row(*sliding, **places) -> the system with these blocks sliding at 0.1 m/s, and its unknowns."""

    def make(*sliding, **places):
        system = scene(ROW).system.instance()
        y = np.zeros(system.n)
        for machine, zone in system.memory["holds"]:
            name = system.machine_names[machine][-1]
            system.zones[machine] = zone if name not in sliding else (1 if zone != 1 else 0)
        for name in sliding:
            y[system.unknown_names.index(f"{name}.v")] = 0.1
        for name, place in places.items():
            y[system.unknown_names.index(f"{name}.x")] = place
        return system, y

    return make


def named(names, which):
    return {names[k] for k in np.flatnonzero(which)}


MARGINS = [
    # The spring pulls at b, whose contact has a force that varies. Its balance needs a row, that of b.v.
    (0, {"a.x", "a.v", "b.v", "under_a.force", "under_b.force"}, "ab"),
    # One equation further: a's spring reads b.x.
    (1, {"a.x", "a.v", "b.x", "b.v", "under_a.force", "under_b.force"}, "ab"),
    # Two: the balance of b reads c.x, that of c reads b.x, and gives the force under c.
    (2, {"a.x", "a.v", "b.x", "b.v", "c.x", "c.v", "under_a.force", "under_b.force", "under_c.force"}, "abc"),
]


@pytest.mark.parametrize(("margin", "kept", "machines"), MARGINS)
def test_what_moves_is_kept_with_a_margin_of_equations(row, margin, kept, machines):
    system, y = row("a")
    moving = system.subsystem.moving(0.0, y, margin, 0.95)
    assert named(system.unknown_names, moving.kept) == kept | LEDGER
    assert [system.machine_names[k] for k in moving.machines] == [f"under_{name}" for name in machines]


@pytest.mark.parametrize(("margin", "boundary"), [(0, "bcd"), (1, "bcd"), (2, "cd")])
def test_the_boundary_is_what_holds_the_blocks_that_are_left_out(row, margin, boundary):
    """With a margin of one b is kept, but the force under c is left out, which varies as soon as b lets go."""
    system, y = row("a")
    moving = system.subsystem.moving(0.0, y, margin, 0.95)
    found = named(system.machine_names, moving.boundary)
    assert found == {f"under_{name}" for name in boundary}
    part = system.subsystem.part(0.0, y, moving)
    inside = [system.machine_names[k] for k in part.machines]
    assert named(inside, part.boundary) == found & set(inside)


def test_a_whole_of_which_too_much_moves_is_left_whole(row):
    """Of 14 unknowns 11 stay with a margin of two: three blocks and the ledger."""
    system, y = row("a")
    assert system.subsystem.moving(0.0, y, 2, 11 / system.n) is not None
    assert system.subsystem.moving(0.0, y, 2, 10.9 / system.n) is None
    assert system.subsystem.moving(0.0, y, 3, 0.95) is None


@pytest.mark.parametrize("sliding", ["abcd", "acd"])
def test_where_nearly_all_slides_nothing_is_left_out(row, sliding):
    system, y = row(*sliding)
    assert system.subsystem.moving(0.0, y, 0, 0.9) is None


def test_from_the_middle_motion_spreads_to_both_sides(row):
    system, y = row("b")
    kept = named(system.unknown_names, system.subsystem.moving(0.0, y, 0, 0.95).kept)
    assert kept == {"b.x", "b.v", "a.v", "c.v", "under_a.force", "under_b.force", "under_c.force"} | LEDGER


@pytest.mark.parametrize("margin", [0, 1, 2])
def test_the_balances_of_the_part_have_what_rests_as_numbers(row, margin):
    """Of free contact forces: what springs pull, between blocks of which some are left out away from zero."""
    places = {"a": 0.01, "b": -0.02, "c": 0.03, "d": -0.04}
    system, y = row("a", **places)
    part = system.subsystem.part(0.0, y, system.subsystem.moving(0.0, y, margin, 0.95))
    mine = y[part.unknowns]
    names = [system.unknown_names[k] for k in part.unknowns]
    mine[names.index("a.x")] = places["a"] = 0.05  # moved on since it was cut
    f = np.zeros(part.problem.n)
    call(part.problem, "rhs", 0.0, mine, f)
    pull = {pair: k * (places[pair[1]] - places[pair[0]]) for pair, k in STIFFNESS.items()}
    wanted = {"a.v": pull["ab"], "b.v": pull["bc"] - pull["ab"], "c.v": pull["cd"] - pull["bc"]}
    for name in wanted.keys() & set(names):
        assert f[names.index(name)] == pytest.approx(wanted[name], rel=1e-12), name
    assert f[names.index("a.x")] == pytest.approx(0.1)
    np.testing.assert_array_equal(part.problem.zones, system.zones[part.machines])


def test_a_system_in_which_nothing_holds_has_nothing_to_leave_out(scene):
    """Blocks and springs alone."""
    text = "\n".join(line for line in ROW.splitlines() if "under_a:" not in line and "Contact" not in line)
    for name in "abcd":
        text = text.replace(f"under_{name}.b, ", "")
    text = text.replace("      - [floor.flange, under_a.a, under_b.a, under_c.a, under_d.a]\n", "")
    text = text.replace("      floor: {type: Ground}\n", "")
    assert not scene(text).system.instance().subsystem.possible
    assert scene(ROW).system.instance().subsystem.possible

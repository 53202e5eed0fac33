"""Nodes that a rim takes along by a gear: by hand, what is entrained, what is left of the equations, what ends it."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, parts
from fairlead.integrate.parts import SLOPES, ActiveSubsystem
from fairlead.integrate.rodas.tableau import TABLEAUS
from fairlead.system.active import entrained as entraining
from fairlead.system.active import subsystem as looking
from fairlead.system.active.entrained import Bonds, entrained
from fairlead.system.compiled.asking import call, guards_at
from tests.callbacks import Called

CLASSES = '''
    class Geared(Component):
        """The bond of a node with a rim, through a gear and a radius, up to a place."""

        node = Translational("the node")
        rim = Translational("the rim")
        place = Parameter("m", "Where it ends.")
        gear = Parameter("1", "Speed of the node over that of the rim, for a radius of 1 and one tooth.")
        teeth = Parameter("1", "What it is divided by.")
        lock = Parameter("N*s/m", "Bond.")
        radius = Input("1", "What the gear is multiplied by.")
        zones = Zones("stored", "free")
        carried = Carries("node", by="rim", zone="stored")

        @zone("stored")
        def on_rim(p, node, rim, radius):
            """As fast as the rim, times the ratio."""
            slip = node.v - p.gear * radius * rim.v / p.teeth
            force = p.lock * slip
            return Law(node=force, rim=-p.gear * radius * force / p.teeth, dissipated=force * slip)

        @zone("free")
        def off_rim(p):
            """By itself."""
            return Law(node=0, rim=0)

        @guard("stored", to="free", unit="m")
        def leaves(p, node):
            """Beyond the place."""
            return node.x - p.place

        @guard("free", to="stored", unit="m")
        def comes_back(p, node):
            """Inboard of it."""
            return p.place - node.x


    class Hung(Component):
        """A constant force."""

        port = Translational("a node")
        force = Parameter("N", "The force.")

        def law(p, port):
            """Always the same."""
            return Law(port=-p.force)


    class Size(Component):
        """A number as a signal."""

        size = Parameter("1", "The number.")
        signal = Output("1", "The same.")

        def law(p):
            """At all times."""
            return Law(signal=p.size)

'''
NODES, STORED, FREE, APART, PULL, LOCK, HELD, RIM = 10, 8, 3, 0.1, 100.0, 50.0, 30.0, 10.0
GEAR, RADIUS, TEETH = 2.0, 0.6, 0.8
RATIO = GEAR * RADIUS / TEETH
HUNG = {1: 7.0, 3: -2.5, 9: 4.0}
"""Constant forces on nodes [N]."""
CARRIED = STORED - FREE
"""Ten nodes; eight of them inboard of the place, of which the last three may come off and stay unknowns."""


def scene_of(rim, size):
    """A rim on a spring, or moved as given, and nodes in a row that are each k + 1 kg."""
    parts = [f"rim: {rim}", f"size: {size}"]
    joins = [", ".join(["rim.flange", *(f"bond{k}.rim" for k in range(NODES))])]
    joins.append(", ".join(["size.signal", *(f"bond{k}.radius" for k in range(NODES))]))
    if "Mass" in rim:
        parts += ["floor: {type: Ground}", f"held: {{type: Spring, stiffness: {HELD} N/m}}"]
        joins[0] += ", held.b"
        joins.append("floor.flange, held.a")
    for k in range(NODES):
        parts.append(f"node{k}: {{type: Mass, mass: {k + 1} kg, position: {APART * k} m}}")
        place = APART * (STORED - 0.5)
        parts.append(f"bond{k}: {{type: Geared, place: {place} m, gear: {GEAR}, teeth: {TEETH}, lock: {LOCK} N*s/m}}")
        ports = [f"node{k}.flange", f"bond{k}.node"]
        if k in HUNG:
            parts.append(f"weight{k}: {{type: Hung, force: {HUNG[k]} N}}")
            ports.append(f"weight{k}.port")
        ports += [f"spring{k}.b"] if k else []
        ports += [f"spring{k + 1}.a"] if k < NODES - 1 else []
        joins.append(", ".join(ports))
        if k:
            parts.append(f"spring{k}: {{type: Spring, stiffness: {PULL} N/m, free_length: {APART / 2} m}}")
    lines = ["components:", *(f"  {one}" for one in parts), "connections:", *(f"  - [{one}]" for one in joins)]
    return "\n".join([*lines, "run: {stop: 1 s}"])


CONSTANT = f"{{type: Size, size: {RADIUS}}}"
IN_TIME = f"{{type: SignalSource, value: {RADIUS}}}"
FREE_RIM = f"{{type: Mass, mass: {RIM} kg}}"
GIVEN_RIM = "{type: MotionSource, velocity: 0.4 m/s}"


@pytest.fixture
def wound(scene, library, monkeypatch):
    """wound(rim) -> the System in the zones that belong to where its nodes are, and unknowns with all at one pace."""
    monkeypatch.setattr(entraining, "KEPT_FREE", FREE)
    monkeypatch.setattr(looking, "LEAST_ENTRAINED", 2)
    monkeypatch.setattr(looking, "MOST", 1.0)

    def make(rim=FREE_RIM, pace=0.2, size=CONSTANT):
        system = scene(scene_of(rim, size), (library(CLASSES),)).system.instance()
        y = system.initial.copy()
        for block in system.blocks:
            if block.kernel.variant.type.__name__ == "Geared":
                for instance, machines in zip(block.instances, block.machines, strict=True):
                    system.zones[machines[0]] = int(instance.path.removeprefix("bond")) >= STORED
        for k, name in enumerate(system.unknown_names):
            if name.endswith(".v"):
                y[k] = pace if name == "rim.v" else RATIO * pace
        return system, y

    return make


def at(system, name):
    return system.unknown_names.index(name)


def numbers_of(system, nodes):
    """Which of the nodes these are."""
    of_group = {group: system.unknown_names[v] for group, v in system.numbering.rate.items()}
    return sorted(int(of_group[one.group].removeprefix("node").removesuffix(".v")) for one in nodes)


@pytest.mark.parametrize("free", range(STORED + 2))
def test_the_nodes_nearest_to_coming_off_are_not_entrained(wound, monkeypatch, free):
    """They lie in the order of their numbers; ratio and bond are those of the law."""
    monkeypatch.setattr(entraining, "KEPT_FREE", free)
    system, y = wound()
    bonds = Bonds(system)
    nodes = bonds.nodes(0.0, y)
    assert bonds.count == STORED
    assert numbers_of(system, nodes) == list(range(max(STORED - free, 0)))
    assert [one.ratio for one in nodes] == pytest.approx([RATIO] * len(nodes))
    assert [one.bond for one in nodes] == pytest.approx([LOCK] * len(nodes))


@pytest.mark.parametrize("rim", [FREE_RIM, GIVEN_RIM])
def test_forces_do_the_same_work_where_their_nodes_are_carried(wound, rim):
    """For any forces on the nodes and any motion of the rim; a reaction at a rim that is moved counts against it."""
    system, y = wound(rim)
    along = entrained(system, Bonds(system).nodes(0.0, y), 0.0, y)
    chance = np.random.default_rng(3)
    rates = along.unknowns[len(along.mass) :]
    assert {system.unknown_names[k] for k in rates} == {f"node{k}.v" for k in range(CARRIED)}
    for _ in range(5):
        forces, pace = chance.uniform(-1, 1, system.numbering.w_dump + 1), chance.uniform(-1, 1)
        (row,) = set(along.row[rates].tolist())
        gained = (along.added_up(forces) - forces)[row]
        sign = 1 if rim == FREE_RIM else -1
        assert row == at(system, "rim.v") if rim == FREE_RIM else row >= system.n
        assert gained * pace == pytest.approx(sign * sum(force * RATIO * pace for force in forces[rates]))
    (mass,) = along.masses.values()
    assert mass == pytest.approx(RATIO**2 * sum(range(1, CARRIED + 1)))  # for the same kinetic energy


def test_what_is_entrained_stands_where_the_rim_takes_it(wound):
    """From where it was when it was entrained, ratio times as far and as fast as the rim."""
    system, y = wound()
    along = entrained(system, Bonds(system).nodes(0.0, y), 0.0, y)
    later = y.copy()
    later[at(system, "rim.x")] += 0.07
    later[at(system, "rim.v")] = 1.3
    later[at(system, "node9.x")] += 0.5
    found = along.aligned(system, 0.0, later)
    for k in range(NODES):
        x, v = at(system, f"node{k}.x"), at(system, f"node{k}.v")
        carried = k < CARRIED
        assert found[x] == pytest.approx(y[x] + RATIO * 0.07 if carried else later[x])
        assert found[v] == pytest.approx(RATIO * 1.3 if carried else later[v])


def test_what_a_moved_rim_takes_along_moves_with_time(wound):
    """0.4 m/s, ratio times, from where it was."""
    system, y = wound(GIVEN_RIM)
    along = entrained(system, Bonds(system).nodes(0.5, y), 0.5, y)
    found = along.aligned(system, 0.75, y)
    for k in range(CARRIED):
        x, v = at(system, f"node{k}.x"), at(system, f"node{k}.v")
        assert found[x] == pytest.approx(y[x] + RATIO * 0.4 * 0.25)
        assert found[v] == pytest.approx(RATIO * 0.4)


def pulls(places):
    """Force of the springs on every node, and of what hangs there."""
    stretch = np.diff(places) - APART / 2
    return PULL * (np.append(stretch, 0.0) - np.append(0.0, stretch)) + [HUNG.get(k, 0.0) for k in range(NODES)]


def test_the_part_is_the_rim_with_all_that_it_carries(wound):
    """Forces and inertias by hand: of springs between nodes, of the spring of the rim, of the bonds left."""
    system, y = wound()
    moving = system.subsystem.moving(0.0, y, 2, 0.5)
    kept = {system.unknown_names[k] for k in np.flatnonzero(moving.kept)}
    outboard = range(CARRIED, NODES)
    assert kept - {"energy.dissipated", "energy.supplied"} == {
        "rim.x", "rim.v", *(f"node{k}.{one}" for k in outboard for one in "xv")
    }  # fmt: skip
    laws = zip(system.blocks, moving.laws, strict=True)
    assert {block.instances[k].path for block, some in laws for k in np.flatnonzero(some)}.isdisjoint(
        {"weight1", "weight3", *(f"bond{k}" for k in range(CARRIED)), *(f"spring{k}" for k in range(1, CARRIED))}
    )
    part = system.subsystem.part(0.0, y, moving)
    chance = np.random.default_rng(5)
    names = [system.unknown_names[k] for k in part.unknowns]
    for _ in range(3):
        later = y + np.where(moving.kept & ~system.quadrature, chance.uniform(-0.02, 0.02, system.n), 0.0)
        f = Called(part.problem).rhs(0.0, later[part.unknowns])
        way, pace = (later - y)[at(system, "rim.x")], later[at(system, "rim.v")]
        places = np.array([
            y[at(system, f"node{k}.x")] + RATIO * way if k < CARRIED else later[at(system, f"node{k}.x")]
            for k in range(NODES)
        ])  # fmt: skip
        acts = pulls(places)
        bonds = [LOCK * (later[at(system, f"node{k}.v")] - RATIO * pace) for k in range(CARRIED, STORED)]
        on_rim = RATIO * acts[:CARRIED].sum() + RATIO * sum(bonds) - HELD * later[at(system, "rim.x")]
        assert f[names.index("rim.v")] == pytest.approx(on_rim, rel=1e-9)
        for k in outboard:
            slowed = bonds[k - CARRIED] if k < STORED else 0.0
            assert f[names.index(f"node{k}.v")] == pytest.approx(acts[k] - slowed, rel=1e-9)
    inertia = np.diag(Called(part.problem).mass())
    assert inertia[names.index("rim.v")] == pytest.approx(RIM + RATIO**2 * sum(range(1, CARRIED + 1)))
    assert inertia[names.index(f"node{NODES - 1}.v")] == pytest.approx(NODES)


def test_a_rim_that_is_moved_has_to_take_what_its_nodes_are_pulled_with(wound):
    """Their springs and constant forces, `ratio` times: nothing accelerates, and bonds that are left do not slip."""
    system, y = wound(GIVEN_RIM, pace=0.4)
    part = system.subsystem.part(0.0, y, system.subsystem.moving(0.0, y, 2, 0.5))
    names = [one.name for one in system.record.recorded]
    found = np.zeros(system.n_outputs)
    call(part.problem, "outputs", 0.0, y[part.unknowns], found)
    acts = pulls(np.array([y[at(system, f"node{k}.x")] for k in range(NODES)]))
    assert abs(found[names.index("rim.force")]) == pytest.approx(abs(RATIO * acts[:CARRIED].sum()))


def test_a_ratio_that_may_change_with_time_lets_nothing_be_left_out(wound):
    """A source may give another radius later, so that what lies on the rim would not go as far as the rim."""
    system, y = wound(size=IN_TIME)
    assert len(Bonds(system).nodes(0.0, y)) == CARRIED
    assert system.subsystem.moving(0.0, y, 2, 0.5) is None


@pytest.mark.parametrize("pace", [0.0, 0.2, -3.0])
def test_the_first_to_come_off_is_watched(wound, pace):
    """The rim is turned, a little at a time, until a bond that is left out would let go: that one is among the watched.

    Inboard nothing ever does: nodes that lie on the rim are behind the place already.
    """
    system, y = wound(pace=pace)
    moving = system.subsystem.moving(0.0, y, 2, 0.5)
    chosen = [
        (block.instances[i].path, watched)
        for block, watches in zip(system.blocks, moving.watched, strict=True)
        for i, watched in enumerate(watches)
        if block.kernel.variant.type.__name__ == "Geared"
    ]
    watched = {path for path, yes in chosen if yes}
    owner = np.array([system.machine_names[m] for m in system.memory["guard_machines"]])
    out = np.isin(owner, [f"bond{k}" for k in range(CARRIED)])
    first = {}
    for sense in (1, -1):
        for way in np.arange(0.0, 1.0, 1e-3):
            later = y.copy()
            later[at(system, "rim.x")] += sense * way
            fired = out & (guards_at(system, 0.0, moving.carried.aligned(system, 0.0, later)) > 0)
            if fired.any():
                first[sense] = set(owner[fired].tolist())
                break
    assert first == {1: {f"bond{CARRIED - 1}"}}
    assert watched == first[1]
    by_boundary = {system.machine_names[k] for k in np.flatnonzero(moving.boundary)}
    assert watched <= by_boundary


def test_a_whole_is_given_back_all_that_the_rim_takes_along(wound):
    """Places and speeds of nodes on the rim; slopes that are theirs are a share of those of the rim."""
    system, y = wound()
    part = system.subsystem.part(0.0, y, system.subsystem.moving(0.0, y, 2, 0.5))
    later = y.copy()
    later[at(system, "rim.x")] += 0.03
    later[at(system, "rim.v")] = 0.9
    slopes = np.arange(1.0, system.n + 1)
    wanted = slopes.copy()
    for k in range(CARRIED):
        for one in "xv":
            wanted[at(system, f"node{k}.{one}")] = RATIO * slopes[at(system, f"rim.{one}")]
    part.carry(slopes)
    np.testing.assert_allclose(slopes, wanted, rtol=1e-12)
    part.prolong(0.0, later)
    f = np.zeros(system.n)
    call(system, "rhs", 0.0, later, f)
    mine = np.zeros(part.problem.n)
    call(part.problem, "rhs", 0.0, later[part.unknowns], mine)
    rim = mine[part.unknowns.tolist().index(at(system, "rim.v"))] / (RIM + RATIO**2 * sum(range(1, CARRIED + 1)))
    for k in range(CARRIED):
        assert later[at(system, f"node{k}.x")] == pytest.approx(y[at(system, f"node{k}.x")] + RATIO * 0.03)
        # its bond slips by as much as accelerates it as fast as its place on the rim
        assert f[at(system, f"node{k}.v")] / (k + 1) == pytest.approx(RATIO * rim)


def test_a_run_takes_such_a_part_at_once_and_gives_back_what_is_taken_along(wound, monkeypatch):
    """What lies on a rim cannot move by itself, so nothing has to be waited for; places and slopes follow the rim."""
    monkeypatch.setattr(parts, "LEAST", 1)
    system, y = wound()
    active = ActiveSubsystem(system.of, Run(stop=1.0), TABLEAUS[Run(stop=1.0).method])
    active.whole_problem.zones[:] = system.zones
    active.whole.array["y"][:] = y
    active.whole.number["t_release"] = np.inf
    active.whole.number["steps"] = 10
    active.restrict()
    assert active.part.sure
    mine = [system.unknown_names[k] for k in active.part.unknowns]
    active.memory.array["y"][mine.index("rim.x")] += 0.02
    for count, name in enumerate(SLOPES):
        active.memory.array[name][mine.index("rim.v")] = 1.0 + count
    found = active.finish()
    for k in range(CARRIED):
        x, v = at(system, f"node{k}.x"), at(system, f"node{k}.v")
        assert found.array["y"][x] == pytest.approx(y[x] + RATIO * 0.02)
        assert [found.array[name][v] for name in SLOPES] == pytest.approx(
            [RATIO * (1.0 + count) for count in range(len(SLOPES))]
        )

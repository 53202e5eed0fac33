"""A line on a drum as part of the drum: what is left of the equations, and that they are those of the whole."""

import numpy as np
import pytest

from fairlead.integrate import Run, integrate, parts
from fairlead.system.active import entrained
from fairlead.system.active.dependences import dependences, laws
from fairlead.system.active.entrained import nothing_entrained
from fairlead.system.compiled.asking import call, guards_at
from tests.models.test_carried import CLASSES, CONTROLLED, SCENE

PAIR = """
    components:
      a: {type: Mass, mass: 1 kg}
      spring: {type: Spring, stiffness: 100 N/m}
      b: {type: Mass, mass: 1 kg}
    connections: [[a.flange, spring.a], [spring.b, b.flange]]
    run: {stop: 1 s}
"""


@pytest.mark.parametrize(("ratio", "answering"), [(None, True), (0.5, True), (1.0, False)])
def test_a_spring_whose_ends_move_alike_answers_to_nothing(scene, ratio, answering):
    """Its ends are `ratio` times as far from where they were; None: each by itself."""
    system = scene(PAIR).system.instance()
    a, b = (system.unknown_names.index(name) for name in ("a.x", "b.x"))
    along = nothing_entrained(system)
    if ratio is not None:
        along.place[b], along.ratio[b] = a, ratio
    found = dependences(system, laws(system), along, guards_at(system, 0.0, np.zeros(system.n)))
    assert bool(np.isin(found.value_z, (a, b)).any()) == answering


@pytest.fixture
def wound(scene, library, monkeypatch):
    """wound(length) -> a route with all of a line but 6 m on the drum, 0.1 s after the start.

    The System, its time and its unknowns; and the part without what is deep on the drum.
    """
    monkeypatch.setattr(parts, "LEAST", 10**9)

    def make(length=40.0):
        text = SCENE.format(**CONTROLLED).replace("length: 40 m", f"length: {length} m")
        system = scene(text.replace("start: -34 m", f"start: {6 - length} m"), (library(CLASSES),)).system
        outcome = integrate(system, Run(stop=0.1))
        system = outcome.problem
        moving = system.subsystem.moving(outcome.t, outcome.y, 12, 0.5)
        return system, outcome.t, outcome.y, system.subsystem.part(outcome.t, outcome.y, moving)

    return make


def test_the_drum_has_the_inertia_of_what_lies_on_it(wound):
    part = wound()[-1]
    drum = [u.mass for u in part.problem.numbering.unknowns if u.mass > 15.0]
    carried = 2.0 * 0.25 * len(part.carried.groups)  # kg
    fastened = 2.0 * 0.25 / 2  # its end is part of the drum in any case
    assert drum == [pytest.approx(20.0 / 0.5**2 + carried + fastened)]  # seen at the rim


def test_less_is_left_out_than_lies_on_the_drum_by_the_margin(wound):
    """Of 136 nodes inboard of the drum's edge 24 may come off before the next look; the end is fastened."""
    part = wound()[-1]
    assert 136 - 24 - 2 <= len(part.carried.groups) <= 136 - 24


def test_what_is_left_does_not_depend_on_how_much_is_wound_on(wound):
    """Neither unknowns nor laws."""
    few, many = (wound(length)[-1].problem.n for length in (40.0, 160.0))
    assert few == many


def test_the_equations_of_the_part_are_those_of_the_whole_wherever_it_goes(wound):
    """With all that is kept displaced at random, and carried what is carried: rows of the whole, added up."""
    system, t, now, part = wound()
    chance = np.random.default_rng(7)
    for _ in range(3):
        y = now.copy()
        y[part.unknowns] += 1e-4 * chance.uniform(-1, 1, len(part.unknowns))
        whole = part.carried.aligned(system, t, y)
        call(system, "rhs", t, whole, np.zeros(system.n))
        rows = part.carried.added_up(system.memory["w"])
        f = np.zeros(part.problem.n)
        call(part.problem, "rhs", t, y[part.unknowns], f)
        kept = ~part.problem.quadrature
        np.testing.assert_allclose(f[kept], rows[part.unknowns][kept], rtol=1e-6, atol=1e-5)


def test_what_is_carried_gets_the_slip_with_which_its_bond_accelerates_it(wound):
    """Given back to the whole, a node deep on the drum has the acceleration of its place on the rim."""
    system, t, y, part = wound()
    part.prolong(t, y)
    f = np.zeros(system.n)
    call(system, "rhs", t, y, f)
    numbering = system.numbering
    rate = {g: f[numbering.rate[g]] / system.flat.groups[g].mass for g in part.carried.groups}
    torque = np.zeros(part.problem.n)
    call(part.problem, "rhs", t, y[part.unknowns], torque)
    drum = next(i for i, u in enumerate(part.problem.numbering.unknowns) if u.mass > 15.0)
    wanted = torque[drum] / part.problem.numbering.unknowns[drum].mass
    assert abs(wanted) > 1e-3
    np.testing.assert_allclose(list(rate.values()), wanted, rtol=1e-5)


TIED = '''
    class Tied(Component):
        """The bond of a node with a rim, up to a place."""

        node = Translational("the node")
        rim = Translational("the rim")
        place = Parameter("m", "Where it ends.")
        zones = Zones("stored", "free")
        carried = Carries("node", by="rim", zone="stored")

        @zone("stored")
        def on_rim(p, node, rim):
            """As fast as the rim."""
            force = 1e9 * (node.v - rim.v)
            return Law(node=force, rim=-force, dissipated=force * (node.v - rim.v))

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


    class Brushed(Component):
        """A damper on a node within a window."""

        node = Translational("the node")
        window = Table("m", "1", "Share of it that is brushed, over place.")

        def law(p, node):
            """In proportion to the share."""
            force = p.window(node.x) * node.v
            return Law(node=force, dissipated=force * node.v)

'''


def tied(size):
    """Sixty nodes, `size` apart, of which forty lie on a rim, and a brush a little outboard of that."""
    nodes = range(60)
    window = [f"{size * (45 + k)} m" for k in (0, 1, 3, 4)]
    parts = ["rim: {type: Mass, mass: 10 kg}"]
    joins = []
    for k in nodes:
        parts.append(f"node{k}: {{type: Mass, mass: 1 kg, position: {size * k} m}}")
        parts.append(f"bond{k}: {{type: Tied, place: {size * 39.5} m}}")
        parts.append(f"brush{k}: {{type: Brushed, window: {{x: {window}, y: [0, 1, 1, 0]}}}}")
        joins.append(f"[rim.flange, bond{k}.rim]")
        joins.append(f"[node{k}.flange, bond{k}.node, brush{k}.node]")
    for k in nodes[1:]:
        parts.append(f"spring{k}: {{type: Spring, stiffness: 100 N/m, free_length: {size} m}}")
        joins.append(f"[node{k - 1}.flange, spring{k}.a]")
        joins.append(f"[spring{k}.b, node{k}.flange]")
    lines = ["components:", *(f"  {one}" for one in parts), "connections:", *(f"  - {one}" for one in joins)]
    return "\n".join([*lines, "run: {stop: 1 s}"]).replace("'", "")


def partition(system, speed):
    """Names of the unknowns that stay, of what is monitored and of the laws that act, all at one speed."""
    begin = system.instance()
    y = begin.initial.copy()
    y[[v for _, v in begin.numbering.pairs]] = speed
    for block in begin.blocks:  # every bond in the zone it is in by its place
        if block.kernel.variant.type.__name__ == "Tied":
            place = block.kernel.structure.inputs.index("port:node:x")
            inside = y[block.in_index[:, place]] < block.parameters[:, block.kernel.structure.parameters.index("place")]
            begin.zones[block.machines[:, 0]] = np.where(inside, 0, 1)
    moving = begin.subsystem.moving(0.0, y, 12, 0.5)

    def named(chosen):
        """Paths of these instances, block after block."""
        pairs = zip(begin.blocks, chosen, strict=True)
        return [block.instances[i].path for block, some in pairs for i in np.flatnonzero(some).tolist()]

    return np.array(begin.unknown_names)[moving.kept].tolist(), named(moving.laws), named(moving.watched)


@pytest.mark.slow
def test_what_is_left_depends_neither_on_the_size_of_a_scene_nor_on_its_speed(scene, library, monkeypatch):
    """Nodes a millimetre, a quarter of a metre, and a hundred metres apart, at rest and at 50 m/s."""
    monkeypatch.setattr(entrained, "KEPT_FREE", 4)
    found = [
        partition(scene(tied(size), (library(TIED),)).system, speed)
        for size, speed in ((0.25, 0.8), (0.25, 50.0), (0.25, 0.0), (1e-3, 0.8), (100.0, 50.0))
    ]
    kept, laws, monitored = found[0]
    assert "node35.x" not in kept
    assert "node36.x" in kept
    assert {"spring36", "spring59", "brush47"} <= set(laws)
    assert not {"spring35", "bond12"} & set(laws)
    assert monitored
    for other in found[1:]:
        assert other == found[0]

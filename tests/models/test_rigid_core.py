"""A core that does not stretch: one body with one motion whose tensions are still told; the limit of a stiff one."""

import itertools
import math

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError

TRAIN = """
    components:
      a: {type: Mass, mass: 1 kg, position: 0 m}
      b: {type: Mass, mass: 2 kg}
      c: {type: Mass, mass: 3 kg}
      ab: {type: RigidCore, length: 1 m}
      bc: {type: RigidCore, length: 2 m}
      MOVER
      floor: {type: Ground}
      pad: {type: Contact, normal_force: 10 N, curve: 0.2}
    connections:
      - [a.flange, ab.a, pad.b]
      - [ab.b, b.flange, bc.a]
      - [bc.b, c.flange, mover.flange]
      - [pad.a, floor.flange]
    friction: {method: hold}
    run: {stop: 1 s, accuracy: 1e-8}
    record: {every: 50 ms, signals: [ab.tension, bc.tension, c.v, c.x, a.x]}
"""
MASSES, FRICTION = (1.0, 2.0, 3.0), 2.0  # kg, N
BEND = """
    components:
      line:
        type: ArrayModule
        length: 8 m
        element: 0.25 m
        start: 1.5 m
        tension: 800 N
        hose: {mass: 1.6 kg/m, stiffness: 8 kN, damping_ratio: 0.5}
        core: {mass: 4.2 kg/m, stiffness: 500 kN, damping_ratio: 0.5}
        bulkhead_friction: BULKHEADS
      route: {type: Route, stations: [{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: MU}]}
      haul: {type: MotionSource, velocity: {ramp: {to: -0.05 m/s, over: 2 s}}}
      tow: {type: ForceSource, force: 800 N}
    connections: [[haul.flange, line.inboard], [tow.flange, line.outboard], [line.path, route.path]]
    friction: {method: hold}
    run: {stop: 4 s, accuracy: 1e-6}
    record: {every: 20 ms, signals: [haul.force, "line.registration[*].d", "line.hose[*].tension",
             "line.core[*].tension", "line.core_node[*].v"]}
"""
OFF = {"effects.core_stretch": "off"}
ELEMENTS, TOWED, ANGLE = 32, 800.0, math.pi / 2


def bend(mu=0.6, bulkheads=0.4):
    return BEND.replace("MU", str(mu)).replace("BULKHEADS", str(bulkheads))


def mean(result, name, begin=2.5):
    """Mean over time of a signal from `begin` on, in steady motion."""
    t, y = np.asarray(result.t), np.asarray(result[name])
    there = t >= begin
    return np.trapezoid(y[there], t[there]) / (t[there][-1] - t[there][0])


def end_and_means(result):
    """What a haul comes to: registrations and hose tensions at its end, mean tensions of the core and of the haul."""
    ends = [result[f"line.registration[{k}].d"][-1] * 1e3 for k in range(1, ELEMENTS)]
    hose = [result[f"line.hose[{k}].tension"][-1] for k in range(ELEMENTS)]
    core = [mean(result, f"line.core[{k}].tension") for k in range(ELEMENTS)]
    return np.array(ends), np.array(hose), np.array([*core, mean(result, "haul.force")])


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
@pytest.mark.parametrize(
    ("mover", "acceleration"),
    [("ForceSource, force: 14 N", (14.0 - FRICTION) / sum(MASSES)),
     ("MotionSource, velocity: {ramp: {to: 3 m/s, over: 2 s}}", 1.5)],
)  # fmt: skip
def test_every_link_carries_what_the_bodies_behind_it_take(simulate, mover, acceleration, engine):
    text = TRAIN.replace("MOVER", f"mover: {{type: {mover}}}")
    if "Motion" in mover:  # nothing may hold exactly between the floor and what is given
        text = text.replace("method: hold", "method: binding")
    result = simulate(text, **{"run.engine": engine})
    behind = (MASSES[0], MASSES[0] + MASSES[1])
    for link, mass in zip(("ab", "bc"), behind, strict=True):
        assert result[f"{link}.tension"][-1] == pytest.approx(FRICTION + mass * acceleration, rel=1e-6)
    assert result["c.v"][-1] == pytest.approx(acceleration, rel=1e-6)
    assert np.ptp(result["c.x"] - result["a.x"]) < 1e-12


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
def test_a_core_hauled_over_a_bend_pulls_by_the_capstan_law(simulate, engine):
    mu, nodes = 0.3, 6  # about: a bend of 1.57 m and elements of 0.25 m
    result = simulate(bend(mu, bulkheads=2.0), **OFF, **{"run.engine": engine})
    inboard, outboard = mean(result, "line.core[0].tension"), mean(result, f"line.core[{ELEMENTS - 1}].tension")
    hose = mean(result, "line.hose[0].tension"), mean(result, f"line.hose[{ELEMENTS - 1}].tension")
    assert outboard + hose[1] == pytest.approx(TOWED, rel=1e-6)
    of_mesh = nodes * (mu * ANGLE / nodes) ** 3 / 12  # docs/physics.md, 8 item 9
    ripple = 2e-3  # of the trapezoid windows of docs/physics.md, 4.0, as nodes pass
    assert (inboard + hose[0]) / TOWED == pytest.approx(math.exp(mu * ANGLE), rel=of_mesh + ripple)


def test_a_stiff_core_goes_to_one_that_does_not_stretch_as_one_over_its_stiffness(simulate):
    """Hauled over a bend on which the hose parts from it: ten times as stiff, a tenth of what is left."""
    limit = end_and_means(simulate(bend(), **OFF))
    left = []
    for times in (10, 100, 1000):
        near = end_and_means(simulate(bend(), **{"line.core.stiffness": f"{500 * times} kN"}))
        left.append([np.abs(one - its).max() for one, its in zip(near, limit, strict=True)])
    for before, after in itertools.pairwise(left):
        for far, nearer in zip(before[:2], after[:2], strict=True):  # registrations [mm], hose tensions [N]
            assert 8 < far / nearer < 12.5
    assert [gap[2] < share * TOWED for gap, share in zip(left, (1e-2, 1e-3, 3e-4), strict=True)] == [True] * 3


def test_the_core_has_one_motion_and_fewer_unknowns(scene):
    free = bend().replace("haul: {type: MotionSource, velocity: {ramp: {to: -0.05 m/s, over: 2 s}}}",
                          "haul: {type: ForceSource, force: -800 N}")  # fmt: skip
    on, off = scene(free).system, scene(free, **OFF).system
    # of 33 places and speeds of the core one of each is left, and 32 tensions and one acceleration come
    circles = sum(unknown.kind == "share" for unknown in off.numbering.unknowns)
    assert on.n - (off.n - circles) == 2 * (ELEMENTS + 1) - (2 + ELEMENTS + 1)
    moving = [one.name for one in off.numbering.unknowns if "core_node" in one.name and one.kind == "rate"]
    assert len(moving) <= 1


@pytest.mark.slow
def test_energy_adds_up(simulate):
    result = simulate(bend(), **OFF)
    assert result.run["energy"]["closure"] < 1e-6


@pytest.mark.slow
def test_other_masses_are_those_of_a_model_read_anew(scene):
    text = bend()
    changed = scene(text, **OFF).with_values({"line.core.mass": "6 kg/m"}).run(out=None)
    anew = scene(text, **OFF, **{"line.core.mass": "6 kg/m"}).run(out=None)
    for name in ("haul.force", "line.core[5].tension"):
        assert changed[name][-1] == pytest.approx(anew[name][-1], rel=1e-9)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (TRAIN.replace("MOVER", "mover: {type: ForceSource, force: 1 N}\n      ac: {type: RigidCore, length: 3 m}")
         .replace("[pad.a, floor.flange]", "[pad.a, floor.flange]\n      - [a.flange, ac.a]\n      - [c.flange, ac.b]"),
         "closes a ring of rigid links"),
        (TRAIN.replace("MOVER", "mover: {type: Ground}")
         .replace("pad: {type: Contact, normal_force: 10 N, curve: 0.2}", "")
         .replace("[a.flange, ab.a, pad.b]", "[a.flange, ab.a, floor.flange]").replace("- [pad.a, floor.flange]", ""),
         "between two places whose motion is given"),
        (bend().replace("length: 8 m", "length: 8 m\n        modules: 2\n        effects: {core_stretch: off}"),
         "its modules have connectors in between"),
        (bend().replace("friction: 0.6}", "friction: 0.6}, {type: Tensioner, force: 100 N}")
         .replace("length: 8 m", "length: 8 m\n        effects: {core_stretch: off}"),
         "cannot run through route.tensioner"),
    ],
)  # fmt: skip
def test_what_no_core_without_stretch_can_do_is_refused_by_name(scene, text, said):
    with pytest.raises(ModelError, match=said):
        scene(text).system  # noqa: B018 - compiled here


ROPE = """
    components:
      rope: {type: Cable, length: 8 m, element: 0.25 m, start: 1.5 m, tension: 800 N, mass: 2 kg/m, stiffness: 5 MN,
             damping_ratio: 0.5, compression: PUSHES}
      route: {type: Route, stations: [{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: 0.3}]}
      haul: {type: MotionSource, velocity: {ramp: {to: -0.05 m/s, over: 2 s}}}
      sling: {type: SpringDamper, stiffness: 200 kN/m, damping: 2 kN*s/m, free_length: 1496 mm}  # 800 N
      tow: {type: ForceSource, force: 800 N}
    connections: [[haul.flange, sling.a], [sling.b, rope.inboard], [tow.flange, rope.outboard], [rope.path, route.path]]
    run: {stop: 4 s, accuracy: 1e-6}
    record: {every: 20 ms, signals: [haul.force, "rope.line[*].tension", "rope.node[*].x", "rope.node[*].v"]}
"""
UNSTRETCHED = {"effects.line_stretch": "off"}


def rope(pushes="none"):
    return ROPE.replace("PUSHES", pushes)


@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
@pytest.mark.parametrize("pushes", ["none", "carried"])
def test_a_rope_that_does_not_stretch_pulls_by_the_capstan_law_and_keeps_its_length(simulate, pushes, engine):
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = simulate(rope(pushes), **UNSTRETCHED, **{"run.engine": engine})
    inboard, outboard = mean(result, "rope.line[0].tension"), mean(result, f"rope.line[{ELEMENTS - 1}].tension")
    assert outboard == pytest.approx(TOWED, rel=1e-6)
    of_mesh, ripple = 6 * (0.3 * ANGLE / 6) ** 3 / 12, 2e-3  # as of the core above
    assert inboard / TOWED == pytest.approx(math.exp(0.3 * ANGLE), rel=of_mesh + ripple)
    assert np.ptp(result[f"rope.node[{ELEMENTS}].x"] - result["rope.node[0].x"]) < 1e-12
    assert result.run["energy"]["closure"] < 1e-5


@pytest.mark.slow
def test_a_stiff_rope_goes_to_one_that_does_not_stretch_as_one_over_its_stiffness(simulate):
    """By how much the rope is longer than at its start, in steady motion; and what the haul takes is the same."""
    limit, longer = mean(simulate(rope(), **UNSTRETCHED, **{"run.engine": "stepping"}), "haul.force"), []
    for times in (1, 10, 100):
        near = simulate(rope(), **{"rope.stiffness": f"{5 * times} MN"})
        longer.append(mean(near, f"rope.node[{ELEMENTS}].x") - mean(near, "rope.node[0].x") - 8.0)
        assert mean(near, "haul.force") == pytest.approx(limit, rel=2e-3)  # ripple, as above
    assert longer[0] / longer[1] == pytest.approx(10, rel=0.02)
    assert longer[1] / longer[2] == pytest.approx(10, rel=0.02)


def test_a_rope_that_does_not_stretch_has_one_motion(scene):
    on, off = scene(rope()).system, scene(rope(), **UNSTRETCHED).system
    kinds = ("rate", "position")
    moving = [one.name for one in off.numbering.unknowns if "rope.node" in one.name and one.kind in kinds]
    assert len(moving) <= 2
    assert on.n - off.n >= ELEMENTS - 2  # of 2 * 33 places and speeds one each is left, 32 tensions and a rate come


@pytest.mark.parametrize(
    ("text", "effects"),
    [(bend(), {"effects.core_stretch": "off", "effects.hose_core_slip": "off"}),
     (rope().replace("[haul.flange, sling.a], [sling.b, rope.inboard]", "[haul.flange, rope.inboard]")
      .replace("sling:", "# sling:"), UNSTRETCHED)],
)  # fmt: skip
def test_a_line_of_one_body_whose_motion_is_given_is_refused(scene, text, effects):
    """Its friction was left out, and the haul pulled with what tows."""
    said = r"_stretch is off and its motion is given: it is one body, which no friction could hold back"
    with pytest.raises(ModelError, match=said):
        scene(text, **effects).system  # noqa: B018 - compiled here


def test_a_rope_that_does_not_stretch_does_not_run_through_a_tensioner(scene):
    text = rope().replace("friction: 0.3}", "friction: 0.3}, {type: Tensioner, start: 6 m, force: 100 N}")
    with pytest.raises(ModelError, match=r"line_stretch is off, and a line that does not stretch cannot run through"):
        scene(text, **UNSTRETCHED).system  # noqa: B018 - compiled here


def test_a_core_that_pushes_is_told(simulate):
    """Hauled from both ends, the one behind faster: between them it is pressed together by what rubs on it."""
    text = """
    components:
      behind: {{type: MotionSource, velocity: 0.1 m/s}}
      first: {{type: RigidCore, length: 1 m}}
      second: {{type: RigidCore, length: 1 m}}
      body: {{type: Mass, mass: 1 kg}}
      rubs: {{type: Damper, damping: {damping} N*s/m}}
      end: {{type: Mass, mass: 1 kg}}
      pull: {{type: ForceSource, force: 2 N}}
      floor: {{type: Ground}}
    connections: [[behind.flange, first.a], [first.b, body.flange, rubs.b, second.a], [rubs.a, floor.flange],
                  [second.b, end.flange, pull.flange]]
    run: {{stop: 1 s, accuracy: 1e-6}}
    """
    with pytest.warns(fairlead.RunWarning, match=r"first pushes with 1 N at t = .*: a core pushes only"):
        found = simulate(text.format(damping=30)).run["pushes"]
    assert (found["component"], found["count"]) == ("first", 1)
    assert found["most"] == pytest.approx(1.0, rel=1e-6)  # 2 N pull, and 30 * 0.1 N are lost behind
    assert simulate(text.format(damping=10)).run["pushes"] is None

"""Arrays in modules, with discrete bulkheads, and hose that rucks."""

import math

import numpy as np
import pytest

from tests.reference.capstan import tension_ratio


def array(more="", friction=0.35):
    """Two modules hauled round a bend."""
    return f"""
components:
  line:
    type: ArrayModule
    length: 12 m
    element: 0.125 m
    start: 1 m
    tension: 400 N
    hose: {{mass: 1.6 kg/m, stiffness: 8 kN}}
    core: {{mass: 4.2 kg/m, stiffness: 200 kN}}
    bulkhead_friction: 0.6
    {more}
  route: {{type: Route, stations: [{{type: Bend, start: 3.5 m, angle: 90 deg, radius: 1 m, friction: {friction}}}]}}
  haul: {{type: MotionSource, velocity: {{ramp: {{to: -0.3 m/s, over: 1 s}}}}}}
  tow: {{type: ForceSource, force: 400 N}}
connections:
  - [haul.flange, line.inboard]
  - [tow.flange, line.outboard]
  - [line.path, route.path]
run: {{stop: 5 s}}
record: {{every: 20 ms}}
"""


def haul(result):
    """Mean force of the haul [N] over time when it runs steadily."""
    return -result["haul.force"][np.searchsorted(result.t, np.arange(2.5, 5.0, 0.02))].mean()


@pytest.mark.slow
def test_modules_are_joined_by_connectors_in_which_hose_and_core_are_one(simulate):
    result = simulate(array("modules: 2"))
    np.testing.assert_allclose(result["line.hose_node[48].x"], result["line.core_node[48].x"])
    assert "line.registration[48].d" not in result
    assert haul(result) == pytest.approx(400 * tension_ratio(0.35, math.pi / 2), rel=0.01)


def test_bulkheads_at_a_pitch_carry_the_hose_along_as_smeared_ones_do(simulate):
    smeared, pitched = (simulate(array(f"modules: 2\n    {more}")) for more in ("", "bulkhead_pitch: 0.5 m"))
    assert len(pitched.match("line.inner[*].slip")) == 2 * (12 - 1)
    assert len(smeared.match("line.inner[*].slip")) == 2 * (48 - 1)
    assert haul(pitched) == pytest.approx(haul(smeared), rel=0.01)
    slip = [np.abs(r.columns(r.match("line.registration[*].d"))).max() for r in (smeared, pitched)]
    assert slip[1] < 0.02
    assert slip[0] < 0.02


def squeezed(softening):
    """A short hose between a wall and a hand that pushes, pulls back and pushes on; slow, so that it is at rest."""
    return f"""
components:
  wall: {{type: Ground}}
  hose: {{type: RuckingHose, axial_stiffness: 8 kN, length: 1 m, limit: 160 N, softening: {softening}}}
  hand: {{type: MotionSource, position: {{table: {{t: [0 s, 4 s, 6 s, 10 s], y: [1 m, 0.96 m, 0.97 m, 0.95 m]}}}}}}
connections:
  - [wall.flange, hose.a]
  - [hand.flange, hose.b]
run: {{stop: 10 s, accuracy: 1e-6}}
record: {{every: 50 ms}}
"""


@pytest.mark.slow
def test_a_hose_that_rucks_softens_and_unloads_along_the_elastic_line(simulate):
    result = simulate(squeezed(0.05))

    def tension(t):
        return result["hose.tension"][np.searchsorted(result.t, t - 1e-9)]

    k, limit = 8000.0, 160.0
    lowest = -limit - 0.05 * k * 0.02  # 2 % beyond the limit strain at 5 % of the stiffness
    assert tension(1.0) == pytest.approx(-k * 0.01, rel=1e-6)
    assert tension(4.0) == pytest.approx(lowest, rel=1e-6)
    assert tension(6.0) == pytest.approx(lowest + k * 0.01, rel=1e-6)
    assert tension(10.0) == pytest.approx(lowest - 0.05 * k * 0.01, rel=1e-6)


def test_the_work_of_rucking_is_accounted_for(simulate):
    assert simulate(squeezed(0.05)).run["energy"]["closure"] < 1e-6


def test_a_watched_hose_tells_when_and_how_long_it_is_compressed_beyond_the_limit(simulate):
    text = squeezed(0.05).replace("RuckingHose", "WatchedHose").replace(", softening: 0.05", "")
    result = simulate(text)
    switched = [(event.t, event.zone_to) for event in result.events if event.component == "hose"]
    assert [to for _, to in switched] == ["beyond"]
    assert switched[0][0] == pytest.approx(2.0, abs=1e-6)  # 2 % strain is 160 N


@pytest.fixture(scope="module")
def hauls():
    """Forces of the haul by the effects that are on or off, each found once."""
    return {}


def moved(simulate, hauls, **effects):
    """Force of the haul with effects on or off."""
    switches = ", ".join(f"{name}: {word}" for name, word in effects.items())
    if switches not in hauls:
        hauls[switches] = haul(simulate(array("modules: 2", friction=0.3) + f"effects: {{{switches}}}\n"))
    return hauls[switches]


def unknowns(scene, **effects):
    switches = ", ".join(f"{name}: {word}" for name, word in effects.items())
    return scene(array("modules: 2", friction=0.3) + f"effects: {{{switches}}}\n").system


@pytest.mark.slow
def test_hose_and_core_as_one_body_have_half_the_unknowns_and_no_inner_contacts(scene):
    two, one = unknowns(scene), unknowns(scene, hose_core_slip="off")
    assert one.n == two.n - 3 * (96 + 1 - 3)  # place and speed of a node, and the force that holds its bulkhead
    assert not [instance for instance in one.flat.instances if ".inner" in instance.path]


@pytest.mark.slow
def test_below_the_threshold_of_slip_they_are_the_limit_of_two(simulate, hauls):
    assert moved(simulate, hauls, hose_core_slip="off") == pytest.approx(moved(simulate, hauls), rel=0.005)


def test_a_core_that_may_push_has_no_zones(scene):
    assert not [name for name in unknowns(scene, tension_only_core="off").machine_names if ".core[" in name]
    assert [name for name in unknowns(scene).machine_names if ".core[" in name]


def test_in_tension_it_is_the_same_core(simulate, hauls):
    assert moved(simulate, hauls, tension_only_core="off") == pytest.approx(moved(simulate, hauls), rel=1e-3)

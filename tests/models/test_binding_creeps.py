"""What the binding law costs: a contact that sticks creeps, leaks its load and breaks away late.

All three follow from one number, the slope g0 of friction over slip while the contact binds, and all
three are known exactly (`tests/reference/creep.py`; physics section 8, items 1 to 3).
"""

import numpy as np
import pytest

from tests.reference.creep import BoundContact

HELD_BLOCK = """
    parameters: {load: 3 N, creep: 0.1 mm/s, viscous: 0 N*s/m}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      push: {type: ForceSource, force: "{load}"}
      pad:
        type: Contact
        method: binding
        creep: "{creep}"
        normal_force: 10 N
        curve: {curve: stribeck, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
"""

PRELOADED_SPRING = """
    parameters: {creep: 0.1 mm/s}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 0.4 kg, position: 0 m}
      spring: {type: Spring, stiffness: 1e4 N/m, free_length: -4 mm}
      pad: {type: Contact, method: binding, creep: "{creep}", normal_force: 100 N, curve: 0.5}
    connections: [[ground.flange, pad.a, spring.a], [pad.b, block.flange, spring.b]]
    run: {stop: 10 s, accuracy: 1e-8}
    record: {every: 1 s}
"""


def bound(creep: float) -> BoundContact:
    """The contact of the block test: 5 N of stiction; the Stribeck curve has fallen a little at v_n = 4 creep."""
    edge = 10.0 * (0.3 + 0.2 * np.exp(-((4.0 * creep / 5e-3) ** 2)))
    return BoundContact(stiction=5.0, creep_speed=creep, sliding_at_edge=edge)


@pytest.mark.parametrize("creep", [1e-4, 1e-5])
@pytest.mark.parametrize("load", [0.5, 3.0, 4.9])
def test_a_held_block_creeps_at_the_load_over_the_slope(simulate, creep: float, load: float) -> None:
    result = simulate(HELD_BLOCK, creep=f"{creep} m/s", load=f"{load} N")
    # Getting there takes m/g0, some 20 microseconds: nothing is left of it after a second.
    assert result["pad.slip"][-1] == pytest.approx(float(bound(creep).creep(load)), rel=1e-6)
    assert result["pad.friction"][-1] == pytest.approx(load, rel=1e-6)


def test_creep_is_told_by_the_closing_table(simulate) -> None:
    result = simulate(HELD_BLOCK)
    worst = result.run["worst_creep"]
    assert worst["contact"] == "pad"
    assert worst["value"] == pytest.approx(float(bound(1e-4).creep(3.0)), rel=1e-6)


@pytest.mark.parametrize("creep", [1e-4, 1e-5])
def test_a_stuck_contact_leaks_the_load_of_a_spring(simulate, creep: float) -> None:
    result = simulate(PRELOADED_SPRING, creep=f"{creep} m/s")
    contact = BoundContact(stiction=50.0, creep_speed=creep)
    exact = contact.leaked_load(40.0, 1e4, result.t)
    # Leaving out the mass, as the closed form does, changes the load by m k/g0^2 < 2e-8 of itself.
    np.testing.assert_allclose(result["spring.tension"], exact, rtol=1e-6)
    assert exact[-1] / exact[0] == pytest.approx({1e-4: 0.852, 1e-5: 0.984}[creep], abs=1e-3)  # hazard H5


@pytest.mark.parametrize(("creep", "published"), [(1e-4, 1.00080), (1e-5, 1.00008)])
def test_the_pulled_block_breaks_away_late_by_what_it_crept(bundled, creep: float, published: float) -> None:
    result = bundled("block_and_spring", {"creep": f"{creep} m/s", "run.stop": "2 s"})
    first = result.events[0]
    assert (first.component, first.zone_from, first.zone_to) == ("pad", "plateau", "break_forward")
    exact = bound(creep).breakaway_time(stiffness=100.0, speed=0.05)
    # The closed form leaves out the mass: the spring ends v_d m/g0 further back, in time m/g0 <= 16 microseconds
    # while the load rises, less than 1e-7 s of it at breakaway. The published numbers are rounded to 1e-5 s.
    assert first.t == pytest.approx(exact, abs=1e-7)
    assert first.t == pytest.approx(published, abs=1e-5)


def test_the_held_block_does_not_creep_and_breaks_away_in_time(bundled) -> None:
    result = bundled("block_and_spring", {"method": "hold", "run.stop": "2 s"})
    before = result.t < 1.0
    assert result.events[0].t == pytest.approx(1.0, abs=1e-9)  # F_s/(k v_d), to rounding
    assert np.abs(result["pad.slip"][before]).max() < 1e-12
    assert result["spring.tension"][before] == pytest.approx(result["pad.friction"][before], abs=1e-9)


def test_the_spring_lets_the_block_go_at_stiction(bundled) -> None:
    """However slow the creep: friction itself reaches F_s = 5 N at breakaway, and never more."""
    result = bundled("block_and_spring", {"creep": "1e-4 m/s", "run.stop": "2 s"})
    assert result.at("spring.tension", result.events[0].t) == pytest.approx(5.0, abs=1e-4)
    assert result["pad.friction"].max() <= 5.0 * (1 + 1e-12)


@pytest.mark.parametrize("share", [0.5, 0.85, 0.95, 0.995])
def test_sloping_faces_let_the_creep_grow_as_the_load_nears_stiction(simulate, share: float) -> None:
    """From (1 - face) F_s on  T = F_s u (1 + face/b)/(face + u),  u = v/creep, b = v_n/creep = 4; below, T = g0 v."""
    face, width = 0.1, 4.0
    text = HELD_BLOCK.replace("creep}\"", "creep}\"\n        face: 0.1", 1).replace(
        "{curve: stribeck, stiction: 0.5, coulomb: 0.3, velocity: 5 mm/s}", "0.5"
    )
    result = simulate(text, load=f"{share * 5} N")
    steep, sloping = share / (1 + 1 / width), share * face / (1 + face / width - share)
    exact = 1e-4 * (steep if share <= 1 - face else sloping)
    assert result["pad.slip"][-1] == pytest.approx(exact, rel=1e-6)


def test_sloping_faces_break_away_at_stiction_and_not_above(simulate) -> None:
    text = HELD_BLOCK.replace("creep}\"", "creep}\"\n        face: 0.2", 1)
    text = text.replace('force: "{load}"', "force: {ramp: {to: 6 N, over: 1 s}}")
    result = simulate(text)
    assert result["pad.friction"].max() <= 5.0 * (1 + 1e-9)
    first = next(event for event in result.events if event.zone_to in ("slide_forward", "break_forward"))
    assert 4.9 < result.at("push.force", first.t) <= 5.0 + 1e-6

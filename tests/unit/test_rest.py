"""What rests as long as what holds goes on holding: said by hand for scenes small enough to see it."""

import numpy as np
import pytest

from fairlead.system.active.rest import anatomy, at_rest, leaning_on

STACK = """
    components:
      floor: {type: Ground}
      low: {type: Mass, mass: 2 kg}
      high: {type: Mass, mass: 1 kg}
      under: {type: Contact, normal_force: 30 N, curve: 0.5}
      between: {type: Contact, normal_force: 10 N, curve: 0.5}
      spring: {type: Spring, stiffness: 100 N/m}
      free: {type: Mass, mass: 1 kg}
    connections:
      - [floor.flange, under.a]
      - [under.b, low.flange, between.a]
      - [between.b, high.flange, spring.a]
      - [spring.b, free.flange]
    friction: {method: hold}
    run: {stop: 1 s}
"""


def resting(system, *held):
    """Names of the unknowns that rest while these contacts hold and the others slide."""
    names = system.machine_names
    for place, (machine, zone) in zip(system.memory["holds"][:, 0], system.memory["holds"], strict=True):
        system.zones[place] = zone if names[machine] in held else (1 if zone != 1 else 0)
    found = at_rest(anatomy(system), system, np.zeros(system.n))
    return {system.unknown_names[k] for k in np.flatnonzero(found.still)}, found


def test_a_stack_rests_while_both_of_its_contacts_hold(scene):
    """The upper block's contact carries the swinging load, and the lower one's both: their forces vary."""
    still, _ = resting(scene(STACK).system.instance(), "under", "between")
    assert still == {"low.x", "low.v", "high.x", "high.v"}


def test_nothing_rests_on_what_slides(scene):
    """The upper block holds on the lower one; if that slides, both move."""
    assert resting(scene(STACK).system.instance(), "between")[0] == set()
    assert resting(scene(STACK).system.instance(), "under")[0] == {"low.x", "low.v"}


def test_without_the_swinging_load_the_forces_rest_too(scene):
    """Then every contact carries what it carries."""
    text = STACK.replace(", spring.a]\n      - [spring.b, free.flange]", "]")
    text = text.replace("      spring: {type: Spring, stiffness: 100 N/m}\n      free: {type: Mass, mass: 1 kg}\n", "")
    still, _ = resting(scene(text).system.instance(), "under", "between")
    assert still >= {"low.x", "low.v", "high.x", "high.v", "under.force", "between.force"}


def test_what_a_block_at_rest_leans_on_is_all_that_holds_it(scene):
    """The upper block rests on both contacts, the lower one on its own alone."""
    system = scene(STACK).system.instance()
    _, found = resting(system, "under", "between")
    for name, contacts in (("high.v", {"under", "between"}), ("high.x", {"under", "between"}), ("low.x", {"under"})):
        which = np.array([unknown == name for unknown in system.unknown_names])
        leans = leaning_on(found, which, len(system.zones))
        assert {system.machine_names[k] for k in np.flatnonzero(leans)} == contacts


@pytest.mark.parametrize(
    ("belt", "rests"), [("{type: Ground}", True), ("{type: MotionSource, velocity: 0.1 m/s}", False)]
)
def test_a_block_carried_along_does_not_rest(scene, belt, rests):
    """On ground it does; on a belt it moves with the belt."""
    text = f"""
        components:
          belt: {belt}
          block: {{type: Mass, mass: 1 kg}}
          pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
        connections:
          - [belt.flange, pad.a]
          - [pad.b, block.flange]
        friction: {{method: hold}}
        run: {{stop: 1 s}}
    """
    assert ("block.v" in resting(scene(text).system.instance(), "pad")[0]) == rests


def test_a_speed_that_is_not_zero_does_not_rest(scene):
    """A contact that has just caught a block with a slip left over proves nothing."""
    system = scene(STACK).system.instance()
    resting(system, "under", "between")
    y = np.zeros(system.n)
    y[system.unknown_names.index("low.v")] = 1e-3
    assert not at_rest(anatomy(system), system, y).still.any()

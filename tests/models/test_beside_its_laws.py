"""`stepping` asked for by name remarks on laws it is not made for; `auto`, and other engines, say nothing."""

import pytest

BELT = """
    components:
      ground: {type: Ground}
      weight: {type: Mass, mass: 1 kg}
      pull: {type: ForceSource, force: 1 N}
      rub: {type: Contact, normal_force: 10 N, CONTACT}
    connections:
      - [ground.flange, rub.a]
      - [weight.flange, rub.b, pull.flange]
    run: {stop: 0.1 s, engine: ENGINE}
    """
LEVEL, FALLING = "curve: 0.3", "curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}"


@pytest.mark.parametrize(
    ("contact", "said"),
    [
        (LEVEL, ""),
        (FALLING, "rub falls there"),
        (f"{FALLING}, method: karnopp", "rub falls there"),
        (f"{LEVEL}, method: binding", "rub turn inside its steps"),
        (f"{LEVEL}, method: lugre", "rub turn inside its steps"),
        (f"{LEVEL}, method: tanh", ""),
    ],
)
def test_what_creeps_or_falls_is_named_with_the_way_out(scene, contact, said):
    text = BELT.replace("CONTACT", contact)
    found = scene(text.replace("ENGINE", "stepping")).check()
    assert bool(found) == bool(said)
    assert all(said in fault.what and "run.engine: rodas" in str(fault) for fault in found)
    assert not scene(text.replace("ENGINE", "auto")).check()
    assert not scene(text.replace("ENGINE", "rodas")).check()

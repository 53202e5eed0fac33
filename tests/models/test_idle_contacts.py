"""Contacts that are idle ask for no steps of their own: those that stand still together, and those that are off.

What they cost within a step is measured by benchmarks/idle_contacts.py; here only counts are judged.
"""

import pytest

STANDING = """
    components:
      rod: {type: RodOnGuides, blocks: N, mass: M kg, axial_stiffness: K N, damping_time: 0.002 s, friction: F N}
      hook: {type: SpringDamper, stiffness: 2000 N/m, damping: 4 N*s/m}
      hand: {type: MotionSource, position: {sine: {amplitude: 2.7 mm, frequency: 1 Hz}}}
    connections:
      - [rod.end, hook.a]
      - [hook.b, hand.flange]
    friction: {method: hold}
    run: {stop: 2 s, accuracy: 1e-4}
    record: {signals: [hook.tension]}
"""


def standing(blocks):
    """A rod whose blocks and springs are the same however many there are."""
    given = {"N,": f"{blocks},", "M kg": f"{0.1 * blocks} kg", "K N": f"{1e6 / blocks} N", "F N": f"{0.5 * blocks} N"}
    text = STANDING
    for word, value in given.items():
        text = text.replace(f": {word}", f": {value}")
    return text


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_blocks_that_stand_still_together_add_no_steps_no_switches_and_no_factorisations(simulate, engine):
    """The pull of 5.4 N at most moves ten blocks of 0.5 N; the others hold, sixty of them or a thousand.

    For four seconds: in stepping what moves of the many is a part, which begins with no row known (known_rows.py) and
    evaluates f until they are.
    """
    few, many = (simulate(standing(n), **{"run.engine": engine, "run.stop": "4 s"}) for n in (60, 1000))
    if engine == "rodas":  # stepping guesses how far a front runs, and takes some guesses back
        moved = {int(e.component.removeprefix("rod.guide[")[:-1]) - 1000 for e in many.events if e.t > 0}
        assert moved == {int(e.component.removeprefix("rod.guide[")[:-1]) - 60 for e in few.events if e.t > 0}
        assert moved == set(range(-10, 0))
    for name in ("steps", "rhs", "factorisations", "solves", "switches"):
        assert many.run["counters"][name] == pytest.approx(few.run["counters"][name], rel=0.15), name


@pytest.mark.parametrize("method", ["hold", "binding"])
def test_contacts_that_nothing_presses_add_no_steps_and_no_switches(scene, simulate, method):
    """All contacts of a block are off but one; off, they are the same scene with more of the same zone."""
    text = """
        components:
          floor: {type: Ground}
          spring: {type: Spring, stiffness: 100 N/m}
          hand: {type: MotionSource, velocity: 0.1 m/s}
          block: {type: Mass, mass: 1 kg}
          pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
          LIFTED
        connections:
          - [hand.flange, spring.a]
          - [spring.b, block.flange, pad.b ENDS]
          - [floor.flange, pad.a GROUNDS]
        run: {stop: 3 s}
    """.replace("\n        ", "\n    ")
    names = [f"lifted_{i}" for i in range(30)]
    more = "\n      ".join(f"{name}: {{type: Contact, normal_force: 0 N, curve: 0.5}}" for name in names)
    runs = []
    for lifted in ([], names):
        given = {"LIFTED": more if lifted else "", " ENDS": "".join(f", {n}.b" for n in lifted),
                 " GROUNDS": "".join(f", {n}.a" for n in lifted)}  # fmt: skip
        made = text
        for word, value in given.items():
            made = made.replace(word, value)
        runs.append(simulate(made, **{"friction.method": method}))
    few, many = (run.run["counters"] for run in runs)
    assert many["steps"] == pytest.approx(few["steps"], abs=3)
    assert {e.component for e in runs[1].events if e.t > 0} == {"pad"}

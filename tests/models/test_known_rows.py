"""Stepping goes on with the rows of contacts as they were in the same zone before: scenes where they no longer are."""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate
from fairlead.integrate.stepping.neighbours import known_rows

BLOCKS = 8
SHAKEN = "position: {sine: {amplitude: 40 mm, frequency: 1.5 Hz}}"  # its acceleration is zero at the start, alone
CASES = {
    "surfaces whose speed varies": (SHAKEN, "normal_force: 10 N", ""),
    "limits that vary with time": (SHAKEN, "", "{sine: {amplitude: 4, frequency: 0.7 Hz, offset: 10}}"),
    "limits that jump": (SHAKEN, "", "{step: {from: 10, to: 5, at: 0.7 s}}"),
}


def blocks_in_a_row(table, force, press):
    """Blocks on a table of given motion, each on a pad of its own, with springs between them."""
    parts, wires = [f"  table: {{type: MotionSource, {table}}}"], []
    if press:
        parts.append(f"  press: {{type: SignalSource, value: {press}}}")
    for k in range(BLOCKS):
        parts += [
            f"  block{k}: {{type: Mass, mass: {1.0 + 0.07 * k:g} kg}}",
            f"  pad{k}: {{type: Contact, curve: {0.2 + 0.03 * k:g}{', ' + force if force else ''}}}",
        ]
        wires.append(f"[table.flange, pad{k}.a], [pad{k}.b, block{k}.flange]")
        if press:
            wires.append(f"[press.signal, pad{k}.normal]")
        if k:
            parts.append(f"  spring{k}: {{type: SpringDamper, stiffness: 400 N/m, damping: 2 N*s/m}}")
            wires.append(f"[block{k - 1}.flange, spring{k}.a], [spring{k}.b, block{k}.flange]")
    head = "schema: 1\nname: row\nfriction: {method: hold}\nrun: {stop: 2 s}\ncomponents:\n"
    return head + "\n".join(parts) + f"\nconnections: [{', '.join(wires)}]\n"


def run(path, engine, accuracy):
    """What was recorded on a grid, by signal, [rows, BLOCKS]; and the counters."""
    system = fairlead.load(path, set={"run.accuracy": accuracy}).system
    signals = ["block*.x", "pad*.slip", "pad*.bound"]
    outcome = integrate(system, Run(stop=2.0, every=0.01, engine=engine, most_located=0, record=signals))
    assert outcome.ok, outcome.sentence
    rows, names = outcome.values[outcome.sides == 0], [signal.name for signal in outcome.problem.recorded]
    found = {
        kind: rows[:, [names.index(f"{part}{k}.{kind}") for k in range(BLOCKS)]]
        for part, kind in (("block", "x"), ("pad", "slip"), ("pad", "bound"))
    }
    return found, outcome.counters


@pytest.mark.parametrize("case", CASES)
def test_laws_that_vary_are_followed_as_by_rodas_and_held_exactly(tmp_path, case):
    path = tmp_path / "row.yaml"
    path.write_text(blocks_in_a_row(*CASES[case]), encoding="utf-8")
    exact, _ = run(path, "rodas", "1e-7")
    found, counters = run(path, "stepping", "1e-6")
    held = found["bound"] == 1
    assert held.sum() > 20
    assert np.abs(found["slip"][held]).max() < 1e-12
    assert np.abs(found["x"] - exact["x"]).max() < 1e-4  # m, of 40 mm
    assert counters.jacobians < counters.switches  # not evaluated anew at every switch
    # Limits are judged where they are read: no cycles. A step that is taken again switches again.
    assert counters.settling_passes < 3 * counters.switches + counters.rejected_error


def test_contacts_that_share_a_load_are_not_known_by_their_row_alone(scene):
    """Two pads under one block divide what holds it: when one lets go the other's share changes too."""
    system = scene("""
        components:
          floor: {type: Ground}
          one: {type: Mass, mass: 1 kg}
          left: {type: Contact, normal_force: 10 N, curve: 0.5}
          right: {type: Contact, normal_force: 8 N, curve: 0.4}
          other: {type: Mass, mass: 1 kg}
          alone: {type: Contact, normal_force: 10 N, curve: 0.5}
          spring: {type: Spring, stiffness: 100 N/m}
        connections:
          - [floor.flange, left.a, right.a, alone.a]
          - [left.b, right.b, one.flange, spring.a]
          - [spring.b, other.flange, alone.b]
        friction: {method: hold}
        run: {stop: 1 s}
    """).system
    assert {system.machine_names[z] for z in system.beyond_row} == {"left", "right"}
    row = known_rows(system)["own_row"]
    assert {system.machine_names[z] for z in np.flatnonzero(row >= 0)} == {"alone"}

"""Contacts that come to their limits together: which of them is the first is not in the model, so it is told."""

import pytest

from fairlead.cli.summary import summary_rows

STACK = """
components:
  floor: {{type: Ground}}
  b1: {{type: Mass, mass: 1 kg}}
  b2: {{type: Mass, mass: 1 kg}}
  b3: {{type: Mass, mass: 1 kg}}
  low: {{type: Contact, normal_force: 30 N, curve: {{curve: coulomb, stiction: 0.21, coulomb: 0.20}}}}
  mid: {{type: Contact, normal_force: 20 N, curve: {{curve: coulomb, stiction: 0.32, coulomb: 0.30}}}}
  top: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.65, coulomb: 0.50}}}}
  push: {{type: ForceSource, force: {force}}}
connections:
  - [floor.flange, low.a]
  - [low.b, b1.flange, mid.a]
  - [mid.b, b2.flange, top.a]
  - [top.b, b3.flange, push.flange]
run: {{stop: 0.2 s, engine: {engine}}}
"""
STEP = "{{step: {{at: 0.1 s, from: 0 N, to: {} N}}}}"
RAMP = "{table: [[0, 0], [0.1, 0], [0.101, 6.45]]}"
APART = """
components:
  floor: {type: Ground}
  b1: {type: Mass, mass: 1 kg}
  b2: {type: Mass, mass: 1 kg}
  p1: {type: Contact, normal_force: 10 N, curve: 0.3}
  p2: {type: Contact, normal_force: 10 N, curve: 0.3}
  spring: {type: Spring, stiffness: 100 N/m}
  push: {type: ForceSource, force: {step: {at: 0.1 s, from: 0 N, to: 5 N}}}
  pull: {type: ForceSource, force: {step: {at: 0.1 s, from: 0 N, to: 5 N}}}
connections:
  - [floor.flange, p1.a, p2.a]
  - [p1.b, b1.flange, push.flange, spring.a]
  - [p2.b, b2.flange, pull.flange, spring.b]
run: {stop: 0.2 s, engine: rodas}
"""
TIE = """
components:
  b1: {type: Mass, mass: 1 kg}
  b2: {type: Mass, mass: 1 kg}
  b3: {type: Mass, mass: 1 kg}
  p1: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.4}}
  p2: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.4}}
  push: {type: ForceSource, force: {step: {at: 0.1 s, from: 0 N, to: 10 N}}}
  pull: {type: ForceSource, force: {step: {at: 0.1 s, from: 0 N, to: -10 N}}}
connections:
  - [b1.flange, p1.a, push.flange]
  - [p1.b, b2.flange, p2.a]
  - [p2.b, b3.flange, pull.flange]
run: {stop: 0.2 s, engine: rodas}
"""


def told(model):
    """What run.json says, and the row of the closing table."""
    run = model.run(out=None).run
    return run["released_together"], dict(summary_rows(run, "")).get("let go at once", "")


@pytest.mark.parametrize("force", [RAMP, STEP.format(6.38), STEP.format(6.45)])
def test_one_contact_that_lets_go_alone_is_not(force, scene):
    """6.45 N pass the limits of two, 6.3 and 6.4 N; the one that a build-up meets first relieves the other."""
    assert told(scene(STACK.format(force=force, engine="rodas"))) == ({"count": 0, "first": []}, "")


def test_contacts_that_only_a_spring_joins_do_not_wait_for_each_other(scene):
    assert told(scene(APART)) == ({"count": 0, "first": []}, "")


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_tie_is_told(engine, scene):
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae")
    found, row = told(scene(TIE.replace("engine: rodas", f"engine: {engine}")))
    assert found == {"count": 1, "first": [{"t": pytest.approx(0.1, abs=1e-9), "contacts": ["p1", "p2"], "of": 2}]}
    assert row.startswith("t = 0.1 s: p1, p2 came to their limits together")


def test_where_nothing_falls_no_order_matters(scene):
    assert told(scene(TIE.replace("coulomb: 0.4", "coulomb: 0.5"))) == ({"count": 0, "first": []}, "")

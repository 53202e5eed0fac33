"""Contacts that creep, between bodies some of which follow within a step and some of which do not.

What follows its law within a step is shown where the law balances. A body beside it may be too heavy for that. It used
to stand still meanwhile, and the force between two light bodies was shown up to three quarters wrong.
"""

import numpy as np
import pytest

import fairlead

LOAD, LIMIT, CREEP = 2.0, 1.0, 1e-5  # N, N, m/s

MASSES = [(1, 1, 10), (10, 1, 1), (1, 1, 100), (1, 1, 10, 1), (1, 10, 1), (1, 20), (1, 1, 1e4)]


def scene(masses, names="mc"):
    body, contact = names
    joins = [[f"{body}{k}.flange"] for k in range(len(masses))]
    parts = [f"  {body}{k}: {{type: Mass, mass: {mass} kg}}" for k, mass in enumerate(masses)]
    for k in range(len(masses) - 1):
        parts.append(f"  {contact}{k}: {{type: Contact, normal_force: {LIMIT} N, curve: 1}}")
        joins[k].append(f"{contact}{k}.a")
        joins[k + 1].append(f"{contact}{k}.b")
    parts.append(f"  hand: {{type: ForceSource, force: {{sine: {{amplitude: {LOAD} N, frequency: 1 Hz}}}}}}")
    joins[0].append("hand.flange")
    lines = [f"  - [{', '.join(join)}]" for join in joins]
    return "\n".join(["schema: 1", "components:", *parts, "connections:", *lines,
                      f"friction: {{method: binding, creep: {CREEP} m/s}}", "run: {stop: 90 ms}"])  # fmt: skip


@pytest.mark.parametrize("masses", MASSES, ids=str)
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("names", ["mc", "zb"])
def test_the_force_of_a_contact_that_creeps_is_what_moves_the_bodies_behind_it(tmp_path, masses, engine, names):
    """The load times the share of what is behind it of all mass."""
    netlist = tmp_path / "scene.yaml"
    netlist.write_text(scene(masses, names), encoding="utf-8")
    result = fairlead.load(netlist).run(out=None, engine=engine)
    for k in range(len(masses) - 1):
        right = LOAD * sum(masses[k + 1 :]) / sum(masses) * abs(np.sin(2 * np.pi * result.t))
        creeps = (right < 0.95 * LIMIT) & (result.t > 0.01)
        lag = 5e-4  # N: what it takes to let bodies of some kilograms creep by 1e-5 m/s more within 0.1 s
        assert abs(abs(result[f"{names[1]}{k}.friction"]) - right)[creeps].max() < lag + 1e-3 * LIMIT

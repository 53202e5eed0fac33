"""A contact whose slip comes to the end of its creep is within its limit in every row, also beside one that creeps.

Its slip is known there to the tolerance of its guard. That of a slip is 1e-10 m/s, 3e-6 of an end of 4e-5 m/s; where a
guard in newtons shares its slot it was 1e-8 m/s, which showed up to 2e-4 of the limit more than a contact can carry.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import fairlead
from tests.conftest import Scene

CREEP = 1e-5  # m/s
ALLOWED = 1e-5
SCENES = {
    "light load beside": ([(1, 0, 1), (1, 2, 1), (1, 5, 1)], [(0, 1, 1), (1, 2, 1)]),
    "light body between": ([(0.01, 0, 1), (1, 13, 1), (10, 18, 4)], [(0, 1, 1), (0, 2, 6)]),
    "row of four": ([(1, 0, 1), (1, 1, 1), (0.1, 0, 1), (1, 9, 2)], [(0, 1, 1), (1, 2, 2), (2, 3, 3)]),
    "three on one": ([(1, 12, 1), (1, 0, 1), (0.1, 3, 2), (10, 0, 1)], [(0, 1, 2), (0, 2, 1), (0, 3, 4)]),
}
"""Bodies (kg, N, Hz), contacts (a, b, limit in N)."""


def netlist(bodies: list[tuple[float, float, float]], contacts: list[tuple[int, int, float]]) -> str:
    """The bodies under loads that swing, and their contacts."""
    joins = [[f"m{k}.flange", f"f{k}.flange"] for k in range(len(bodies))]
    parts = []
    for k, (mass, load, rate) in enumerate(bodies):
        force = f"{{sine: {{amplitude: {load} N, frequency: {rate} Hz}}}}"
        parts += [f"  m{k}: {{type: Mass, mass: {mass} kg}}", f"  f{k}: {{type: ForceSource, force: {force}}}"]
    for j, (a, b, limit) in enumerate(contacts):
        parts.append(f"  c{j}: {{type: Contact, normal_force: {limit} N, curve: 1}}")
        joins[a].append(f"c{j}.a")
        joins[b].append(f"c{j}.b")
    lines = [f"  - [{', '.join(join)}]" for join in joins]
    friction = f"friction: {{method: binding, creep: {CREEP} m/s}}"
    run = "run: {stop: 1 s, accuracy: 1e-5}"
    return "\n".join(["components:", *parts, "connections:", *lines, friction, run])


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("name", SCENES)
def test_no_row_shows_more_than_the_limit(simulate: Scene, name: str, engine: str) -> None:
    bodies, contacts = SCENES[name]
    result = simulate(netlist(bodies, contacts), **{"run.engine": engine})
    creeps = 0
    for j, (_, _, limit) in enumerate(contacts):
        force = np.abs(result[f"c{j}.friction"])
        assert force.max() <= limit * (1 + ALLOWED)
        creeps += int(((force > 0.1 * limit) & (force < 0.9 * limit)).sum())
    assert creeps > 20


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("name", SCENES)
def test_both_rows_of_an_event_show_the_same_speeds(simulate: Scene, name: str, engine: str) -> None:
    """No speed jumps where nothing is struck."""
    bodies, contacts = SCENES[name]
    result = simulate(netlist(bodies, contacts), **{"run.engine": engine})
    before = np.flatnonzero(result.side[:-1] == -1)
    before = before[result.side[before + 1] == 1]
    assert len(before) > 3
    for k in range(len(bodies)):
        speed = result[f"m{k}.v"]
        assert np.abs(speed[before + 1] - speed[before]).max() <= 1e-10 + 1e-12 * np.abs(speed).max()


@pytest.mark.parametrize("method", ["hold", "binding", "karnopp", "tanh"])
def test_guards_that_share_a_slot_have_one_unit(tmp_path, method: str) -> None:
    """A slot has one tolerance."""
    path = tmp_path / "scene.yaml"
    text = netlist(*SCENES["light load beside"]).replace("method: binding", f"method: {method}")
    path.write_text("schema: 1\nname: scene\n" + text.replace(f", creep: {CREEP} m/s", ""), encoding="utf-8")
    for block in fairlead.load(path).system.blocks:
        by_slot = itertools.zip_longest(*block.kernel.structure.guards.values())
        for slot in by_slot:
            assert len({guard["unit"] for guard in slot if guard is not None}) == 1

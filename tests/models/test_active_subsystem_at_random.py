"""Random networks of blocks with friction of which some stand still: what moves alone, and the whole."""

import random

import numpy as np
import pytest

from fairlead.integrate import parts

CASES = 14


def network(seed):
    """Blocks on contacts, each tied to one of the three before it, some of them pulled by forces that come and go."""
    r = random.Random(seed)
    blocks = r.choice([12, 20, 40])
    lines, at = ["floor: {type: Ground}"], [[f"b{i}.flange", f"c{i}.b"] for i in range(blocks)]
    for i in range(blocks):
        lines.append(f"b{i}: {{type: Mass, mass: {r.choice([0.2, 1, 3])} kg}}")
        lines.append(f"c{i}: {{type: Contact, normal_force: {r.choice([5, 10, 30])} N, curve: {r.choice([0.3, 0.5])}}}")
    for i in range(1, blocks):
        kind, stiffness = r.choice(["Spring", "SpringDamper", "Tether"]), r.choice([200, 2000, 20000])
        damping = f", damping: {r.choice([1, 10])} N*s/m" if kind == "SpringDamper" else ""
        lines.append(f"s{i}: {{type: {kind}, stiffness: {stiffness} N/m{damping}}}")
        at[r.randrange(max(0, i - 3), i)].append(f"s{i}.a")
        at[i].append(f"s{i}.b")
    for k in range(r.choice([1, 2])):
        swing = f"{{sine: {{amplitude: {r.choice([8, 20, 40])} N, frequency: {r.choice([1, 3])} Hz}}}}"
        late = f"{{table: {{t: [0 s, 0.5 s, 0.6 s, 1 s, 1.2 s], y: [0 N, 0 N, {r.choice([20, 50])} N, 60 N, 0 N]}}}}"
        lines.append(f"f{k}: {{type: ForceSource, force: {r.choice([swing, late])}}}")
        at[r.randrange(blocks)].append(f"f{k}.flange")
    joins = [["floor.flange", *(f"c{i}.a" for i in range(blocks))], *at]
    wiring = "".join(f"\n  - [{', '.join(ports)}]" for ports in joins)
    return (
        "components:\n  " + "\n  ".join(lines) + f"\nconnections:{wiring}\nfriction: {{method: hold}}\n"
        'run: {stop: 1.5 s, accuracy: 1e-6, engine: rodas}\nrecord: {every: 10 ms, signals: ["b*.x"]}\n'
    )


@pytest.mark.parametrize("seed", range(CASES))
def test_what_moves_alone_moves_as_in_the_whole(simulate, monkeypatch, seed):
    """Looked at every third step, with a margin of three equations: the rest wakes often, and is cut out again."""
    text, grid = network(seed), np.arange(1, 150) * 0.01
    runs = []
    for least in (1, 10**9):
        for name, value in {"LEAST": least, "LOOK_COST": 0, "LOOK_BASE": 3, "MOST": 0.97, "MARGIN": 3}.items():
            monkeypatch.setattr(parts, name, value)
        result = simulate(text)
        position = [np.interp(grid, result.t, np.asarray(result[s.name])) for s in result.signals if s.name[-1] == "x"]
        runs.append((result.run["counters"], np.array(position)))
    (part, alone), (whole, together) = runs
    assert part["partial_steps"] > 0
    assert whole["partial_steps"] == 0
    assert alone == pytest.approx(together, abs=1e-6)  # m, of some centimetres

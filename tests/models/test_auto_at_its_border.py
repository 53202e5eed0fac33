"""Random rows of blocks with some 100 contacts: whatever `auto` takes keeps the accuracy that was asked for."""

import numpy as np
import pytest

from fairlead.engine import engine_of

ACCURACY = 1e-4


def random_row(seed, count):
    """Blocks on springs, pulled at one end; levels, masses and loads by chance; every third has a limit that swings."""
    chance = np.random.default_rng(seed)
    swings = seed % 3 == 1
    parts, joins, floor = [], [], ["floor.flange"]
    if swings:
        parts.append(f"  load: {{type: SignalSource, value: {{sine: {{amplitude: 3, offset: 10, "
                     f"frequency: {chance.uniform(20, 60):.4g} Hz}}}}}}")  # fmt: skip
    for k in range(count):
        mass, level = chance.uniform(0.5, 2.0), chance.uniform(0.05, 0.15)
        parts.append(f"  m{k}: {{type: Mass, mass: {mass:.4g} kg, position: 0 m, velocity: 0 m/s}}")
        parts.append(f"  c{k}: {{type: Contact, normal_force: 10 N, curve: {level:.4g}}}")
        floor.append(f"c{k}.a")
        joins.append(f"  - [c{k}.b, m{k}.flange{f', s{k}.b' if k else ', pull.flange'}"
                     f"{f', s{k + 1}.a' if k < count - 1 else ''}]")  # fmt: skip
        if k:
            parts.append(
                f"  s{k}: {{type: SpringDamper, stiffness: {chance.uniform(1, 4):.4g} kN/m, damping: 5 N*s/m}}"
            )
    parts.append(f"  pull: {{type: ForceSource, force: {{ramp: {{to: {chance.uniform(20, 60):.4g} N, over: 1 s}}}}}}")
    joins += [f"  - [{', '.join(floor)}]"] + ([f"  - [load.signal, c{count // 2}.normal]"] if swings else [])
    tail = f"run: {{stop: 1.2 s, accuracy: {ACCURACY}}}\nrecord: {{signals: ['m*.x'], every: 50 ms}}\n"
    head = "components:\n  floor: {type: Ground}\n"
    return head + "\n".join(parts) + "\nconnections:\n" + "\n".join(joins) + "\n" + tail, swings


@pytest.mark.parametrize(("seed", "count"), [(0, 100), *(
    pytest.param(seed, count, marks=pytest.mark.slow)
    for seed, count in enumerate((90, 95, 99, 100, 101, 105, 110, 100, 104), 1)
)])  # fmt: skip
def test_what_auto_takes_keeps_the_accuracy(seed, count, scene, tmp_path):
    text, swings = random_row(seed, count)
    model = scene(text)
    engine, _ = engine_of(model.netlist.run, model.system)
    assert engine == ("stepping" if count >= 100 and not swings else "rodas")
    found = model.run(out=tmp_path / "found")
    exact = model.run(out=tmp_path / "exact", engine="rodas", accuracy=1e-7)
    x, y = (np.array([one[f"m{k}.x"][one.side == 0] for k in range(count)]) for one in (found, exact))
    error = np.abs(x - y).max() / max(np.abs(y).max(), 0.1)
    assert error <= ACCURACY  # 0.1 m is what an accuracy refers to

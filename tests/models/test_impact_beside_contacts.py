"""An impact on a body with two contacts side by side, one of them at its limit: as with one contact in their place.

The body is preloaded against the blow, so that the weaker contact already carries its sliding friction without moving.
Under the impulse both have to slide the other way.
"""

from __future__ import annotations

import numpy as np
import pytest

WEAK, STRONG = 4.9, 28.92  # N, sliding friction

STOP = """
    components:
      floor: {{type: Ground}}
      hit: {{type: Mass, mass: 3.52 kg}}
      comes: {{type: Mass, mass: 4.89 kg, position: 0.05 m, velocity: -0.8 m/s}}
      stop: {{type: RigidStop, restitution: {restitution}}}
      preload: {{type: Spring, stiffness: 2880 N/m, free_length: 0.0047 m}}
{contacts}
    connections:
      - [floor.flange, {grounds}, preload.a]
      - [hit.flange, {bodies}, stop.a, preload.b]
      - [comes.flange, stop.b]
    run: {{stop: 0.4 s, accuracy: 1e-7}}
"""
SHAFT = """
    components:
      hit: {{type: Inertia, moment: 0.3 kg*m^2}}
      comes: {{type: Inertia, moment: 0.5 kg*m^2, speed: 0.05 rad/s}}
      dog: {{type: DogClutch}}
      press: {{type: SignalSource, value: {{step: {{from: 0, to: 1, at: 0.1 s}}}}}}
      load: {{type: TorqueSource, torque: -1.6 N*m}}
{contacts}
    connections:
      - [hit.shaft, {bodies}, dog.a, load.shaft]
      - [comes.shaft, dog.b]
      - [press.signal, dog.engage]
    run: {{stop: 0.6 s, accuracy: 1e-7}}
"""


def _contacts(forces: list[float], names: list[str], kind: str) -> dict[str, str]:
    more = {"Contact": "", "Brake": ", radius: 1 m"}[kind]
    rows = [f"      {n}: {{type: {kind}, curve: 1.0, normal_force: {f} N{more}}}" for n, f in zip(names, forces)]
    side = {"Contact": "b", "Brake": "shaft"}[kind]
    return {
        "contacts": "\n".join(rows),
        "grounds": ", ".join(f"{n}.a" for n in names),
        "bodies": ", ".join(f"{n}.{side}" for n in names),
    }


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("restitution", [0.0, 0.4])
@pytest.mark.parametrize("names", [["f0", "f1"], ["z", "a"]])
def test_a_stop_hits_a_body_with_two_contacts(simulate, names, restitution, engine):
    ends = []
    for forces in ([WEAK, STRONG], [WEAK + STRONG]):
        text = STOP.format(restitution=restitution, **_contacts(forces, names[: len(forces)], "Contact"))
        result = simulate(text, **{"run.engine": engine})
        ends.append((result["hit.x"][-1], result["comes.x"][-1], np.abs(result["hit.v"]).max()))
    assert ends[0] == pytest.approx(ends[1], rel=1e-5, abs=1e-8)
    after = 0.8 * 4.89 / (4.89 + 3.52) * (1 + restitution)
    assert ends[0][2] == pytest.approx(after, rel=1e-3)  # momentum; the blow passes no impulse to the ground


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_dog_clutch_catches_a_shaft_with_two_brakes(simulate, engine):
    ends = []
    for forces in ([1.0, 3.0], [4.0]):
        text = SHAFT.format(**_contacts(forces, ["b0", "b1"][: len(forces)], "Brake"))
        result = simulate(text, **{"run.engine": engine})
        ends.append((result["hit.angle"][-1], result["comes.angle"][-1], np.abs(result["hit.speed"]).max()))
    assert ends[0] == pytest.approx(ends[1], rel=1e-5, abs=1e-8)
    assert ends[0][2] == pytest.approx(0.05 * 0.5 / 0.8, rel=1e-3)

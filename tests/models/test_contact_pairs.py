"""Action equals reaction, to the last bit, in every zone of everything that joins two bodies.

Physics section 8, item 32: the forces of a contact on its two bodies cancel exactly. They do because a law
is traced: the sum of what the two ports take in is zero as a formula, and the compiled kernel computes
the one number once.
"""

import numpy as np
import pytest
import sympy

from fairlead.component.registry import known_types
from fairlead.component.trace import trace
from fairlead.component.values import variant_of
from fairlead.kernels import layout
from fairlead.testing.rig import Rig
from fairlead.testing.samples import families, sample

JOINTS = ["Contact", "Spring", "Damper", "SpringDamper", "Tether", "Hose", "Core"]


def members():
    """Every way to join two bodies as (class, choices): each contact with each of its curves and options."""
    types = known_types(())
    for name in JOINTS:
        for kind, chosen in families(types[name]):
            yield pytest.param(kind, chosen, id=" ".join([kind.__name__, *map(str, chosen.values())]))


@pytest.mark.parametrize(("kind", "chosen"), list(members()))
def test_what_two_ports_take_in_cancels_as_a_formula(kind, chosen) -> None:
    values = sample(kind, np.random.default_rng(1), chosen, True)
    for name, zone in trace(variant_of(values)).zones.items():
        assert sympy.simplify(sum(zone.flows.values())) == 0, name


FACTORS = {"load_dependence", "temperature_dependence"}  # of the normal force; off they are no term
MACHINE_CODE = [
    p for p in members() if p.values[1].get("curve", "stribeck") == "stribeck" and not FACTORS & set(p.values[1])
]


@pytest.mark.parametrize(("kind", "chosen"), MACHINE_CODE)
def test_what_two_ports_take_in_cancels_in_machine_code(kind, chosen) -> None:
    """With one curve each: what a curve says is in both flows the same number, and compiling takes seconds."""
    rng = np.random.default_rng(2)
    values = sample(kind, rng, chosen, True)
    rig = Rig([values], [{"a": 1.0, "b": 2.0}])
    s = rig.structure
    ports = [s.targets.index(f"port:{port}") for port in "ab"]
    for zone in range(len(s.zones)):
        for _ in range(20):
            zones = [zone, *(table.begin for table in rig.pieces[0])][-s.machines :] if s.machines else []
            flows = rig.ask(layout.FLOWS, rng.normal(size=len(s.inputs)), zones, machine=True)[0]
            a, b = flows[ports]
            assert a == -b  # equal to the last bit; zero where nothing is carried


@pytest.mark.slow
def test_momentum_of_two_free_blocks_is_kept(simulate) -> None:
    """Nothing outside: whatever the contact does, m_a v_a + m_b v_b stays what it was."""
    for method in ("hold", "binding", "tanh"):
        result = simulate(
            """
            parameters: {method: hold}
            components:
              sled: {type: Mass, mass: 3 kg, position: 0 m, velocity: 1 m/s}
              load: {type: Mass, mass: 1 kg, position: 0 m, velocity: -0.5 m/s}
              pad: {type: Contact, method: "{method}", normal_force: 10 N, curve: 0.4}
            connections: [[sled.flange, pad.a], [pad.b, load.flange]]
            run: {stop: 1 s, accuracy: 1e-6}
            """,
            method=method,
        )
        momentum = 3.0 * result["sled.v"] + 1.0 * result["load.v"]
        # The linear algebra of each step rounds; 1e-13 is some hundred units in the last place.
        np.testing.assert_allclose(momentum, 2.5, rtol=1e-13)
        assert result["load.v"][-1] == pytest.approx(2.5 / 4.0, abs=1e-6)  # they end up moving together

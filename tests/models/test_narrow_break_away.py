"""A load above stiction by a thousandth: what `stepping` may not miss, since friction then falls to a third."""

import pytest

import fairlead
from fairlead.integrate import Run, integrate

SCENE = """
schema: 1
components:
  block: {{type: Mass, mass: 1 kg}}
  floor: {{type: Ground}}
  pad: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 1.0, coulomb: 0.3}}, method: hold}}
  spring: {{type: Spring, stiffness: 1 kN/m}}
  pull: {{type: ForceSource, force: {{sine: {{amplitude: {force} N, frequency: 1 Hz}}}}}}
connections:
  - [pull.flange, block.flange, pad.b, spring.b]
  - [pad.a, spring.a, floor.flange]
run: {{stop: 2 s}}
"""


@pytest.mark.parametrize("over", [1e-3, 2e-3])
@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4"])
def test_it_breaks_away_at_its_peak(tmp_path, over, accuracy):
    """At rest without force in the spring the peak of 10 (1 + over) N at 0.25 s is above 10 N, and 7 N are set free."""
    (tmp_path / "peak.yaml").write_text(SCENE.format(force=10 * (1 + over)), encoding="utf-8")
    system = fairlead.load(tmp_path / "peak.yaml", set={"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=2.0, engine="stepping"))
    assert outcome.ok, outcome.sentence
    assert outcome.events["t"][0] == pytest.approx(0.25, abs=0.02)
    x = outcome.values[:, system.unknown_names.index("block.x")]
    assert x.max() > 7e-3  # 7 N on 1 kN/m, and about as much again by its swing

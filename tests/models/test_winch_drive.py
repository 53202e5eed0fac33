"""The electrohydraulic winch: design numbers, an independent formulation, its ledger, and what the effects change."""

from pathlib import Path

import numpy as np
import pytest

import fairlead
from tests.reference.valve_drive import Drive, SampledPi

MODEL = Path(__file__).parents[2] / "models" / "winch_drive.yaml"
# Where both formulations begin: the shaft already turns, so that dry friction never changes its sign.
TURNING = """
initial:
  drive.spool.position: 0.05
  drive.volume_a.port.pressure: 110 bar
  drive.volume_b.port.pressure: 85 bar
  drive.rotor.shaft.speed: 0.05 rad/s
"""


def between(result, first, last):
    """Line speed between two times."""
    return result["line.v"][(result.t >= first) & (result.t <= last)]


def test_the_winch_keeps_its_speed_and_dips_as_designed(bundled):
    """0.2994 m/s at 3 to 4 s, a dip to 0.2886 m/s, 0.2995 m/s again: the design is without the sample of delay."""
    result = bundled("winch_drive", {"control.delay": "none"})
    assert between(result, 3, 4).mean() == pytest.approx(0.2994, abs=1e-4)
    assert between(result, 4, 5).min() == pytest.approx(0.2886, abs=1e-4)
    assert between(result, 7, 8).mean() == pytest.approx(0.2995, abs=2e-4)


def test_a_sample_of_delay_deepens_the_dip_a_little(bundled):
    dips = [between(bundled("winch_drive", {"control.delay": delay}), 4, 5).min() for delay in ("none", "sample")]
    assert 1e-4 < dips[0] - dips[1] < 1e-3


@pytest.mark.parametrize("delay", ["none", "sample"])
def test_it_agrees_with_an_independent_formulation(tmp_path, delay):
    """The same equations in numpy with a fixed-step method; the pull steps at 2 s."""
    path = tmp_path / "winch.yaml"
    path.write_text(MODEL.read_text(encoding="utf-8") + TURNING, encoding="utf-8")
    settings = {"control.delay": delay, "run.stop": "3 s", "run.accuracy": "1e-6", "load.force.step.at": "2 s",
                "profile.value.ramp.from": "0.05"}  # fmt: skip
    result = fairlead.load(path, set=settings).run(out=tmp_path / "run")
    assert result.status == "finished", result.run["sentence"]
    t, v = SampledPi(delayed=delay == "sample").run(
        Drive(), 3.0, lambda t: 1386.0 if t < 2 else 2053.0, lambda t: min(0.05 + 0.25 * t, 0.3)
    )
    times = np.arange(0.1, 2.99, 0.05)
    np.testing.assert_allclose(result.at("line.v", times), np.interp(times, t, v), atol=1e-6)


@pytest.mark.parametrize(
    "settings",
    [{}, {"effects.supply_dynamics": "on"}, {"effects.compressibility": "off"}, {"effects.gear_friction": "on"},
     {"effects.valve_dynamics": "off"}, {"effects.sampling": "off"}, {"gear.effects.backlash": "on"}],
    ids=lambda settings: next(iter(settings), "as it is"),
)  # fmt: skip
def test_energy_closes_whatever_effects_are_on(bundled, settings):
    result = bundled("winch_drive", settings)
    assert result.run["energy"]["closure"] < 1e-5
    assert between(result, 3, 4).mean() == pytest.approx(0.2995, abs=1e-3)


def test_an_oil_that_is_not_compressed_makes_the_dip_too_small(bundled):
    """What the compressibility is for: without it the dip is a third less."""
    runs = [bundled("winch_drive", {"effects.compressibility": word}) for word in ("on", "off")]
    dips = [0.2996 - between(result, 4, 5).min() for result in runs]
    assert dips[1] < 0.75 * dips[0]


def test_opened_fully_without_load_it_runs_at_the_speed_of_the_closed_form(bundled):
    """1.158 m/s of line, less what leakage and friction take."""
    drive = Drive()
    settings = {"pull": "0 N", "more_pull": "0 N", "run.stop": "6 s", "profile.value.ramp.to": "3",
                "effects.leakage": "off", "effects.motor_friction": "off"}  # fmt: skip
    result = bundled("winch_drive", settings)
    assert result["line.v"][-1] == pytest.approx(drive.no_load_speed(1.0) * drive.radius / drive.gear, rel=1e-4)


def test_a_drive_can_stand_on_a_supply_that_others_share(bundled):
    """The pressure sinks while the drum speeds up, and settles below the cut-off by the pump's characteristic."""
    result = bundled("winch_drive", {"effects.supply_dynamics": "on"})
    p = result["power.pressure"][-1]
    leaking = Drive().internal * result["drive.load_pressure"][-1] + Drive().external * result["drive.pressure_a"][-1]
    flow = result["drive.speed"][-1] * Drive().displacement + leaking
    assert p == pytest.approx(180e5 - 10e5 * flow / 1e-3, rel=1e-4)
    assert result["power.pressure"].max() <= 180e5 * (1 + 1e-9)

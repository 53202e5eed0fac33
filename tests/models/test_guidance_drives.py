"""The guidance route with its deployer on a servo valve and its winch in torque mode, both sampled."""

from pathlib import Path

import pytest

import fairlead

MODELS = Path(__file__).parents[2] / "models"


def test_the_deployer_follows_its_profile_and_the_winch_keeps_the_tension(tmp_path):
    """The first two seconds of the deployment: 0.5 m/s after one, by the valve and its controller."""
    text = (MODELS / "guidance_route.yaml").read_text(encoding="utf-8")
    text = text.replace("parts/ideal_drives.yaml", "parts/electrohydraulic_drives.yaml")
    lines = [line for line in text.splitlines() if "signals: [belts.force]" not in line]
    text = "\n".join(lines).replace("belts.force, belts.v", "belt_speed.signal, winch_control.torque, power.level")
    (tmp_path / "parts").mkdir()
    for part in (MODELS / "parts").glob("*.yaml"):
        (tmp_path / "parts" / part.name).write_text(part.read_text(encoding="utf-8"), encoding="utf-8")
    path = tmp_path / "route.yaml"
    path.write_text(text, encoding="utf-8")
    result = fairlead.load(path, set={"run.stop": "2 s"}).run(out=tmp_path / "run")
    assert result.status == "finished", result.run["sentence"]
    assert result["belt_speed.signal"][-1] == pytest.approx(0.5, rel=0.01)
    assert result["belt_speed.signal"].max() < 0.53
    assert result["winch_control.torque"][-1] == pytest.approx(-200 * 0.65)
    assert result.run["energy"]["closure"] < 1e-6

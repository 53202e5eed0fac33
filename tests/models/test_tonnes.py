"""Heavy bodies at an instant: in a step of 1e-14 s a force does little, which is no reason to call it undetermined."""

import pytest


@pytest.mark.parametrize("tonnes", [1e-3, 1.0, 100.0])
@pytest.mark.parametrize("beyond", [-1e-14, 0.0, 1e-14, 1e-13, 1e-12])
def test_a_run_may_end_where_a_heavy_block_comes_to_rest(simulate, tonnes, beyond) -> None:
    """From 1 m/s with 1 m/s^2: at rest at 1 s, half a metre on."""
    text = f"""
    components:
      block: {{type: Mass, mass: {1000 * tonnes} kg, position: 0, velocity: 1 m/s}}
      ground: {{type: Ground}}
      pad: {{type: Contact, normal_force: {10000 * tonnes} N, curve: 0.1}}
    connections: [[block.flange, pad.b], [ground.flange, pad.a]]
    run: {{stop: {1 + beyond!r} s, accuracy: 1e-6}}
    """
    result = simulate(text)
    assert result["block.v"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["block.x"][-1] == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize("moment", [50, 500, 5e3, 5e5])
@pytest.mark.parametrize("heat", ["", ", heat: {capacity: 50 kJ/K}"])
def test_a_heavy_wheel_may_begin_at_speed_in_its_brake(simulate, moment, heat) -> None:
    """The first guess is that the brake holds; the force that this would take is known to rounding of itself."""
    text = f"""
    components:
      wheel: {{type: Inertia, moment: {moment} kg*m^2, angle: 0, speed: 20 rad/s}}
      brake: {{type: Brake, radius: 0.1 m, curve: 0.4, normal_force: {200 * moment} N{heat}}}
    connections: [[wheel.shaft, brake.shaft]]
    run: {{stop: 0.1 s, accuracy: 1e-6}}
    """
    assert simulate(text)["wheel.speed"][-1] == pytest.approx(20 - 8 * 0.1, abs=1e-6)

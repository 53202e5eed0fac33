"""What a motion given in time drives through a spring: `stepping` finds the force that takes, however stiff it is."""

import numpy as np
import pytest

# Contacts at rest, so many that `stepping` looks for switches inside its steps; without them it lands on each.
PADS = 45
RESTING = "".join(
    f"""
          rest{k}: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}
          pad{k}: {{type: Contact, normal_force: 10 N, curve: 0.5, method: hold}}"""
    for k in range(PADS)
)
JOINED = "".join(f"\n          - [rest{k}.flange, pad{k}.b]" for k in range(PADS)) + (
    "\n          - [ground.flange, " + ", ".join(f"pad{k}.a" for k in range(PADS)) + "]"
)


@pytest.mark.parametrize("pads", [False, True], ids=["landed_on", "inside"])
@pytest.mark.parametrize("stiffness", [1e3, 1e7, 1e10])
def test_a_mass_behind_a_spring_takes_its_inertia_from_a_drive_that_speeds_up(simulate, stiffness, pads):
    """At 0.4 m/s^2, once the little that it swings has gone. The chord of a step of 5 ms is 1.2 um ahead of it."""
    damping = 0.6 * np.sqrt(stiffness * 0.05)
    result = simulate(f"""
        components:
          ground: {{type: Ground}}
          haul: {{type: MotionSource, velocity: {{ramp: {{to: 0.2 m/s, over: 0.5 s}}}}}}
          load: {{type: Mass, mass: 0.05 kg, position: 0 m, velocity: 0 m/s}}
          line: {{type: SpringDamper, stiffness: {stiffness} N/m, damping: {damping} N*s/m}}{RESTING if pads else ""}
        connections:
          - [haul.flange, line.a]
          - [line.b, load.flange]{JOINED if pads else ""}
        run: {{stop: 0.45 s, accuracy: 1e-4, engine: stepping}}
    """.replace("          ground: {type: Ground}\n" if not pads else "\0", ""))
    late = result.t > 0.25
    assert result["haul.force"][late] == pytest.approx(0.4 * 0.05, rel=2e-3)
    assert result.run["energy"]["closure"] < 1e-3


@pytest.mark.parametrize("stiffness", [4e3, 1e8])
def test_a_shaft_is_turned_to_and_fro_through_a_spring_with_the_torque_of_its_inertia(simulate, stiffness):
    """From where it is in its steady swing, phi = Re(A e^(i w t)) (k + i w c)/(k - J w^2 + i w c), J = 0.3 kg m^2."""
    omega, amplitude, damping, inertia = 2 * np.pi * 1.3, 0.4, 2.0, 0.3
    wave = amplitude * (stiffness + 1j * omega * damping) / (stiffness - inertia * omega**2 + 1j * omega * damping)
    result = simulate(f"""
        components:
          drive: {{type: SpeedSource,
                  angle: {{sine: {{amplitude: {amplitude} rad, frequency: 1.3 Hz, phase: 90 deg}}}}}}
          rotor: {{type: Inertia, moment: {inertia} kg*m^2, angle: {wave.real!r} rad,
                  speed: {(1j * omega * wave).real!r} rad/s}}
          shaft: {{type: TorsionSpring, stiffness: {stiffness} N*m/rad, damping: {damping} N*m*s/rad}}
        connections: [[drive.shaft, shaft.a], [shaft.b, rotor.shaft]]
        run: {{stop: 1.2 s, accuracy: 1e-5, engine: stepping}}
    """)
    exact = (-(omega**2) * inertia * wave * np.exp(1j * omega * result.t)).real
    ends = result.side == 0  # inside a step the angle is on a parabola
    assert result["drive.torque"][ends] == pytest.approx(exact[ends], abs=3e-3 * abs(exact).max())

"""What bundled parts remember can be recorded: every state is an output, or a function of one, under a name."""

import importlib
import pkgutil

import fairlead.components
import numpy as np
import pytest

from fairlead.component import Component

TOLD_BY = {
    "Capacitor": {"charged": "voltage"}, "FilteredDerivative": {"slow": "filtered"}, "Inductor": {"flowing": "current"},
    "Integrator": {"gathered": "signal"}, "SampleHold": {"kept": "signal"}, "SignalDelay": {"signal": "signal"},
    "AccelerationActuator": {"place": "x", "moving": "v"}, "AngleActuator": {"place": "angle", "moving": "speed"},
    "PositionActuator": {"place": "x", "moving": "v"}, "SpeedActuator": {"place": "angle", "moving": "speed"},
    "VelocityActuator": {"place": "x", "moving": "v"}, "LoadSensingPump": {"delivered": "flow"},
    "SignalEdge": {"was": "last", "found": "signal", "edges": "count"}, "TransferStage": {"gathered": "signal"},
    "SignalTimer": {"lasted": "elapsed", "was": "last", "done": "signal"},
    "SpaceState": {"gathered": "signal"}, "SecondOrder": {"told": "signal", "rate": "slope"},
    "Accumulator": {"log_pressure": "pressure"}, "Bristle": {"moved": "slid"}, "CavitatingVolume": {"empty": "void"},
    "Chamber": {"oil": "pressure", "empty": "void"}, "ContinuousPi": {"summed": "integral", "applied": "command"},
    "Dahl": {"z": "deflection"}, "DcDrive": {"flowing": "current"}, "DcMotor": {"flowing": "current"},
    "Elastoplastic": {"z": "deflection"}, "FrictionHeat": {"theta": "temperature"}, "FullChamber": {"oil": "pressure"},
    "IdealPid": {"summed": "integral", "slow": "filtered"},
    "Pid": {"summed": "integral", "slow": "filtered", "applied": "command", "used": "error"},
    "LaggingPm": {"flowing": "current"}, "LuGre": {"z": "deflection"},
    "MaxwellSlip": dict.fromkeys(("z1", "z2", "z3", "z4"), "deflection"),
    "Meter": {"slipped": "scuffed", "worked": "work"}, "OilColumn": {"moving": "flow"},
    "PiController": {"summed": "integral", "applied": "command", "used": "error"},
    "PmMotor": {"flowing": "current", "summed": "integral"}, "PressurePump": {"delivered": "flow"},
    "OverTensionTrip": {"broken_for": "waiting", "trips": "tripped"},
    "ReferenceShaper": {"value": "reference", "rate": "slope"},
    "RelaxingHose": {"branch": "relaxing"}, "ReliefValve": {"raised": "lift"}, "ResetIntegrator": {"z": "deflection"},
    "RuckTrip": {"broken_for": "waiting", "trips": "tripped"}, "RuckingHose": {"folded": "compressed"},
    "SampledSensor": {"signal": "signal"}, "SignalLag": {"told": "signal"}, "Spool": {"position": "opening"},
    "TensionTorque": {"held": "torque"}, "TensionTrim": {"summed": "integral", "held": "reference"},
    "MovingTail": {"pull": "elastic"}, "RopeTail": {"pull": "elastic"}, "WebAccumulator": {"pull": "elastic"},
    "WebSpan": {"pull": "elastic"}, "WholeSpan": {"pull": "elastic"},
    "Volume": {"log_pressure": "pressure"}, "ZeroTensionHold": {"holds": "holding", "passed": "reference"},
}  # fmt: skip
NOT_TOLD = {
    "Spool": {"speed"},  # a spool without dynamics, which stands in for it, has none
    "PiController": {"seen"}, "TensionTrim": {"seen"},  # an input, one sample ago
}  # fmt: skip


def bundled():
    """All classes of the library."""
    for module in pkgutil.walk_packages(fairlead.components.__path__, "fairlead.components."):
        importlib.import_module(module.name)
    waiting = [Component]
    while waiting:
        found = waiting.pop().__subclasses__()
        waiting += found
        yield from (cls for cls in found if cls.__module__.startswith("fairlead.components."))


def test_every_state_of_a_bundled_part_is_told_by_an_output():
    remembers = {}
    for cls in bundled():
        declared = getattr(cls, "declaration", None)
        states = {*getattr(declared, "states", ()), *getattr(declared, "discrete", ())}
        if states:
            remembers[cls.__name__] = states
            told = TOLD_BY.get(cls.__name__, {})
            assert states == set(told) | NOT_TOLD.get(cls.__name__, set()), cls
            assert set(told.values()) <= set(declared.outputs), cls
    assert set(remembers) == set(TOLD_BY)


CONTROLLED = """
components:
  wanted: {{type: SignalSource, value: 2}}
  measured: {{type: SignalSource, value: 0.5}}
  control: {{type: PiController, gain: 3, integral_time: 4 s, period: 10 ms, delay: none, low: -100, high: 100}}
  block: {{type: Mass, mass: 1 kg}}
  hand: {{type: ForceSource, force: 1 N}}
connections: [[wanted.signal, control.reference], [measured.signal, control.measured], [block.flange, hand.flange]]
effects: {{sampling: "{sampling}"}}
run: {{stop: 2 s, accuracy: 1e-6}}
record: {{signals: [control.integral, control.command]}}
"""


@pytest.mark.parametrize("sampling", ["on", "off"])
def test_the_integral_of_a_controller_grows_with_the_error(simulate, sampling):
    """I = K_p/T_i e t; held for a sample of 10 ms, or behind by the anti-windup of a command that lags 1 ms."""
    result = simulate(CONTROLLED.format(sampling=sampling))
    exact = 3 / 4 * 1.5 * result.t
    assert np.abs(result["control.integral"] - exact).max() < 3 / 4 * 1.5 * 0.01 + 5e-3
    assert result["control.integral"][-1] > 2.2
    assert result["control.command"][-1] == pytest.approx(3 * 1.5 + result["control.integral"][-1], abs=0.02)

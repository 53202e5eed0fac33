"""A line that starts under the tensions of statics: profile: statics."""

import math

import numpy as np
import pytest

from fairlead.errors import ModelError

SCENE = """
components:
  line: {type: TYPE, length: 12 m, element: 0.125 m, start: 0 m, tension: 100 N, profile: statics, MORE}
  route:
    type: Route
    stations: [{type: Bend, start: 4 m, angle: 90 deg, radius: 1 m, friction: 0.3}]
  haul: {type: MotionSource, velocity: {ramp: {to: VELOCITY, over: 1 s}}}
  load: {type: ForceSource, force: 100 N}
connections:
  - [line.path, route.path]
  - [haul.flange, line.inboard]
  - [load.flange, line.outboard]
friction: {method: hold}
run: {stop: 10 ms}
record: {every: 10 ms, signals: ["line.*[*].tension"]}
"""
ROPE = "mass: 0.5 kg/m, stiffness: 1 MN"
ARRAY = "hose: {mass: 1 kg/m, stiffness: 8 kN}, core: {mass: 4 kg/m, stiffness: 500 kN}"
MIDDLES = (np.arange(96) + 0.5) * 0.125


def text(kind, more, velocity):
    return SCENE.replace("TYPE", kind).replace("MORE", more).replace("VELOCITY", velocity)


@pytest.mark.parametrize(("velocity", "sense"), [("-0.2 m/s", -1), ("0.2 m/s", 1)])
def test_every_element_of_a_rope_begins_with_the_tension_of_the_capstan(simulate, velocity, sense):
    result = simulate(text("Cable", ROPE, velocity))
    told = result.columns([f"line.line[{k}].tension" for k in range(96)])[0]
    left = np.clip(4 + math.pi / 2 - MIDDLES, 0, math.pi / 2)  # rad to the outboard end of the bend
    np.testing.assert_allclose(told, 100 * np.exp(-sense * 0.3 * left), rtol=1e-9)


@pytest.mark.slow
def test_both_layers_of_an_array_begin_with_one_strain(simulate):
    result = simulate(text("ArrayModule", ARRAY, "-0.2 m/s"))
    hose, core = (result.columns([f"line.{layer}[{k}].tension" for k in range(96)])[0] for layer in ("hose", "core"))
    left = np.clip(4 + math.pi / 2 - MIDDLES, 0, math.pi / 2)
    np.testing.assert_allclose(hose + core, 100 * np.exp(0.3 * left), rtol=1e-9)
    np.testing.assert_allclose(hose / 8, core / 500, rtol=1e-9)


def test_a_line_that_no_reference_moves_cannot_begin_so(scene):
    still = text("Cable", ROPE, "-0.2 m/s").replace("{ramp: {to: -0.2 m/s, over: 1 s}}", "0 m/s")
    with pytest.raises(ModelError, match="no reference tells which way the line will move"):
        scene(still).check()

"""The verdict of a line that is watched for rucking, where a run ended between two rows, or before the first."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.margins.ruck import sentence, verdicts

SCENE = """
components:
  line: {type: ArrayModule, length: 8 m, element: 0.25 m, start: -4 m, tension: 200 N, ruck_force: 160 N,
         hose: {mass: 1.6 kg/m, stiffness: 8 kN}, core: {mass: 4.2 kg/m, stiffness: 500 kN}}
  route: {type: Route, stations: [{type: Bend, start: 0 m, angle: 90 deg, radius: 1 m, friction: 0.6}]}
  drive: {type: MotionSource, velocity: {ramp: {to: -0.3 m/s, over: 1 s}}}
  load: {type: ForceSource, force: 200 N}
connections: [[line.path, route.path], [drive.flange, line.inboard], [load.flange, line.outboard]]
run: {stop: 4 s}
record: {every: 0.2 s, signals: ["line.hose[*].tension", "line.core[*].tension", "line.hose_node[*].x"]}
"""


@pytest.mark.parametrize("steps", [150, 200, 260])
def test_its_lowest_tension_may_lie_behind_the_last_row(scene, tmp_path, steps):
    result = scene(SCENE).run(out=tmp_path / "run", check=False, max_steps=steps)
    assert result.status == "budget"
    (found,) = verdicts(result)
    assert found["rucks"] is False
    assert found["compressed"] > 10
    assert found["place"] is not None
    assert result.t[-1] <= found["t"] + 0.2


def test_a_run_without_a_row_has_none():
    assert verdicts(SimpleNamespace(t=np.empty(0))) == []


def test_a_compression_that_its_damping_brings_beyond_the_limit_is_no_margin_below_one():
    found = {"line": "l", "ruck_force": 138.0, "rucks": False, "compressed": 139.45, "margin": 138 / 139.45,
             "t": 0.2, "element": 31}  # fmt: skip
    assert sentence(found).endswith("with its damping, but without that by no more than 138 N")
    assert "margin" not in sentence(found)

"""The first sample reads a scene that has settled, whenever the run begins."""

import pytest

import fairlead

LIMITED = """
schema: 1
components:
  given: {{type: SignalSource, value: 5}}
  part: {{type: {part}}}
  held: {{type: {reader}}}
connections:
  - [given.signal, part.value]
  - [part.signal, held.value]
run: {{start: {start} s, stop: {stop} s, engine: {engine}}}
"""

PUSHED = """
schema: 1
components:
  hand: {{type: ForceSource, force: 10 N}}
  block: {{type: Mass, mass: 1 kg, velocity: 1 m/s}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.3}}
  floor: {{type: Ground}}
  seen: {{type: SampleHold, period: 20 ms}}
connections:
  - [hand.flange, block.flange, pad.a]
  - [pad.b, floor.flange]
  - [pad.friction, seen.value]
run: {{start: {start} s, stop: {stop} s, engine: {engine}}}
"""

STARTS = [0.0, 0.3, 1.0, 5.0, -5.0, 1e3, 1e6]


def first_sample(tmp_path, text, signal, start, **names):
    netlist = tmp_path / "scene.yaml"
    netlist.write_text(text.format(start=start, stop=start + 0.1, **names), encoding="utf-8")
    result = fairlead.load(netlist).run(out=None)
    return result[signal][0], result[signal][result.t > start + 0.005][0]


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_limited_signal_is_sampled_within_its_limits(tmp_path, engine, start):
    names = {"part": "Limiter, low: -1, high: 1", "reader": "SampleHold, period: 20 ms", "engine": engine}
    assert first_sample(tmp_path, LIMITED, "held.signal", start, **names) == (1.0, 1.0)


@pytest.mark.parametrize(("part", "told"), [
    ("DeadZone, band: 0.5", 4.5), ("SignalSize", 5.0), ("Relay, upper: 1, lower: 0, on: 7, off: -7", 7.0),
])  # fmt: skip
@pytest.mark.parametrize("start", [0.0, 1.0, 1e3])
def test_so_is_whatever_has_zones(tmp_path, part, told, start):
    names = {"part": part, "reader": "SampleHold, period: 20 ms", "engine": "rodas"}
    assert first_sample(tmp_path, LIMITED, "held.signal", start, **names) == (told, told)


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_friction_is_sampled_while_it_slides(tmp_path, engine, start):
    first, soon = first_sample(tmp_path, PUSHED, "seen.signal", start, engine=engine)
    assert abs(first) == pytest.approx(3.0, rel=1e-6)
    assert soon == first

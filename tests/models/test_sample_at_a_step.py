"""Samples that fall on a step of a source read what the source has from then on, on every way from it to the sample.

Zones of dead zones, tables and their like settle after a step. A sample must not read the new value in an old zone:
that is neither what was nor what is, and it is held for a whole period.
"""

import pytest

BLOCKS = {
    "size": ("{type: SignalSize}", -1.0, 3.0, (1.0, 3.0)),
    "limiter": ("{type: Limiter, low: -0.5, high: 0.7}", -1.0, 3.0, (-0.5, 0.7)),
    "dead zone": ("{type: DeadZone, band: 0.2, gain: 2}", -1.0, 3.0, (-1.6, 5.6)),
    "table": ("{type: SignalTable, points: [[-2, 5], [0, 0], [1, 2], [4, 10]]}", -1.0, 3.0, (2.5, 22 / 3)),
    "function": ('{type: SignalFunction, expression: "max(abs(a) - 0.5, a*3)"}', -1.0, 3.0, (0.5, 9.0)),
    "there and back": ("{type: SignalSize}", 0.6, -0.6, (0.6, 0.6)),
}
SCENE = """
components:
  s: {{type: SignalSource, value: {{step: {{from: {before}, to: {after}, at: 0.3 s}}}}}}
  {block}: {what}
  hold: {{type: SampleHold, period: 0.1 s}}
  next: {{type: SampleHold, period: 0.1 s}}
connections:
  - [s.signal, {block}.{port}]
  - [{block}.signal, hold.value]
  - [hold.signal, next.value]
run: {{stop: 0.6 s}}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("name", BLOCKS)
def test_a_sample_reads_the_step_in_the_zone_that_goes_with_it(simulate, name, engine):
    what, before, after, (was, now) = BLOCKS[name]
    port = "a" if name == "function" else "value"
    text = SCENE.format(before=before, after=after, what=what, block="b", port=port)
    result = simulate(text, **{"run.engine": engine})
    assert [result.at("hold.signal", t) for t in (0.25, 0.35, 0.45)] == pytest.approx([was, now, now])
    assert [result.at("next.signal", t) for t in (0.35, 0.45)] == pytest.approx([was, now])  # one sample later
    changes = [event for event in result.events if event.component == "b" and event.t > 0.0]
    assert all(event.t == pytest.approx(0.3) for event in changes)  # zones settle once, and are logged as ever


def test_names_do_not_matter(simulate):
    what, before, after, (_, now) = BLOCKS["dead zone"]
    for block in ("a", "z"):
        result = simulate(SCENE.format(before=before, after=after, what=what, block=block, port="value"))
        assert result.at("hold.signal", 0.35) == pytest.approx(now)


def test_nothing_happens_to_a_loop_that_measures_the_size_of_what_turns_round(simulate):
    """A load of 0.6 that becomes -0.6 on a sample: its size stays, and the command goes on as without it."""
    loop = """
    components:
      load: {{type: SignalSource, value: {{step: {{from: 0.6, to: {to}, at: 2 s}}}}}}
      size: {{type: SignalSize}}
      plant: {{type: SignalLag, lag: 0.2 s}}
      reference: {{type: SignalSource, value: 1}}
      ctl: {{type: Pid, gain: 1, integral_time: 0.5 s, period: 0.1 s}}
      sum: {{type: Sum, gain_b: 3}}
    connections:
      - [reference.signal, ctl.reference]
      - [load.signal, size.value]
      - [size.signal, sum.b]
      - [plant.signal, sum.a]
      - [sum.signal, ctl.measured]
      - [ctl.command, plant.value]
    run: {{stop: 4 s, accuracy: 1e-8}}
    """
    turned, kept = (simulate(loop.format(to=to)) for to in (-0.6, 0.6))
    for t in (1.95, 2.05, 2.15, 3.0):
        assert turned.at("ctl.command", t) == pytest.approx(kept.at("ctl.command", t), abs=1e-6)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_what_is_sampled_at_the_start_reads_what_a_delay_begins_with(simulate, engine):
    """Two delays in a row and a sample: 7 until what came in at the start has gone through both."""
    text = """
    components:
      s: {type: SignalSource, value: 3}
      one: {type: SignalDelay, samples: 3, initial: 7, period: 10 ms}
      two: {type: SignalDelay, samples: 2, initial: 7, period: 10 ms}
      hold: {type: SampleHold, period: 10 ms}
    connections: [[s.signal, one.value], [one.signal, two.value, hold.value]]
    run: {stop: 0.1 s}
    """
    result = simulate(text, **{"run.engine": engine})
    assert [result.at("two.signal", t) for t in (0.005, 0.025, 0.045, 0.055)] == pytest.approx([7, 7, 7, 7])
    assert result.at("two.signal", 0.075) == pytest.approx(3)
    assert [result.at("hold.signal", t) for t in (0.005, 0.035, 0.045)] == pytest.approx([7, 7, 3])

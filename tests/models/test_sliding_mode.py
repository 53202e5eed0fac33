"""A comparator without hysteresis whose output drives its input back: at its level it has no zone to rest in."""

import pytest

import fairlead

DWELL = 1e-3  # s
DRIFT, PULL = 0.5, 1.25  # 1/s: what drives the integral up, and what the relay takes off while it is on

SCENE = """
schema: 1
components:
  level: {{type: Integrator, initial: -0.2}}
  {relay}: {{type: Relay, upper: 0.0, on: {on}, off: {off}}}
connections:
  - [level.signal, {relay}.value]
  - [{relay}.signal, level.value]
run: {{stop: 2 s, chatter: {chatter}, dwell: 1 ms, engine: {engine}}}
"""


def played(tmp_path, *, chatter="hold", engine="rodas", relay="relay", scale=1.0):
    netlist = tmp_path / "scene.yaml"
    on, off = (DRIFT - PULL) * scale, DRIFT * scale
    netlist.write_text(SCENE.format(chatter=chatter, engine=engine, relay=relay, on=on, off=off), encoding="utf-8")
    return fairlead.load(netlist).run(out=None, check=False)


@pytest.mark.parametrize("scale", [1.0, 30.0])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_what_is_held_for_a_dwell_stays_within_a_dwell_of_its_level(tmp_path, engine, scale):
    with pytest.warns(fairlead.RunWarning, match="relay switched to and fro"):
        result = played(tmp_path, engine=engine, scale=scale)
    assert result.ok
    late = result.t > 0.5
    assert abs(result["level.signal"][late]).max() < 2 * DWELL * max(PULL - DRIFT, DRIFT) * scale
    # Filippov: the relay is on for the share DRIFT/PULL of the time, so that its mean is what keeps the level
    mean = (result["level.signal"][-1] - result["level.signal"][result.t >= 0.5][0]) / 1.5
    assert mean == pytest.approx(0.0, abs=2 * DWELL * PULL * scale)


def test_what_circles_at_one_instant_is_one_switch_of_the_log(tmp_path):
    with pytest.warns(fairlead.RunWarning):
        result = played(tmp_path)
    assert len(result.events) == result.run["counters"]["switches"] <= 2.0 / DWELL


def test_where_nothing_is_to_be_held_the_run_ends_and_names_hysteresis(tmp_path):
    result = played(tmp_path, chatter="warn", relay="valve")
    assert not result.ok
    assert "valve" in result.run["sentence"]
    assert "hysteresis" in result.run["sentence"]

"""A dead band with hysteresis, and the controller that rests within one: what is heard, its limit, and its rest."""

import pathlib

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError

SCENE = pathlib.Path(__file__).parents[2] / "models" / "single_parts" / "dead_band_pid.yaml"
BAND = """
components:
  swing: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 1 Hz}}}
  rest: {type: DeadBand, band: 0.5, EDGE}
connections: [[swing.signal, rest.value]]
run: {stop: 2 s, engine: ENGINE}
record: {every: 1 ms, signals: [rest.signal, swing.signal]}
"""
ENGINES = ("rodas", "ida", "stepping")


def band(edge="inner: 0.2", engine="auto"):
    return BAND.replace("EDGE", edge).replace("ENGINE", engine)


def run(**settings):
    result = fairlead.load(SCENE, set=settings).run(out=None)
    assert result.ok
    return result


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("edge", "inner"), [("inner: 0.2", 0.2), ("gone: 0", 0.25)])
def test_a_sine_is_heard_from_where_it_leaves_the_band_to_where_it_is_well_within(simulate, edge, inner, engine):
    """From asin(0.5) on to pi - asin(inner), the same half a turn later with the other sign; whole, and silent else."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = simulate(band(edge if "inner" in edge else "", engine).replace(", }", "}"))
    angle = 2 * np.pi * result.t % np.pi
    begins, ends = np.arcsin(0.5), np.pi - np.arcsin(inner)
    heard = (angle > begins) & (angle < ends)
    clear = np.minimum(abs(angle - begins), abs(angle - ends)) > 2 * np.pi * 1e-3  # a row beside a jump may be either
    assert np.abs(np.where(heard, np.sin(2 * np.pi * result.t), 0.0) - result["rest.signal"])[clear].max() < 1e-6
    for k, event in enumerate(result.events):
        turn, what = divmod(k, 2)
        assert event.t == pytest.approx((turn * np.pi + (begins, ends)[what]) / (2 * np.pi), abs=1e-3)
    assert len(result.events) == 8


@pytest.mark.parametrize("engine", ENGINES)
def test_a_control_of_a_slide_with_stiction_rests_once_it_is_well_within_its_band(engine):
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = run(**{"run.engine": engine})
    late = result.t > 2
    assert np.abs(result["slide.v"][late]).max() < 1e-9
    assert np.abs(result["control.error"][late]).max() < 2e-3
    assert np.abs(result["control.heard"][late]).max() == 0
    assert np.ptp(result["control.integral"][late]) < 1e-9  # it stays
    assert result["guide.force"][-1] == pytest.approx(result["control.command"][-1], abs=1e-6)


@pytest.mark.parametrize("sampling", ["on", "off"])
def test_a_band_of_nothing_is_the_controller_without_one(simulate, sampling):
    text = "components:" + SCENE.read_text(encoding="utf-8").partition("components:")[2]
    text = text.replace("sampling: off", f"sampling: {sampling}")
    plain = text.replace("DeadBandPid", "Pid").replace("    band: 2e-3\n    inner: 1e-3\n", "")
    plain = plain.replace(" control.heard,", "")
    settings = {"run.stop": "0.5 s", "run.accuracy": "1e-6", "record.every": "1 ms"}
    narrow = simulate(text, **settings, **{"control.band": "1e-12", "control.inner": "1e-13"})
    without = simulate(plain, **settings)
    t = np.linspace(5e-3, 0.495, 50)  # between samples, which are 10 ms apart
    assert np.abs(narrow.at("slide.x", t) - without.at("slide.x", t)).max() < 1e-6
    assert np.abs(narrow.at("control.integral", t) - without.at("control.integral", t)).max() < 1e-3


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ("inner: 0.5", r"rest.inner: inner 0.5 is not below band = 0.5"),
        ("inner: 0", r"rest.inner = 0"),
        ("gain: 2", r"rest.gain"),
    ],
)
def test_a_band_that_contradicts_itself_is_refused(scene, given, says):
    with pytest.raises(ModelError, match=says):
        scene(band(given)).check()


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"control.inner": "3e-3"}, r"inner 0.003 is not below band = 0.002"),
        ({"control.high": "-500"}, r"high -500 is not above low -400"),
        ({"control.band": "0"}, r"control.band = 0"),
    ],
)
def test_a_controller_that_contradicts_itself_is_refused(given, says):
    with pytest.raises(ModelError, match=says):
        fairlead.load(SCENE, set=given).check()

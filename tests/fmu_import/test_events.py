"""Event mode and early return of FMI 3.0, discarded steps of FMI 2 and 3: exact where points and events do not meet.

The FMUs fail at every call in a mode that the standard forbids, and at every step over an event.
"""

import math

import numpy as np
import pytest

from fairlead.errors import RunError
from fairlead.foreign import underway
from tests.fmu_import.build import EVENT_MODE, EVENTS
from tests.fmu_import.test_fmu import fall

FREE = """
    components:
      fmu: {type: Fmu, file: %s, period: %s, parameters: {%s}}
      ramp: {type: SignalSource, value: {ramp: {to: 1, over: 1 s}}}
    connections: [[ramp.signal, fmu.free]]
    run: {stop: %s}
    record: {every: 10 ms}
"""


def test_a_ball_that_comes_back_early_at_each_bounce_flies_exactly(make, load):
    """It stops every step at the ground, with up to four bounces within one; two updates of discrete states each."""
    make("ball", rich=True)
    result = load("""
        components: {fmu: {type: Fmu, file: rich_ball3.fmu, period: 70 ms, parameters: {e: 0.6}}}
        run: {stop: 1.75 s}
    """).run(out=None)
    points = 0.07 * np.arange(24)
    heights, bounces = np.transpose([fall(t, restitution=0.6) for t in points])
    np.testing.assert_allclose(result.at("fmu.h", points + 0.003), heights, atol=1e-12)
    np.testing.assert_allclose(result.at("fmu.bounces", points + 0.003), bounces, atol=1e-12)
    assert result.at("fmu.updates", 1.62) == pytest.approx(1 + 2 * bounces[-1])


@pytest.mark.parametrize("period", [0.3, pytest.param(0.25, marks=pytest.mark.slow)])
def test_a_stair_rises_at_its_time_events_whether_points_meet_them_or_not(make, load, period):
    """One more at every second: the counter is 1 + floor(t)."""
    make("stair", rich=True)
    result = load(f"""
        components: {{fmu: {{type: Fmu, file: rich_stair3.fmu, period: {period} s}}}}
        run: {{stop: 4.5 s}}
    """).run(out=None)
    points = period * np.arange(int(4.5 / period))
    wanted = 1 + np.floor(points + 1e-9)
    np.testing.assert_allclose(result.at("fmu.counter", points + 0.01), wanted, atol=1e-9)
    assert result.at("fmu.visits", 4.45) == pytest.approx(4)


@pytest.mark.parametrize("period", [0.1, pytest.param(0.3, marks=pytest.mark.slow)])
def test_a_time_event_that_the_fmu_sees_a_rounding_error_late_is_handled(make, load, period):
    """It adds 0.1 to 0.1 and compares exactly; points are at k * 0.1, which is at times below that sum."""
    make("strict", rich=True)
    result = load(f"""
        components: {{fmu: {{type: Fmu, file: rich_strict3.fmu, period: {period} s}}}}
        run: {{stop: 6.05 s}}
    """).run(out=None)
    points = period * np.arange(round(6 / period) + 1)
    wanted = 1 + np.round(10 * points)
    np.testing.assert_allclose(result.at("fmu.counter", points + 0.02), wanted, atol=1e-9)


@pytest.mark.slow
def test_an_fmu_whose_steps_have_one_length_has_its_events_at_communication_points(make, load):
    make("stair", rich=True, more='hasEventMode="true"', name="even_stair")
    result = load("""
        components: {fmu: {type: Fmu, file: even_stair3.fmu, period: 0.25 s}}
        run: {stop: 2.5 s}
    """).run(out=None)
    points = 0.25 * np.arange(10)
    np.testing.assert_allclose(result.at("fmu.counter", points + 0.01), 1 + np.floor(points), atol=1e-9)


@pytest.mark.slow
def test_inputs_that_change_are_set_in_event_mode_and_others_cause_none(make, load):
    make("stair", rich=True)
    result = load(FREE % ("rich_stair3.fmu", "0.3 s", "", "0.95 s")).run(out=None)
    np.testing.assert_allclose(result.at("fmu.visits", [0.1, 0.4, 0.7, 0.94]), [0, 1, 2, 3], atol=1e-9)
    still = load("""
        components: {fmu: {type: Fmu, file: rich_stair3.fmu, period: 0.3 s}}
        run: {stop: 0.95 s}
    """).run(out=None)
    assert still.at("fmu.visits", 0.94) == 0


@pytest.mark.parametrize("version", [3, pytest.param(2, marks=pytest.mark.slow)])
def test_a_step_that_is_discarded_is_done_in_shorter_ones(make, load, version):
    """Steps above 30 ms are discarded: of FMI 3 as if they had not been tried, of FMI 2 after a part of them."""
    make("choosy", version, rich=version == 3, name="choosy",
         variables=[{"name": "x", "ref": 30 if version == 3 else 0, "causality": "output"}],
         more='canHandleVariableCommunicationStepSize="true"')  # fmt: skip
    result = load(f"""
        components: {{fmu: {{type: Fmu, file: choosy{version}.fmu, period: 0.1 s}}}}
        run: {{stop: 0.95 s}}
    """).run(out=None)
    points = 0.1 * np.arange(9)
    np.testing.assert_allclose(result.at("fmu.x", points + 0.05), np.exp(-points), rtol=1e-13)


@pytest.mark.slow
def test_a_ball_is_saved_and_restored_amid_its_bounces(make, load):
    make("ball", rich=True)
    run = load("""
        components: {fmu: {type: Fmu, file: rich_ball3.fmu, period: 70 ms, parameters: {e: 0.6}}}
        run: {stop: 2 s}
    """).start()
    run.advance(0.8)
    state = run.save()
    for _ in range(2):
        run.advance(1.5)
        assert run.get("fmu.h") == pytest.approx(fall(0.07 * 21, restitution=0.6)[0], abs=1e-12)
        run.restore(state)


CLAIMS = [{"name": "h", "ref": 30, "causality": "output"}, *EVENTS]


@pytest.mark.parametrize(
    ("kind", "more", "told"),
    [
        ("unsettled", EVENT_MODE, r"unsettled3\.fmu: its discrete states do not settle at 0 s in 1000 updates"),
        pytest.param("stands", EVENT_MODE, r"it comes back from doStep at 0 s again and again", marks=pytest.mark.slow),
        pytest.param("never", EVENT_MODE, r"it names 1 s as the time of its next event, and has none there",
                     marks=pytest.mark.slow),
        pytest.param("beyond", EVENT_MODE, r"it came back at 0\.2 s from a step from 0 s to 0\.1 s",
                     marks=pytest.mark.slow),
        pytest.param("choosy", 'hasEventMode="true"', r"it discards the step from 0 s to 0\.1 s\. Look at its inputs",
                     marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_what_goes_wrong_with_events_is_told(make, load, kind, more, told):
    make(kind, rich=True, variables=CLAIMS, more=more)
    with pytest.raises(RunError, match=told):
        load(f"""
            components: {{fmu: {{type: Fmu, file: rich_{kind}3.fmu, period: 0.1 s}}}}
            run: {{stop: 1.2 s}}
        """).run(out=None)


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ("crash", r"the process of rich_crash3\.fmu ended by SIGSEGV in updateDiscreteStates\."),
        ("hang", r"rich_hang3\.fmu did not come back from updateDiscreteStates within 2 s"),
    ],
)
def test_a_call_of_event_mode_that_ends_the_process_is_named(make, load, kind, told):
    """An input that changes brings it into event mode at each point; from the second on it fails there."""
    make(kind, rich=True, variables=CLAIMS)
    text = FREE % (f"rich_{kind}3.fmu", "0.1 s", "", "1 s")
    with pytest.raises(RunError, match=told):
        load(text.replace("period:", "time_limit: 2 s, period:")).run(out=None)


@pytest.mark.parametrize(
    ("call", "does"),
    [("fmi3EnterInitializationMode", "enterInitializationMode"), ("fmi3GetFloat64", "getFloat64"),
     ("fmi2DoStep", "doStep"), ("", "")],
)  # fmt: skip
def test_a_call_is_known_by_its_name_while_it_is_under_way(tmp_path, call, does):
    underway.make(tmp_path / "memory")
    told = underway.Underway(str(tmp_path / "memory"))
    with told.call(call):
        assert underway.read(tmp_path / "memory") == does
    assert underway.read(tmp_path / "memory") == ""


def test_variables_that_are_binary_or_text_are_left_alone_until_a_signal_wants_them(make, load):
    """The FMU fails if they are read or set."""
    kinds = [{"name": "h", "ref": 30, "causality": "output"},
             {"name": "picture", "ref": 90, "causality": "input", "kind": "Binary", "start": "00ff"},
             {"name": "film", "ref": 91, "causality": "output", "kind": "Binary"},
             {"name": "title", "ref": 92, "causality": "output", "kind": "String"}]  # fmt: skip
    make("stair", rich=True, variables=kinds, name="binary")
    text = """
        components: {fmu: {type: Fmu, file: binary3.fmu, period: 0.1 s%s}}
        run: {stop: 0.3 s}
    """
    assert load(text % "").run(out=None).at("fmu.h", 0.25) == 1
    for wanted, told in [
        (", inputs: {a: picture}", r"fmu\.inputs\.a: picture is Binary, and a signal is one number\.\n +Leave it out"),
        (", outputs: {a: film}", r"fmu\.outputs\.a: film is Binary, and a signal is one number"),
        (', parameters: {picture: "00"}', r"picture is Binary.*\n +Leave it out; it keeps its own start"),
    ]:
        with pytest.raises(Exception, match=told):
            load(text % wanted).check()


def test_fall_is_the_formula_of_a_ball():
    """The reference itself: at the first contact of a ball from 1 m, and half of the speed back."""
    at = math.sqrt(2 / 10)
    assert fall(at - 1e-9)[0] == pytest.approx(0, abs=1e-7)
    assert fall(at + 0.5 * at)[0] == pytest.approx(0.25, rel=1e-12)

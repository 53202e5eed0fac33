"""Clocks of FMI 3.0: the FMU fails at a tick that is not at its time, and at clocked variables in between."""

import re

import numpy as np
import pytest

from fairlead.errors import ModelError, RunError
from tests.fmu_import.build import CLOCKS, EVENT_MODE

CLOCKED = """
    components:
      fmu: {type: Fmu, file: rich_clocked3.fmu, period: %s, parameters: {%s}}
      ramp: {type: SignalSource, value: {ramp: {to: 10, over: 10 s}}}
      steps: {type: Fmu, file: rich_stair3.fmu, period: 0.25 s}
    connections: [[ramp.signal, fmu.u], [steps.counter, fmu.trigger]]
    run: {stop: 3.1 s}
"""
TICKS = "fmu.ticks_"


@pytest.fixture(scope="module")
def clocked(make):
    """The FMUs, once."""
    make("stair", rich=True)
    return make("clocked", rich=True)


def r(t):
    """Ticks of r up to t: 0.1, 0.35, 0.6 ..."""
    return int(np.floor((t - 0.1) / 0.25 + 1e-9)) + 1 if t >= 0.1 - 1e-9 else 0


def test_each_kind_of_clock_ticks_at_its_times(clocked, load):
    """r: 0.1 + 0.25 k, q: 0.5 k, p: 0.15 + 0.3 k, g after 0.1, 0.2, 0.3 ..., d 0.05 after r; out every second r.

    The clock `fourth` is clocked itself, and may be asked only when `out` ticks.
    """
    result = load(CLOCKED % ("0.25 s", "")).run(out=None)
    for t in (0.0, 0.25, 0.5, 1.25, 2.75):
        wanted = {
            "r": r(t), "q": int(t / 0.5 + 1e-9) + 1, "p": int((t - 0.15) / 0.3 + 1e-9) + 1 if t > 0.1 else 0,
            "g": sum(0.1 * k * (k + 1) / 2 <= t + 1e-9 for k in range(1, 20)), "d": r(t - 0.05),
        }  # fmt: skip
        found = {name: result.at(f"{TICKS}{name}", t + 0.01) for name in wanted}
        assert found == pytest.approx(wanted, abs=1e-9), t
        assert result.at("fmu.out", t + 0.01) == pytest.approx(wanted["r"] // 2)
        assert result.at("fmu.fourth", t + 0.01) == pytest.approx(wanted["r"] // 4)


@pytest.mark.parametrize(
    ("period", "first", "seen"), [("50 ms", 0.1, 1.37), pytest.param("0.25 s", 0.0, 1.51, marks=pytest.mark.slow)]
)
def test_a_clocked_input_is_the_one_of_the_last_point_and_a_clocked_output_is_held(clocked, load, period, first, seen):
    """`total` sums u = t at six ticks of r. Points every 50 ms meet them; with 250 ms the input is that of the last."""
    result = load(CLOCKED % (period, "")).run(out=None)
    assert result.at("fmu.total", seen) == pytest.approx(sum(first + 0.25 * np.arange(6)), rel=1e-9)


@pytest.mark.slow
def test_a_triggered_clock_ticks_when_its_signal_rises(clocked, load):
    """Points are every 0.25 s, and values of another FMU are one sample old: 0 before its first, then 1, 2, 3, 4."""
    result = load(CLOCKED % ("0.25 s", "")).run(out=None)
    np.testing.assert_allclose(result.at(f"{TICKS}trigger", [0.9, 1.3, 2.3, 3.05]), [1, 2, 3, 3], atol=1e-9)


@pytest.mark.slow
def test_the_netlist_gives_an_interval_and_a_parameter_changes_one(clocked, load):
    """q every 0.4 s, p every 0.2 s from 0.15 s on."""
    result = load(CLOCKED % ("0.25 s", "q: 400 ms, every: 0.2 s")).run(out=None)
    assert result.at(f"{TICKS}q", 2.76) == pytest.approx(7)
    assert result.at(f"{TICKS}p", 2.76) == pytest.approx(14)


@pytest.mark.slow
def test_clocks_go_with_the_state(clocked, load):
    run = load(CLOCKED % ("0.25 s", "")).start()
    run.advance(0.8)
    state = run.save()
    for _ in range(2):
        run.advance(2.4)
        assert [run.get(f"{TICKS}{one}") for one in "rqpgd"] == [r(2.25), 5, 8, 6, 9]
        run.restore(state)
        assert run.get(f"{TICKS}r") == 3


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("parameters: {q: 0 s}", r"the clock q has an interval of 0 s\.\n +Give a time above 0"),
        ("parameters: {q: 3 m}", r"3 m is a length, not a time"),
        ("parameters: {r: 1 s}", r"r is a clock with intervalVariability constant: the FMU alone says when it ticks"),
        ("parameters: {p: 1 s}", r"p is a clock with intervalVariability fixed: the FMU alone"),
        ("parameters: {out: 1 s}", r"out is a triggered clock and has no interval"),
        ("inputs: {a: r}", r"fmu\.inputs\.a: r is a clock \(constant\), which ticks by itself\.\n +Leave it out"),
        ("outputs: {a: trigger}", r"trigger is input and cannot be one of its outputs"),
    ],
)
def test_a_mistake_about_clocks_is_told_at_its_place(clocked, load, given, told):
    with pytest.raises(ModelError) as refused:
        load(f"""
components:
  fmu:
    type: Fmu
    file: rich_clocked3.fmu
    period: 1 s
    {given}
run: {{stop: 1 s}}
""").check()
    found = "\n".join(map(str, refused.value.faults))
    assert re.search(told, found), found


P = next(one for one in CLOCKS if one["name"] == "p")


@pytest.mark.parametrize(
    ("kind", "more", "told"),
    [
        pytest.param("lost", EVENT_MODE, r"t = 0 s: fmu.*lost3\.fmu: it gives the clock p an interval of nan s",
                     marks=pytest.mark.slow),
        pytest.param("clocked", 'hasEventMode="true"', r"its clock p ticks at 0\.15 s, between two communication po",
                     marks=pytest.mark.slow),
    ],
)  # fmt: skip
def test_an_interval_that_the_fmu_gives_at_run_time_is_judged(make, load, kind, more, told):
    file = make(kind, rich=True, variables=[P], more=more, name=f"only_{kind}").name
    with pytest.raises(RunError, match=told):
        load(f"components: {{fmu: {{type: Fmu, file: {file}, period: 0.25 s}}}}\nrun: {{stop: 1 s}}").run(out=None)


ODD = {"name": "r", "ref": 100, "causality": "input", "kind": "Clock"}
CONSTANT = {"intervalVariability": "constant"}


@pytest.mark.parametrize(
    ("clock", "more", "told"),
    [
        ({}, EVENT_MODE, r"has the clock r, of which nothing says when it ticks: intervalVariability is missing"),
        ({"intervalVariability": "daily"}, EVENT_MODE, r"intervalVariability is daily"),
        (CONSTANT, EVENT_MODE, r"the constant clock r without an interval \(intervalDecimal\)"),
        (CONSTANT | {"intervalDecimal": 0}, EVENT_MODE, r"r with an interval of 0 s, .* above 0"),
        (CONSTANT | {"intervalDecimal": "nan"}, EVENT_MODE, r"the clock r with intervalDecimal = nan"),
        (CONSTANT | {"intervalDecimal": 0.1}, "",
         r"has clocks \(r\) and no event mode \(hasEventMode\)"),
        (CONSTANT | {"intervalDecimal": 0.3}, 'hasEventMode="true"',
         r"steps of one length only, and its clock r has the interval 0\.3 s, which is no multiple of period = 1 s"),
    ],
)  # fmt: skip
def test_a_clock_that_cannot_tick_is_told(make, load, clock, more, told):
    make("clocked", rich=True, variables=[ODD | clock], more=more, name="odd_clock")
    with pytest.raises(ModelError) as refused:
        load("components: {fmu: {type: Fmu, file: odd_clock3.fmu, period: 1 s}}\nrun: {stop: 1 s}").check()
    found = "\n".join(map(str, refused.value.faults))
    assert "odd_clock3.fmu" in found
    assert re.search(told, found), found

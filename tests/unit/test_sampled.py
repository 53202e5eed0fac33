"""Discrete variables and sample times: exact between samples, all samplers of an instant see what was before."""

import ctypes

import numpy as np
import pytest

from fairlead.errors import ModelError

FEEDBACK = """
    class Feedback(Component):
        flange = Translational("the body it pushes")
        period = Parameter("s", above=0)
        stiffness = Parameter("N/m")
        damping = Parameter("N*s/m")
        held = Discrete("N", "force between samples")
        force = Output("N")

        def law(p, flange, held):
            return Law(flange=-held, force=held)

        @sampled(every="period")
        def sample(p, flange):
            return Law(held=-p.stiffness * flange.x - p.damping * flange.v)
"""

COUNTER = """
    class Counter(Component):
        period = Parameter("s", above=0)
        count = Discrete("1")
        shown = Output("1")

        def law(p, count):
            return Law(shown=count)

        @sampled(every="period")
        def sample(p, count):
            return Law(count=count + 1)
"""

FOLLOWER = """
    class Follower(Component):
        seen = Input("1")
        period = Parameter("s", above=0)
        first = Parameter("1")
        value = Discrete("1", start="first")
        shown = Output("1")

        def law(p, value):
            return Law(shown=value)

        @sampled(every="period")
        def sample(p, seen):
            return Law(value=seen)
"""


def just_after(result, name, times):
    """Values on the right of the given times, rounded: reading between two records adds an error in the last digit."""
    return np.array([result.at(name, t, side="right") for t in times]).round(12)


def test_a_sampled_double_integrator_follows_its_exact_recursion(simulate, library):
    """Between samples the force stands still, so  v += T u/m,  x += T v + T^2 u/2m  (zero-order hold, exactly)."""
    text = """
        components:
          cart: {type: Mass, mass: 2 kg, position: 0.1 m, velocity: 0 m/s}
          control: {type: Feedback, period: 50 ms, stiffness: 40 N/m, damping: 12 N*s/m}
        connections: [[cart.flange, control.flange]]
        run: {stop: 2 s}
        record: {signals: [cart.*, control.force]}
    """
    result = simulate(text, libraries=(library(FEEDBACK),))
    period, mass, x, v, u = 0.05, 2.0, 0.1, 0.0, 0.0
    for k in range(40):
        u = -40.0 * x - 12.0 * v
        found = [just_after(result, name, [k * period])[0] for name in ("cart.x", "cart.v", "control.force")]
        np.testing.assert_allclose(found, [x, v, u], rtol=1e-9, atol=1e-11)
        x, v = x + period * v + period**2 * u / (2 * mass), v + period * u / mass


def test_two_samplers_at_one_instant_read_what_was_before_it(simulate, library):
    """Each takes the other's value: they swap for ever, and nobody sees a value of the same instant."""
    text = """
        components:
          wall: {type: Ground}
          mass: {type: Mass, mass: 1 kg}
          spring: {type: Spring, stiffness: 1 N/m}
          left: {type: Follower, period: 0.1 s, first: 1}
          right: {type: Follower, period: 0.1 s, first: 2}
        connections:
          - [wall.flange, spring.a]
          - [spring.b, mass.flange]
          - [left.shown, right.seen]
          - [right.shown, left.seen]
        run: {stop: 1 s}
        record: {signals: [left.shown, right.shown]}
    """
    result = simulate(text, libraries=(library(FOLLOWER),))
    times = np.arange(10) * 0.1
    np.testing.assert_array_equal(just_after(result, "left.shown", times + 0.05), [2, 1] * 5)
    np.testing.assert_array_equal(just_after(result, "right.shown", times + 0.05), [1, 2] * 5)


TWO_CLOCKS = """
    components:
      wall: {type: Ground}
      mass: {type: Mass, mass: 1 kg}
      spring: {type: Spring, stiffness: 1 N/m}
      fast: {type: Counter, period: 0.1 s}
      slow: {type: Counter, period: 0.25 s}
    connections: [[wall.flange, spring.a], [spring.b, mass.flange]]
    run: {stop: 1.02 s, start: 0 s}
    record: {signals: ["*.shown"]}
"""


def test_every_component_keeps_its_own_period(simulate, library):
    result = simulate(TWO_CLOCKS, libraries=(library(COUNTER),))
    for name, period in (("fast", 0.1), ("slow", 0.25)):
        times = np.arange(0, int(1.0 / period) + 1) * period
        np.testing.assert_array_equal(just_after(result, f"{name}.shown", times + 0.01), np.arange(1, len(times) + 1))
        assert set(times[1:]) <= set(result.t.tolist())  # a step lands on every sample, to the last bit


def test_the_first_sample_is_at_the_start_of_the_run(simulate, library):
    result = simulate(TWO_CLOCKS, libraries=(library(COUNTER),), **{"run.start": "0.95 s"})
    assert just_after(result, "fast.shown", [0.96])[0] == 1
    assert result["fast.shown"].max() == 1  # the second would be at 1.05 s, not at 1 s


@pytest.mark.slow
@pytest.mark.parametrize(("start", "period"), [(0.0, 0.1), (0.3, 0.001)])
def test_a_hundred_thousand_sample_times_are_exact(scene, library, start, period):
    """Sample k is at start + k T, computed afresh: a sum of periods would be off by a hundred thousand roundings."""
    settings = {"fast.period": f"{period} s", "slow.period": "1e9 s", "run.start": f"{start} s", "run.stop": "1e6 s"}
    system = scene(TWO_CLOCKS, libraries=(library(COUNTER),), **settings).system.instance()
    number, pointer = ctypes.c_double, ctypes.c_void_p
    next_time = ctypes.CFUNCTYPE(number, pointer, number)(system.callbacks["next_time"])
    at_time = ctypes.CFUNCTYPE(ctypes.c_int64, pointer, number, pointer)(system.callbacks["at_time"])
    y, t = system.initial.copy(), start
    at_time(system.context, t, y.ctypes.data)
    for k in range(1, 100_001):
        t = next_time(system.context, t)
        at_time(system.context, t, y.ctypes.data)
        assert t == start + k * period
    assert sorted(system.memory["sample_count"].tolist()) == [1, 100_001]


def test_a_sampled_law_must_give_every_discrete_variable(library, scene):
    text = COUNTER.replace("Law(count=count + 1)", "Law()")
    with pytest.raises(ModelError, match=r"classes0\.py:\d+.*a sampled law gives Law\(count\)"):
        scene(TWO_CLOCKS, libraries=(library(text),)).check()


def test_a_change_of_a_sampled_law_is_seen_by_the_kernel_cache(library, simulate):
    """The sampled law is part of what a kernel depends on."""
    for step in (1, 2):
        path = library(COUNTER.replace("count + 1", f"count + {step}"))
        assert just_after(simulate(TWO_CLOCKS, libraries=(path,)), "slow.shown", [0.3])[0] == 2 * step


def test_what_is_computed_at_sample_times_is_described(library):
    from fairlead.simulate import describe_type

    said = describe_type("Feedback", (library(FEEDBACK),))
    assert "force = held" in said
    assert "every period, from the values before it" in said
    assert "held = -damping*flange.v - stiffness*flange.x" in said

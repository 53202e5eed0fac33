"""A contact carries loads up to its stiction, and that load itself: one that comes to it and goes no further is held.

Every load here is at its limit to the last digit and no further, so that a contact that lets go would run away: its
friction falls from 6 to 4 N. A thousandth more does that, and the closed form says how far.
"""

from __future__ import annotations

import math

import pytest

ENGINES = ("rodas", "stepping", "ida")
BLOCK = """
    components:
      block: {{type: Mass, mass: {mass}}}
      ground: {{type: Ground}}
      pad: {{type: Contact, {normal}curve: {{curve: coulomb, stiction: 0.6, coulomb: {sliding}}}}}
      {push}
    connections:
      - [block.flange, pad.b, {end}]
      - [ground.flange, pad.a]
      {more}
    run: {{stop: {stop}, accuracy: 1e-5}}
"""
HAND = """hand:
        type: MotionSource
        velocity: {trapezoid: {to: 0.06 m/s, start: 0.5 s, rise: 0.5 s, stay: 0.5 s, fall: 0.5 s}}
      spring: {type: Spring, stiffness: 100 N/m}"""
FALLING = """push: {type: ForceSource, force: 6 N}
      weight: {type: SignalSource, value: {ramp: {from: 30, to: 10, over: 1 s}}}"""


def pushed(force: str) -> str:
    """A force on the block."""
    return f"push: {{type: ForceSource, force: {{{force}}}}}"


LOADS = {
    "ramp": {"push": pushed("ramp: {to: 6 N, over: 1 s}")},
    "two ramps": {"push": pushed("ramp: [{to: 4.2 N, over: 0.3 s}, {to: 1.8 N, over: 1 s, start: 0.5 s}]")},
    "step": {"push": pushed("step: {from: 0 N, to: 6 N, at: 1 s}")},
    "sine": {"push": pushed("sine: {amplitude: 6 N, frequency: 0.25 Hz}")},
    "falling normal force": {"push": FALLING, "normal": "", "more": "- [weight.signal, pad.normal]"},
    "spring": {"push": HAND, "end": "spring.b", "more": "- [hand.flange, spring.a]"},
}
USUAL = {"mass": "1 kg", "normal": "normal_force: 10 N, ", "end": "push.flange", "more": "", "stop": "3 s",
         "sliding": "0.4"}  # fmt: skip


def scene(load: str, **other: str) -> str:
    """The netlist of a block under such a load."""
    return BLOCK.format(**(USUAL | LOADS[load] | other))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("load", LOADS)
def test_a_load_that_comes_to_its_limit_and_no_further_is_held(simulate, load, engine) -> None:
    """Nothing lets go."""
    result = simulate(scene(load), **{"run.engine": engine})
    assert abs(result["block.x"]).max() < 1e-9
    assert not result.events


@pytest.mark.parametrize("engine", ENGINES)
def test_a_thousandth_more_than_the_limit_moves(simulate, engine) -> None:
    """It lets go at 6 N, 1/1.001 s into the ramp, and slides against 4 N; x by the closed form of a linear load."""
    result = simulate(scene("ramp", push=pushed("ramp: {to: 6.006 N, over: 1 s}")), **{"run.engine": engine})
    begin, rate = 6 / 6.006, 6.006
    ramp = 1 - begin
    v, x = 2 * ramp + rate * ramp**2 / 2, ramp**2 + rate * ramp**3 / 6
    assert result["block.x"][-1] == pytest.approx(x + v * 2 + 2.006 * 2**2 / 2, rel=1e-4)
    assert next(event.t for event in result.events if event.component == "pad") == pytest.approx(begin, abs=1e-7)


@pytest.mark.parametrize("change", [{"stop": "1.7 s"}, {"mass": "1 t"}, {"mass": "1 g"}, {"sliding": "0.6"}])
def test_stop_time_mass_and_sliding_friction_decide_nothing(simulate, change) -> None:
    """Nor does what comes after the instant."""
    for load in ("ramp", "sine", "falling normal force"):
        assert abs(simulate(scene(load, **change))["block.x"]).max() < 1e-9


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
def test_ties_do_not_depend_on_the_size_of_forces(simulate, scale, engine) -> None:
    """Forces and masses times a number: the motion is the same."""
    load = {
        "push": pushed(f"sine: {{amplitude: {6 * scale!r} N, frequency: 0.25 Hz}}"), "mass": f"{scale!r} kg",
        "normal": f"normal_force: {10 * scale!r} N, lift: {1e-6 * scale!r} N, ",
    }  # fmt: skip
    assert abs(simulate(scene("sine", **load), **{"run.engine": engine})["block.x"]).max() < 1e-9


@pytest.mark.parametrize("engine", ENGINES)
def test_a_clutch_carries_its_limit(simulate, engine) -> None:
    """Torque 0.6 N*m at 0.1 m and 6 N of friction; the shaft does not turn."""
    result = simulate("""
        components:
          push: {type: TorqueSource, torque: {ramp: {to: 0.6 N*m, over: 1 s}}}
          house: {type: Housing}
          rotor: {type: Inertia, moment: 0.1 kg*m^2}
          disc: {type: Clutch, radius: 0.1 m, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.6, coulomb: 0.4}}
        connections: [[house.shaft, disc.a], [push.shaft, rotor.shaft, disc.b]]
        run: {stop: 3 s, accuracy: 1e-5}
    """, **{"run.engine": engine})  # fmt: skip
    assert abs(result["rotor.angle"]).max() < 1e-9


BESIDE = """
    components:
      ground: {{type: Ground}}
      near: {{type: Mass, mass: 1 kg}}
      far: {{type: Mass, mass: 1 kg}}
      pad: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.6, coulomb: 0.4}}}}
      shoe: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.6, coulomb: 0.4}}}}
      sway: {{type: ForceSource, force: {{sine: {{amplitude: 6 N, frequency: 0.5 Hz}}}}}}
      push: {{type: ForceSource, force: {{{push}}}}}
    connections:
      - [near.flange, pad.b, sway.flange]
      - [far.flange, shoe.b, push.flange]
      - [ground.flange, pad.a, shoe.a]
    run: {{stop: {stop}, accuracy: {accuracy}}}
"""


@pytest.mark.parametrize("after", [0.0, 0.02, 0.1])
@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-5"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_load_that_comes_to_its_limit_hides_no_other_that_goes_beyond(simulate, engine, accuracy, after) -> None:
    """The sine tops out at its limit at 0.5 s; the ramp beside it passes its own then, or soon after."""
    push = f"ramp: {{to: 12 N, over: 1 s, start: {after} s}}"
    result = simulate(BESIDE.format(push=push, accuracy=accuracy, stop="1 s"), **{"run.engine": engine})
    assert abs(result["near.x"]).max() < 1e-9
    assert next(iter(result.events)).t == pytest.approx(0.5 + after, abs=2e-5)
    assert {event.component for event in result.events} == {"shoe"}


@pytest.mark.parametrize(("frequency", "amplitude"), [(0.45, 6.06), (0.48, 6.006), (0.52, 6.006)])
@pytest.mark.parametrize("accuracy", [1e-4, 1e-5, 1e-6])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_load_that_tops_out_at_its_limit_hides_no_other_top(simulate, engine, accuracy, frequency, amplitude) -> None:
    """Two sines in one step: the one at its limit is held, the other passes it for 0.03 to 0.09 s and lets go."""
    push = f"sine: {{amplitude: {amplitude} N, frequency: {frequency} Hz}}"
    result = simulate(BESIDE.format(push=push, accuracy=accuracy, stop="0.9 s"), **{"run.engine": engine})
    exact = math.asin(6 / amplitude) / (2 * math.pi * frequency)
    slope = amplitude * 2 * math.pi * frequency * math.sqrt(1 - (6 / amplitude) ** 2)
    assert abs(result["near.x"]).max() < 1e-9
    assert next(iter(result.events)).t == pytest.approx(exact, abs=10 * accuracy * 6 / slope)
    assert {event.component for event in result.events} == {"shoe"}


@pytest.mark.parametrize(("contacts", "apart", "frequency"), [(1, 0.0, 0.5), (1, 0.0, 0.3777), (3, 0.11, 0.21)])
@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-6"])
@pytest.mark.parametrize("engine", ENGINES)
def test_loads_that_come_to_their_limits_again_and_again_are_held(
    simulate, engine, accuracy, contacts, apart, frequency
) -> None:
    """Each sine tops out at its limit twice a period, for 30 s: also where a step ends at a top, or many are near."""
    parts = ["ground: {type: Ground}"]
    joins = [f"[ground.flange, {', '.join(f'pad{i}.a' for i in range(contacts))}]"]
    for i in range(contacts):
        force = f"sine: {{amplitude: 6 N, frequency: {frequency + apart * i} Hz}}"
        parts += [
            f"block{i}: {{type: Mass, mass: 1 kg}}", f"push{i}: {{type: ForceSource, force: {{{force}}}}}",
            f"pad{i}: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.6, coulomb: 0.4}}}}",
        ]  # fmt: skip
        joins.append(f"[block{i}.flange, pad{i}.b, push{i}.flange]")
    netlist = "components: {{{}}}\nconnections: [{}]\nrun: {{stop: 30 s, accuracy: {}}}"
    result = simulate(netlist.format(", ".join(parts), ", ".join(joins), accuracy), **{"run.engine": engine})
    assert not result.events

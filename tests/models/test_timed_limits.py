"""Limits of held forces that follow something given in time: `stepping` rounds their instants, so `auto` leaves it."""

import pytest

from fairlead.engine import engine_of
from fairlead.system.timed_limits import timed_limits

SWING = "{sine: {amplitude: 9.8, frequency: 500 Hz, offset: 10}}"
CORNERS = "{table: [[0, 10], [0.1, 2], [0.2, 10]]}"
STAIRS = "{step: {at: 0.1 s, from: 10, to: 5}}"
FORCE = "{sine: {amplitude: 2 N, frequency: 500 Hz, offset: 5 N}}"
CLASSES = """
    class Gauge(Component):
        '''Turns a position into a load, and tells what the contact it stands for would bear.'''

        flange = Translational()
        load = Output("N")

        def law(p, flange):
            return Law(flange=0, load=10 + 1000 * flange.x)


    class Press(Component):
        '''A load in time of its own.'''

        load = Output("N")
        beat = Parameter("1/s", default=0.0)

        def law(p, t):
            return Law(load=10 + sin(p.beat * t))


    class Grip(Component):
        '''A contact of another name whose limit is a quantity in time.'''

        a, b = Translational(), Translational()
        limit = Waveform("N")
        pull = Unknown("N")
        zones = Zones("fast", "gone")

        @zone("fast")
        def fast(p, a, b, pull):
            return Law(a=-pull, b=+pull, pull=hold(b.v - a.v))

        @zone("gone")
        def gone(p, a, b, pull):
            return Law(a=0, b=0, pull=pull)

        @guard("fast", to="gone", unit="N")
        def lets_go(p, pull, t):
            return pull - p.limit(t)
"""
TOLD = "[source.signal, pad0.normal]"
LOADS = {
    "a sine": (f"source: {{type: SignalSource, value: {SWING}}}", TOLD, True),
    "a table": (f"source: {{type: SignalSource, value: {CORNERS}}}", TOLD, True),
    "a chain of signals": (
        f"source: {{type: SignalSource, value: {SWING}}}\n  gain: {{type: SignalGain, gain: 2}}",
        "[source.signal, gain.value], [gain.signal, pad0.normal]",
        True,
    ),
    "a lag": (
        f"source: {{type: SignalSource, value: {SWING}}}\n  late: {{type: SignalLag, lag: 20 ms, initial: 10}}",
        "[source.signal, late.value], [late.signal, pad0.normal]",
        True,
    ),
    "a temperature": (f"source: {{type: SignalSource, value: {SWING}}}", "[source.signal, pad0.temperature]", False),
    "the place of a given motion": (
        "hand: {type: MotionSource, position: {sine: {amplitude: 1 mm, frequency: 5 Hz}}}\n  gauge: {type: Gauge}",
        "[hand.flange, gauge.flange], [gauge.load, pad0.normal]",
        True,
    ),
    "the place of a body": ("gauge: {type: Gauge}", "[block0.flange, gauge.flange], [gauge.load, pad0.normal]", False),
    "a law that reads the clock": ("press: {type: Press, beat: 3}", "[press.load, pad0.normal]", True),
    "a number": ("source: {type: SignalSource, value: 10}", TOLD, False),
    "stairs": (f"source: {{type: SignalSource, value: {STAIRS}}}", TOLD, False),
    "what comes late": ("source: {type: SignalSource, value: {table: [[0, 9], [1, 9], [2, 3]]}}", TOLD, False),
    "a force beside a fixed load": (
        "push: {type: ForceSource, force: {sine: {amplitude: 9 N, frequency: 5 Hz}}}",
        "[push.flange, block0.flange]",
        False,
    ),
}  # fmt: skip


def text(load, wires, count=2, pad="{type: Contact, normal_force: 10 N, curve: 0.5}", run="stop: 1 s"):
    """Blocks on a floor, of which the first has a load from elsewhere."""
    parts = "".join(f"  block{k}: {{type: Mass, mass: 1 kg}}\n  pad{k}: {pad}\n" for k in range(count))
    joins = "".join(f"  - [floor.flange, pad{k}.a]\n  - [pad{k}.b, block{k}.flange]\n" for k in range(count))
    more = "".join(f"  - [{wire.strip('[] ')}]\n" for wire in wires.split("],") if wire)
    return f"components:\n  floor: {{type: Ground}}\n  {load}\n{parts}connections:\n{joins}{more}run: {{{run}}}\n"


@pytest.mark.parametrize("name", LOADS)
def test_a_limit_that_follows_something_given_in_time_is_known(name, scene, library):
    load, wires, varies = LOADS[name]
    system = scene(text(load, wires), libraries=(library(CLASSES),)).system
    assert timed_limits(system, 0.0, 1.0) == (["pad0"] if varies else [])


@pytest.mark.parametrize(("limit", "names"), [(FORCE, ["pad0", "pad1"]), ("5 N", [])])
def test_a_contact_of_any_name_is_known_by_its_guards(limit, names, scene, library):
    system = scene(text("", "", pad=f"{{type: Grip, limit: {limit}}}"), libraries=(library(CLASSES),)).system
    assert timed_limits(system, 0.0, 1.0) == names


@pytest.mark.parametrize(("count", "load", "engine"), [(99, "a sine", "rodas"), (100, "a sine", "rodas"),
    (101, "a table", "rodas"), (100, "a number", "stepping"), (100, "stairs", "stepping"),
    (100, "the place of a body", "stepping")])  # fmt: skip
def test_auto_leaves_stepping_where_a_limit_varies_in_time(count, load, engine, scene, library):
    model = scene(text(*LOADS[load][:2], count=count), libraries=(library(CLASSES),))
    found, reason = engine_of(model.netlist.run, model.system)
    assert found == engine
    assert ("the force limit of pad0 varies in time" in reason) == (LOADS[load][2] and count >= 100)


@pytest.mark.parametrize(
    ("value", "turns"), [(SWING, True), (CORNERS, False), ("{ramp: {from: 10, to: 2, over: 1 s}}", False)]
)
def test_a_limit_that_turns_now_and_then_does_not_turn_often(value, turns, scene):
    system = scene(text(f"source: {{type: SignalSource, value: {value}}}", TOLD)).system
    assert timed_limits(system, 0.0, 1.0) == ["pad0"]
    assert timed_limits(system, 0.0, 1.0, turning=True) == (["pad0"] if turns else [])

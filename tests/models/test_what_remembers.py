"""A relay or a state machine remembers what it has read. What a settlement only tries is not read by it.

While zones are looked for, a contact holds with more than its limit, and a stop pulls. Closed forms.
"""

import pytest

ENGINES = ["rodas", "stepping", "ida"]
PUSHED = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 2 kg}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
      wish: {type: SignalSource, value: {step: {to: 80, at: 0.3 s}}}
      overload: OVERLOAD
      power: {type: SignalFunction, expression: "wish*(1 - trip)"}
      motor: {type: ForceActuator}
    connections:
      - [floor.flange, pad.a]
      - [block.flange, pad.b, motor.flange]
      - [pad.friction, overload.value]
      - [overload.signal, power.trip]
      - [wish.signal, power.wish]
      - [power.signal, motor.force]
    run: {engine: ENGINE, stop: 1 s}
    record: {signals: [block.v, pad.friction, overload.signal]}
"""
COMPARATOR = "{type: Relay, upper: LEVEL}"
RELAY = "{type: Relay, upper: LEVEL, lower: -1000}"


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("level", ["6", "50", "79"])
@pytest.mark.parametrize("relay", [RELAY, COMPARATOR], ids=["relay", "comparator"])
def test_a_relay_is_not_tripped_by_a_force_that_the_contact_cannot_bear(simulate, engine, level, relay):
    """The pad slips at 5 N: 80 N less its 3 N move the block for 0.7 s."""
    result = simulate(PUSHED.replace("OVERLOAD", relay.replace("LEVEL", level)).replace("ENGINE", engine))
    assert result["block.v"][-1] == pytest.approx((80 - 3) / 2 * 0.7, rel=1e-4)
    assert result["overload.signal"].max() == 0.0
    assert result.extremes("pad.friction").highest <= 5.0 + 1e-3


@pytest.mark.parametrize("engine", ENGINES)
def test_it_is_by_one_that_the_contact_bears_in_the_end(simulate, engine):
    """Of 3 N that stay when it slips: the relay trips at once, and the motor is off."""
    result = simulate(PUSHED.replace("OVERLOAD", RELAY.replace("LEVEL", "2")).replace("ENGINE", engine))
    assert result["block.v"][-1] == pytest.approx(0.0, abs=1e-6)
    assert result["overload.signal"][-1] == 1.0


@pytest.mark.parametrize("engine", ENGINES)
def test_what_tells_no_more_than_it_reads_changes_before_the_contacts(simulate, engine):
    """A limiter lets 4 N of 80 N pass, which the pad bears with its 5 N: it was never asked for 80 N."""
    text = PUSHED.replace("OVERLOAD", RELAY.replace("LEVEL", "50")).replace("ENGINE", engine)
    text = text.replace("      power:", "      least: {type: Limiter, high: 4, low: -4}\n      power:")
    limited = "- [power.signal, least.value]\n      - [least.signal, motor.force]"
    text = text.replace("- [power.signal, motor.force]", limited)
    result = simulate(text)
    assert abs(result["block.v"]).max() < 1e-9
    assert result["pad.friction"][-1] == pytest.approx(4.0, rel=1e-6)


LIFTED = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 2 kg}
      lasting: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
      lifted: {type: Contact, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
      weight: {type: SignalSource, value: {constant: 20, step: {to: -20, at: 0.3 s}}}
      push: {type: ForceSource, force: 8 N}
      over: {type: Relay, upper: 6, lower: -1000}
    connections:
      - [floor.flange, lasting.a, lifted.a]
      - [block.flange, lasting.b, lifted.b, push.flange]
      - [weight.signal, lifted.normal]
      - [lasting.friction, over.value]
    run: {engine: ENGINE, stop: 1 s}
    record: {signals: [block.v, lasting.friction, over.signal]}
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_nor_is_it_when_another_contact_is_taken_away(simulate, engine):
    """Of 8 N that two pads bore one is left with 5 N."""
    result = simulate(LIFTED.replace("ENGINE", engine))
    assert result["block.v"][-1] == pytest.approx((8 - 3) / 2 * 0.7, rel=1e-4)
    assert result["over.signal"].max() == 0.0


STRUCK = """
    components:
      wall: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      stop: {type: RigidStop}
      push: {type: ForceSource, force: FORCE}
      ball: {type: Mass, mass: 1 kg, position: -0.5 m, velocity: 2 m/s}
      hit: {type: RigidStop, restitution: 1}
      pulled: {type: Relay, upper: 1, lower: -1, begins_on: "yes"}
    connections:
      - [wall.flange, stop.a]
      - [block.flange, stop.b, push.flange, hit.b]
      - [ball.flange, hit.a]
      - [stop.force, pulled.value]
    run: {engine: ENGINE, stop: 1 s}
    record: {signals: [block.v, ball.v, pulled.signal, stop.force]}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_stop_that_is_let_go_in_an_impact_never_pulled(simulate, engine):
    """A stop cannot pull: a relay that drops out at a force of -1 N never does."""
    result = simulate(STRUCK.replace("ENGINE", engine).replace("FORCE", "-5 N"))
    assert result["stop.force"].min() >= 0.0
    assert result["pulled.signal"].min() == 1.0


TIE = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 1 kg}
      pad: {type: Contact, normal_force: 20 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
      pull: {type: ForceSource, force: {ramp: {to: 10 N, over: 2 s}}}
      hold: {type: SampleHold, period: PERIOD}
      level: {type: SignalSource, value: 20}
    connections:
      - [floor.flange, pad.a]
      - [pad.b, block.flange, pull.flange]
      - [level.signal, hold.value]
    run: {engine: ENGINE, stop: 2.2 s}
    record: {signals: [block.x]}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("period", ["0.3 s", "2 s", "0.25 s"])
def test_a_sampler_beside_it_decides_no_tie(simulate, engine, period):
    """The load ends at what the pad just bears, and rises no further."""
    result = simulate(TIE.replace("ENGINE", engine).replace("PERIOD", period))
    assert abs(result["block.x"]).max() < 1e-9

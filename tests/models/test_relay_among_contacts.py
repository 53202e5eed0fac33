"""Signals that switch beside more contacts than `stepping` ends its steps for: what they command has its accuracy.

Steps of `stepping` have switches of contacts inside. What a relay commands jumps, so a step that has its new value for
all of it, or for none, is wrong by a step. The contacts here are pulled along and have nothing to do with the relay.
"""

import math

import pytest

SINE = 2 * math.pi * 0.7  # rad/s
RELAY = "{type: Relay, upper: 0.6, lower: -0.3}"
ON = [math.asin(0.6) / SINE + k / 0.7 for k in range(2)]
OFF = [(math.pi + math.asin(0.3)) / SINE + k / 0.7 for k in range(2)]


def gathered(t):
    """How long the relay has been on."""
    return sum(min(max(t - on, 0.0), off - on) for on, off in zip(ON, OFF, strict=True))


def scene(parts, connections, *, blocks=60, scale=1.0, name="b"):
    """A row of blocks that is drawn over the ground, beside parts of another kind."""
    parts = {"ground": "{type: Ground}", "pull": "{type: MotionSource, velocity: 0.1 m/s}"} | parts
    joints, floor = ["[pull.flange, k0.b]"], ["ground.flange"]
    for k in range(blocks):
        parts[f"{name}{k}"] = f"{{type: Mass, mass: {scale} kg}}"
        parts[f"c{k}"] = f"{{type: Contact, normal_force: {10 * scale} N, curve: 0.3}}"
        parts[f"k{k}"] = f"{{type: Spring, stiffness: {1000 * scale} N/m}}"
        floor.append(f"c{k}.a")
        joints.append(f"[{name}{k}.flange, c{k}.b, k{k}.a{f', k{k + 1}.b' if k < blocks - 1 else ''}]")
    joints += [f"[{', '.join(floor)}]", *connections]
    listed = "".join(f"  {key}: {value}\n" for key, value in parts.items())
    return f"components:\n{listed}connections:\n" + "".join(f"  - {joint}\n" for joint in joints)


SOURCE = {"source": "{type: SignalSource, value: {sine: {amplitude: 1, frequency: 0.7 Hz}}}"}
PUSHED = SOURCE | {
    "relay": RELAY, "sum": "{type: Integrator}", "push": "{type: ForceActuator}", "body": "{type: Mass, mass: 1 kg}",
}  # fmt: skip
PUSHES = ["[source.signal, relay.value]", "[relay.signal, sum.value, push.force]", "[push.flange, body.flange]"]
RUN = "run: {stop: 3 s}\nrecord: {every: 5 ms, signals: [%s]}\n"


@pytest.mark.parametrize(("scale", "name"), [(1.0, "b"), (1000.0, "z")])
@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5])
def test_a_relay_switches_at_its_instant_whatever_it_commands(simulate, accuracy, scale, name):
    text = scene(PUSHED, PUSHES, scale=scale, name=name) + RUN % "sum.signal, body.v"
    result = simulate(text, **{"run.engine": "stepping", "run.accuracy": accuracy})
    switched = [event.t for event in result.events if event.component == "relay" and event.t > 0.0]
    assert switched == pytest.approx([ON[0], OFF[0], ON[1], OFF[1]], abs=1e-7)
    for t in (0.5, 1.2, 2.0, 3.0):
        assert result.at("sum.signal", t) == pytest.approx(gathered(t), abs=accuracy)
        assert result.at("body.v", t) == pytest.approx(gathered(t), abs=accuracy)


def test_a_relay_that_nothing_feels_is_told_at_its_instant(simulate):
    parts, joints = SOURCE | {"band": "{type: DeadBand, band: 0.5, inner: 0.1}"}, ["[source.signal, band.value]"]
    result = simulate(scene(parts, joints) + RUN % "band.signal", **{"run.engine": "stepping"})
    first = [event.t for event in result.events if event.component == "band" and event.t > 0.0][:2]
    assert first == pytest.approx([math.asin(0.5) / SINE, (math.pi - math.asin(0.1)) / SINE], abs=1e-7)


@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
def test_a_signal_that_jumps_and_remembers_nothing_pushes_as_long_as_it_says(simulate, accuracy):
    parts = SOURCE | {
        "one": "{type: SignalSource, value: 1}", "choose": "{type: SignalSwitch, level: 0.3}",
        "push": "{type: ForceActuator}", "body": "{type: Mass, mass: 1 kg}",
    }  # fmt: skip
    joints = ["[source.signal, choose.control]", "[one.signal, choose.a]", "[choose.signal, push.force]"]
    text = scene(parts, [*joints, "[push.flange, body.flange]"]) + RUN % "body.v"
    result = simulate(text, **{"run.engine": "stepping", "run.accuracy": accuracy})
    each = (math.pi - 2 * math.asin(0.3)) / SINE  # s of a period
    last = max(0.0, 3.0 - (2 / 0.7 + math.asin(0.3) / SINE))
    assert result.at("body.v", 3.0) == pytest.approx(2 * each + last, abs=10 * accuracy)


@pytest.mark.parametrize("accuracy", [1e-4, 1e-6])
def test_a_switch_is_felt_through_laws_without_inertia(simulate, accuracy):
    """A switch closes a circuit of resistors before an inductor: i = I (1 - exp(-t R/L)), then i exp(-t R/L)."""
    parts = {
        "source": "{type: SignalSource, value: {sine: {amplitude: 1, frequency: 0.25 Hz}}}",
        "volts": "{type: VoltageSource, voltage: 12 V, inner: 1e-5 ohm}",
        "close": "{type: ElectricSwitch, open_resistance: 1e9 ohm, closed_resistance: 1e-5 ohm}",
        "lead": "{type: Resistor, resistance: 2 ohm}", "beside": "{type: Resistor, resistance: 3 ohm}",
        "coil": "{type: Inductor, inductance: 1 H}", "earth": "{type: Earth}",
    }  # fmt: skip
    joints = [
        "[source.signal, close.control]", "[volts.plus, close.plus]", "[close.minus, lead.plus]",
        "[lead.minus, coil.plus, beside.plus]", "[coil.minus, beside.minus, volts.minus, earth.terminal]",
    ]  # fmt: skip
    result = simulate(
        scene(parts, joints) + RUN % "coil.current", **{"run.engine": "stepping", "run.accuracy": accuracy}
    )
    closed, opened = 1 / 3, 5 / 3  # s: sin passes 1/2
    before = 2.0 + 2e-5  # ohm, of the lead, the switch and the source
    most, rate = 12 / before, 1 / (1 / before + 1 / 3)  # 12 V behind it; both resistors side by side
    at_opening = most * (1 - math.exp(-rate * (opened - closed)))
    rising, falling = most * (1 - math.exp(-rate * (1.0 - closed))), at_opening * math.exp(-3.0 * (2.5 - opened))
    assert result.at("coil.current", 1.0) == pytest.approx(rising, abs=10 * accuracy)
    assert result.at("coil.current", 2.5) == pytest.approx(falling, abs=10 * accuracy)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_a_relay_that_reads_a_force_switches_where_the_force_is_there(simulate, accuracy):
    """A spring of 30 N/m behind a sensor swings a body about -+1/30 m: force 3 cos(omega t) and so on, by halves."""
    parts = {
        "relay": "{type: Relay, upper: 2.5, lower: -2.5, on: -1, off: 1}", "push": "{type: ForceActuator}",
        "cell": "{type: ForceSensor}", "end": "{type: Mass, mass: 0.25 kg, position: 0.1 m}",
        "body": "{type: Mass, mass: 1 kg, position: 0.1 m}", "spring": "{type: Spring, stiffness: 30 N/m}",
        "wall": "{type: Ground}",
    }  # fmt: skip
    joints = [
        "[wall.flange, spring.a]", "[spring.b, cell.a, end.flange]", "[cell.b, body.flange, push.flange]",
        "[cell.tension, relay.value]", "[relay.signal, push.force]",
    ]  # fmt: skip
    text = scene(parts, joints) + RUN % "body.x, body.v"
    found, exact = (
        simulate(text, **{"run.engine": engine, "run.accuracy": fine})
        for engine, fine in (("stepping", accuracy), ("rodas", 1e-8))
    )
    told = [[event.t for event in run.events if event.component == "relay"] for run in (found, exact)]
    assert len(told[1]) >= 3
    assert told[0] == pytest.approx(told[1], abs=accuracy)
    for t in (0.5, 1.1, 2.3, 3.0):
        assert found.at("body.x", t) == pytest.approx(exact.at("body.x", t), abs=accuracy)

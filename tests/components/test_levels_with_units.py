"""Levels of signal parts that are written with the unit of the signal joined to them."""

from __future__ import annotations

import pytest

from fairlead.errors import ModelError

SCENE = """
    parameters: {{most: 15 N}}
    components:
      push: {{type: ForceSource, force: {{ramp: {{to: 20 N, over: 2 s}}}}}}
      body: {{type: Mass, mass: 1 kg}}
      spring: {{type: SpringDamper, stiffness: 10 kN/m, damping: 200 N*s/m}}
      wall: {{type: Ground}}
      cell: {{type: ForceSensor}}
      reading: {{type: SignalLag, lag: 1 ms, initial: 0}}
      shaper: {{type: SignalSource, value: 1}}
      part: {{{part}}}
    connections:
      - [push.flange, body.flange, cell.a]
      - [cell.b, spring.a]
      - [spring.b, wall.flange]
      - [cell.tension, reading.value]
      - [{signal}, {inputs}]
    run: {{stop: 2 s}}
"""
RELAY = "type: Relay, lower: {}, upper: {}"


def made(scene, part: str, signal: str = "cell.tension", inputs: str = "part.value"):
    return scene(SCENE.format(part=part, signal=signal, inputs=inputs))


@pytest.mark.parametrize(
    ("part", "plain", "inputs"),
    [
        (RELAY.format("-12 N", "-5 N"), RELAY.format(-12, -5), "part.value"),
        (RELAY.format("-0.012 kN", '"{-most/3}"'), RELAY.format(-12, -5), "part.value"),
        ("type: Limiter, low: -15 N, high: 9 mN", "type: Limiter, low: -15, high: 0.009", "part.value"),
        ("type: DeadZone, band: 3 N", "type: DeadZone, band: 3", "part.value"),
        ("type: DeadBand, band: 0.006 kN, inner: 3 N", "type: DeadBand, band: 6, inner: 3", "part.value"),
        ("type: SignalSwitch, level: -4 N", "type: SignalSwitch, level: -4", "part.control, part.a"),
        ("type: LogicGate, gate: or, level: -4 N", "type: LogicGate, gate: or, level: -4", "part.a, part.b"),
        ("type: SampledSensor, period: 10 ms, resolution: 1 N", "type: SampledSensor, period: 10 ms, resolution: 1",
         "part.value"),
    ],
)  # fmt: skip
def test_a_level_in_the_unit_of_the_signal_is_that_in_si(scene, part: str, plain: str, inputs: str) -> None:
    one, other = (made(scene, each, inputs=inputs).run(out=None)["part.signal"] for each in (part, plain))
    assert one.tolist() == other.tolist()
    assert len(set(one.tolist())) > 1


def test_a_part_that_passes_a_signal_on_passes_its_unit_on(scene) -> None:
    assert made(scene, RELAY.format("-12 N", "-5 N"), signal="reading.signal")


@pytest.mark.parametrize("levels", [("-12 m", "-5 N"), ("-12", "-5 m"), ('"{-13*most/(1 N/m)}"', -5)])
@pytest.mark.parametrize("signal", ["cell.tension", "reading.signal"])
def test_a_level_in_another_unit_is_refused_by_name(scene, levels: tuple[str, str], signal: str) -> None:
    with pytest.raises(ModelError) as caught:
        made(scene, RELAY.format(*levels), signal=signal).run(out=None)
    (fault,) = caught.value.faults
    assert fault.what.startswith("part.upper" if "m" in str(levels[1]) else "part.lower")
    assert "is a length" in fault.what
    assert fault.what.endswith(f"and {signal}, which is joined to part.value, is a force.")
    assert fault.where is not None


def test_a_level_with_a_unit_of_a_signal_that_is_a_plain_number_is_refused(scene) -> None:
    with pytest.raises(ModelError, match=r"shaper\.signal, .* is a plain number\.\n    Write it without unit, in SI"):
        made(scene, RELAY.format("-12 N", "-5 N"), signal="shaper.signal").run(out=None)


def test_other_values_are_asked_as_the_first_ones_were(scene) -> None:
    model = made(scene, RELAY.format("-12 N", "-5 N"))
    right = model.with_values({"part.upper": "-0.006 kN"}).run(out=None)["part.signal"]
    assert right.tolist() == made(scene, RELAY.format(-12, -6)).run(out=None)["part.signal"].tolist()
    with pytest.raises(ModelError, match=r"part\.upper = '?-6 m'? is a length"):
        model.with_values({"part.upper": "-6 m"}).run(out=None)


def test_a_level_like_what_is_no_plain_input_is_refused_as_the_class_is_made() -> None:
    from fairlead.component import Component, Input, Output, Parameter

    for body, said in (
        ({"level": Parameter("1", like="value")}, "no input"),
        ({"level": Parameter("1", like="value"), "value": Input("N")}, "plain numbers"),
        ({"value": Input("1"), "level": Parameter("m", like="value")}, "plain numbers"),
    ):
        law = {"signal": Output("1"), "law": lambda p: {"signal": 0}}
        with pytest.raises(TypeError, match=said):
            type("Odd", (Component,), {"__module__": __name__, "__doc__": "Odd.", **body, **law})

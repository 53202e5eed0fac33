"""Outputs by the names they had: they still work, and today's is told, in a netlist, a class and from Python."""

import pathlib

import pytest

import fairlead
from fairlead.component import Component
from fairlead.component.registry import known_types
from fairlead.component.symbols import symbol
from fairlead.describe.specimen import traced_specimen
from fairlead.errors import RunWarning
from tests.mistakes.bases import DRILL
from tests.mistakes.entry import damaged

OLD = DRILL.replace("run: {stop: 10 s}", 'run: {stop: 0.1 s}\nlimits: {"bit.turned": {below: 1 rad}}').replace(
    "[bit.speed, table.speed, string.torque]", "[bit.rate, table.rate, bit.turned]"
)

CYLINDER = pathlib.Path(__file__).parents[2] / "models" / "single_parts" / "cylinder_with_valve.yaml"

OWN = '''\
from fairlead.component import Composite, Expansion, Output, Rotational
from fairlead.components.rotation.inertia import Inertia


class Disc(Composite):
    """A disc that tells its speed."""

    shaft = Rotational()
    rate = Output("rad/s", "Its speed.")

    def expand(p, scene):
        return Expansion({"body": scene.make(Inertia, moment=2.0)}, [], {"shaft": "body.shaft"}, {"rate": "body.rate"})
'''


@pytest.fixture
def model(tmp_path):
    (tmp_path / "drill.yaml").write_text(OLD, encoding="utf-8")
    return fairlead.load(tmp_path / "drill.yaml")


def test_a_netlist_by_old_names_runs_and_is_told_those_of_today(model):
    told = {str(fault).split(": ", 1)[1] for fault in model.check() if "is called" in fault.what}
    names = {"bit.rate": "bit.speed", "table.rate": "table.speed", "bit.turned": "bit.angle"}
    expected = {f"{old} is called {new} now; the old name still works.\n    Write {new}." for old, new in names.items()}
    assert told == expected
    result = model.run(out=None)
    assert [signal.name for signal in result.signals] == ["table.speed", "bit.angle", "bit.speed"]
    assert [limit["signal"] for limit in result.limits] == ["bit.angle"]
    with pytest.warns(RunWarning, match=r"bit\.rate is called bit\.speed now"):
        assert (result["bit.rate"] == result["bit.speed"]).all()
    with pytest.warns(RunWarning, match=r"\*\.turned is called \*\.angle now"):
        assert result.match("*.turned") == ["bit.angle"]
    with pytest.raises(KeyError, match=r"bit\.turns was not recorded"):
        result["bit.turns"]


def test_a_signal_of_the_old_name_can_be_joined_and_stepped(tmp_path):
    text = OLD.replace("[press.signal, clutch.normal]", "[press.signal, clutch.normal]\n  - [bit.rate, gain.value]")
    text = text.replace("  press:", "  gain: {type: SignalGain, gain: 2}\n  press:")
    text = text.replace("signals: [", "signals: [gain.signal, ")
    (tmp_path / "drill.yaml").write_text(text, encoding="utf-8")
    run = fairlead.load(tmp_path / "drill.yaml").start()
    run.advance(0.05)
    assert run.get("bit.rate") == run.get("bit.speed") == run.get("gain.signal") / 2


def test_a_class_of_ones_own_may_call_an_output_as_it_likes(tmp_path):
    (tmp_path / "own.py").write_text(OWN, encoding="utf-8")
    text = DRILL.replace("bit: {type: Inertia, moment: 1 kg*m^2, angle: 0 rad, speed: 0 rad/s}", "bit: {type: Disc}")
    text = text.replace("bit.speed", "bit.rate, bit.body.speed").replace("stop: 10 s", "stop: 0.1 s")
    (tmp_path / "drill.yaml").write_text(text, encoding="utf-8")
    model = fairlead.load(tmp_path / "drill.yaml", libraries=[tmp_path / "own.py"])
    assert model.check() == []
    result = model.run(out=None)
    assert (result["bit.rate"] == result["bit.body.speed"]).all()


OF_TODAY = {"cylinder.level_?": "cylinder.pressure_?", "source.level": "source.pressure",
            "cylinder.level_a": "cylinder.pressure_a"}  # fmt: skip


def test_pressures_by_old_names_are_recorded_joined_and_told(tmp_path):
    text = damaged(
        CYLINDER.read_text(encoding="utf-8"),
        ("cylinder.travel, cylinder.pressure_a, cylinder.pressure_b", 'gauge.signal, "cylinder.level_?", source.level'),
        ("  wall: {", "  gauge: {type: SignalGain, gain: 1.0e-5}\n  wall: {"),
        ("  - [wall.flange", "  - [cylinder.level_a, gauge.value]\n  - [wall.flange"),
        ("stop: 1 s", "stop: 0.05 s"),
    )
    (tmp_path / "drive.yaml").write_text(text, encoding="utf-8")
    model = fairlead.load(tmp_path / "drive.yaml")
    told = {f"{old} is called {new} now; the old name still works." for old, new in OF_TODAY.items()}
    assert {fault.what for fault in model.check()} == told
    result = model.run(out=None)
    assert set(OF_TODAY.values()) - {"cylinder.pressure_?"} <= {signal.name for signal in result.signals}
    with pytest.warns(RunWarning, match=r"cylinder\.level_a is called cylinder\.pressure_a now"):
        assert (result["cylinder.level_a"] * 1e-5 == result["gauge.signal"]).all()


def test_no_part_calls_a_pressure_a_level():
    """A level is what friction has: `LoadedFriction.level`, in newtons."""
    told = [
        f"{name}.{output}"
        for name, part in known_types().items()
        for output, its in part.declaration.outputs.items()
        if its.unit == "Pa" and output.startswith("level")
    ]
    assert not told


SOURCES = """
schema: 1
name: sources
components:
  hand: {type: ForceSource, force: 3 N}
  body: {type: Mass, mass: 1 kg}
  motor: {type: TorqueSource, torque: 2 N*m}
  rotor: {type: Inertia, moment: 1 kg*m^2}
  tank: {type: Tank}
  pump: {type: FlowSource, flow: 1 L/min}
  seen: {type: SignalGain, gain: 2}
connections:
  - [hand.flange, body.flange]
  - [motor.shaft, rotor.shaft]
  - [tank.port, pump.inlet, pump.outlet]
  - [motor.applied, seen.value]
record: {signals: ["*.applied", pump.given, seen.signal]}
run: {stop: 0.1 s}
"""


def test_sources_tell_what_they_give_by_the_name_of_their_port(tmp_path):
    (tmp_path / "sources.yaml").write_text(SOURCES, encoding="utf-8")
    model = fairlead.load(tmp_path / "sources.yaml")
    told = {fault.what for fault in model.check() if "is called" in fault.what}
    new = {"*.applied": "*.force or *.torque", "pump.given": "pump.flow", "motor.applied": "motor.torque"}
    assert told == {f"{old} is called {today} now; the old name still works." for old, today in new.items()}
    result = model.run(out=None)
    assert {signal.name for signal in result.signals} == {"hand.force", "motor.torque", "pump.flow", "seen.signal"}
    assert result["motor.torque"][-1] == result["seen.signal"][-1] / 2 == 2
    with pytest.warns(RunWarning, match=r"hand\.applied is called hand\.force now"):
        assert (result["hand.applied"] == 3).all()
    run = model.start()
    assert run.get("hand.applied") == run.get("hand.force") == 3


OF_THEIR_OWN = {
    "tension": "a force that pulls both ends towards each other", "friction": "what friction gives",
    "size": "without sign", "pull": "what a tail pulls with", "drag": "what water gives", "load": "what gravity gives",
    "skew": "the part of a loss that turns with the load", "elastic": "a pull without what damps it",
}  # fmt: skip
"""Outputs that say more than their port does."""
TAKEN = {"HeatActuator.given": "its input is called heat"}


def test_an_output_that_tells_what_a_port_carries_or_how_it_moves_bears_the_name_of_that():
    """Over all classes, by what their laws say, not by their names."""
    wrong = []
    for name, part in known_types().items():
        if issubclass(part, Component) and any(_suspects(part.declaration)):
            wrong += [f"{name}.{output}" for output in _named_otherwise(traced_specimen(part))]
    assert sorted(set(wrong)) == sorted(TAKEN)


def _suspects(has):
    """Outputs in the unit of what a port carries or of how it moves, with another name: the others need no look."""
    known = {(n, unit) for port in has.ports.values() for n, unit in (*port.domain.across, port.domain.through)}
    for output, its in has.outputs.items():
        names = {n for n, unit in known if unit == its.unit}
        yield bool(names) and not names & set(output.split("_")) and output not in OF_THEIR_OWN


def _named_otherwise(traced):
    for zone in traced.zones.values():
        for output, said in zone.outputs.items():
            for name, carried in _of_ports(traced, zone):
                same = said != 0 and not said.is_number and carried in (said, -said)
                if same and name not in output.split("_") and output not in OF_THEIR_OWN:
                    yield output


def _of_ports(traced, zone):
    for port, its in traced.variant.type.declaration.ports.items():
        yield its.domain.through[0], zone.flows.get(port, 0)
        yield from ((n, symbol(f"port:{port}:{k}")) for (n, _), k in zip(its.domain.across, "xv", strict=False))

"""A body that friction holds at a rigid stop, and that breaks away from there, leaves it at once and for good."""

import functools

import pytest

import fairlead

SCENE = """
schema: 1
components:
  k: {type: Spring, stiffness: 50 N/m, free_length: 1 m}
  far: {type: Mass, mass: 0.5 kg, position: 1.3 m, velocity: 0}
  pull: {type: ForceSource, force: {ramp: {from: 20 N, to: -20 N, over: 1 s, start: 0.1 s}}}
  slide: {type: MassWithStops, mass: 1 kg, lower: -5 m, upper: 0.9 m, sliding: 5 N, breakaway: 10 N, speed: 0.1 m/s,
          position: 0.3 m, velocity: 0}
connections: [[pull.flange, slide.flange, k.a], [k.b, far.flange]]
run: {stop: 1.5 s}
"""
MIRRORED = {"from: 20 N, to: -20 N": "from: -20 N, to: 20 N", "lower: -5 m, upper: 0.9 m": "lower: -0.9 m, upper: 5 m",
            "position: 0.3 m": "position: -0.3 m", "position: 1.3 m": "position: -1.3 m",
            "free_length: 1 m": "free_length: -1 m"}  # fmt: skip


@pytest.fixture
def switches(tmp_path):
    return functools.partial(_switches, tmp_path / "scene.yaml")


def _switches(path, text, accuracy, engine="auto"):
    path.write_text(text)
    settings = {"run.accuracy": accuracy, "run.engine": engine}
    result = fairlead.load(path, set=settings).run(out=None)
    return [(event.component, event.zone_to) for event in result.events], [event.t for event in result.events]


@pytest.mark.parametrize(("engine", "accuracy"), [("auto", 1e-4), ("auto", 3e-5), ("auto", 1e-6), ("ida", 1e-5)])
def test_it_switches_as_often_at_any_accuracy(switches, engine, accuracy):
    """Friction begins at its breakaway, so it leaves by t^3: the interpolant of a long step has it go back first."""
    fine, instants = switches(SCENE, 1e-7)
    assert [zone for name, zone in fine if name == "slide.above"] == ["touching", "free"]
    found, when = switches(SCENE, accuracy, engine)
    assert found == fine
    assert when == pytest.approx(instants, abs=5e-3)


def test_it_does_so_at_the_other_stop_too(switches):
    text = SCENE
    for one, other in MIRRORED.items():
        assert one in text
        text = text.replace(one, other)
    found, _ = switches(text, 1e-4)
    turned = {"slide.above": "slide.below", "forward": "backward", "backward": "forward"}
    assert found == [(turned.get(name, name), turned.get(zone, zone)) for name, zone in switches(SCENE, 1e-4)[0]]


def test_two_drums_with_little_damping_do_not_chatter(recwarn):
    """A bond that breaks at its limit and is caught is no chatter; it was 425 switches with a warning."""
    model = fairlead.load("machines/traction_winch", set={"winch.damping_ratio": 0.1})
    result = model.run(out=None)
    assert not [warning for warning in recwarn if "to and fro" in str(warning.message)]
    assert result.run["energy"]["closure"] < 1e-3

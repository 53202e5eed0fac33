"""Names of signals that went with an effect which the user switched off are remarked; other names are mistakes."""

from __future__ import annotations

import warnings

import pytest

import fairlead
from fairlead.errors import ModelError

SCENE = """
    components:
      motor: {{type: Inertia, moment: 1 kg*m^2, speed: 10 rad/s}}
      gear: {{type: Gearbox, ratio: 2{own}}}
      fan: {{type: Inertia, moment: 1 kg*m^2}}
    connections:
      - [motor.shaft, gear.a]
      - [gear.b, fan.shaft]
    run: {{stop: 0.1 s}}
    record: {{every: 10 ms, signals: [motor.speed, {recorded}], plots: [{{signals: [gear.loss], file: loss.png}}]}}
    limits: {{gear.loss: {{below: 3 N*m}}}}
    {whole}
"""
OFF = {"scene": {"own": "", "whole": "effects: {gear_friction: off}"},
       "part": {"own": ", effects: {gear_friction: off}", "whole": ""}}  # fmt: skip


def said(found):
    """What speaks of names that are left out."""
    return [str(one) for one in found if "left out of record" in str(one)]


@pytest.mark.parametrize("where", OFF)
def test_a_name_that_went_is_left_out_with_a_remark(scene, tmp_path, where) -> None:
    """By `check`, in a run, and in its folder."""
    model = scene(SCENE.format(recorded="gear.loss", **OFF[where]))
    (one,) = said(model.check())
    assert "gear.loss" in one
    assert "gear_friction: off" in one
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = model.run(out=tmp_path / "run")
    assert [one.name for one in result.signals] == ["motor.speed"]
    assert len(said(result.remarks)) == 1


@pytest.mark.parametrize("where", OFF)
def test_a_name_that_never_was_is_a_mistake_all_the_same(scene, where) -> None:
    """Also beside one that went."""
    with pytest.raises(ModelError, match=r"no signal has the name gear\.los") as told:
        scene(SCENE.format(recorded="gear.loss, gear.los", **OFF[where])).check()
    assert len(told.value.faults) == 1


def test_with_the_effect_there_is_nothing_to_say(scene) -> None:
    """The same scene with its friction."""
    assert not said(scene(SCENE.format(recorded="gear.loss", own="", whole="")).check())


@pytest.mark.parametrize("effect", ["device_friction", "hose_core_slip"])
def test_a_route_is_set_and_recorded_on_a_grid_without_its_friction(effect) -> None:
    """As `effects` does."""
    model = fairlead.load("guidance_route", set={f"effects.{effect}": "off", "record.every": "0.1 s"})
    assert said(model.check())


GUIDED = """
    components:
      body: {{type: MassWithStops, mass: 1 kg, lower: -1 m, upper: 1 m, velocity: 0.5 m/s{more}}}
      lag: {{type: SignalLag, lag: 1 s}}
    connections: [[body.{joined}, lag.value]]
    run: {{stop: 0.1 s}}
    record: {{signals: [body.x, body.friction]}}
"""


def test_an_output_that_a_part_has_with_other_values_only_is_left_out_with_a_remark(scene):
    """No effect is switched: a guide that does not rub tells no friction."""
    (one,) = said(scene(GUIDED.format(more="", joined="x")).check())
    assert "body.friction: no signal with the values as they are" in one
    assert not said(scene(GUIDED.format(more=", sliding: 1 N", joined="x")).check())
    assert not said(scene(GUIDED.format(more="", joined="x").replace("body.friction", "body.v")).check())


def test_a_connection_to_it_is_a_mistake_that_says_why(scene):
    """A signal that a part does not have cannot be read."""
    with pytest.raises(ModelError, match=r"body\.friction.* with other values or effects only"):
        scene(GUIDED.format(more="", joined="friction").replace(", body.friction", "")).check()

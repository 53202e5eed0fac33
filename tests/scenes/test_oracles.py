"""Every oracle bites: of a scene that is right it says nothing, of the same run falsified it says what is wrong."""

from __future__ import annotations

import copy
import dataclasses

import numpy as np
import pytest

from tests.scenes.classes import CLASSES, Scene
from tests.scenes.machine import Machine
from tests.scenes.mirrored import SHOWN, mirrored
from tests.scenes.observed import every_step, loaded, observed
from tests.scenes.oracles.agreement import Compared, agreement
from tests.scenes.oracles.beginning import beginning
from tests.scenes.oracles.energy import energy
from tests.scenes.oracles.impulses import impulses
from tests.scenes.oracles.laws import laws
from tests.scenes.oracles.momentum import isolated, momentum
from tests.scenes.oracles.ramps import ramps
from tests.scenes.oracles.sensitive import sensitivity
from tests.scenes.oracles.symmetry import symmetry
from tests.scenes.verdict import judge

ACCURACY = 1e-6
TEXT = """
schema: 1
name: plain
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg, position: 10 mm, velocity: 0.7 m/s}
  spring: {type: Spring, stiffness: 300 N/m}
  pad: {type: Contact, normal_force: 6 N, curve: {curve: stribeck, stiction: 0.5, coulomb: 0.3, velocity: 20 mm/s}}
  push: {type: ForceSource, force: {ramp: {to: 4 N, over: 0.2 s, start: 0.1 s}}}
connections:
  - [floor.flange, spring.a, pad.a]
  - [block.flange, spring.b, pad.b, push.flange]
friction: {method: hold}
run: {stop: 0.6 s}
record: {every: 10 ms, signals: ["*"]}
"""
PLAIN = Scene("plain", 0, TEXT)


@pytest.fixture(scope="module")
def run():
    return observed(loaded(PLAIN), ACCURACY)


def falsified(run, **changes):
    """A copy in which columns are what functions make of them."""
    made = dataclasses.replace(run, columns=dict(run.columns))
    for name, change in changes.items():
        key = name.replace("__", ".")
        made.columns[key] = change(run.columns[key])
    return made


def test_what_is_right_passes(run):
    machine = Machine(TEXT)
    assert run.status == "finished"
    assert len(run.switches) > 1
    assert [energy(run), beginning(run, machine), momentum(run, machine), laws(run, machine)] == [""] * 4
    assert judge(PLAIN).word == "right"


def test_energy_sees_what_nobody_booked(run):
    lost = dataclasses.replace(run, energy=dict(run.energy))
    lost.energy["dissipated"] *= 1.001
    missing = lost.energy["stored_change"] + lost.energy["dissipated"] - lost.energy["supplied"]
    lost.energy["closure"] = abs(missing)
    assert "missing" in energy(lost)
    assert "gave" in energy(falsified(run, energy__dissipated=lambda e: -e))


@pytest.mark.parametrize("wrong", [1.001, -1.0, 0.0])
def test_momentum_sees_a_force_that_is_not_what_acts(run, wrong):
    machine = Machine(TEXT)
    assert "momentum" in momentum(falsified(run, pad__friction=lambda f: wrong * f), machine)
    assert "momentum" in momentum(falsified(run, spring__tension=lambda f: wrong * f), machine)
    assert "motion" in momentum(falsified(run, block__x=lambda x: x + 1e-4 * run.t), machine)


def test_momentum_of_all_sees_what_acts_on_one_only():
    scene = CLASSES["ties"](2)
    machine = Machine(scene.text)
    run = observed(loaded(scene), ACCURACY)
    free = Machine(scene.text.replace("type: ForceSource", "type: Spring").replace("type: Ground", "type: Spring"))
    assert "changes" in isolated(run, free)  # a push that is taken for a spring between bodies
    assert isolated(run, machine) == ""


@pytest.mark.parametrize(
    ("given", "other", "said"),
    [("stiffness: 300 N/m", "stiffness: 300.1 N/m", "spring"), ("stiction: 0.5", "stiction: 0.499", "pad"),
     ("coulomb: 0.3,", "coulomb: 0.3005,", "pad"), ("normal_force: 6 N", "normal_force: 6.001 N", "pad"),
     ("to: 4 N", "to: 4.001 N", "push"), ("start: 0.1 s", "start: 0.1001 s", "push")],
)  # fmt: skip
def test_laws_see_numbers_that_are_not_those_of_the_netlist(run, given, other, said):
    assert given in TEXT
    assert said in laws(run, Machine(TEXT.replace(given, other)))


def test_laws_see_friction_that_drives(run):
    assert "drives" in laws(falsified(run, pad__friction=lambda f: -f), Machine(TEXT))


def test_the_beginning_sees_a_speed_that_was_erased(run):
    assert "block.v" in beginning(falsified(run, block__v=lambda v: v - v[0]), Machine(TEXT))


def test_impulses_see_an_impact_that_pulls_rebounds_or_gains():
    scene = CLASSES["impacts"](0)
    run = observed(loaded(scene), ACCURACY)
    assert impulses(run, scene.blow) == ""
    body = next(iter(scene.blow.mass))
    jumps = np.flatnonzero(run.side == 1)
    late = run.t >= run.t[jumps[-1]]
    late[: jumps[-1]] = False
    for change in (0.01, -0.01):
        assert "impulses" in impulses(falsified(run, **{f"{body}__v": lambda v, c=change: v + c * late}), scene.blow)


@pytest.mark.slow
def test_agreement_sees_a_switch_that_is_late_and_friction_that_is_scaled(run):
    one = Compared(run)
    assert agreement(one, Compared(observed(loaded(PLAIN), ACCURACY / 10)), "tenth") == ""
    assert agreement(one, Compared(observed(loaded(PLAIN), ACCURACY, "ida")), "ida") == ""
    scaled = observed(loaded(PLAIN, TEXT.replace("coulomb: 0.3", "coulomb: 0.3001")), ACCURACY)
    assert "differs" in agreement(one, Compared(scaled), "scaled")
    later = observed(loaded(PLAIN, TEXT.replace("start: 0.1 s", "start: 0.1002 s")), ACCURACY)
    assert "differs" in agreement(one, Compared(later), "later")


def test_an_error_that_the_start_would_make_as_well_is_allowed_and_no_other(run):
    one, model = Compared(run), loaded(PLAIN)
    grown, horizon = sensitivity(model, one, ACCURACY)
    assert horizon == np.inf
    assert 0 < grown.max() < 1e-3
    scaled = observed(loaded(PLAIN, TEXT.replace("coulomb: 0.3", "coulomb: 0.303")), ACCURACY)
    assert "differs" in agreement(one, Compared(scaled), "scaled", grown, horizon)


@pytest.mark.slow
def test_a_scene_that_nobody_can_foretell_has_a_horizon():
    """Two pendulums, one on the other, thrown over: what is off at the start grows by e in a fifth of a second."""
    scene = next(one for one in map(CLASSES["ratios"], range(4, 225, 5)) if "rod1" in one.text)
    text = scene.text[: scene.text.index("run:")] + 'run: {stop: 20 s}\nrecord: {every: 10 ms, signals: ["*"]}\n'
    model = loaded(scene, text)
    _, horizon = sensitivity(model, Compared(observed(model, 1e-3)), 1e-3)
    assert 0 < horizon <= 20 or horizon == np.inf


def test_symmetry_sees_one_of_two_that_is_kept():
    scene = CLASSES["ties"](1)
    run = observed(loaded(scene), ACCURACY)
    assert symmetry(run, scene.twins) == ""
    body = next(iter(scene.twins))
    assert "symmetry" in symmetry(falsified(run, **{f"{body}__v": lambda v: v * (1 + 1e-3)}), scene.twins)


def test_a_mirror_image_is_one_and_a_scene_with_a_direction_is_seen(run):
    image = mirrored(every_step(TEXT))
    other = Compared(observed(loaded(PLAIN, image), ACCURACY), -1.0, SHOWN)
    assert agreement(Compared(run), other, "mirrored") == ""
    assert "differs" in agreement(Compared(run), Compared(run, -1.0, SHOWN), "mirrored")
    tether = TEXT.replace("type: Spring, stiffness: 300 N/m", "type: Tether, stiffness: 300 N/m, length: 1 mm")
    one, other = (observed(loaded(PLAIN, text), ACCURACY) for text in (tether, mirrored(every_step(tether))))
    assert agreement(Compared(one), Compared(other, -1.0, SHOWN), "mirrored") == ""


def test_ramps_see_a_jump_that_lets_another_contact_go():
    scene = next(one for one in map(CLASSES["jumps"], range(30)) if len(one.text) > 900)
    runs = [observed(loaded(scene, text), ACCURACY) for text in ("", *scene.ramps)]
    assert ramps(*runs) == ""
    moving = max((name for name in runs[0].columns if name.endswith(".v")), key=lambda n: abs(runs[0].columns[n][-1]))
    wrong = copy.copy(runs[0])
    wrong.columns = {**wrong.columns, moving: wrong.columns[moving] * 1.1}
    assert "ramps" in ramps(wrong, *runs[1:])
    wrong.columns = {**wrong.columns, moving: wrong.columns[moving] * 2}
    assert ramps(runs[0], runs[1], wrong) is None


def test_a_scene_that_is_refused_or_ends_is_told_apart():
    unknown = dataclasses.replace(PLAIN, text=TEXT.replace("type: Spring,", "type: Sprung,"))
    assert judge(unknown).word == "refused"
    open_ended = dataclasses.replace(PLAIN, text=TEXT.replace("stop: 0.6 s", "stop: 0.6 s, max_steps: 5"))
    assert judge(open_ended).word == "aside"

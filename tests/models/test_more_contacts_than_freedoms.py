"""Shafts of a gear with three shafts that begin in motion, with more contacts than such a gear leaves freedoms.

Contacts begin held, and all of them together would leave their forces open. Which of them slide their speeds tell.
The size of the scene does not matter: a few unknowns are factored as a full matrix, more of them as a sparse one.
"""

import pytest

DIFFERENTIAL = """
components:
  right: {{type: Inertia, moment: 0.16, angle: 0, speed: 0}}
  case: {{type: Inertia, moment: 0.352, angle: 0, speed: 7.19}}
  left: {{type: Inertia, moment: 0.299, angle: 0, speed: 14.38}}
  gear: {{type: Differential}}
  {one}: {{type: ShaftFriction, sliding: 0.758}}
  {two}: {{type: ShaftFriction, sliding: 3.39}}
  {brake}: {{type: Brake, radius: 0.176, curve: 0.423, faces: 2}}
  press: {{type: SignalSource, value: 59.54}}
  spring: {{type: TorsionSpring, stiffness: 14, damping: 0.298, rest: 0.0148}}
  torque: {{type: TorqueSource, torque: 0.5 N*m}}
{more}
connections:
  - [right.shaft, gear.right, {two}.a, spring.a, torque.shaft]
  - [case.shaft, gear.case, {one}.a, {two}.b, spring.b]
  - [gear.left, left.shaft, {one}.b, {brake}.shaft]
  - [press.signal, {brake}.normal]
{joints}
run: {{stop: 0.3 s, accuracy: 1e-7}}
friction: {{method: {method}}}
"""
PLANETARY = """
components:
  h: {{type: Housing}}
  floor: {{type: Ground}}
  ring: {{type: Inertia, moment: 0.272, angle: 0, speed: 3.91}}
  sun: {{type: Inertia, moment: 0.143, angle: 0, speed: -18.2}}
  gear: {{type: Planetary, ratio: 1.98}}
  carrier: {{type: Inertia, moment: 0.269, angle: 0, speed: -3.5094630872483217}}
  rack: {{type: Rack, radius: 0.259}}
  body: {{type: Mass, mass: 5.94, position: 0, velocity: -0.9089509395973153}}
  {one}: {{type: Contact, curve: 0.509, normal_force: 192}}
  {two}: {{type: Clutch, radius: 0.135, curve: 0.191, faces: 2}}
  {brake}: {{type: Clutch, radius: 0.0717, curve: 0.497, faces: 3}}
  press: {{type: SignalSource, value: 14.66}}
  spring: {{type: TorsionSpring, stiffness: 283, damping: 0.917, rest: -0.286}}
  torque: {{type: TorqueSource, torque: 0.9 N*m}}
{more}
connections:
  - [floor.flange, {one}.a]
  - [h.shaft, {two}.a, {brake}.a]
  - [ring.shaft, gear.ring, {brake}.b, spring.a]
  - [sun.shaft, gear.sun, {two}.b]
  - [gear.carrier, carrier.shaft, rack.pinion, spring.b, torque.shaft]
  - [rack.rack, body.flange, {one}.b]
  - [press.signal, {brake}.normal, {two}.normal]
{joints}
run: {{stop: 0.3 s, accuracy: 1e-7}}
friction: {{method: {method}}}
"""
SCENES = {"differential": (DIFFERENTIAL, ["right.angle", "case.angle"]),
          "planetary": (PLANETARY, ["ring.angle", "sun.angle", "body.x"])}  # fmt: skip
NAMES = [("a", "b", "c"), ("z", "k", "f")]


def played(simulate, which, names=NAMES[0], others=0, method="hold", **settings):
    text, signals = SCENES[which]
    more = "\n".join(
        f"  other{k}: {{type: Mass, mass: 1 kg, velocity: 1 m/s}}\n  push{k}: {{type: ForceSource, force: 1 N}}"
        for k in range(others)
    )
    joints = "\n".join(f"  - [other{k}.flange, push{k}.flange]" for k in range(others))
    given = dict(zip(("one", "two", "brake"), names, strict=True))
    result = simulate(text.format(more=more, joints=joints, method=method, **given), **settings)
    return [result.at(signal, 0.3) for signal in signals]


@pytest.mark.parametrize("others", [0, 30])
@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("which", SCENES)
def test_speeds_tell_which_contacts_slide_at_the_start(simulate, which, engine, others):
    """Beside a smooth law, whose slips are exact while they slide; at rest it creeps on."""
    smooth = played(simulate, which, method="tanh", **{"friction.stick_speed": "1e-6 m/s", "run.engine": "rodas"})
    ends = played(simulate, which, others=others, **{"run.engine": engine})
    assert ends == pytest.approx(smooth, abs=2e-5)


@pytest.mark.parametrize("which", SCENES)
def test_names_do_not_matter(simulate, which):
    one, two = (played(simulate, which, names) for names in NAMES)
    assert one == pytest.approx(two, abs=1e-9)

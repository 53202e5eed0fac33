"""What a composite gives an input that nothing is joined to counts, whatever the part inside gives."""

from __future__ import annotations

import pytest

PUSHER = '''
from fairlead.component import Component, Composite, Expansion, Input, Law, Output, Parameter


class Hand(Component):
    """Hands on what comes in, or one."""

    taken = Input("1", "What comes in."{inner})
    told = Output("1", "The same.")

    def law(p, taken):
        """As it is."""
        return Law(told=taken)


class Wrist(Composite):
    """A hand inside."""

    rest = Parameter("1", "At rest.", default=0.5)
    turned = Input("1", "What comes in."{outer})
    seen = Output("1", "The same.")

    def expand(p, scene):
        """One hand."""
        return Expansion({{"hand": scene.make(Hand)}}, [], {{}}, {{"turned": "hand.taken", "seen": "hand.told"}})
'''
SCENE = """
    components:
      wrist: {type: Wrist, rest: 3}
      body: {type: Mass, mass: 1 kg}
      push: {type: ForceSource, force: 1 N}
    connections:
      - [body.flange, push.flange]
    run: {stop: 0.1 s}
"""


@pytest.mark.parametrize(
    ("inner", "outer", "shown"),
    [("", ", default=2.0", 2.0), (", default=7.0", ", default=2.0", 2.0), (", default=7.0", "", 7.0),
     ("", ', default="rest"', 3.0)],
)  # fmt: skip
def test_the_composite_has_the_last_word(simulate, library, inner, outer, shown) -> None:
    """By number or by a parameter's name; without a word of its own the part inside has it."""
    result = simulate(SCENE, (library(PUSHER.format(inner=inner, outer=outer)),))
    assert result["wrist.seen"][-1] == shown


def test_without_either_it_must_be_joined(simulate, library) -> None:
    """As before."""
    with pytest.raises(Exception, match=r"wrist.turned: nothing is connected to this input"):
        simulate(SCENE, (library(PUSHER.format(inner="", outer="")),))


def test_another_value_of_the_parameter_is_another_default(scene, library) -> None:
    """In a model that shares what was compiled as well."""
    model = scene(SCENE, (library(PUSHER.format(inner="", outer=', default="rest"')),))
    assert model.run(out=None)["wrist.seen"][-1] == 3.0
    assert model.with_values({"wrist.rest": 4.0}).run(out=None)["wrist.seen"][-1] == 4.0


ARM = PUSHER + '''

class Arm(Composite):
    """A wrist inside, whose input it hands out with a default of its own."""

    bent = Input("1", "What comes in.", default=9.0)
    seen = Output("1", "The same.")

    def expand(p, scene):
        """One wrist."""
        return Expansion({{"wrist": scene.make(Wrist)}}, [], {{}}, {{"bent": "wrist.turned", "seen": "wrist.seen"}})
'''


def test_of_several_the_outermost_has_it_and_what_is_joined_before_all(simulate, library) -> None:
    """However deep."""
    parts = library(ARM.format(inner=", default=7.0", outer=", default=2.0"))
    text = SCENE.replace("{type: Wrist, rest: 3}", "{type: Arm}")
    assert simulate(text, (parts,))["wrist.seen"][-1] == 9.0
    joined = text.replace("body:", "one: {type: SignalSource, value: 5}\n      body:")
    joined = joined.replace("connections:", "connections:\n      - [one.signal, wrist.bent]")
    assert simulate(joined, (parts,))["wrist.seen"][-1] == 5.0

BRAKED = """
    components:
      rotor: {type: Inertia, moment: 1 kg*m^2, speed: 10 rad/s}
      brake: {type: Brake, radius: 0.1 m, curve: 0.5, normal_force: 10 N}
    connections: [[rotor.shaft, brake.shaft]]
    run: {stop: 1 s}
"""


def test_a_brake_that_nothing_presses_takes_its_own_force_in_every_model_that_shares_it(scene) -> None:
    """d(speed)/dt = -mu N r/J, for the value that the model has and for others."""
    model = scene(BRAKED)
    for force in (10.0, 40.0, 10.0):
        other = model.with_values({"brake.normal_force": force})
        assert not other.rebuilt
        assert other.run(out=None)["rotor.speed"][-1] == pytest.approx(10 - 0.5 * force * 0.1, rel=1e-6)

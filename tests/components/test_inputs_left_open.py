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

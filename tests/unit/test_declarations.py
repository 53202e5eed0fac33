"""A class that contradicts itself is refused when it is created, at its own file and line."""

import re

import pytest

from fairlead.component.base import DeclarationError
from fairlead.errors import ModelError

LAW = "def law(p, a):\n    return (0,)"
REFUSED = {
    "a zone without a law": (
        "zones = Zones('on', 'off')\n@zone('on')\ndef on(p, a):\n    return (0,)",
        "zone 'off' has no law",
    ),
    "a law of an unknown zone": (
        "zones = Zones('on')\n@zone('on', 'of')\ndef on(p, a):\n    return (0,)",
        "a law is declared for 'of', which is not in zones",
    ),
    "a guard of an unknown zone": (
        "zones = Zones('on')\n@zone('on')\ndef on(p, a):\n    return (0,)\n"
        "@guard('on', to='off', unit='m')\ndef leaves(p, a):\n    return a.x",
        "guard 'leaves' names 'off', which is not in zones",
    ),
    "a guard that leads nowhere": (
        "zones = Zones('on')\n@zone('on')\ndef on(p, a):\n    return (0,)\n"
        "@guard('on', to='on', unit='m')\ndef stays(p, a):\n    return a.x",
        "guard 'stays' leads from 'on' to itself",
    ),
    "an argument nobody declared": (
        "def law(p, a, b):\n    return (0,)",
        "law asks for 'b'; known: ['a', 'p', 't', 'zone']",
    ),
    "no law at all": ("", "zone 'always' has no law"),
    "a discrete variable that nothing samples": (f"{LAW}\nheld = Discrete('N')", "no sampled law gives ['held']"),
    "a period that is no parameter": (
        f"{LAW}\nheld = Discrete('N')\n@sampled(every='period')\ndef sample(p, a):\n    return Law(held=0)",
        "'sample' is sampled every 'period', which is no parameter",
    ),
    "a unit that means nothing": (f"{LAW}\nstiffness = Parameter('N/mile^9')", "'stiffness': N/mile^9 is not a unit"),
    "a name that is taken": (f"{LAW}\nvariant = Parameter('N')", "a parameter cannot be called 'variant'"),
    "a start that is no parameter": (
        f"{LAW}\nheld = Discrete('N', start='first')",
        "'held' starts at 'first', which is no parameter",
    ),
    "a default that is no parameter": (f"{LAW}\npull = Input('N', default='force')", "'pull' is 'force' when nothing"),
    "a unit inside a block": (LAW + "\nhose = Block({'mass': Parameter('kg per m')})", "kg per m"),
}  # fmt: skip


def declare(body, kind="Component"):
    """Create a class with this body."""
    names = {}
    exec("from fairlead.component import *", names)  # as the top of a user's file
    lines = "".join(f"    {line}\n" for line in ["a = Translational()", *body.splitlines()])
    exec(f"class Mine({kind}):\n{lines}", names)  # the text of this test
    return names["Mine"]


@pytest.mark.parametrize("name", REFUSED)
def test_a_contradiction_is_refused_when_the_class_is_created(name):
    body, says = REFUSED[name]
    with pytest.raises(DeclarationError) as caught:
        declare(body)
    assert says in str(caught.value)
    assert "Mine: " in str(caught.value)


def test_a_composite_must_say_what_it_is_made_of():
    with pytest.raises(DeclarationError, match=r"a Composite needs an expand\(p\) method"):
        declare("", kind="Composite")


def test_what_does_not_contradict_itself_is_a_component():
    assert list(declare(LAW).declaration.ports) == ["a"]


def test_a_file_with_such_a_class_is_named_with_its_line(scene, library):
    path = library("\nclass Mine(Component):\n    a = Translational()\n")
    with pytest.raises(ModelError) as caught:
        scene("components: {}\nrun: {stop: 1 s}", libraries=(path,)).check()
    assert re.search(r"classes0\.py:3: Mine: zone 'always' has no law", str(caught.value))

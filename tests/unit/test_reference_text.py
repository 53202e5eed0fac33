"""The public names have what a generated reference needs: a sentence each, and annotations."""

import inspect

import pytest

import fairlead
from fairlead.results import Event, Signal
from fairlead.results.kept_lists import Events, RunRecord, Signals
from fairlead.results.table import Table
from fairlead.statics import Statics, StaticsOfLines

CLASSES = [getattr(fairlead, name) for name in fairlead.__all__ if inspect.isclass(getattr(fairlead, name))]
CLASSES += [Event, Events, RunRecord, Signal, Signals, Statics, StaticsOfLines, Table]
FUNCTIONS = [getattr(fairlead, name) for name in fairlead.__all__ if inspect.isfunction(getattr(fairlead, name))]


def members(cls):
    """Public methods and properties of ours."""
    for name, member in inspect.getmembers_static(cls):
        owner = next((base for base in cls.__mro__ if name in vars(base)), None)
        if not name.startswith("_") and owner is not None and owner.__module__.startswith("fairlead"):
            function = getattr(member, "fget", None) or getattr(member, "func", None) or getattr(
                member, "__func__", member)  # fmt: skip
            if inspect.isfunction(function):
                yield f"{cls.__name__}.{name}", function


def says(text):
    """Whether a docstring begins with a sentence."""
    return bool(text) and text.strip().split("\n\n")[0].rstrip()[-1] in ".:;"


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_a_public_class_and_all_its_members_say_what_they_are(cls):
    silent = [name for name, function in members(cls) if not says(function.__doc__)]
    assert not silent
    assert says(cls.__doc__)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_every_argument_and_answer_of_a_public_member_is_annotated(cls):
    bare = []
    for name, function in members(cls):
        signature = inspect.signature(function)
        first, *others = [*signature.parameters.values(), None]
        given = [one for one in (first, *others) if one is not None and one.name not in ("self", "cls")]
        if any(one.annotation is inspect.Parameter.empty for one in given):
            bare.append(name)
        if signature.return_annotation is inspect.Signature.empty:
            bare.append(name)
    assert not bare


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda function: function.__name__)
def test_a_public_function_says_what_it_does_and_raises(function):
    assert says(function.__doc__)
    assert all(one.annotation is not inspect.Parameter.empty for one in inspect.signature(function).parameters.values())


def test_every_name_of_the_package_is_there():
    for name in fairlead.__all__:
        assert getattr(fairlead, name) is not None
    with pytest.raises(AttributeError, match="has no attribute 'laod'"):
        fairlead.laod  # noqa: B018

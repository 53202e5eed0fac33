"""A netlist names a type by one word, so no two classes of the library may have the same."""

from fairlead.component.bundled import bundled, written


def test_no_two_types_of_the_library_have_one_name():
    """The one imported later would hide the other, without a word: `Cylinder` was once a roll of web."""
    known = written()
    assert known is not None
    assert {name: where for name, where in known.where.items() if name in bundled() and len(where) > 1} == {}
    assert bundled()["Cylinder"].__module__ == "fairlead.components.hydraulics.cylinder"

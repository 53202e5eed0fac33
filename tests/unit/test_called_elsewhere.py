"""What other tools call a part leads to the one here."""

import pytest

from fairlead.component.called_elsewhere import CALLED, MEANT, similar_type
from fairlead.component.registry import known_types


def test_each_part_is_one_and_each_word_is_none_and_leads_to_one():
    types = known_types(())
    assert set(CALLED) <= set(types)
    assert not set(MEANT) & {name.lower() for name in types}
    assert len(MEANT) == sum(len(words.split()) for words in CALLED.values())


@pytest.mark.parametrize(
    ("written", "meant"),
    [("Friction", "Contact"), ("Crank_Slider", "Crank"), ("crank-slider", "Crank"), ("Masss", "Mass"), ("Xyzzy", "")],
)
def test_letters_decide_only_where_no_word_does(written, meant):
    assert similar_type(written, known_types(())) == (f"Did you mean {meant}?" if meant else "")

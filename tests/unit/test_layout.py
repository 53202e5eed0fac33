"""The positions of flat memory: one name for each, and rows as long as the arrays that have them."""

import pytest

import fairlead
from fairlead.kernels import layout
from fairlead.system.compiled.context import ADDRESSES, COUNTED

ROWS = {
    "schedule": layout.CALL, "pairs": layout.PAIR, "program": layout.ADD, "fixed": layout.ADD,
    "mass_program": layout.MASS_ADD, "holds": layout.HOLD, "guard_place": layout.GUARD_ROW, "guard_to": layout.TO,
    "time_place": layout.TIME, "sampled": layout.SAMPLED_ROW, "accelerated": layout.ACCELERATED_ROW,
    "circle_pairs": layout.CIRCLE, "circle_coef": layout.CIRCLE_COEFS, "circle_zones": layout.CIRCLE_ZONE,
    "circle_bodies": layout.BODY, "circle_nodes": layout.NODE, "rated": layout.RATED_NODE,
    "rated_joins": layout.JOIN, "rated_terms": layout.TERM,
}  # fmt: skip


@pytest.fixture(scope="module")
def memory():
    return fairlead.load("belt").system.memory


@pytest.mark.parametrize("name", ROWS)
def test_a_row_of_an_array_is_as_long_as_its_description(name, memory):
    assert memory[name].shape[1] == ROWS[name]


def test_no_two_numbers_of_the_context_have_one_position(memory):
    names = {*ADDRESSES, *COUNTED}
    assert memory["context"].shape == (layout.CONTEXT,)
    assert len({getattr(layout, name) for name in names}) == len(names) > 50

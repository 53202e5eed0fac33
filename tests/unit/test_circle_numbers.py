"""Circles of contacts that may hold are one where they have a body in common, and have numbers."""

from fairlead.system.numbering.contact_cycles import REST, HeldPair, numbers


def pair(one, other):
    return HeldPair(f"{one} {other}", "force", ((one, 1.0), (other, -1.0)), 1.0)


def test_two_rings_have_two_numbers_and_what_joins_them_makes_one_of_them():
    rings = [pair(1, 2), pair(1, 2), pair(3, REST), pair(3, REST)]
    of_pairs, of_bodies = numbers(rings, {1: 10, 2: 11, 3: 12})
    assert of_pairs[0] == of_pairs[1] == of_bodies[1] == of_bodies[2]
    assert of_pairs[2] == of_pairs[3] == of_bodies[3] != of_pairs[0]
    of_pairs, _ = numbers([*rings, pair(2, 3)], {1: 10, 2: 11, 3: 12})
    assert set(of_pairs) == {1}


def test_what_moves_as_given_joins_no_circles():
    """Body 9 has no share: its motion is given."""
    of_pairs, of_bodies = numbers([pair(1, 9), pair(1, 9), pair(2, 9), pair(2, 9), pair(9, 9)], {1: 10, 2: 11})
    assert of_pairs == [of_bodies[1]] * 2 + [of_bodies[2]] * 2 + [3]


def test_numbers_do_not_exceed_the_rows_that_bear_them():
    of_pairs, of_bodies = numbers([pair(9, REST), pair(9, REST)], {})
    assert (of_pairs, of_bodies) == ([1, 2], {})

"""How a line is cut, and how much of a device its nodes feel: sums that hold for any mesh."""

import math

import numpy as np
import pytest
from fairlead.components.line.mesh import Mesh, bulkheads, cut
from fairlead.components.route.window import Reach, Window, total
from hypothesis import given, settings
from hypothesis import strategies as some

LENGTHS = some.lists(some.floats(0.05, 2.0), min_size=30, max_size=60)


@settings(max_examples=200, deadline=None)
@given(lengths=LENGTHS, begin=some.floats(3.0, 8.0), extent=some.floats(0.2, 12.0))
def test_the_weights_of_all_nodes_sum_to_the_length_of_the_device(lengths, begin, extent):
    """Item 33, for unequal elements and for devices shorter than one: the pieces of the nodes tile the line."""
    places = (-15.0, *(-15.0 + np.cumsum([*lengths, 40.0])))
    mesh = Mesh(tuple(places), frozenset())
    device = Window(begin, begin + extent)
    felt = sum(mesh.reach(i).length * total([device], mesh.reach(i))(x) for i, x in enumerate(places))
    assert felt == pytest.approx(extent, abs=1e-9)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(place=some.floats(-3.0, 3.0), behind=some.floats(0.01, 1.0), ahead=some.floats(0.01, 1.0))
def test_where_one_device_ends_and_the_next_begins_the_weights_sum_to_one(place, behind, ahead):
    reach = Reach(behind, ahead)
    both = [Window(-9.0, 0.0), Window(0.0, 9.0)]
    assert total(both, reach)(place) == pytest.approx(1.0, abs=1e-12)
    assert sum(total([one], reach)(place) for one in both) == pytest.approx(1.0, abs=1e-12)


def test_a_window_without_end_rises_once():
    sea = total([Window(2.0, math.inf)], Reach(0.1, 0.1))
    assert [sea(x) for x in (-50, 1.9, 2.0, 2.1, 500)] == pytest.approx([0, 0, 0.5, 1, 1])
    drum = total([Window(-math.inf, 0.0)], Reach(0.1, 0.1))
    assert [drum(x) for x in (-500, -0.1, 0.0, 0.1, 50)] == pytest.approx([1, 1, 0.5, 0, 0])


def test_equal_modules_have_connectors_where_they_meet():
    mesh = cut(30.0, 0.5, modules=3)
    assert mesh.elements == 60
    assert sorted(mesh.connectors) == [0, 20, 40, 60]
    assert mesh.places[20] == pytest.approx(10.0)


def test_graded_elements_have_the_wanted_length_and_fill_the_line():
    mesh = cut(40.0, 1.0, graded=lambda s: 0.25 if 10 <= s <= 20 else 2.0)
    lengths = np.array(mesh.lengths)
    assert lengths.sum() == pytest.approx(40.0)
    middle = np.add(mesh.places[1:], mesh.places[:-1]) / 2
    np.testing.assert_allclose(lengths[(middle > 11) & (middle < 19)], 0.25, rtol=0.1)
    assert mesh.elements < 65


@pytest.mark.parametrize(("pitch", "nodes"), [(0.5, list(range(1, 20))), (1.0, list(range(2, 20, 2)))])
def test_bulkheads_sit_at_their_pitch_and_share_the_core_among_them(pitch, nodes):
    mesh = cut(10.0, 0.5)
    found = bulkheads(mesh, pitch)
    assert sorted(found) == nodes
    assert all(reach.length == pytest.approx(pitch) for reach in found.values())
    assert sum(reach.length for reach in found.values()) == pytest.approx(10.0 - pitch)  # the rest is the connectors'


def test_bulkheads_that_are_smeared_take_the_piece_of_every_node():
    mesh = cut(10.0, 0.5)
    assert bulkheads(mesh, None) == {i: mesh.reach(i) for i in range(1, 20)}


def test_a_piece_reaches_half_way_to_the_nodes_beside_it():
    """To its neighbours, itself at an end; a bulkhead's to the bulkheads or connectors beside it."""
    mesh = cut(12.0, 1.0, modules=2, graded=lambda place: 0.25 if 3.0 < place < 6.0 else 1.0)
    inner = range(1, mesh.elements)
    assert all(mesh.beside(i, mesh.reach(i)) == (i - 1, i + 1) for i in inner)
    assert mesh.beside(0, mesh.reach(0)) == (0, 1)
    assert mesh.beside(mesh.elements, mesh.reach(mesh.elements)) == (mesh.elements - 1, mesh.elements)
    found = bulkheads(mesh, 2.0)
    marks = sorted({*found, *mesh.connectors})
    assert all(mesh.beside(i, found[i]) == (marks[k - 1], marks[k + 1]) for k, i in enumerate(marks) if i in found)

"""Drawings of the wiring: everything is in them, big models stay small, text cannot break them."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

import fairlead
from fairlead.flatten.drawing import dot, draw, mermaid
from fairlead.flatten.layered import place
from fairlead.flatten.picture import Arrow, Box, Picture, Wire, picture
from fairlead.flatten.vector_drawing import svg

MODELS = sorted(path.stem for path in (Path(__file__).parents[2] / "models").glob("*.yaml"))
NASTY = Picture(
    'a "b" <c>',
    (Box('"]; <script>', "T&U", 1, False), Box("b\\", "#quot;", 3, True)),
    (Wire(((0, "a"), (1, "<b>")), "translational", 1),),
    (Arrow((0, '"'), (1, "&"), 1),),
)


@pytest.fixture(scope="module")
def belt() -> fairlead.Model:
    return fairlead.load("belt")


@pytest.mark.parametrize("kind", ["mermaid", "dot", "svg"])
@pytest.mark.parametrize("name", ["wall", "spring", "block", "belt", "pad", "Contact, hold", "Ground"])
def test_every_component_is_in_the_drawing(belt: fairlead.Model, kind: str, name: str) -> None:
    assert name in draw(belt.flat, kind)


def test_three_joined_ports_meet_in_a_dot_and_two_in_a_line(belt: fairlead.Model) -> None:
    text = mermaid(picture(belt.flat))
    assert text.count("(( ))") == 1  # spring.b, block.flange, pad.b
    assert 'c0 ---|"flange - a"| c1' in text


def test_elements_of_a_line_share_a_box_with_their_number() -> None:
    drawn = picture(fairlead.load("single_bend").flat)
    names = {box.name: box for box in drawn.boxes}
    assert names["line.hose[0..59]"].count == 60
    assert names["line.core_node[0..60]"].caption == "61 x Mass"
    assert len(drawn.boxes) < 15
    assert len(drawn.wires) < 15


def test_signals_are_arrows_from_output_to_input() -> None:
    drawn = picture(fairlead.load("single_bend").flat)
    boxes = [box.name for box in drawn.boxes]
    found = {(boxes[a.source[0]], a.source[1], boxes[a.target[0]], a.target[1]) for a in drawn.arrows}
    assert ("line.outer_load[1..60]", "force", "line.outer[1..60]", "normal") in found
    assert "-.->" in mermaid(drawn)
    assert "style=dashed" in dot(drawn)


@pytest.mark.parametrize("model", MODELS)
def test_svg_is_well_formed_and_no_boxes_overlap(model: str) -> None:
    drawn = picture(fairlead.load(model).flat)
    ElementTree.fromstring(svg(drawn))
    boxes = [p for (kind, _), p in place(drawn).items() if kind == "box"]
    for k, one in enumerate(boxes):
        for other in boxes[k + 1 :]:
            apart = abs(one.x - other.x) >= (one.width + other.width) / 2
            assert apart or abs(one.y - other.y) >= (one.height + other.height) / 2


def test_text_from_outside_is_escaped() -> None:
    text = svg(NASTY)
    ElementTree.fromstring(text)
    assert "<script>" not in text
    assert "<script>" not in mermaid(NASTY)
    assert not re.search(r'(?<!\\)(\\\\)*"\];', dot(NASTY).splitlines()[4].removesuffix('"];'))


def test_a_model_in_two_pieces_is_drawn_one_below_the_other() -> None:
    boxes = tuple(Box(name, "Mass", 1, False) for name in "abcd")
    wires = (Wire(((0, "b"), (1, "a")), "hydraulic", 1), Wire(((2, "b"), (3, "a")), "odd", 1))
    places = place(Picture("pieces", boxes, wires, ()))
    upper = max(places["box", k].y for k in (0, 1))
    assert upper < min(places["box", k].y for k in (2, 3))


def test_a_single_component_can_be_drawn() -> None:
    ElementTree.fromstring(svg(Picture("one", (Box("a", "Mass", 1, False),), (), ())))

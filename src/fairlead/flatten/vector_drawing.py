"""A picture as SVG text, drawn by hand so that no system package is needed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from fairlead.flatten.layered import DOT, Place, Vertex, place
from fairlead.flatten.picture import End, Picture, Wire

Places = dict[Vertex, Place]
MARGIN = 24.0  # px
ARROW = 'class="signal" marker-end="url(#head)"'
COLOURS = {"translational": "#22577a", "rotational": "#7a4b22", "hydraulic": "#1b7f79", "electrical": "#8a6d00",
           "thermal": "#a33b20"}  # fmt: skip
STYLE = """
  svg { background: white; font-family: sans-serif; }
  .box { fill: #f5f7fa; stroke: #44546a; stroke-width: 1.2; } .anchored { fill: #e3e6ea; }
  .many { fill: white; } .name { font-size: 12px; fill: #1d2733; } .type { font-size: 10.5px; fill: #5c6b7a; }
  .port { font-size: 9.5px; fill: #44546a; paint-order: stroke; stroke: white; stroke-width: 3px; }
  .wire { fill: none; stroke-width: 1.6; } .signal { fill: none; stroke: #b5485d; stroke-dasharray: 5 4; }
"""
ARROW_HEAD = """<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8"
  orient="auto"><path d="M0,0.8 L8,4 L0,7.2 z" fill="#b5485d"/></marker></defs>"""


def svg(drawn: Picture) -> str:
    """The picture as one SVG document."""
    places = place(drawn)
    width = round(max((p.x + p.width / 2 for p in places.values()), default=0.0) + 2 * MARGIN)
    height = round(max((p.y + p.height / 2 for p in places.values()), default=0.0) + 2 * MARGIN)
    inside = [*_boxes(drawn, places), *_drawn_lines(_lines(drawn), places), *_dots(drawn, places)]
    return "\n".join([
        '<svg xmlns="http://www.w3.org/2000/svg"',
        f'  viewBox="0 0 {width} {height}" width="{width}" height="{height}">',
        f"<title>{escape(drawn.name)}</title><style>{STYLE}</style>{ARROW_HEAD}",
        f'<rect width="{width}" height="{height}" fill="white"/>',
        f'<g transform="translate({MARGIN:.0f},{MARGIN:.0f})">', *inside, "</g></svg>",
    ])  # fmt: skip


def _boxes(drawn: Picture, places: Places) -> Iterator[str]:
    for k, box in enumerate(drawn.boxes):
        p = places["box", k]
        if box.count > 1:  # a second sheet behind
            yield _rectangle(p, "box many", 4.0)
        yield _rectangle(p, "box anchored" if box.anchored else "box", 0.0)
        yield f'<text class="name" text-anchor="middle" x="{p.x:.1f}" y="{p.y - 3:.1f}">{escape(box.name)}</text>'
        yield f'<text class="type" text-anchor="middle" x="{p.x:.1f}" y="{p.y + 12:.1f}">{escape(box.caption)}</text>'


def _rectangle(p: Place, kind: str, shift: float) -> str:
    x, y = p.x - p.width / 2 + shift, p.y - p.height / 2 + shift
    return f'<rect class="{kind}" x="{x:.1f}" y="{y:.1f}" width="{p.width:.1f}" height="{p.height:.1f}" rx="4"/>'


def _dots(drawn: Picture, places: Places) -> Iterator[str]:
    for number, wire in enumerate(drawn.wires):
        if len(wire.ends) != 2:
            p = places["wire", number]
            said = escape(", ".join(f"{drawn.boxes[box].name}.{port}" for box, port in wire.ends))
            circle = f'cx="{p.x:.1f}" cy="{p.y:.1f}" r="{DOT}" fill="{_colour(wire)}"'
            yield f"<circle {circle}><title>{said}</title></circle>"


def _colour(wire: Wire) -> str:
    return COLOURS.get(wire.domain, "#444444")


@dataclass(frozen=True)
class Line:
    """Ports of boxes, joined at or through a point."""

    point: Vertex
    ends: tuple[End, ...]
    style: str


def _lines(drawn: Picture) -> list[Line]:
    wires = [Line(("wire", k), w.ends, f'class="wire" stroke="{_colour(w)}"') for k, w in enumerate(drawn.wires)]
    return wires + [Line(("arrow", k), (a.source, a.target), ARROW) for k, a in enumerate(drawn.arrows)]


def _drawn_lines(lines: list[Line], places: Places) -> Iterator[str]:
    """Curves that leave a box sideways; what leaves one side of a box is spread over it."""
    heights, labels = _heights(lines, places), []
    for line in lines:
        starts = []
        for box, port in line.ends:
            side = _side(box, line, places)
            x, y = places["box", box].x + side * places["box", box].width / 2, heights[box, side, port]
            starts.append((x, y, side))
            labels.append(_label(x, y, side, port))
        for path in _paths(starts, places[line.point]):
            yield f'<path {line.style} d="{path}"/>'
    yield from dict.fromkeys(labels)  # last, so that no line runs through them


def _paths(starts: list[tuple[float, float, int]], point: Place) -> Iterator[str]:
    """One path through the point for two ends, else one to it from each end."""
    if len(starts) != 2:
        for x, y, _ in starts:
            yield f"M{x:.1f},{y:.1f} {_curve(x, y, point.x, point.y)}"
        return
    (x0, y0, side), (x1, y1, other) = starts
    if side == other:  # both ends lie on one side of the point: out and back
        far = point.x + (point.x - max(x0, x1, key=lambda x: side * x)) / 3
        yield f"M{x0:.1f},{y0:.1f} C{far:.1f},{y0:.1f} {far:.1f},{y1:.1f} {x1:.1f},{y1:.1f}"
    else:
        yield f"M{x0:.1f},{y0:.1f} {_curve(x0, y0, point.x, point.y)} {_curve(point.x, point.y, x1, y1)}"


def _curve(x0: float, y0: float, x1: float, y1: float) -> str:
    """Level at both ends."""
    middle = (x0 + x1) / 2
    return f"C{middle:.1f},{y0:.1f} {middle:.1f},{y1:.1f} {x1:.1f},{y1:.1f}"


def _label(x: float, y: float, side: int, port: str) -> str:
    anchor = "start" if side > 0 else "end"
    return f'<text class="port" text-anchor="{anchor}" x="{x + 5 * side:.1f}" y="{y - 3:.1f}">{escape(port)}</text>'


def _side(box: int, line: Line, places: Places) -> int:
    """+1 when the line leaves the box to the right."""
    return 1 if places[line.point].layer > places["box", box].layer else -1


def _heights(lines: list[Line], places: Places) -> dict[tuple[int, int, str], float]:
    """Where on its side of a box each port lies: in the order of what it leads to."""
    reach: dict[tuple[int, int], dict[str, list[float]]] = {}
    for line in lines:
        for box, port in line.ends:
            reach.setdefault((box, _side(box, line, places)), {}).setdefault(port, []).append(places[line.point].y)
    heights = {}
    for (box, side), ports in reach.items():
        p = places["box", box]
        order = sorted(ports, key=lambda name: (sum(ports[name]) / len(ports[name]), name))
        for number, name in enumerate(order):
            heights[box, side, name] = p.y + p.height * ((number + 1) / (len(order) + 1) - 0.5)
    return heights

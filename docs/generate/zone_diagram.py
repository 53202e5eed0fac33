"""The zones of a component as a drawing: a circle for each, an arrow for each way from one to another."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from html import escape

WIDE, HIGH, RADIUS = 640, 360, 34
STYLE = (
    "text{font:13px sans-serif;text-anchor:middle;fill:#1b1f24}.guard{font-size:11px;fill:#57606a}"
    "circle{fill:#dbe9f6;stroke:#2a6f97;stroke-width:1.5}path{fill:none;stroke:#57606a;stroke-width:1.2}rect{fill:#ffffff}"
)


def zone_diagram(zones: Iterable[str], ways: Mapping[tuple[str, str], str], title: str) -> str:
    """An SVG. `ways`: what leads from a zone to another, by (from, to)."""
    names = list(zones)
    high = 170 if len(names) == 2 else HIGH
    at = {name: _place(k, len(names), high) for k, name in enumerate(names)}
    parts = [_arrow(at[start], at[end], guard) for (start, end), guard in ways.items() if start in at and end in at]
    for name, (x, y) in at.items():
        parts.append(f'<circle cx="{x:.0f}" cy="{y:.0f}" r="{RADIUS}"/>')
        parts += _words(name, x, y)
    told = "; ".join(f"{start} to {end} by {guard}" for (start, end), guard in ways.items())
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {high}" width="{WIDE}" role="img">'
        f"<title>{escape(title)}: {escape(told)}</title><style>{STYLE}</style>"
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L8 4L0 8z" style="fill:#57606a;stroke:none"/></marker></defs>'
        f'<rect width="{WIDE}" height="{high}"/>{"".join(parts)}</svg>'
    )


def _place(k: int, count: int, high: float) -> tuple[float, float]:
    if count == 2:
        return (WIDE / 2 + (-1 if k == 0 else 1) * 150, high / 2)
    angle = 2 * math.pi * k / count - math.pi / 2
    return WIDE / 2 + 230 * math.cos(angle), high / 2 + 125 * math.sin(angle)


def _words(name: str, x: float, y: float) -> list[str]:
    """The name in the circle, broken at its underscores."""
    lines = name.split("_")
    first = y + 4 - 7 * (len(lines) - 1)
    return [f'<text x="{x:.0f}" y="{first + 14 * k:.0f}">{escape(line)}</text>' for k, line in enumerate(lines)]


def _arrow(start: tuple[float, float], end: tuple[float, float], guard: str) -> str:
    """A bent arrow, so that the way back does not lie on it, with the name of its guard."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    size = math.hypot(dx, dy) or 1.0
    ux, uy = dx / size, dy / size
    nx, ny = -uy, ux
    mx, my = (start[0] + end[0]) / 2 + 34 * nx, (start[1] + end[1]) / 2 + 34 * ny
    a = (start[0] + RADIUS * (0.9 * ux + 0.4 * nx), start[1] + RADIUS * (0.9 * uy + 0.4 * ny))
    b = (end[0] - (RADIUS + 3) * (0.9 * ux - 0.4 * nx), end[1] - (RADIUS + 3) * (0.9 * uy - 0.4 * ny))
    tx, ty = (start[0] + end[0]) / 2 + 30 * nx, (start[1] + end[1]) / 2 + 30 * ny + 4
    path = f'<path d="M{a[0]:.0f} {a[1]:.0f}Q{mx:.0f} {my:.0f} {b[0]:.0f} {b[1]:.0f}" marker-end="url(#tip)"/>'
    return f'{path}<text class="guard" x="{tx:.0f}" y="{ty:.0f}">{escape(guard)}</text>'

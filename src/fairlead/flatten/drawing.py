"""The wiring of a model as Mermaid, DOT or SVG text.

Components are boxes; joined ports meet in a line, or in a dot when there are more than two; signals are dashed
arrows. Names of ports stand at the ends.
"""

from __future__ import annotations

from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.picture import Arrow, Picture, picture
from fairlead.flatten.vector_drawing import svg

MERMAID = str.maketrans({'"': "#quot;", "<": "#lt;", ">": "#gt;", "#": "#35;", "&": "#amp;"})


def draw(flat: FlatModel, format: str) -> str:
    """The picture of a model in `mermaid`, `dot` or `svg`."""
    return {"mermaid": mermaid, "dot": dot, "svg": svg}[format](picture(flat))


def mermaid(drawn: Picture) -> str:
    """A Mermaid flowchart, as GitHub and many editors show it."""
    lines = ["flowchart LR"]
    lines += [f'  c{k}["{_mermaid(box.name)}<br/><i>{_mermaid(box.caption)}</i>"]' for k, box in enumerate(drawn.boxes)]
    for number, wire in enumerate(drawn.wires):
        if len(wire.ends) == 2:
            (one, a), (two, b) = wire.ends
            lines.append(f'  c{one} ---|"{_mermaid(f"{a} - {b}")}"| c{two}')
            continue
        lines.append(f"  n{number}(( ))")
        lines += [f'  c{box} ---|"{_mermaid(port)}"| n{number}' for box, port in wire.ends]
    for arrow in drawn.arrows:
        lines.append(f'  c{arrow.source[0]} -.->|"{_mermaid(_label(arrow))}"| c{arrow.target[0]}')
    return "\n".join(lines)


def dot(drawn: Picture) -> str:
    """A Graphviz graph."""
    lines = [f'graph "{_dot(drawn.name)}" {{', "  rankdir=LR;", '  node [shape=box, fontname="sans-serif"];',
             '  edge [fontname="sans-serif", fontsize=9];']  # fmt: skip
    lines += [f'  c{k} [label="{_dot(box.name)}\\n{_dot(box.caption)}"];' for k, box in enumerate(drawn.boxes)]
    for number, wire in enumerate(drawn.wires):
        if len(wire.ends) == 2:
            (one, a), (two, b) = wire.ends
            lines.append(f'  c{one} -- c{two} [taillabel="{_dot(a)}", headlabel="{_dot(b)}"];')
            continue
        lines.append(f"  n{number} [shape=point];")
        lines += [f'  c{box} -- n{number} [taillabel="{_dot(port)}"];' for box, port in wire.ends]
    for arrow in drawn.arrows:
        ends = f'taillabel="{_dot(arrow.source[1])}", headlabel="{_dot(arrow.target[1])}"'
        lines.append(f"  c{arrow.source[0]} -- c{arrow.target[0]} [style=dashed, dir=forward, {ends}];")
    return "\n".join([*lines, "}"])


def _label(arrow: Arrow) -> str:
    return f"{arrow.source[1]} to {arrow.target[1]}"


def _mermaid(text: str) -> str:
    return text.translate(MERMAID)


def _dot(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')

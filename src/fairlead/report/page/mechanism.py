"""The mechanism of a scene for the page: the boxes of its netlist, their places, and what moves them.

A box moves with the position that its component tells, a wheel turns with its angle, and ports that are joined move
together. Strips show what is made of many: the places of all elements, each in the colour of its zone.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from fairlead.flatten.layered import place
from fairlead.flatten.picture import Box, Picture, Wire
from fairlead.flatten.vector_drawing import svg
from fairlead.report.page.signals import families

if TYPE_CHECKING:
    from fairlead.results import Result, Signal

MOST_SHOWN = 3
"""Values beside a box."""
MOST_BOXES = 240


def picture(scene: Mapping[str, Any], name: str) -> Picture:
    """The wiring at the level of the netlist."""
    parts = list(scene["components"].items())[:MOST_BOXES]
    number = {one: k for k, (one, _) in enumerate(parts)}
    boxes = tuple(Box(one, str(about["type"]), 1, bool(about["fixed"])) for one, about in parts)
    wires = []
    for joined in scene["connections"]:
        ends = [(end.partition(".")[0], end.partition(".")[2]) for end in joined["ends"]]
        known = tuple((number[one], port) for one, port in ends if one in number)
        if len(known) > 1:
            wires.append(Wire(known, str(joined["domain"]), 1))
    return Picture(name, boxes, tuple(wires), ())


def wiring(result: Result) -> str:
    """The wiring as an image address with the SVG in it; "" of a run that kept no scene."""
    scene = result.run.get("scene")
    if not scene or not scene["components"]:
        return ""
    drawn = svg(picture(scene, str(result.run.get("name", "")))).encode()
    return f"data:image/svg+xml;base64,{base64.b64encode(drawn).decode()}"


def mechanism_data(result: Result) -> dict[str, Any] | None:
    """Boxes, wires and strips with the families that move them; None of a run that kept no scene."""
    scene = result.run.get("scene")
    if not scene or not scene["components"]:
        return None
    drawn, known = picture(scene, ""), families(result)
    places = place(drawn)
    boxes = [
        {"name": box.name, "type": box.type, "fixed": box.anchored, **_at(places["box", k]),
         "x": _own(known, box.name, "m", "x"), "angle": _own(known, box.name, "rad", "angle"),
         "zone": box.name, "shown": _shown(known, box.name)}
        for k, box in enumerate(drawn.boxes)
    ]  # fmt: skip
    wires = [
        {"ends": [{"box": box, "port": port} for box, port in wire.ends], "domain": wire.domain,
         **_at(places["wire", k])}
        for k, wire in enumerate(drawn.wires)
    ]  # fmt: skip
    left = len(scene["components"]) - len(boxes)
    return {"boxes": boxes, "wires": wires, "strips": _strips(known), "left_out": left}


def _at(found: Any) -> dict[str, float]:
    return {"cx": found.x, "cy": found.y, "w": found.width, "h": found.height}


def _own(known: Mapping[str, list[Signal]], name: str, unit: str, word: str) -> str | None:
    """The signal that tells where a component is: `block.x`, else one of that unit and word of a part of it."""
    if known.get(f"{name}.{word}", [None])[0] is not None and known[f"{name}.{word}"][0].unit == unit:
        return f"{name}.{word}"
    own = ((one, each) for one, each in known.items() if one.startswith(f"{name}.") and one.endswith(f".{word}"))
    parts = [one for one, each in own if len(each) == 1 and each[0].unit == unit]
    return parts[0] if parts else None


def _shown(known: Mapping[str, list[Signal]], name: str) -> list[str]:
    own = [one for one, each in known.items() if one.startswith(f"{name}.") and len(each) == 1]
    return sorted(own, key=lambda one: (one.count("."), known[one][0].unit in ("m", "rad")))[:MOST_SHOWN]


def _strips(known: Mapping[str, list[Signal]]) -> list[dict[str, Any]]:
    """Families of places of many elements."""
    many = ((name, each) for name, each in known.items() if "[*]" in name and len(each) > 2)
    return [{"family": name, "count": len(each)} for name, each in many
            if each[0].unit in ("m", "rad") and name.rpartition(".")[2] in ("x", "angle")]  # fmt: skip

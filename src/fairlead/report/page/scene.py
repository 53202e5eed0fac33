"""The scene as its user wrote it, and the settings: rows and lines for the page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fairlead.results import Result

APART = ("scene", "zones", "routes", "extremes", "effects_in_force", "ruck", "limits", "against_statics", "files",
         "description", "friction", "effects", "profile", "energy", "remarks")  # fmt: skip
"""Entries of run.json that other parts of the page show, or that are too long to read."""
LONGEST = 300


def scene_data(result: Result) -> dict[str, Any]:
    """Files as numbered lines, parameters, values given from outside, effects and friction chosen by hand."""
    scene = result.run.get("scene") or {}
    components = scene.get("components") or {}
    return {
        "files": {name: text.splitlines() for name, text in (scene.get("files") or {}).items()},
        "parameters": {name: _told(value) for name, value in (scene.get("parameters") or {}).items()},
        "set": scene.get("set") or {},
        "chosen": dict(_flat({"effects": scene.get("effects") or result.run.get("effects") or {},
                              "friction": scene.get("friction") or {}})),
        "components": [{"name": name, **about, "given": _given(about["parameters"])}
                       for name, about in components.items()],
        "connections": [" - ".join(one["ends"]) for one in scene.get("connections") or ()],
    }  # fmt: skip


def settings_rows(run: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Settings, versions and counters, nested ones under the words above them."""
    return [(words, _told(value)) for words, value in _flat({key: run[key] for key in run if key not in APART})]


def _given(parameters: Mapping[str, Any]) -> str:
    return ", ".join(f"{key}: {_told(value)}" for key, value in parameters.items())


def _flat(entries: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in entries.items():
        words = f"{above} {str(key).replace('_', ' ')}".strip()
        if isinstance(value, Mapping):
            yield from _flat(value, words)
        elif value is not None and value != []:
            yield words, value


def _told(value: Any) -> str:
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."

"""The scene as its user wrote it, and the settings: rows and lines for the page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from fairlead.report.page.places import named, without_folders

if TYPE_CHECKING:
    from fairlead.results import Result

APART = ("scene", "zones", "routes", "extremes", "effects_in_force", "ruck", "limits", "against_statics", "files",
         "description", "friction", "effects", "profile", "energy", "remarks", "format", "process", "host", "boot",
         "locked", "name", "sentence")  # fmt: skip
"""Entries of run.json that other parts of the page show, that are too long to read, or that serve a running process."""
SAYS = {
    "switches": "zone changes", "machines": "parts with zones", "build": "compiled for", "versions": "version of",
    "rhs": "evaluations of the laws", "guards": "evaluations of the guards", "located": "zone changes located in time",
    "settling_passes": "passes of settling", "record_every": "recorded every [s]",
}  # fmt: skip
"""What a reader calls an entry that run.json has a word of the program for."""
UNKNOWN = "not kept: an earlier version of fairlead wrote this run"
LONGEST = 300


def scene_data(result: Result) -> dict[str, Any]:
    """Files as numbered lines, parameters, values given from outside, effects and friction chosen by hand."""
    scene = result.run.get("scene") or {}
    components = scene.get("components") or {}
    return {
        "files": {named(name, result.run): text.splitlines() for name, text in (scene.get("files") or {}).items()},
        "parameters": {name: _told(value) for name, value in (scene.get("parameters") or {}).items()},
        "set": scene.get("set") or {},
        "chosen": dict(_flat({"effects": scene.get("effects") or result.run.get("effects") or {},
                              "friction": scene.get("friction") or {}})),
        "components": [{"name": name, **about, "given": _given(about["parameters"])}
                       for name, about in components.items()],
        "connections": [" - ".join(one["ends"]) for one in scene.get("connections") or ()],
    }  # fmt: skip


def settings_rows(run: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Versions, settings and counters, nested ones under the words above them."""
    first = {"versions": run.get("versions") or {"fairlead": UNKNOWN}}
    rest = {key: value for key, value in run.items() if key not in APART and key not in first}
    return [(words, without_folders(_told(value), run)) for words, value in _flat(first | rest)]


def shared(scenes: Sequence[dict[str, Any]], labels: Sequence[str]) -> list[str]:
    """By run, the label of an earlier one whose files are the same, so that none is printed twice; else ""."""
    return [next((labels[j] for j in range(k) if scenes[j]["files"] and scenes[j]["files"] == one["files"]), "")
            for k, one in enumerate(scenes)]  # fmt: skip


def _given(parameters: Mapping[str, Any]) -> str:
    return ", ".join(f"{key}: {_told(value)}" for key, value in parameters.items())


def _flat(entries: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in entries.items():
        words = f"{above} {SAYS.get(str(key), str(key).replace('_', ' '))}".strip()
        if isinstance(value, Mapping):
            yield from _flat(value, words)
        elif value is not None and value != []:
            yield words, value


def _told(value: Any) -> str:
    text = _written(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def _written(value: Any) -> str:
    """A value as a netlist writes it: `{mass: 1.6 kg/m}`, `[1, 2]`."""
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{key}: {_written(one)}' for key, one in value.items())}}}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_written, value))}]"
    return f"{value:.6g}" if isinstance(value, float) else str(value)

"""Files as a page that goes to others names them: by their place beside the netlist, not on the author's machine."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def named(file: str, run: Mapping[str, Any]) -> str:
    """A file of a run by its path from the netlist's folder; by its name alone where it lies elsewhere."""
    path, folder = Path(file), Path(str(run.get("netlist") or "")).parent
    if not path.is_absolute():
        return file
    return str(path.relative_to(folder)) if path.is_relative_to(folder) else path.name


def without_folders(text: str, run: Mapping[str, Any]) -> str:
    """A sentence with the files of a run so named; whatever else lies in the netlist's folder as well."""
    netlist = str(run.get("netlist") or "")
    for file in sorted({netlist, *((run.get("scene") or {}).get("files") or ())}, key=len, reverse=True):
        if Path(file).is_absolute():
            text = text.replace(file, named(file, run))
    folder = Path(netlist).parent
    return text.replace(f"{folder}/", "") if folder.is_absolute() and folder != folder.parent else text

"""Runs of a study kept on disk by content, so that one that was interrupted goes on where it stopped.

A run is known by what it depends on: the bytes of the netlist and its overrides, the outputs asked for, the
libraries, the code of fairlead and of the components, and the machine, whose times they are. Changing any of these
makes a new entry; the folder is kept below a size by dropping what was not used longest.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.util
import io
import json
import os
import pathlib
import platform
from collections.abc import Iterable

import numpy as np

import fairlead.sealed as sealed
from fairlead.analysis.cost.timed_run import Timed
from fairlead.component.library_files import all_files

MOST_BYTES = 500_000_000
FORMAT = "fairlead-timed-2"
KIND = f"{FORMAT}\n".encode()


class KeptRuns:
    """A folder of runs by key. With `folder` None nothing is kept; a folder that cannot be used is as good as none."""

    def __init__(self, folder: pathlib.Path | None) -> None:
        self.folder = folder

    def get(self, key: str, cap: float) -> Timed | None:
        """The run under a key. One that was cut off counts only when it had at least `cap` seconds."""
        if self.folder is None:
            return None
        path = self.folder / f"{key}.npz"
        try:
            body = sealed.read(path, KIND)
            os.utime(path)
        except (OSError, sealed.BrokenSealError):
            return None
        with np.load(io.BytesIO(body), allow_pickle=False) as stored:
            meta, values = json.loads(str(stored["meta"])), stored["values"]
        events = tuple((float(t), *names) for t, *names in meta.pop("events"))
        timed = Timed(**meta, values=values, events=events)
        return timed if timed.finished or timed.cap >= cap or timed.status != "budget" else None

    def put(self, key: str, timed: Timed) -> None:
        """Keep a run; whole or not at all, so that Ctrl-C leaves no torn entry."""
        if self.folder is None:
            return
        body = io.BytesIO()
        meta = json.dumps({**timed.plain(), "events": timed.events})
        np.savez_compressed(body, meta=np.array(meta), values=timed.values)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            sealed.write(self.folder / f"{key}.npz", KIND, body.getvalue())
            self._drop_oldest()
        except OSError:
            return

    def _drop_oldest(self) -> None:
        assert self.folder is not None
        entries = sorted(((p.stat().st_mtime, p.stat().st_size, p) for p in self.folder.glob("*.npz")), reverse=True)
        total = 0
        for _, size, path in entries:
            total += size
            if total > MOST_BYTES:
                path.unlink(missing_ok=True)


def default_folder() -> pathlib.Path:
    """Where runs are kept for this user; FAIRLEAD_CACHE names another place, as for compiled code."""
    import platformdirs

    chosen = os.environ.get("FAIRLEAD_CACHE")
    return pathlib.Path(chosen) / "runs" if chosen else platformdirs.user_cache_path("fairlead") / "runs"


def key_of(digest: str, parts: Iterable[object], libraries: Iterable[str] = ()) -> str:
    """The name of a run: `digest` is that of its netlist, `parts` whatever else decides its result."""
    hash = hashlib.sha256(f"{FORMAT}\0{digest}\0{code_digest()}\0{platform.node()}\0".encode())
    for part in parts:
        hash.update(f"{part!r}\0".encode())
    for library in libraries:
        hash.update(b"\0".join(file.read_bytes() for file in all_files(library).values()))
    return hash.hexdigest()


def bytes_of(path: pathlib.Path) -> bytes:
    """The bytes of all Python files of a folder in the order of their paths."""
    return b"\0".join(file.read_bytes() for file in sorted(path.rglob("*.py")) if file.is_file())


@functools.cache
def code_digest() -> str:
    """A digest of fairlead and its bundled components."""
    hash = hashlib.sha256()
    for package in ("fairlead", "fairlead.components"):
        found = importlib.util.find_spec(package)
        for folder in (found and found.submodule_search_locations) or ():
            hash.update(bytes_of(pathlib.Path(folder)))
    return hash.hexdigest()

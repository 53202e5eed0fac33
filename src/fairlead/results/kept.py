"""Results that a run replaces, kept in the folder `earlier` until it has finished.

    set_aside(path)     all files of the run in `path` under a second name, in `earlier`, which comes by one rename
    earlier(path)       where they are
    drop(path)          away with them

The files of a run get a second name (a hard link; a copy where there are none) in a hidden folder, which is then
renamed to `earlier`. Nothing in `path` has changed until then, and from then on all of it is in `earlier`: a process
that is killed at any instant leaves the results in one place or in the other. Where the name is taken, by notes that
somebody put into it, the folder is `earlier-2` and so on; the highest number is the latest.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable
from pathlib import Path

import fairlead.results.run_file as run_file
from fairlead.results.events import EVENT_FILE
from fairlead.results.placing import is_part
from fairlead.results.store import SERIES_FILE, TEMPORARY

EARLIER, UNDER_WAY = "earlier", ".earlier.part"
REPORT_FILE, TABLE_FILE = "report.html", "series.csv"
FIGURE_MARK, TABLE_MARK = b"Software\0fairlead", b"time [s],side"


def set_aside(path: Path) -> None:
    """Keep the run in `path`; what was kept before goes."""
    part = path / UNDER_WAY
    remove_parts(path)
    part.mkdir()
    for file in files_of_run(path):
        _second_name(file, part / file.name)
    before = _folders(path)
    part.rename(path / _next_name(before))
    for folder in before:
        _drop(folder)


def earlier(path: Path) -> Path | None:
    """Where the results lie that a run in `path` was to replace, if it has not finished; a run directory itself."""
    return next((folder for folder in reversed(_folders(path)) if run_file.read(folder) is not None), None)


def drop(path: Path) -> None:
    """Remove the results that a run in `path` has replaced, now that it has finished."""
    for folder in _folders(path):
        _drop(folder)


def files_of_run(path: Path) -> list[Path]:
    """Files that a run writes, or what is made of its results, as far as there are any; files of others are not."""
    named = [path / name for name in (SERIES_FILE, EVENT_FILE, REPORT_FILE, run_file.RUN_FILE)]
    made = [*_marked(path.glob("*.png"), FIGURE_MARK), *_marked([path / TABLE_FILE], TABLE_MARK)]
    return [file for file in [*made, *named] if file.is_symlink() or file.is_file()]


def remove_parts(path: Path) -> None:
    """Remove what a killed process left half done."""
    for file in [path / TEMPORARY, *(file for file in path.iterdir() if is_part(file))]:
        if file.is_symlink() or not file.is_dir():
            file.unlink(missing_ok=True)
        elif file.name == UNDER_WAY:
            shutil.rmtree(file)


def _second_name(file: Path, kept: Path) -> None:
    """Give a file a second name; a link that lies there is kept as a link to the same."""
    try:
        if not file.is_symlink():
            os.link(file, kept)
        elif file.exists():
            kept.symlink_to(file.resolve())
    except (OSError, NotImplementedError):  # filesystems without links
        shutil.copy2(file, kept)


def _drop(folder: Path) -> None:
    """Remove the files of a kept run, run.json last: what a kill leaves of it goes the next time."""
    if run_file.read(folder) is not None:  # else they are not ours to remove
        for file in files_of_run(folder):
            file.unlink(missing_ok=True)
    if not any(folder.iterdir()):
        folder.rmdir()


def _folders(path: Path) -> list[Path]:
    """`earlier`, `earlier-2` and so on, as far as there are any."""
    try:
        found = [folder for folder in path.iterdir() if _number(folder) and folder.is_dir() and not folder.is_symlink()]
    except OSError:
        return []
    return sorted(found, key=_number)


def _number(folder: Path) -> int:
    parts = re.fullmatch(rf"{EARLIER}(?:-([1-9]\d{{0,8}}))?", folder.name)
    return int(parts[1] or 1) if parts else 0


def _next_name(folders: list[Path]) -> str:
    return f"{EARLIER}-{_number(folders[-1]) + 1}" if folders else EARLIER


def _marked(files: Iterable[Path], mark: bytes) -> list[Path]:
    """Those that fairlead has made; a picture or a table of somebody else stays."""
    return [file for file in files if mark in _beginning(file)]


def _beginning(file: Path) -> bytes:
    try:
        with file.open("rb") as stream:
            return stream.read(1024)
    except OSError:
        return b""

"""A job as it travels to another machine: the model with the text of its libraries and of the tables it names."""

from __future__ import annotations

import copy
import importlib.metadata
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from fairlead.cases.cases import Cases
from fairlead.cases.identity import named_files
from fairlead.component.library_files import all_files
from fairlead.errors import UsageError
from fairlead.model import Model
from fairlead.studies.sweeps.job import Job

Files = Mapping[str, bytes]


def _version() -> str:
    return importlib.metadata.version("fairlead")


@dataclass(frozen=True)
class Parcel:
    """A job; files by their paths below the folder that they come to."""

    job: Job
    libraries: tuple[tuple[str, Files], ...] = ()
    """Name of each library, and its files."""
    tables: Files | None = None
    version: str = ""

    @classmethod
    def of(cls, job: Job) -> Parcel:
        """Pack a job; one that has no model has no files."""
        if not isinstance(job, Cases):
            return cls(job, version=_version())
        folder = job.model.sources.folder
        tables = {file.relative_to(folder).as_posix(): file.read_bytes() for file in named_files(job.model)}
        return cls(job, tuple(map(_library, job.model.libraries)), tables, _version())

    def unpack(self) -> Job:
        """The job on this machine, its files in a new folder. Raises UsageError for another version of fairlead."""
        if self.version != _version():
            raise UsageError(f"This machine has fairlead {_version()}, the sweep comes from {self.version}.")
        if not isinstance(self.job, Cases):
            return self.job
        folder = Path(tempfile.mkdtemp(prefix="fairlead-"))
        libraries = []
        for number, (name, files) in enumerate(self.libraries):
            place = folder / f"library_{number}" / name
            _write(place.parent if "" in files else place, {k or name: v for k, v in files.items()})
            libraries.append(str(place))
        scene = folder / "scene"
        _write(scene, self.tables or {})
        old = self.job.model
        sources = replace(old.sources, top=scene / old.sources.top.name)
        made = copy.copy(self.job)
        made.model = Model(sources, old.overrides, tuple(libraries), allow_fmu=old.allow_fmu)
        return made


def _library(path: str) -> tuple[str, Files]:
    """A file under the name "" and the neighbours that it imports, or the Python files of a folder by their paths."""
    file = Path(path)
    if not file.is_dir():
        folder = file.resolve().parent
        beside = [one for one in all_files(path).values() if one != file.resolve() and one.is_relative_to(folder)]
        neighbours = {one.relative_to(folder).as_posix(): one.read_bytes() for one in beside}
        return file.name, {"": file.read_bytes(), **neighbours}
    return file.name, {one.relative_to(file).as_posix(): one.read_bytes() for one in sorted(file.rglob("*.py"))}


def _write(folder: Path, files: Files) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)

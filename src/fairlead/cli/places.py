"""Where verbs write what they make: a place that cannot be one is refused before any work, a full disk is a sentence.

refuse_place("--csv", path)                  a file is to be written there
refuse_place("--out", path, folder=True)     files are to be written into this folder
place(path, text)                            the file, with the folders that lead to it
"""

import contextlib
import pathlib
from collections.abc import Collection, Iterator

from fairlead.errors import FairleadError, UsageError, listing, printable


def refuse_place(
    option: str, path: pathlib.Path | None, *, folder: bool = False, endings: Collection[str] = ()
) -> None:
    """Raise UsageError for a path of the other kind, one below a file, or a file of another format; None is no path.

    `endings` are those of the formats that can be written; without any, every format is.
    """
    if path is None:
        return
    for above in path.parents:
        if above.exists() and not above.is_dir():
            way = printable(str(above))
            raise UsageError(f"{option} {printable(str(path))}: {way} is a file, not a folder.{_OTHER}")
    if path.is_symlink() and not path.exists():
        to = printable(str(path.readlink()))
        raise UsageError(f"{option} {printable(str(path))} is a link to {to}, where nothing is.{_OTHER}")
    if folder and path.exists() and not path.is_dir():
        raise UsageError(f"{option} {printable(str(path))} is a file, and a folder is wanted.{_OTHER}")
    if folder and path.suffix.lower() in OF_FILES and not path.exists():
        what = f"{option} {printable(str(path))} is the name of a file, and a folder is wanted."
        raise UsageError(f"{what}\n    Name a folder, in which files have names of their own.")
    if not folder and path.is_dir():
        inside = printable(str(path / "NAME"))
        what = f"{option} {printable(str(path))} is a folder, and a file is wanted."
        raise UsageError(f"{what}\n    Name a file: {inside}.")
    if endings and path.suffix.lower() not in endings:
        formats = listing(list(endings))
        raise UsageError(f"{option} {printable(str(path))}: the format is not known.\n    Formats are {formats}.")


OF_FILES = (".png", ".svg", ".pdf", ".html", ".csv", ".json", ".xlsx", ".nc", ".yaml", ".yml")
"""Endings that nobody gives a folder."""
FIGURES = (".png", ".svg", ".pdf")
_OTHER = "\n    Choose another place."


def place(path: pathlib.Path, text: str) -> None:
    """Write a text into a file. Raises FairleadError where the disk refuses."""
    with written_to(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


@contextlib.contextmanager
def written_to(path: pathlib.Path) -> Iterator[None]:
    """Tell what the operating system refuses in a sentence. Raises FairleadError."""
    try:
        yield
    except OSError as error:
        raise FairleadError(told_of_disk(path, error)) from error


def told_of_disk(path: pathlib.Path, error: OSError) -> str:
    """Why a file is not written, or not read."""
    return f"{printable(str(path))} cannot be used: {error.strerror or error}.{_OTHER}"

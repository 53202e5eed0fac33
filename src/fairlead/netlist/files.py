"""Files of a netlist: found by path or bundled name, inside the scene's folder, bounded, text."""

from __future__ import annotations

import importlib.util
import os
import re
from pathlib import Path

from yaml.reader import Reader

from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.netlist.limits import MOST_BYTES

MOST_NAMES = 200  # of a folder, looked at for a suggestion
SMALL = ("single_parts", "sized", "hard")
"""Folders of netlists that come with fairlead besides the bundled models; each is named with its folder."""
# What YAML (section 5.1) does not allow in a text; a file with one of these is binary or damaged. To make the pattern
# once more would take 3 ms.
UNPRINTABLE = Reader.NON_PRINTABLE


def find(path: str | os.PathLike[str]) -> Path:
    """The file a path or the name of a bundled model means; raises ModelError when there is none."""
    asked = os.fspath(path)
    where = Location(shown(asked))
    if UNPRINTABLE.search(asked):
        raise ModelError([Fault(where, "this is not the name of a file in UTF-8", "Give the file a plain name.")])
    if _is(asked, Path.is_file):
        return Path(asked)
    bundled = bundled_models()
    if (name := asked.removesuffix(".yaml")) in (known := bundled | named_by_folder()):
        return _unless_ambiguous(known[name], Path(f"{name}.yaml"), where)
    if _is(asked, Path.is_dir):
        way_out = _neighbours(Path(asked), "netlist")
        if _is(f"{asked}/run.json", Path.is_file):
            way_out = "It holds the results of a run: give the netlist that was run."
        raise ModelError([Fault(where, "this is a folder, not a netlist", way_out)])
    if _is(asked, Path.exists):
        raise ModelError([Fault(where, "this is not a regular file")])
    if to := leads_nowhere(Path(asked)):
        raise ModelError([Fault(where, *to)])
    stem = Path(asked).stem
    elsewhere = next((f"Did you mean {one}?" for one in known if one.rpartition("/")[2] == stem), "")
    near = elsewhere or did_you_mean(name, known) or did_you_mean(stem, bundled)
    local = _nearest(Path(), asked) if _is_path(asked) else ""
    if not local and not near and _is_path(asked):
        local = _neighbours(Path(asked).parent, Path(asked).name)
    models = f"Bundled models are {listing(sorted(bundled))}." if bundled else ""
    raise ModelError(
        [Fault(where, "there is no such file or bundled model", f"{local or near} {models}".strip())]
    )


def leads_nowhere(path: Path) -> tuple[str, str] | None:
    """What is wrong with a link that is there and leads to no file, and the way out; None for what is no such link."""
    if not _is(str(path), Path.is_symlink) or _is(str(path), Path.exists):
        return None
    to = shown(str(path.readlink()))
    return f"this is a link to {to}, where no file is", "Put the file there, or name another one."


def _unless_ambiguous(bundled: Path, local: Path, where: Location) -> Path:
    """The bundled model, unless a file of that name in the working folder may be the one that is meant."""
    if local.is_file() and not local.samefile(bundled):
        advice = f"Write ./{local} for the file, or work in another folder for the bundled model."
        raise ModelError([Fault(where, f"this is a bundled model, and {local} is a file here", advice)])
    return bundled


def bundled_models() -> dict[str, Path]:
    """The netlists that come with fairlead, by name; whole machines by `machines/NAME`."""
    folders = _folders()
    files = [file for folder in folders for file in sorted(folder.glob("*.yaml"))]
    machines = [file for folder in folders for file in sorted(folder.glob("machines/*.yaml"))]
    return {file.stem: file for file in files} | {f"machines/{file.stem}": file for file in machines}


def named_by_folder() -> dict[str, Path]:
    """The small netlists that come with fairlead, by `single_parts/NAME` and the like."""
    files = [(of, file) for folder in _folders() for of in SMALL for file in sorted(folder.glob(f"{of}/*.yaml"))]
    return {f"{of}/{file.stem}": file for of, file in files}


def _folders() -> list[Path]:
    spec = importlib.util.find_spec("fairlead.models")
    return [Path(folder) for folder in (spec.submodule_search_locations if spec else None) or ()]


def inside(folder: Path, base: Path, text: str, where: Location | None) -> Path:
    """The file that `text`, relative to the folder `base`, means, which must lie in `folder` or below.

    Links are followed first, so that none leads out. Raises ModelError when the path is absolute, leads out,
    or is not a file. Tables and CSV files of a scene go through here as well as includes.
    """
    if Path(text).is_absolute() or re.match(r"[A-Za-z]:|[\\/~]", text):
        advice = "Paths are relative to the file that names them, inside the folder of the netlist."
        raise ModelError([Fault(where, f"{shown(text)} is not a relative path", advice)])
    try:
        file = (base / text).resolve()
        outside = not file.is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # a loop of links, a name too long, a zero byte
        raise ModelError([Fault(where, f"{shown(text)} is not a usable path")]) from None
    if outside:
        advice = f"Files of a netlist lie in its folder or below, links followed: {display(folder)}."
        raise ModelError([Fault(where, f"{shown(text)} leads out of the folder of the netlist", advice)])
    if not _is(str(file), Path.is_file):
        if to := leads_nowhere(base / text):
            raise ModelError([Fault(where, f"{shown(text)}: {to[0]}", to[1])])
        if _is(str(file), Path.exists):
            raise ModelError([Fault(where, f"{shown(text)} is not a regular file")])
        advice = _nearest(base, text) or _neighbours(file.parent, file.name)
        raise ModelError([Fault(where, f"{shown(text)}: there is no such file", advice)])
    return file


def read_text(file: Path, where: Location | None = None) -> tuple[str, bytes]:
    """The text of a file and its bytes; raises ModelError when it is too large, unreadable or binary."""
    place = Location(display(file))
    try:
        with file.open("rb") as stream:
            data = stream.read(MOST_BYTES + 1)
            size = os.fstat(stream.fileno()).st_size
    except OSError as error:
        raise ModelError([Fault(where or place, f"cannot read {display(file)}: {error.strerror}")]) from None
    return text_of(data, place, size), data


def text_of(data: bytes, place: Location, size: int = 0) -> str:
    """The text of the bytes of a file; raises ModelError when they are too many or binary.

    `size` is that of the file, where its bytes were not all read [bytes].
    """
    if len(data) > MOST_BYTES:
        megabytes = max(size, len(data)) / 1e6
        what = f"this file has {megabytes:.1f} MB; a netlist has at most {MOST_BYTES / 1e6:g} MB"
        raise ModelError([Fault(place, what, "Put data into a CSV table.")])
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8-sig")
        what = f"not a text in UTF-8: byte 0x{data[error.start]:02x}"
        raise ModelError([Fault(_at_end(place.file, before), what, _encoding(data))]) from None
    if found := UNPRINTABLE.search(text):
        what = f"not a text file: it holds the control character U+{ord(found[0]):04X}"
        raise ModelError([Fault(_at_end(place.file, text[: found.start()]), what, "A netlist is a YAML file.")])
    return text


def _at_end(file: str, before: str) -> Location:
    """The place that follows a text."""
    return Location(file, before.count("\n") + 1, len(before) - before.rfind("\n"))


def _encoding(data: bytes) -> str:
    """What to do about a file in another encoding."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "It is in UTF-16; save it in UTF-8."
    return "A netlist is a YAML file; save it in UTF-8."


def display(file: Path) -> str:
    """The file as messages name it: relative to the working folder when it lies below it."""
    try:
        return str(Path(os.path.abspath(file)).relative_to(Path.cwd()))  # noqa: PTH100 - keeps links as typed
    except (OSError, ValueError):
        return str(file)


def _is_path(asked: str) -> bool:
    """Whether a text is meant as a path, not as the name of a bundled model."""
    return os.sep in asked or "." in asked


def _nearest(base: Path, asked: str) -> str:
    """The sentence "Did you mean models/belt.yaml?" for a path of which folders or the file are misspelt."""
    at = Path(Path(asked).anchor)
    for word in Path(asked).parts[len(at.parts) :]:
        if not _is(str(base / at / word), Path.exists):
            try:
                names = sorted(each.name for each in (base / at).iterdir())[:MOST_NAMES]
            except (OSError, ValueError):
                return ""
            word = _alike(word, names)
        if not word:
            return ""
        at = at / word
    return f"Did you mean {at}?" if _is(str(base / at), Path.is_file) else ""


def _neighbours(folder: Path, name: str) -> str:
    try:
        names = sorted(file.name for file in folder.glob("*.yaml"))[:MOST_NAMES]
    except (OSError, ValueError):
        return ""
    near = _alike(name, names)
    return f"Did you mean {near}?" if near else f"There are {listing(names)}." if names else ""


def _alike(name: str, names: list[str]) -> str:
    """The name that was meant, "" for none; of two files with an ending the ending makes none alike."""
    if not (ending := Path(name).suffix):
        return _meant(did_you_mean(name, names))
    near = {Path(one).stem: one for one in names if Path(one).suffix[:2] == ending[:2]}
    found = near.get(_meant(did_you_mean(Path(name).stem, near)), "")
    return found or _meant(did_you_mean(name, [one for one in near.values() if one[:1] == name[:1]]))


def _meant(sentence: str) -> str:
    return sentence.removeprefix("Did you mean ").removesuffix("?")


def _is(text: str, test: object) -> bool:
    try:
        return bool(test(Path(text)))  # type: ignore[operator]
    except (OSError, ValueError):
        return False

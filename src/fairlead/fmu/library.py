"""`export_library`: a model as a shared library with a C header, for a program that links it.

The calls are those of `Model.start` in C: `c/library.h` is the header's form, `c/library.c` what is behind it.
"""

from __future__ import annotations

import hashlib
import importlib.resources
import os
import pathlib
import re
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Unpack

from fairlead.arguments import Arguments
from fairlead.errors import RunWarning, UsageError
from fairlead.fmu.archive import write
from fairlead.fmu.compiler import compiles, linked
from fairlead.fmu.description import identifier
from fairlead.fmu.made import asked_of, made_of, own_version, sources
from fairlead.fmu.platforms import platforms_of
from fairlead.fmu.tuned import AFTER, ALWAYS, BEFORE, Tuned
from fairlead.outer import Variable

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.netlist.keywords import RunKeywords

EXAMPLE_STEPS = 20
MARK = "/* Written by fairlead, which leaves this file alone once it has been edited. Digest: "
WHEN = {ALWAYS: "", BEFORE: ", before the start only", AFTER: ", after the start only"}
_WORDS = (
    "alignas alignof and asm auto bitand bitor bool break case catch char class compl concept const constexpr continue "
    "default delete do double else enum explicit export extern false float for friend goto if inline int long main "
    "mutable namespace new noexcept not nullptr operator or private protected public register requires restrict return "
    "short signed sizeof static struct switch template this thread_local throw true try typedef typeid typename union "
    "unsigned using virtual void volatile wchar_t while xor"
)
RESERVED = frozenset(_WORDS.split())
"""Words of C and C++, which no type can be called."""


def export_library(
    model: Model, folder: str | os.PathLike[str] | None = None, *, inputs: Iterable[str] = (),
    outputs: Iterable[str] = (), tunable: Iterable[str] = (), platforms: Iterable[str] = (),
    **settings: Unpack[RunKeywords],
) -> pathlib.Path:  # fmt: skip
    """Write NAME.h, libNAME.so and example.c into a folder, and return the folder.

    NAME is that of the model, as far as it is a name in C. Inputs, outputs, tunable parameters and settings are those
    of `fairlead.fmu.export`; without `folder` it is NAME in this folder. If `platforms` are named, the library for each
    is in a folder of that name inside: for Windows NAME.dll, beside NAME.lib for linking; for macOS libNAME.dylib. A
    library of the same model has the same bytes.

    An example.c that was edited stays, with a RunWarning. Raises ModelError as `Model.start` does, and UsageError for
    what cannot go along, without a C compiler, and where a file cannot be written.
    """
    given = Arguments("export_library")
    given.model(model)
    given.path("folder", folder, none="None for the name of the model")
    given.texts("inputs", inputs, '"valve.command"')
    given.texts("outputs", outputs, '"spring.force"')
    given.texts("tunable", tunable, '"pad.normal_force"')
    given.texts("platforms", platforms, '"aarch64-linux"')
    given.refuse()
    named = [one.name for one in platforms_of(platforms)] if platforms else []
    asked = asked_of(model, inputs, outputs, tunable, settings, "export_library", named)
    made = made_of(asked)
    name = prefix(model.netlist.name)
    target = pathlib.Path(name if folder is None else folder)
    if target.is_file():
        raise UsageError(f"{target} is a file, and a library is a folder.\n    Name another folder with -o.")
    libraries: dict[str, bytes] = {}
    for one in asked.platforms:
        found = linked(sources(made, name, ("library.c",), one), name, one)
        libraries |= {f"{one.name}/{file}" if named else file: content for file, content in found.items()}
    texts = {
        f"{name}.h": header_text(name, model.netlist.name, made.variables, made.tuned),
        "example.c": _example(name, model.netlist.name, asked.settings.start, asked.settings.stop, *named[:1]),
    }
    if _is_edited(target / "example.c", texts["example.c"]):
        told = f"{target / 'example.c'} is not as it was written, and stays. Remove it to have it written anew."
        warnings.warn(told, RunWarning, stacklevel=2)
        del texts["example.c"]
    for file, content in {**libraries, **{file: text.encode() for file, text in texts.items()}}.items():
        write(target / file, content)
    return target


def _is_edited(path: pathlib.Path, new: str) -> bool:
    """Whether an example is there that somebody made his own: its text is not that which its last line tells of."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return path.exists()
    body, _, _ = text.rpartition(MARK)
    return text != new and text != _marked(body)


def _marked(body: str) -> str:
    """A text with a last line that tells whether it has been changed since."""
    return f"{body}{MARK}{hashlib.blake2b(body.encode(), digest_size=8).hexdigest()} */\n"


def prefix(name: str) -> str:
    """What functions of a library begin with: the name of the model, where C has no other use for it.

    A word of C, a name of its library or a macro of the compiler (`run`, `printf`, `linux`) is none that a program can
    use beside them, and `c` and `m` are libraries.
    """
    found = identifier(name)
    if found in RESERVED or found in ("c", "m", "run"):
        return f"model_{found}"
    trial = {f"{found}.h": header_text(found, "", ()).encode(), "example.c": _example(found, "", 0.0, 1.0).encode()}
    return found if compiles(trial, "example.c") else f"model_{found}"


def header_text(name: str, title: str, variables: Sequence[Variable], tuned: Sequence[Tuned] = ()) -> str:
    """The header of a library."""
    ranges = {one.name: one for one in tuned}
    return _filled("library.h", {"NAME": name, "MODEL": _comment(title), "VERSION": own_version(),
                                 "VARIABLES": "\n\n".join(_numbers(name, variables, ranges))})  # fmt: skip


def _numbers(name: str, variables: Sequence[Variable], tuned: Mapping[str, Tuned]) -> Iterator[str]:
    """Enumerations with the numbers of inputs, outputs and parameters."""
    for causality, what in (("input", "INPUTS"), ("output", "OUTPUTS"), ("parameter", "PARAMETERS")):
        those = [one for one in variables if one.causality == causality]
        entries = [f"{name}_{causality.upper()}_{safe}" for safe in _distinct([one.name for one in those])]
        lines = [
            f"    {entry}, /* {_told(one, tuned.get(one.name))} */" for entry, one in zip(entries, those, strict=True)
        ]
        yield "\n".join([f"/* {what.capitalize()}. */", "enum {", *lines, f"    {name}_{what} /* how many */", "};"])


def _told(one: Variable, own: Tuned | None) -> str:
    """A variable in a comment: its name, unit, start, range and description."""
    unit = "" if one.unit == "1" else f" [{one.unit}]"
    start = "" if one.start is None else f"; {one.start:.9g} until it is set"
    if own is not None:
        start += f", from {own.low:.9g} to {own.high:.9g}{WHEN[own.when]}"
    said = f": {one.description}" if one.description else ""
    return _comment(f"{one.name}{unit}{start}{said}")


def _distinct(names: Sequence[str]) -> list[str]:
    """Names as parts of names in C, each another one."""
    found: list[str] = []
    for name in names:
        safe = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
        while safe in found:
            safe += "_"
        found.append(safe)
    return found


def _example(name: str, title: str, start: float, stop: float, folder: str = ".") -> str:
    span = stop - start
    return _marked(_filled("example.c", {
        "NAME": name, "MODEL": _comment(title), "FOLDER": folder, "STOP": f"{span:.9g}", "STEPS": str(EXAMPLE_STEPS),
        "PERIOD * k": f"{start!r} + {span / EXAMPLE_STEPS!r} * k", "PERIOD": f"{span / EXAMPLE_STEPS:.9g}",
    }))  # fmt: skip


def _filled(file: str, words: dict[str, str]) -> str:
    """A form of the folder `c`, its words in capitals replaced all at once."""
    form = (importlib.resources.files("fairlead.fmu") / "c" / file).read_text(encoding="utf-8")
    either = "|".join(map(re.escape, words))
    return re.sub(rf"(?<![A-Z])(?:{either})(?![A-Z])", lambda found: words[found[0]], form)


def _comment(text: str) -> str:
    """A text in one line that ends no comment of C."""
    return " ".join(text.split()).replace("*/", "* /").replace("/*", "/ *").replace("??/", "? ?/").rstrip("\\")

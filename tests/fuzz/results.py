"""Damaged folders of results: whatever is in them, `margins` and `Result` answer in words and read what can be read.

A folder is written once and damaged in a copy, at one place or a few: bytes of a file, entries of run.json, lines of
events.csv, variables of series.nc. Each case is judged in a process of its own where there is `fork`, so that one that
HDF5 does not survive is a finding and not the end.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import pathlib
import random
import shutil
import signal
from collections.abc import Callable, Iterator
from typing import Any

import h5py
import numpy as np
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.errors import FairleadError
from fairlead.results import Result, RunDirectory, Signal, placing

LONGEST, ASLEEP = 60, 600  # s for one case, of the processor and in all
CODES = (0, 1, 2, 5)
Dice = random.Random
LAYER = ("hose", "core")
STATIONS = [
    {"name": "winch", "type": "Winch", "begin": None, "end": 0.5, "curvature": 0.0, "contact": None, "moves": False},
    {"name": "bend", "type": "Bend", "begin": 0.5, "end": 1.5, "curvature": 0.5, "contact": "outer", "moves": False},
    {"name": "belts", "type": "Deployer", "begin": 1.5, "end": 4.0, "curvature": 0.0, "contact": "outer_belts",
     "moves": True},
]  # fmt: skip
ROUTE = {"line": "line", "route": "route", "layers": list(LAYER), "outer": "hose_node", "nodes": 4, "ruck_force": 50.0,
         "side_wall": 100.0, "rigid_from": None, "stations": STATIONS}  # fmt: skip
LIMITS = [
    {"signal": "line.core[*].tension", "sense": 1.0, "bound": 8e3, "unit": "N", "text": "below 8 kN"},
    {"signal": "line.hose[*].tension", "sense": -1.0, "bound": -1.0, "unit": "N", "text": "above -1 N",
     "nearest": ["line.hose[0].tension", 1.0, 0.5]},
]  # fmt: skip


def template(path: pathlib.Path) -> None:
    """A finished run of a line of three elements on a route, with limits, events and a table."""
    names = [f"line.{layer}[{k}].tension" for layer in LAYER for k in range(3)]
    names += [f"line.hose_node[{k}].x" for k in range(4)] + [f"line.outer[{k}].slip" for k in range(4)]
    names += [f"line.outer_belts[{k}].slip" for k in range(2, 4)]
    run = RunDirectory.create(path, [Signal(name, "N", "sound") for name in names], {
        "name": "sound", "routes": [ROUTE], "limits": LIMITS, "counters": {"steps": 3}, "record_every": 0.1,
    })  # fmt: skip
    t = np.linspace(0.0, 1.0, 11)
    run.append(t, 1.0 + np.sin(t)[:, None] + 0.1 * np.arange(len(names)), np.zeros(11))
    for k in range(5):
        run.event(0.1 * k, f"pad{k}", "stuck", "forward", "slides")
    run.finish("finished", {"end_time": 1.0, "sentence": "all went well"})
    placing.place(path / "series.csv", "time [s],side\n0.0,0\n")


def as_of_a_killed_run(path: pathlib.Path) -> None:
    """Take what run.json says of the other files away, as a run that was killed never says it."""
    record = json.loads((path / "run.json").read_text())
    del record["files"]
    (path / "run.json").write_text(json.dumps(record))


def play(folder: pathlib.Path, seed: int, count: int) -> Iterator[str]:
    """Damage `count` copies of a folder of results and yield what was answered badly."""
    sound = folder / "sound"
    template(sound)
    yield from complaints(shutil.copytree(sound, folder / "first"))  # and all is imported before there are copies
    for case in range(count):
        dice = Dice(f"{seed} {case}")
        path = folder / f"run{case}"
        shutil.copytree(sound, path)
        for complaint in apart(lambda dice=dice, path=path: damaged(dice, path)):
            yield f"case {case} of seed {seed}: {complaint}"
        shutil.rmtree(path)


def damaged(dice: Dice, path: pathlib.Path) -> list[str]:
    """Damage a folder and say what was answered badly."""
    chosen = dice.choices(list(DAMAGES), k=dice.choice([1, 1, 1, 2, 4]))
    chosen.sort(key=lambda name: DAMAGES[name] not in BY_HDF5)  # which must find a file that it can open
    if all(DAMAGES[name] in WELL_FORMED for name in chosen):
        as_of_a_killed_run(path)
    for name in chosen:
        with contextlib.suppress(Exception):
            DAMAGES[name](dice, path)  # a second damage may find nothing left to damage
    return [f"{', '.join(chosen)}: {complaint}" for complaint in complaints(path)]


def complaints(path: pathlib.Path) -> list[str]:
    """What is wrong with the answers to a folder of results."""
    return [*_of_margins(path), *_of_report(path), *_of_result(path), *_of_a_new_run(path)]


def _of_margins(path: pathlib.Path) -> Iterator[str]:
    for form in ([], ["--json"]):
        answer = CliRunner().invoke(app, ["margins", str(path), *form])
        if answer.exit_code not in CODES:
            last = answer.output.strip().splitlines()
            yield f"margins ended with {answer.exit_code}: {' '.join(last[2:4])} {answer.exception!r}"
        if set(answer.output) & set(map(chr, [*range(9), *range(11, 32), 127, *range(128, 160)])):
            yield f"margins printed control characters: {answer.output[:300]!r}"
        told = path.name in answer.output and "\n    " in answer.output
        if answer.exit_code in (1, 2) and not form and not told:
            yield f"margins named no file or no way out: {answer.output!r}"
        if answer.exit_code == 0 and "nan" in answer.output.lower():
            yield f"margins made something of what is no number: {answer.output!r}"


def _of_report(path: pathlib.Path) -> Iterator[str]:
    """The page reads nearly all that run.json holds."""
    answer = CliRunner().invoke(app, ["report", str(path), "--out", str(path.with_suffix(".html"))])
    path.with_suffix(".html").unlink(missing_ok=True)
    if answer.exit_code not in CODES:
        yield f"report ended with {answer.exit_code}: {answer.exception!r}"
    if answer.exit_code in (1, 2) and path.name not in answer.output:
        yield f"report named no file: {answer.output!r}"


def _of_result(path: pathlib.Path) -> Iterator[str]:
    """Everything that can be asked of a result: an answer, or a FairleadError."""
    try:
        result = Result.open(path)
    except FairleadError:
        return
    except BaseException as error:  # noqa: BLE001 - whatever else is raised is a finding
        yield f"Result.open raised {type(error).__name__}: {error}"
        return
    names = [signal.name for signal in result.signals]
    asked: list[Callable[[], object]] = [lambda: result.t, lambda: result.side, lambda: result.events,
                                         lambda: repr(result), result._repr_html_, result.to_pandas]  # fmt: skip
    for ask in [*asked, *(lambda name=name: result[name] for name in names)]:
        try:
            ask()
        except FairleadError:
            continue
        except BaseException as error:  # noqa: BLE001
            yield f"Result raised {type(error).__name__}: {error}"


def _of_a_new_run(path: pathlib.Path) -> Iterator[str]:
    """A new run takes the folder with `force`, or refuses in words; without, it never loses rows that can be read."""
    before = sorted(file.name for file in path.iterdir())
    for force in (False, True):
        try:
            RunDirectory.create(path, [Signal("a", "N")], {"name": "new"}, force=force).finish("finished", {})
        except FairleadError:
            continue
        except BaseException as error:  # noqa: BLE001
            yield f"a new run (force={force}) raised {type(error).__name__}: {error}"
            continue
        if contents_lost(path, before):
            yield f"a new run lost {contents_lost(path, before)}"
        with contextlib.suppress(FairleadError):
            Result.open(path)


def contents_lost(path: pathlib.Path, before: list[str]) -> list[str]:
    """Names that are neither in the folder nor kept below it, and are none that a run replaces."""
    ours = {"series.csv", ".writing"}
    there = {file.name for file in path.rglob("*")}
    return [name for name in before if name not in there | ours]


def apart(action: Callable[[], list[str]]) -> list[str]:
    """What `action` returns, from a process of its own where there is `fork`; its death is a complaint."""
    if not hasattr(os, "fork"):
        return action()
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        for number in (signal.SIGALRM, signal.SIGPROF):
            signal.signal(number, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, LONGEST)
        signal.alarm(ASLEEP)
        found = ["nothing was told"]
        try:
            found = action()
        finally:
            os.write(write, json.dumps(found)[:60_000].encode())
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        told = pipe.read()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return json.loads(told) if code == 0 and told else [f"the process ended with {code}"]


def _some_file(dice: Dice, path: pathlib.Path) -> pathlib.Path:
    return path / dice.choice(["run.json", "events.csv", "series.nc"])


def _flip(dice: Dice, path: pathlib.Path) -> None:
    file = _some_file(dice, path)
    data = bytearray(file.read_bytes())
    for _ in range(dice.choice([1, 1, 2, 10, 100])):
        data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
    file.write_bytes(bytes(data))


def _head_of_series(dice: Dice, path: pathlib.Path) -> None:
    """Bytes of the structure of HDF5, which lies before and between the values."""
    file = path / "series.nc"
    data = bytearray(file.read_bytes())
    for _ in range(dice.choice([1, 2, 5])):
        data[dice.randrange(min(len(data), 4096))] = dice.choice([0, 1, 127, 128, 255, dice.randrange(256)])
    file.write_bytes(bytes(data))


def _cut(dice: Dice, path: pathlib.Path) -> None:
    file = _some_file(dice, path)
    file.write_bytes(file.read_bytes()[: dice.choice([0, 1, 100, dice.randrange(file.stat().st_size)])])


def _overwrite(dice: Dice, path: pathlib.Path) -> None:
    file = _some_file(dice, path)
    data = file.read_bytes()
    first = dice.randrange(len(data))
    piece = dice.choice([bytes(64), b"\xff" * 64, dice.randbytes(64), b"\x1b[31m\x07", b"\r\n" * 8, b"\xef\xbb\xbf"])
    file.write_bytes(data[:first] + piece + data[first + dice.choice([0, len(piece)]) :])


def _exchange(dice: Dice, path: pathlib.Path) -> None:
    one, two = dice.sample(["run.json", "events.csv", "series.nc", "series.csv"], 2)
    (path / one).write_bytes((path / two).read_bytes())


def _no_file(dice: Dice, path: pathlib.Path) -> None:
    file = _some_file(dice, path)
    file.unlink()
    kind = dice.randrange(4)
    if kind == 0:
        file.mkdir()
    elif kind == 1:
        file.symlink_to(file.name)
    elif kind == 2:
        file.symlink_to(os.devnull)


STRANGE: list[Any] = [
    None, True, -1, 0, 10**9, 10**30, 1e308, math.nan, math.inf, "", "x", "\x1b]0;title\x07\x1b[31mred", "\ud800",
    "a" * 5000, [], {}, [None], [[]], {"a": 1}, "running", "claimed", "line", ["hose"] * 1000, -0.5, "\n\r", "‮",
]  # fmt: skip


def _entry(dice: Dice, path: pathlib.Path) -> None:
    """Another value for an entry of run.json, or none."""
    file = path / "run.json"
    record = json.loads(file.read_text())
    held: Any = record
    while True:
        key = dice.choice(list(held) if isinstance(held, dict) else range(len(held)))
        if not isinstance(held[key], dict | list) or not held[key] or dice.random() < 0.15:
            break
        held = held[key]
    if dice.random() < 0.2:
        del held[key]
    else:
        held[key] = dice.choice(STRANGE)
    file.write_text(json.dumps(record), encoding="utf-8")


def _deep(dice: Dice, path: pathlib.Path) -> None:
    text = (path / "run.json").read_text()
    deep = dice.choice(["[" * 100_000, '{"a":' * 50_000, "[" * 500 + "]" * 500, "9" * 5000])
    (path / "run.json").write_text(text.replace('"sound"', deep, 1))


def _line(dice: Dice, path: pathlib.Path) -> None:
    """Another line of events.csv."""
    lines = (path / "events.csv").read_text().splitlines()
    strange = ["", ",", "x,pad,stuck,forward,slides", "nan,a,b,c,d", "1e999,a,b,c,d", "0.1,a,b", "0.1,a,b,c,d,e", '"',
               '0.1,"a', "0,1,a,b,c,d", "\0", "0.1," + "a" * 200_000 + ",b,c,d", "0.1;a;b;c;d"]  # fmt: skip
    lines[dice.randrange(len(lines))] = dice.choice(strange)
    (path / "events.csv").write_text("\n".join(lines) + "\n")


def _variable(dice: Dice, path: pathlib.Path) -> None:
    """Another variable of series.nc."""
    with h5py.File(path / "series.nc", "r+") as file:
        name = dice.choice([*list(file), "time", "side"])
        kept = dict(file[name].attrs)
        kind = dice.randrange(9)
        if kind == 0:
            file[name].resize(dice.choice([0, 3, 12, 1000, 10**6]), axis=0)
        elif kind == 1:
            file[name][dice.randrange(11)] = dice.choice([math.nan, math.inf, -1e300, -1.0])
        else:
            del file[name]
        if kind == 2:
            file.create_group(name)
        elif kind == 3:
            file[name] = "text"
        elif kind == 4:
            file[name] = np.ones((11, 2))
        elif kind == 5:
            file.create_dataset(name, (2**45,), "f8", chunks=(2**20,))
        elif kind == 6:
            file[name] = h5py.ExternalLink(os.devnull, "/a")
        elif kind == 7:
            file[name] = h5py.SoftLink(f"/{name}")
        if kind in (3, 4, 5):
            for key, value in kept.items():
                if key in ("units", "long_name", "signal", "position"):
                    file[name].attrs[key] = value


def _attribute(dice: Dice, path: pathlib.Path) -> None:
    with h5py.File(path / "series.nc", "r+") as file:
        held = file if dice.random() < 0.3 else file[dice.choice(list(file))]
        key = dice.choice(list(held.attrs))
        del held.attrs[key]
        if dice.random() < 0.7:
            held.attrs[key] = dice.choice([0, -1, 3.5, "x", "matrix", "\x1b[31m", [1, 2], b"\xff\xfe", 10**12])


def _foreign(dice: Dice, path: pathlib.Path) -> None:
    """A file of HDF5 that is not ours."""
    with h5py.File(path / "series.nc", "w") as file:
        if dice.random() < 0.7:
            file["time"] = np.arange(3.0)
            file.attrs["layout"] = dice.choice(["columns", "matrix", 3])
            file.attrs["format"] = dice.choice(["fairlead-series-1", "fairlead-series-9"])
        if dice.random() < 0.5:
            file["side"] = np.zeros(3, "i1")
            file["values"] = np.zeros((3, 2))


DAMAGES: dict[str, Callable[[Dice, pathlib.Path], None]] = {
    "bits flipped": _flip, "structure of series.nc": _head_of_series, "cut off": _cut, "overwritten": _overwrite,
    "exchanged": _exchange, "no file": _no_file, "an entry of run.json": _entry, "more entries of run.json": _entry,
    "deep run.json": _deep, "a line of events.csv": _line, "a variable of series.nc": _variable,
    "more variables of series.nc": _variable, "an attribute of series.nc": _attribute, "foreign series.nc": _foreign,
}  # fmt: skip
BY_HDF5 = (_variable, _attribute, _foreign)
WELL_FORMED = (*BY_HDF5, _line)
"""Damages that leave files which HDF5, or a reader of CSV, can read; they are told without a checksum too."""

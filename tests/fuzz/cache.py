"""Damaged entries of the cache of machine code: what is loaded is always the function that was asked for.

An entry here is a function that returns its own number, so that an entry taken for another one shows.
"""

from __future__ import annotations

import ctypes
import pathlib
import random
import shutil
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from fairlead import native

NAMES = 4


@dataclass(frozen=True)
class Numbered:
    """A function for `native.Build`, as LLVM text."""

    number: int
    native_name: str = "number"

    def inspect_llvm(self) -> str:
        """The text: a function without arguments that returns the number."""
        return f"define i64 @number() {{ ret i64 {self.number} }}"


def answer(number: int) -> int:
    """What the machine code that goes by this number returns."""
    code = native.load_or_compile(f"entry{number}", lambda: native.Build({"is": number}, {"f": Numbered(number)}))
    assert code.meta == {"is": number}
    return ctypes.CFUNCTYPE(ctypes.c_int64)(code.address["f"])()


def play(folder: pathlib.Path, seed: int, count: int) -> Iterator[str]:
    """Damage `count` entries in `folder`, which is what FAIRLEAD_CACHE names; yield what was answered badly."""
    for number in range(NAMES):
        answer(number)
    whole = {file.name: file.read_bytes() for file in folder.iterdir()}
    for case in range(count):
        dice = random.Random(f"{seed} {case}")
        number, name = dice.randrange(NAMES), dice.choice(list(DAMAGES))
        entry = folder / f"entry{number}.native"
        DAMAGES[name](dice, entry, whole)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", native.CacheWarning)
            try:
                found = answer(number)
            except Exception as error:  # noqa: BLE001 - whatever is raised is a finding
                yield f"case {case} of seed {seed}: {name}: {type(error).__name__}: {error}"
            else:
                if found != number:
                    yield f"case {case} of seed {seed}: {name}: {found} was loaded for {number}"
        _restore(folder, whole)


def _restore(folder: pathlib.Path, whole: dict[str, bytes]) -> None:
    for name, data in whole.items():
        file = folder / name
        if file.is_symlink() or not file.is_file() or file.read_bytes() != data:
            shutil.rmtree(file) if file.is_dir() and not file.is_symlink() else file.unlink(missing_ok=True)
            file.write_bytes(data)


def _flip(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    data = bytearray(whole[entry.name])
    for _ in range(dice.choice([1, 1, 3, 40])):
        data[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
    entry.write_bytes(bytes(data))


def _cut(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.write_bytes(whole[entry.name][: dice.randrange(len(whole[entry.name]))])


def _lengthen(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.write_bytes(whole[entry.name] + dice.randbytes(dice.randrange(1, 100)))


def _zero(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    data = bytearray(whole[entry.name])
    first = dice.randrange(len(data))
    length = min(dice.choice([1, 8, 512]), len(data) - first)
    data[first : first + length] = bytes(length)
    entry.write_bytes(bytes(data))


def _swap_body(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    """The head of this entry before the body of another."""
    other = whole[dice.choice(list(whole))]
    at = dice.choice([len(native.MAGIC), len(native.MAGIC) + 32, len(other) // 2])
    entry.write_bytes(whole[entry.name][:at] + other[at:])


def _whole_of_another(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.write_bytes(whole[dice.choice([name for name in whole if name != entry.name])])


def _link_to_another(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.unlink()
    entry.symlink_to(entry.with_name(dice.choice([name for name in whole if name != entry.name])))


def _link_to_itself(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.unlink()
    entry.symlink_to(entry.name)


def _folder(dice: random.Random, entry: pathlib.Path, whole: dict[str, bytes]) -> None:
    entry.unlink()
    entry.mkdir()


DAMAGES: dict[str, Callable[[random.Random, pathlib.Path, dict[str, bytes]], None]] = {
    "bits flipped": _flip, "cut off": _cut, "made longer": _lengthen, "zeroed": _zero, "body of another": _swap_body,
    "whole of another": _whole_of_another, "link to another": _link_to_another, "link to itself": _link_to_itself,
    "a folder": _folder,
}  # fmt: skip

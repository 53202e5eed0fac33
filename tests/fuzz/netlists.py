"""Netlists damaged at random: bundled ones, and one that has every sort of node in it.

A netlist is damaged as a tree (wrong kinds of nodes, keys left out, doubled, misspelt, parts moved elsewhere) or as a
text (bytes and lines lost, doubled, replaced). The seed and the number say which damage it was.
"""

from __future__ import annotations

import copy
import pathlib
import random
import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import fairlead.models
import yaml

from fairlead.component.bundled import bundled
from fairlead.netlist.yaml12 import read_yaml

QUICK = ("belt", "block_and_spring", "capstan", "power_unit", "all_sorts")
"""Netlists that are compiled at once."""

ALL_SORTS = """\
schema: 1
name: all_sorts
description: Every sort of node that a netlist may hold.
parameters: {mu: 0.3, speed: 0.1 m/s, pull: "{2*mu} N", treatment: binding}
components:
  cable: {type: Cable, length: 4 m, element: 1 m, mass: 5.8 kg/m, stiffness: 500 kN, damping_ratio: 0.5, weight: 20 N/m}
  route:
    type: Route
    stations:
      - {type: Guide, name: in, start: 0 m, length: 2 m, friction: "{mu}"}
      - {type: Bend, name: bend, start: 2 m, angle: 45 deg, radius: 1 m,
         friction: {curve: stribeck, stiction: 0.4, coulomb: 0.3, speed: 1 mm/s}}
  hand: {type: ForceSource, force: {table: {file: pull.csv, kind: linear, beyond: constant}}}
  wave: {type: ForceSource, force: {ramp: {to: 1 N, over: 1 s}, sine: {amplitude: 1 N, frequency: 2 Hz}}}
  block: {type: Mass, mass: 1 kg}
  pad: {type: Contact, method: hold, normal_force: 3 N, curve: {curve: coulomb, coulomb: "{mu}"}}
  wall: {type: Ground}
connections:
  - [cable.path, route.path]
  - [hand.flange, cable.outboard]
  - [wave.flange, block.flange, pad.b]
  - [pad.a, wall.flange]
effects: {}
friction: {method: "{treatment}", creep: 1e-5 m/s}
initial: {block.v: 0.1 m/s}
run: {stop: 1 s, accuracy: 1e-4, engine: rodas, max_steps: 1000}
record:
  signals: ["cable.line[*].tension", "block.?"]
  every: 10 ms
  plots: [{title: Pull, signals: [hand.force], file: pull.png, kind: lines}]
limits: {"cable.line[*].tension": {above: -1 kN, below: 10 kN}}
"""
BESIDE: dict[str, bytes] = {
    "pull.csv": b"t,force\n0,0\n1,2\n2,0\n",
    "commas.csv": b"0,5;1,5\n1,5;2,5\n",
    "wide.csv": b"0,5,1\n1,5,2\n",
    "words.csv": b"t,y\n0,0\nabc,1\n",
    "binary.csv": bytes(range(256)) * 4,
    "empty.csv": b"",
    "utf16.csv": "0,0\n1,1\n".encode("utf-16"),
    "itself.yaml": b"schema: 1\ninclude: [itself.yaml]\n",
}
WORDS = (
    "", " ", "word", "Winch", "Contact", "hold", "null", "[0]", "a.b", "stations", "ü💥", "\u202eabc", "x" * 5000,
    "\x1b[31m", "../x", "/etc/passwd", "C:\\x", "~", "=", "{", "}", "{}", "{mu", "{9**9**9}", "{2**16**2} N", "{1/0}",
    "{nosuch}", "{" + "(" * 90 + ")" * 90 + "}", "{mu} {mu}", "1,5 mm", "1e9999 N", "1e-400 m", "12 kN/fortnight",
    "3 m/s^99", "1 N", "1 m", "1 s", "1e-12 s", "-1 kg", "nan", "inf", "50 %", "*" * 20 + "!", "*", "?",
    "cable.line[*].tension", "[99999999].x", "block.flange", "cable.path", "loop.csv", *BESIDE, "folder.csv",
    "x" * 300 + ".png", "../x.png", "on", "off", "yes",
)  # fmt: skip
NUMBERS = (
    0, 1, -1, 3, 0.5, -0.0, 1e-300, 1e300, -1e300, 1_000_000, 999_999_999_999, 10**40, 2**63, float("nan"),
    float("inf"), True, False, None,
)  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """A damaged netlist in a file, and how to have it again."""

    origin: str
    seed: int
    number: int
    damage: str
    file: pathlib.Path

    def __str__(self) -> str:
        return f"{self.origin}-{self.seed}-{self.number}-{self.damage}"


def mutants(folder: pathlib.Path, seed: int, count: int, only: Iterable[str] = ()) -> Iterator[Mutant]:
    """So many damaged netlists, one after another in one file of `folder`; `only` names what to damage."""
    texts = _originals(folder)
    chosen = sorted(name for name in texts if name in set(only)) or sorted(texts)
    trees = {name: read_yaml(texts[name], name)[0] for name in chosen}
    for number in range(count):
        chance = random.Random(f"{seed}/{number}")
        name = chance.choice(chosen)
        tree = trees[name]
        assert tree is not None
        data, damage = damaged(chance, tree.plain(), texts[name])
        file = folder / "mutant.yaml"
        file.write_bytes(data)
        yield Mutant(name, seed, number, damage, file)


def _originals(folder: pathlib.Path) -> dict[str, str]:
    """The netlists to damage by name, and beside them in `folder` what they include and hostile files."""
    models = pathlib.Path(next(iter(fairlead.models.__path__)))
    for part in models.rglob("*.yaml"):
        target = folder / part.relative_to(models)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(part, target)
    for name, data in BESIDE.items():
        (folder / name).write_bytes(data)
    (folder / "folder.csv").mkdir(exist_ok=True)
    if not (folder / "loop.csv").is_symlink():
        (folder / "loop.csv").symlink_to("loop.csv")
    return {file.stem: file.read_text() for file in models.glob("*.yaml")} | {"all_sorts": ALL_SORTS}


def damaged(chance: random.Random, tree: Any, text: str) -> tuple[bytes, str]:
    """The bytes of a damaged netlist, and what was done to it."""
    if chance.random() < 0.25:
        damage = chance.choice(TEXT_DAMAGES)
        return damage(chance, text.encode()), damage.__name__
    tree, done = copy.deepcopy(tree), []
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        damage_ = chance.choice(TREE_DAMAGES)
        damage_(chance, tree)
        done.append(damage_.__name__)
    return yaml.safe_dump(tree, sort_keys=False, allow_unicode=True).encode("utf-8", "surrogatepass"), "+".join(done)


def _places(tree: Any) -> list[tuple[Any, Any]]:
    """Every (container, key) below a tree."""
    found: list[tuple[Any, Any]] = []
    stack = [tree]
    while stack:
        node = stack.pop()
        keys = list(node) if isinstance(node, dict) else range(len(node)) if isinstance(node, list) else ()
        found += [(node, key) for key in keys]
        stack += [node[key] for key in keys]
    return found


def _place(chance: random.Random, tree: Any) -> tuple[Any, Any]:
    return chance.choice(_places(tree) or [({"": None}, "")])


def _thing(chance: random.Random, tree: Any) -> Any:
    """A node of any kind."""
    kind = chance.randrange(8)
    if kind < 3:
        return chance.choice(WORDS)
    if kind < 5:
        return chance.choice(NUMBERS)
    if kind == 5:
        return [chance.choice(WORDS + NUMBERS) for _ in range(chance.choice((0, 1, 2, 3)))]
    if kind == 6:
        return {chance.choice(WORDS): chance.choice(WORDS + NUMBERS) for _ in range(chance.choice((0, 1, 2)))}
    return _deep(chance)


def _deep(chance: random.Random) -> Any:
    node: Any = chance.choice(WORDS + NUMBERS)
    for _ in range(chance.choice((1, 2, 70))):
        node = [node] if chance.random() < 0.5 else {"a": node}
    return node


def other_kind(chance: random.Random, tree: Any) -> None:
    """A node of another kind in the place of one."""
    holder, key = _place(chance, tree)
    holder[key] = _thing(chance, tree)


def other_type(chance: random.Random, tree: Any) -> None:
    """A component or station of another type."""
    typed = [node for node in (h[k] for h, k in _places(tree)) if isinstance(node, dict) and "type" in node]
    if typed:
        chance.choice(typed)["type"] = chance.choice([*sorted(bundled()), "Bend", "Winch", "Sheave", "Guide"])


def moved(chance: random.Random, tree: Any) -> None:
    """A part of the netlist where another one stood."""
    holder, key = _place(chance, tree)
    other, there = _place(chance, tree)
    holder[key] = copy.deepcopy(other[there])


def left_out(chance: random.Random, tree: Any) -> None:
    """An entry or an item less."""
    holder, key = _place(chance, tree)
    del holder[key]


def renamed(chance: random.Random, tree: Any) -> None:
    """Another key: a misspelt one, one from elsewhere, or none that could be one."""
    maps = [(holder, key) for holder, key in _places(tree) if isinstance(holder, dict)]
    holder, key = chance.choice(maps or [({"": 0}, "")])
    keys = [str(other) for _, other in maps] or [""]
    new = chance.choice((str(key)[::-1], str(key)[1:], f"{key}s", chance.choice(keys), chance.choice(WORDS)))
    holder[new] = holder.pop(key)


def wrapped(chance: random.Random, tree: Any) -> None:
    """A list or a map around a node, or what stands in one instead of it."""
    holder, key = _place(chance, tree)
    node = holder[key]
    if isinstance(node, dict | list) and node and chance.random() < 0.5:
        holder[key] = next(iter(node.values())) if isinstance(node, dict) else node[0]
    else:
        holder[key] = [node] if chance.random() < 0.5 else {"a": node}


def repeated(chance: random.Random, tree: Any) -> None:
    """An item of a list many times."""
    lists = [node for node in (h[k] for h, k in _places(tree)) if isinstance(node, list) and node]
    if lists:
        chosen = chance.choice(lists)
        chosen += [chance.choice(chosen)] * chance.choice((1, 2, 200))


def bytes_replaced(chance: random.Random, data: bytes) -> bytes:
    """Some bytes that are others."""
    made = bytearray(data)
    for _ in range(chance.choice((1, 3, 20))):
        made[chance.randrange(len(made))] = chance.choice((chance.randrange(256), *b"{}[]:,*&!#'\"\n\t -"))
    return bytes(made)


def stretch_lost(chance: random.Random, data: bytes) -> bytes:
    """A stretch of the text, or its end, is missing."""
    start = chance.randrange(len(data))
    return data[:start] + data[start + chance.choice((1, 5, 50, len(data))) :]


def line_doubled(chance: random.Random, data: bytes) -> bytes:
    """A line twice, or at another depth."""
    lines = data.split(b"\n")
    k = chance.randrange(len(lines))
    lines.insert(k, chance.choice((b"", b" ", b"    ")) + lines[k])
    return b"\n".join(lines)


def inserted(chance: random.Random, data: bytes) -> bytes:
    """Something that does not belong there."""
    where = chance.randrange(len(data))
    odd = (b"\xff", b"\x00", b"\xef\xbb\xbf", b"&a ", b"*a ", b"!!python/object:os.system ", b"<<: ", b"---\n", b"? ",
           b"| ", b"{" * 100, b"\r", "\u2028".encode(), b"[" * 70 + b"]" * 70, b"9" * 5000)  # fmt: skip
    return data[:where] + chance.choice(odd) + data[where:]


TREE_DAMAGES: tuple[Callable[[random.Random, Any], None], ...] = (
    other_kind, other_kind, other_kind, other_type, moved, left_out, renamed, wrapped, repeated,
)  # fmt: skip
TEXT_DAMAGES = (bytes_replaced, stretch_lost, line_doubled, inserted)

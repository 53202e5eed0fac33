"""All structs of the memory of a run, one after another: the one list that Python and compiled code read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from fairlead.integrate.memory.of_events import GUARDS, LOADS, SETTLING
from fairlead.integrate.memory.of_linear import FACTORS, MATRICES, REDUCED
from fairlead.integrate.memory.of_methods import CONTACTS, EXCHANGE, RULE, TABLEAU
from fairlead.integrate.memory.of_problem import PROBLEM
from fairlead.integrate.memory.of_run import POINT, RECORDER, RUN
from fairlead.integrate.memory.struct import Struct

CHECK = "FAIRLEAD_CHECK_INDICES"
"""Set in the environment, the loop is compiled to trap where an index lies outside its array (foreign.py)."""

ROOMS: Mapping[str, Struct | Mapping[str, Struct]] = {
    "problem": PROBLEM,
    "run": RUN,
    "point": POINT,
    "linear": {"matrices": MATRICES, "reduced": REDUCED, "factors": FACTORS},
    "events": {"guards": GUARDS, "settling": SETTLING, "loads": LOADS},
    "recorder": RECORDER,
    "method": TABLEAU,
    "stepping": {"rule": RULE, "exchange": EXCHANGE, "contacts": CONTACTS},
}
"""A struct, or the structs of a room by name: a function is given what it reads, of one or of some owners."""

STRUCTS: Mapping[str, Struct] = {
    name: struct
    for room, inside in ROOMS.items()
    for name, struct in ({room: inside} if isinstance(inside, Struct) else inside).items()
}


def check_names(structs: Mapping[str, Struct]) -> None:
    """Refuse what two structs declare: the second would stand in the memory of the first, with its own length."""
    owners: dict[str, str] = {}
    for owner, struct in structs.items():
        for name in (*struct.integers, *struct.numbers, *struct.reals, *struct.indices):
            if name in owners:
                raise ValueError(f"{owner} declares {name}, which {owners[name]} has. Choose another name, or a copy.")
            owners[name] = owner


check_names(STRUCTS)
VECTORS = {name: length for struct in STRUCTS.values() for name, length in struct.reals.items()}
"""Arrays of doubles, by the name of their length."""
INDICES = {name: length for struct in STRUCTS.values() for name, length in struct.indices.items()}
"""Arrays of whole numbers, by the name of their length."""
INTEGERS = tuple(name for struct in STRUCTS.values() for name in struct.integers)
NUMBERS = tuple(name for struct in STRUCTS.values() for name in struct.numbers)
"""Single values; tests ask of each whether a part of a problem has to take it over (tests/integrate/test_parts.py)."""

_ARRAYS = VECTORS | INDICES
LAYOUT = np.dtype(
    [
        (room, inside.record(_ARRAYS))
        if isinstance(inside, Struct)
        else (room, np.dtype([(name, struct.record(_ARRAYS)) for name, struct in inside.items()]))
        for room, inside in ROOMS.items()
    ],
    align=True,
)
"""The struct of structs that the loop is given."""


def _places(kind: np.dtype, base: int = 0) -> Iterator[tuple[str, int, np.dtype]]:
    """Every field of a struct of structs with its place in bytes, where it is at home first."""
    for name in kind.names or ():
        inside, at = kind[name], kind.fields[name][1] if kind.fields else 0
        if inside.names:
            yield from _places(inside, base + at)
        else:
            yield name, base + at, inside


PLACES: dict[str, list[int]] = {}
"""Where a field is, in bytes: at home, and in those that have copies."""
_TYPES: dict[str, np.dtype] = {}
for _name, _at, _kind in _places(LAYOUT):
    PLACES.setdefault(_name, []).append(_at)
    _TYPES[_name] = _kind
for _name, _struct in STRUCTS.items():
    for _copy in _struct.copies:
        if _copy not in PLACES and f"at_{_copy}" not in PLACES:
            raise ValueError(f"{_name} has a copy of {_copy}, which no struct has.")

FLAT = np.dtype(
    {
        "names": list(PLACES),
        "formats": [_TYPES[name] for name in PLACES],
        "offsets": [at[0] for at in PLACES.values()],
        "itemsize": LAYOUT.itemsize,
    }
)
"""The same memory as Python sees it: one record with every field by its own name."""
ADDRESSES = ("at_", "call_", "context", "mean_at")
"""How names of fields begin that are addresses."""
LINKS = np.array(sorted(at // 8 for name, places in PLACES.items() if name.startswith(ADDRESSES) for at in places))
"""Which eight bytes are addresses, not numbers: they belong to a run, and are no part of its state."""
_WORDS = [(at // 8, name[3:]) for name, places in PLACES.items() if name.startswith("at_") for at in places]
LINKED, LINKED_NAMES = np.array([word for word, _ in _WORDS]), tuple(name for _, name in _WORDS)
"""Which of them are addresses of arrays, and of which."""

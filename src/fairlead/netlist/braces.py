"""A parameter of the scene that is named without its braces: what is said of its value gets the way out."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import replace

from fairlead.errors import Fault

VALUE = re.compile(r" = ([^\W\d]\w*) is (?:not|no) ")


def in_braces(faults: Iterable[Fault], parameters: Collection[str]) -> list[Fault]:
    """The faults; where the value is the bare name of a parameter, with how that is written."""
    return [_one(fault, parameters) for fault in faults]


def _one(fault: Fault, parameters: Collection[str]) -> Fault:
    bare = VALUE.search(fault.what)
    if bare is None or bare[1] not in parameters:
        return fault
    return replace(fault, way_out=f'{bare[1]} is a parameter of the scene: write "{{{bare[1]}}}".')

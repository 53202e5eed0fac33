"""Jobs that need no model: functions of values, some of which end their process. Processes import them by name."""

import hashlib
import math
import os
import platform
import time
from dataclasses import dataclass
from typing import Any

from fairlead.cases.identity import key_of
from fairlead.cases.row import ERROR, FINISHED, Row

GATE = "FAIRLEAD_TESTS_GATE"
"""In the environment: the first x that is not computed by `square` here, which waits there until it is ended."""
LONG = 600.0  # s, after which nobody comes any more


def square(values):
    time.sleep(float(values.get("wait", 0.0)))
    begun = time.monotonic()
    while values["x"] >= float(os.environ.get(GATE, "inf")):
        assert time.monotonic() - begun < LONG
        time.sleep(0.05)
    return {"y": values["x"] ** 2}


def crash_at_three(values):
    if values["x"] == 3:
        os._exit(11)
    return {"y": values["x"] ** 2}


def ishigami(values):
    """f = sin a + 7 sin(b)^2 + 0.1 c^4 sin a (Ishigami and Homma 1990)."""
    a, b, c = values["a"], values["b"], values["c"]
    return {"f": math.sin(a) + 7 * math.sin(b) ** 2 + 0.1 * c**4 * math.sin(a)}


@dataclass(frozen=True)
class FunctionJob:
    """Cases of a function: values by name in, figures by name out. Texts that are numbers come as numbers."""

    name: str
    function: Any
    units: dict[str, str]

    @property
    def about(self):
        """Nothing is known of its parameters."""
        return {}

    @property
    def limited(self):
        """A function has no limits."""
        return False

    @property
    def scene(self):
        """By the name alone: a function has no text that could be hashed in every case."""
        return hashlib.sha256(f"function {self.name}".encode()).hexdigest()

    def key(self, values):
        """What a case is known by."""
        return key_of(self.scene, values)

    def check(self, values):
        """A function takes what it is given."""

    def row(self, values):
        """Call the function."""
        begun, start = time.perf_counter(), Row(self.key(values), dict(values), ERROR, host=platform.node())
        try:
            found = dict(self.function({name: _number(value) for name, value in values.items()}))
        except Exception as error:  # noqa: BLE001 - whatever it is, it costs one row
            return Row(start.key, start.values, ERROR, f"{type(error).__name__}: {error}", host=start.host)
        seconds = time.perf_counter() - begun
        return Row(start.key, start.values, FINISHED, figures=found, seconds=seconds, host=start.host)


def _number(value):
    try:
        return float(value)
    except ValueError:
        return value


def job(function, *figures):
    return FunctionJob(function.__name__, function, dict.fromkeys(figures or ("y",), "1"))

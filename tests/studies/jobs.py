"""Jobs that need no model: functions of values, some of which end their process. Processes import them by name."""

import math
import os
import time

from fairlead.studies.sweeps.job import FunctionJob

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


def job(function, figure="y"):
    return FunctionJob(function.__name__, function, {figure: "1"})

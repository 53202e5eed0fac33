"""Jobs that need no model: functions of values, some of which end their process. Processes import them by name."""

import math
import os
import time

from fairlead.studies.sweeps.job import FunctionJob


def square(values):
    time.sleep(float(values.get("wait", 0.0)))
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

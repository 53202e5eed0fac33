"""The loops that all tests share, compiled side by side by the workers that run them.

With cold caches every worker would otherwise wait for the first loop, and again for the second: whoever comes later
waits until the entry is there (native.py).
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from fairlead.integrate.engines import RODAS, STEPPING
from fairlead.integrate.machine_code import compiled_loop, compiled_sundials

SHARES: tuple[tuple[Callable[[], object], ...], ...] = (
    (lambda: compiled_loop(RODAS),),
    (lambda: compiled_loop(STEPPING), compiled_sundials),
)
"""What each worker compiles: of about the same length."""
MANY = 3000
"""From so many tests on, all loops are needed."""


def compile_share(session: pytest.Session) -> None:
    """Compile the share of this worker, if it is one of several that run a large part of the tests."""
    worker = getattr(session.config, "workerinput", None)
    if worker is None or worker["workercount"] < len(SHARES) or len(session.items) < MANY:
        return
    number = int(worker["workerid"].removeprefix("gw"))
    for compiled in SHARES[number] if number < len(SHARES) else ():
        compiled()

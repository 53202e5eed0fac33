"""The list of what the bundled engines run and is compiled on its own."""

from __future__ import annotations

from fairlead.integrate.engines import ENGINES
from fairlead.integrate.machine_code import SUNDIALS, Compiled, loop_code


def all_compiled() -> tuple[Compiled, ...]:
    """What the bundled engines run, the longest to compile first."""
    loops = dict.fromkeys(loop_code(ENGINES[name]) for name in ("stepping", *ENGINES))
    return (*loops, SUNDIALS)

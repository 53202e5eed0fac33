"""All that the bundled engines run, compiled at once into the cache.

    python -m fairlead.integrate.compile_all        a process for each that is missing, as many as there are cores
"""

from __future__ import annotations

import gc
import os
from concurrent.futures import ProcessPoolExecutor

from fairlead.integrate.engines import ENGINES
from fairlead.integrate.machine_code import SUNDIALS, Compiled, loop_code


def all_compiled() -> tuple[Compiled, ...]:
    """What the bundled engines run, the longest to compile first."""
    loops = dict.fromkeys(loop_code(ENGINES[name]) for name in ("stepping", *ENGINES))
    return (*loops, SUNDIALS)


def compile_all() -> None:
    """Put the machine code of all engines into the cache."""
    with ProcessPoolExecutor(os.cpu_count(), initializer=gc.disable) as pool:  # what numba makes stays till the end
        list(pool.map(Compiled.is_cached, all_compiled()))


if __name__ == "__main__":
    compile_all()

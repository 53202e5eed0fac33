"""All that the bundled engines run, compiled at once into the cache.

    python -m fairlead.integrate.compile_all            a process for each that is missing, as many as there are cores
    python -m fairlead.integrate.compile_all rodas      of bitcode, as it is exported with models of rodas

Who exports models as well needs that bitcode too; numba then compiles once for both, and all together: what the engines
have in common is typed in one process.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

from fairlead.integrate.all_compiled import all_compiled
from fairlead.integrate.bitcode import keep, kept_with_native
from fairlead.integrate.engines import ENGINES
from fairlead.integrate.machine_code import Compiled, loop_code


def compile_all(exported: Sequence[str] = ()) -> None:
    """Put the machine code of all engines into the cache; if models of one are exported, bitcode of all of them too."""
    codes = all_compiled()
    if any(loop_code(ENGINES[name]) in codes for name in exported):
        keep(codes)
    with ProcessPoolExecutor(os.cpu_count(), initializer=gc.disable) as pool:  # what numba makes stays till the end
        list(pool.map(_compile, codes, [bool(exported)] * len(codes)))


def _compile(code: Compiled, exported: bool) -> None:
    if exported:
        kept_with_native(code)
    else:
        code.is_cached()


if __name__ == "__main__":
    compile_all(sys.argv[1:])

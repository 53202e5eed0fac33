"""All that the bundled engines run, compiled at once into the cache.

    python -m fairlead.integrate.compile_all            a process for each that is missing, as many as there are cores
    python -m fairlead.integrate.compile_all rodas      the loop of rodas from the bitcode that is exported with a model

Who exports models as well needs that bitcode too; numba then compiles once for both.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

from fairlead.integrate.all_compiled import all_compiled
from fairlead.integrate.bitcode import kept_with_native
from fairlead.integrate.engines import ENGINES
from fairlead.integrate.machine_code import Compiled, loop_code


def compile_all(exported: Sequence[str] = ()) -> None:
    """Put the machine code of all engines into the cache; of these engines their bitcode too."""
    both = [loop_code(ENGINES[name]) for name in exported]
    with ProcessPoolExecutor(os.cpu_count(), initializer=gc.disable) as pool:  # what numba makes stays till the end
        list(pool.map(_compile, all_compiled(), [code in both for code in all_compiled()]))


def _compile(code: Compiled, exported: bool) -> None:
    if exported:
        kept_with_native(code)
    else:
        code.is_cached()


if __name__ == "__main__":
    compile_all(sys.argv[1:])

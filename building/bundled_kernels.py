"""Kernels of the bundled models and parts, traced and lowered for a wheel, and what goes with every model, optimised.

    python bundled_kernels.py FILE

What is left for the first run is to optimise the kernels for its processor (src/fairlead/kernels/lowered_ahead.py).
"""

from __future__ import annotations

import gc
import pathlib
import platform
import sys
from collections.abc import Iterator

import fairlead.models

import fairlead
from fairlead.component.values import Variant
from fairlead.integrate.bitcode import WIDE
from fairlead.kernels.kernel import lowered
from fairlead.kernels.lowered_ahead import name_of, write
from fairlead.system.callbacks.table import compiled_ahead, name_ahead


def variants() -> Iterator[Variant]:
    """All that occur in the models that have a name, and in those that show one part each."""
    for folder in map(pathlib.Path, fairlead.models.__path__):
        for file in [*sorted(folder.glob("*.yaml")), *sorted((folder / "single_parts").glob("*.yaml"))]:
            yield from dict.fromkeys(one.variant for one in fairlead.load(file).flattened.instances)


if __name__ == "__main__":
    gc.disable()  # nearly all that is made stays till the end
    kernels = {name_of(one, 0): lowered(one, 0) for one in dict.fromkeys(variants())}
    callbacks = compiled_ahead(WIDE.get(platform.machine(), "generic"))
    write(pathlib.Path(sys.argv[1]), kernels | {name_ahead(): callbacks})

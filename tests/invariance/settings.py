"""Settings of a process that must not matter, and what is in force where one was asked for."""

from __future__ import annotations

import ctypes
import os
import pathlib

BLAS = ("Prescott", "Haswell", "Zen", "SkylakeX")
NEEDS = {"Prescott": "SSE3", "Haswell": "FMA3", "Zen": "FMA3", "SkylakeX": "AVX512_SKX"}
"""What a processor must have for this kind of OpenBLAS, in the words of numpy."""

NEWER = "AVX2 FMA3 X86_V3 X86_V4 AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL AVX512_SPR ASIMDHP SVE"
"""Instructions that numpy chooses at run time, by the names of its versions; those it can do without."""


def settings() -> dict[str, dict[str, str]]:
    """Environment variables by the name of a setting, for this machine's numpy."""
    plain = {"plain": {}, "other hash seed": {"PYTHONHASHSEED": "12345"}, "generic build": {"FAIRLEAD_CPU": "generic"}}
    blas = {f"OpenBLAS {kind}": {"OPENBLAS_CORETYPE": kind} for kind in BLAS}
    return {**plain, **blas, "numpy without its newer instructions": {"NPY_DISABLE_CPU_FEATURES": dispatched()}}


def dispatched() -> str:
    """Those of NEWER that this numpy dispatches on; naming one that it is built with by all means is an error."""
    from numpy._core._multiarray_umath import __cpu_dispatch__

    return " ".join(name for name in __cpu_dispatch__ if name in NEWER.split())


def lacking(setting: dict[str, str]) -> str:
    """Why a setting cannot be had on this machine; empty if it can."""
    from numpy._core._multiarray_umath import __cpu_features__

    kind = setting.get("OPENBLAS_CORETYPE")
    if kind is not None and blas() is None:
        return "numpy's BLAS is not OpenBLAS"
    if kind is not None and not __cpu_features__.get(NEEDS[kind], False):
        return f"not run: this processor lacks {NEEDS[kind]}, which OpenBLAS for {kind} needs"
    if "NPY_DISABLE_CPU_FEATURES" in setting and not setting["NPY_DISABLE_CPU_FEATURES"]:
        return "not run: this numpy chooses no instructions at run time"
    return ""


def blas() -> str | None:
    """The kind of processor that numpy's OpenBLAS has chosen its code for, or None if it is another BLAS."""
    import numpy

    for folder in ("../numpy.libs", ".dylibs"):
        for file in sorted((pathlib.Path(numpy.__file__).parent / folder).glob("*openblas*")):
            library = ctypes.CDLL(os.fspath(file.resolve()))
            for name in ("scipy_openblas_get_corename64_", "openblas_get_corename64_", "openblas_get_corename"):
                if hasattr(library, name):
                    ask = getattr(library, name)
                    ask.restype = ctypes.c_char_p
                    return ask().decode()
    return None


def in_force() -> str:
    """A line about this process: OpenBLAS, numpy's instructions, build, hash seed."""
    from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

    used = [name for name in __cpu_dispatch__ if __cpu_features__.get(name)]
    try:
        from fairlead.processor import processor

        build = str(processor())
    except ImportError:  # a fairlead of before there were builds
        build = "this processor"
    seed = os.environ.get("PYTHONHASHSEED", "random")
    return f"OpenBLAS {blas()}, numpy with {' '.join(used) or 'its baseline'}, compiled for {build}, hash seed {seed}"

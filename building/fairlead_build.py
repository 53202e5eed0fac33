"""How a wheel of fairlead is built: setuptools, and engine and kernels compiled for any processor of this kind.

pip asks this backend (see pyproject.toml). Only a wheel needs numba, of the oldest version that is supported, because
LLVM reads the bitcode of older versions and of no newer ones. An editable install compiles nothing and holds no
bitcode: its engine changes, so numba compiles it when it is first run.
"""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (  # noqa: F401 - what pip calls
    build_editable,
    build_sdist,
    build_wheel,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py

COMPILERS = ("numba==0.61.2; python_version < '3.14'", "numba>=0.63; python_version >= '3.14'")
# What importing the package takes, to reach the modules that compile.
IMPORTED = ("pydantic>=2.7,<3", "pyyaml>=6.0,<7", "networkx>=3.2,<4", "sympy>=1.12,<2", "pint>=0.24,<1",
            "platformdirs>=4.0,<5", "filelock>=3.12,<5")  # fmt: skip


def get_requires_for_build_wheel(config_settings: Any = None) -> list[str]:
    """Packages that a wheel is built with."""
    return [*build_meta.get_requires_for_build_wheel(config_settings), *COMPILERS, *IMPORTED]


class BuildPy(build_py):
    """Copies the sources, and puts the bitcode of the engine beside its own."""

    def run(self) -> None:
        """Copy, then compile from what was copied."""
        super().run()
        if self.editable_mode:
            return
        copied = pathlib.Path(self.build_lib).resolve()
        path = os.pathsep.join(filter(None, (str(copied), os.environ.get("PYTHONPATH"))))
        there, folder = {**os.environ, "PYTHONPATH": path}, copied / "fairlead"
        kernels = pathlib.Path(__file__).with_name("bundled_kernels.py")
        for words in (["-m", "fairlead.integrate.bitcode", folder / "integrate"],
                      [kernels, folder / "kernels" / "bundled.kernels"]):  # fmt: skip
            subprocess.run([sys.executable, *words], check=True, cwd=copied, env=there)


class BdistWheel(bdist_wheel):
    """A wheel for any Python 3 on one kind of processor and system."""

    def finalize_options(self) -> None:
        """Tell that the wheel is not for every system."""
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple[str, str, str]:
        """Return Python, ABI and platform."""
        return "py3", "none", super().get_tag()[2]

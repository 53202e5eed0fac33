"""Which program made a result: fairlead, Python, and the packages that compute for it."""

from __future__ import annotations

import functools
import importlib.metadata
import platform

COMPUTES = ("numpy", "scipy", "llvmlite")
"""Packages whose version can change a number."""


@functools.cache
def versions() -> dict[str, str]:
    """Versions by name, read off what pip keeps of a package, so that none is imported for it."""
    found = {"fairlead": importlib.metadata.version("fairlead"), "python": platform.python_version()}
    return found | {name: importlib.metadata.version(name) for name in COMPUTES}

"""The systems that a library is made for, by the names of FMI 3.

That of this machine is linked by its C compiler; all others by `ziglang`, which has the C libraries of them all.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Collection, Iterable
from typing import NamedTuple

from fairlead.errors import UsageError, did_you_mean, listing, shown

HERE = "x86_64-linux"
"""That on which libraries are made, and for which they are where nothing else is asked for."""


class Platform(NamedTuple):
    """A processor architecture with its system."""

    name: str
    """In FMI 3."""
    folder: str
    """In FMI 2; empty where that has no name for it."""
    ending: str
    """Of a library's file."""
    triple: str
    """For LLVM, which then knows how data lie and functions are called there."""
    target: str
    """For ziglang, with the oldest system that is served."""

    @property
    def system(self) -> str:
        """The name of the system alone."""
        return self.name.partition("-")[2]

    def flags(self, name: str) -> tuple[str, ...]:
        """Of the linker: nothing in the library tells when or where it was made."""
        if self.system == "linux":
            return ("-Wl,--build-id=none", "-Wl,--no-undefined", "-s", "-lm")
        return ("-s", f"-Wl,--out-implib,{name}.lib") if self.system == "windows" else ("-s",)

    def file(self, name: str) -> str:
        """Of a library that programs link with."""
        return f"{'' if self.system == 'windows' else 'lib'}{name}.{self.ending}"


PLATFORMS = {
    one.name: one
    for one in (
        Platform(HERE, "linux64", "so", "x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17"),
        Platform("aarch64-linux", "", "so", "aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17"),
        Platform("x86_64-windows", "win64", "dll", "x86_64-w64-windows-gnu", "x86_64-windows-gnu"),
        Platform("x86_64-darwin", "darwin64", "dylib", "x86_64-apple-macosx13.0.0", "x86_64-macos.13.0"),
        Platform("aarch64-darwin", "darwin64", "dylib", "arm64-apple-macosx13.0.0", "aarch64-macos.13.0"),
    )
}


def platforms_of(names: Iterable[str]) -> list[Platform]:
    """Those of these names, each once and in one order; without names that of this machine. Raises UsageError."""
    asked = dict.fromkeys(names)
    if unknown := [name for name in asked if name not in PLATFORMS]:
        near = did_you_mean(unknown[0], PLATFORMS)
        said = f"--platform {', '.join(map(shown, unknown))}: libraries are made for {listing(PLATFORMS)}. {near}"
        raise UsageError(said.rstrip())
    return [one for one in PLATFORMS.values() if one.name in asked] or [PLATFORMS[HERE]]


def refuse_without_folder(platforms: Collection[Platform]) -> None:
    """Raise UsageError for what an FMU of version 2 has no folder for."""
    if without := [one.name for one in platforms if not one.folder]:
        named = [one.name for one in PLATFORMS.values() if one.folder]
        raise UsageError(
            f"--platform {listing(without)}: version 2 of the standard has no name for it.\n"
            f"    Take version 3 (--fmi 3), or of {listing(named)}."
        )


def has_ziglang() -> bool:
    """Whether the package is installed, which links for other systems."""
    return importlib.util.find_spec("ziglang") is not None

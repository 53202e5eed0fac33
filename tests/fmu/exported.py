"""FMUs that several tests look at, exported once, and what runs them."""

from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
from collections.abc import Iterator
from typing import Any

import filelock
import pytest

import fairlead
from fairlead.fmu import export

PATIENCE = 600.0  # s, for a process of a second on a machine that is busy
HERE = pathlib.Path(__file__).parent

PUSHED = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 2 kg}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.5}}
  push: {type: ForceActuator}
  command: {type: SignalInput, start: 0}
connections:
  - [floor.flange, pad.a]
  - [pad.b, block.flange, push.flange]
  - [command.signal, push.force]
run: {stop: 1 s, engine: rodas}
interface:
  inputs:
    pull: {of: command.value, unit: N, description: Force on the block., nominal: 10 N, start: 9}
  outputs:
    speed: {of: block.v, nominal: 0.2 m/s, description: "Of the <block>, \\"v\\" & co."}
"""
"""5 N of friction on 2 kg; a pull of 9 N gives it 2 m/s^2, none stops it at 2.5 m/s^2."""


def fmpy() -> Any:
    """The package, or the test is skipped."""
    return pytest.importorskip("fmpy", reason="FMPy is not installed: pip install 'fairlead[fmu]'")


def needs_compiler() -> None:
    """Skip the test where nothing links an FMU."""
    if not any(map(shutil.which, ("cc", "gcc", "clang"))):
        pytest.skip("no C compiler is installed, which links an FMU")


def once(folder: pathlib.Path, name: str, version: int, text: str = "", **given: Any) -> pathlib.Path:
    """The FMU of a bundled model, or of a netlist by its text; made once for all workers."""
    needs_compiler()
    file = folder / f"{name}_{version}.fmu"
    with filelock.FileLock(folder / "fmu.lock", timeout=600):
        if not file.exists():
            export(model(folder, name, text), file, version=version, **given)
    return file


def model(folder: pathlib.Path, name: str, text: str = "") -> fairlead.Model:
    """A bundled model, or the netlist of a text."""
    if not text:
        return fairlead.load(name)
    netlist = folder / f"{name}.yaml"
    netlist.write_text(f"schema: 1\nname: {name}\n{text}", encoding="utf-8")
    return fairlead.load(netlist)


class Slave:
    """An instance in FMPy, for both versions of the standard by the same names."""

    def __init__(self, file: pathlib.Path, folder: pathlib.Path, *, start: float = 0.0, stop: float | None = None,
                 **how: Any) -> None:  # fmt: skip
        from fmpy import extract, read_model_description
        from fmpy.fmi2 import FMU2Slave
        from fmpy.fmi3 import FMU3Slave

        self.described = read_model_description(str(file))
        self.references = {one.name: one.valueReference for one in self.described.modelVariables}
        self.outputs = [one.name for one in self.described.modelVariables if one.causality == "output"]
        self.newer = self.described.fmiVersion == "3.0"
        kind = FMU3Slave if self.newer else FMU2Slave
        self.fmu = kind(
            guid=self.described.guid, unzipDirectory=extract(str(file), unzipdir=str(folder)),
            modelIdentifier=self.described.coSimulation.modelIdentifier, instanceName="one",
        )  # fmt: skip
        self.fmu.instantiate(**how)
        if not self.newer:
            self.fmu.setupExperiment(startTime=start, stopTime=stop)
        self.fmu.enterInitializationMode(**({"startTime": start, "stopTime": stop} if self.newer else {}))
        self.t = start

    def set(self, name: str, value: float) -> None:
        (self.fmu.setFloat64 if self.newer else self.fmu.setReal)([self.references[name]], [value])

    def get(self, *names: str) -> list[float]:
        references = [self.references[name] for name in names]
        return list((self.fmu.getFloat64 if self.newer else self.fmu.getReal)(references))

    def step(self, h: float) -> Any:
        said = self.fmu.doStep(self.t, h)
        self.t += h
        return said


@contextlib.contextmanager
def slave(file: pathlib.Path, folder: pathlib.Path, **how: Any) -> Iterator[Slave]:
    """An instance that is being initialised; freed in the end."""
    made = Slave(file, folder, **how)
    try:
        yield made
    finally:
        made.fmu.freeInstance()


def in_group(command: list[str], **more: Any) -> str:
    """What a command prints; its whole group is ended when it takes too long."""
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True, **more
    ) as process:
        try:
            said, complained = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    assert process.returncode == 0, complained
    return said

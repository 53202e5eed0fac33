"""The handling system and its control electronics as two FMUs, coupled by FMPy, beside both as one model.

    python benchmarks/coupled_fmus.py            # the table; wants fairlead[fmu] and a C compiler

`master` is all that another program has to do: bring the plant to a point, give what it measures to the electronics,
bring them to the same point, and give their commands to the plant.
"""

from __future__ import annotations

import pathlib
import shutil
import sys
import tempfile
from typing import Any

import coupled_route
import numpy as np
from coupled_route import HELD, MEASURED, PERIOD, PLANT, STOP
from numpy.typing import NDArray

import fairlead

COMMANDS = ("deployer_command", "winch_command")


class Instance:
    """An FMU of version 3 in FMPy, by names."""

    def __init__(self, file: pathlib.Path, given: dict[str, float] | None = None) -> None:
        """Initialised at 0 s with these inputs, and with the start values of the others."""
        from fmpy import extract, read_model_description
        from fmpy.fmi3 import FMU3Slave

        told, self.folder = read_model_description(file), extract(file)
        self.number = {one.name: one.valueReference for one in told.modelVariables}
        self.fmu: Any = FMU3Slave(guid=told.guid, unzipDirectory=self.folder, instanceName=file.stem,
                                  modelIdentifier=told.coSimulation.modelIdentifier)  # fmt: skip
        self.fmu.instantiate()
        self.fmu.enterInitializationMode(startTime=0.0)
        self.set(given or {})
        self.fmu.exitInitializationMode()

    def set(self, values: dict[str, float]) -> None:
        """Set inputs."""
        self.fmu.setFloat64([self.number[name] for name in values], list(values.values()))

    def get(self, names: tuple[str, ...]) -> dict[str, float]:
        """Outputs."""
        return dict(zip(names, self.fmu.getFloat64([self.number[name] for name in names]), strict=True))

    def close(self) -> None:
        """Free it."""
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder)


def master(plant: Instance, electronics: Instance, held: int, stop: float) -> dict[str, NDArray[np.float64]]:
    """What is measured at all multiples of H = `held` Ts up to `stop`."""
    found = [plant.get(MEASURED)]
    for k in range(0, round(stop / PERIOD), held):
        plant.set(electronics.get(COMMANDS))
        step(plant, k, held)
        found.append(plant.get(MEASURED))
        for more in range(held):  # between two points the electronics go on with what they were given at the last
            if more == held - 1:
                electronics.set(found[-1])
            step(electronics, k + more, 1)
    return {name: np.array([one[name] for one in found]) for name in MEASURED}


def step(one: Instance, k: int, count: int) -> None:
    """From sample k over `count` samples, so that it arrives at the sample itself and not at its side by rounding.

    A sampled controller that arrives 1e-16 s early takes its sample at the beginning of the next step.
    """
    begin, end = PERIOD * k, PERIOD * (k + count)
    one.fmu.doStep(begin, end - begin)


def exported(folder: pathlib.Path, accuracy: float) -> tuple[pathlib.Path, pathlib.Path]:
    """Both FMUs."""
    from fairlead.fmu import export

    files = []
    for name in ("plant", "electronics"):
        model = fairlead.load(PLANT.with_name(f"{name}.yaml"))
        files.append(export(model, folder / f"{name}.fmu", version=3, engine="rodas", accuracy=accuracy))
    return files[0], files[1]


def coupled(files: tuple[pathlib.Path, pathlib.Path], held: int, stop: float) -> dict[str, NDArray[np.float64]]:
    """The same, with both begun anew."""
    plant = Instance(files[0])
    both = [plant, Instance(files[1], plant.get(MEASURED))]  # their first sample is taken while they are initialised
    try:
        return master(both[0], both[1], held, stop)
    finally:
        for one in both:
            one.close()


def main(stop: float = STOP) -> None:
    """Print the table."""
    one = coupled_route.together(stop)
    with tempfile.TemporaryDirectory() as folder:
        files = exported(pathlib.Path(folder), coupled_route.ACCURACY)
        print("H/Ts  largest and rms difference over the largest value, of " + ", ".join(MEASURED))
        for m in HELD:
            far = coupled_route.off(coupled(files, m, stop), one, m).values()
            print(f"{m:4d}  " + "  ".join(f"{most:.1e} {mean:.1e}" for most, mean in far), flush=True)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:2]))

"""The process in which the code of an FMU runs: answers questions on standard input, one line of JSON each.

    {"do": "open", "file": ..., "starts": {...}, ...}    unpack, load, instantiate
    {"do": "step", "from": t | null, "step": h, "inputs": [...]}    doStep(t, h) unless null, set, get
    {"do": "save"}  {"do": "load", "token": k}  {"do": "free", "token": k}

What the code prints goes to standard error, and a mark behind it when a question ends in an error. The process ends as
soon as its standard input does, even inside the FMU.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
import zipfile
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from fairlead.foreign.refusals import FAILED

Named = list[list[Any]]  # [kind, value reference] of variables
FLOATS = ("Real", "Float64", "Float32")
DISCARD, TERMINATED = 2, 3  # fmi2Status and fmi2StatusKind, FMI 2.0.4, sections 2.1.3 and 4.2.3


class Instance:
    """An FMU of version 2 or 3 that is loaded; begins with the first step."""

    def __init__(self, asked: dict[str, Any]) -> None:
        """Unpack, load and instantiate it, and set what is to be set before the start."""
        with zipfile.ZipFile(asked["file"]) as archive:
            archive.extractall(asked["folder"])  # it takes .. and leading slashes out of names
        self.version, self.begun = asked["version"], False
        given = {"guid": asked["token"], "unzipDirectory": asked["folder"], "modelIdentifier": asked["identifier"],
                 "instanceName": asked["name"]}  # fmt: skip
        self.states: dict[int, Any] = {}
        self.number = 0
        self.past = bool(asked["keeps_state"])  # it may be set back to a time before
        self.fmu: Any = (FMU2Slave if self.version == 2 else FMU3Slave)(**given)
        self.fmu.instantiate()
        self.inputs, self.outputs = by_kind(asked["inputs"]), by_kind(asked["outputs"])
        for kind, reference, value in asked["starts"]:
            self.set(kind, [reference], [value])

    def step(self, begin: float, at: float | None, step: float, inputs: list[Any]) -> dict[str, Any]:
        """Go on from `at` by `step` unless that is None, give it the inputs, and take its outputs."""
        if not self.begun:
            self.start(begin, inputs)
        elif at is not None:
            ended = self.do_step(at, step)
            if ended is not None and ended[1]:
                return {"error": f"it asks to end the simulation at {at + step:.9g} s"}
            if ended is not None and ended[2]:
                return {"error": f"it came back early, at {ended[3]:.9g} s, and nobody allowed it"}
        self.give(inputs)
        found = [0.0] * sum(len(references) for _, references, _ in self.outputs)
        for kind, references, places in self.outputs:
            for place, value in zip(places, self.get(kind, references), strict=True):
                found[place] = float(value)
                if kind not in FLOATS and int(found[place]) != int(value):
                    return {"error": f"a {kind} output is {value}, which no signal holds exactly"}
        return {"outputs": found}

    def do_step(self, at: float, step: float) -> tuple[Any, ...] | None:
        """Step; of FMI 3 what it says: event, end, early return, time. FMI 2 discards a step at which it ends."""
        try:
            said: tuple[Any, ...] | None = self.fmu.doStep(at, step, not self.past)
            return said
        except FMICallException as error:
            if self.version == 2 and error.status == DISCARD and self.fmu.getBooleanStatus(TERMINATED):
                return False, True, False, at
            raise

    def start(self, begin: float, inputs: list[Any]) -> None:
        """Initialise at `begin`."""
        self.begun = True
        if self.version == 2:
            self.fmu.setupExperiment(startTime=begin)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=begin)
        self.give(inputs)
        self.fmu.exitInitializationMode()

    def give(self, inputs: list[Any]) -> None:
        """Set all inputs."""
        for kind, references, places in self.inputs:
            self.set(kind, references, [inputs[k] for k in places])

    def set(self, kind: str, references: list[int], values: list[Any]) -> None:
        """Set variables of one type."""
        getattr(self.fmu, f"set{self._named(kind)}")(references, values)

    def get(self, kind: str, references: list[int]) -> list[Any]:
        """Variables of one type."""
        return list(getattr(self.fmu, f"get{self._named(kind)}")(references))

    def _named(self, kind: str) -> str:
        """How the calls of the standard name a type."""
        return kind if kind != "Enumeration" else "Integer" if self.version == 2 else "Int64"

    def save(self) -> dict[str, Any]:
        """Keep where it is, under a number."""
        self.number += 1
        self.states[self.number] = self.fmu.getFMUState()
        return {"token": self.number}

    def load(self, token: int) -> dict[str, Any]:
        """Go to where it was."""
        self.fmu.setFMUState(self.states[token])
        return {}

    def free(self, token: int) -> dict[str, Any]:
        """Forget where it was."""
        self.fmu.freeFMUState(self.states.pop(token))
        return {}


def by_kind(variables: Named) -> list[tuple[str, list[int], list[int]]]:
    """Type, value references and places in the list, of each type that occurs."""
    kinds: dict[str, tuple[list[int], list[int]]] = {}
    for place, (kind, reference) in enumerate(variables):
        references, places = kinds.setdefault(kind, ([], []))
        references.append(reference)
        places.append(place)
    return [(kind, *lists) for kind, lists in kinds.items()]


def answer(question: dict[str, Any], instances: list[Instance]) -> dict[str, Any]:
    """What is asked, done; what goes wrong in it is told."""
    try:
        match question["do"]:
            case "open":
                instances.append(Instance(question))
                return {}
            case "step":
                return instances[0].step(question["begin"], question["from"], question["step"], question["inputs"])
            case "save":
                return instances[0].save()
            case what:
                return dict(getattr(instances[0], what)(question["token"]))
    except Exception as error:  # noqa: BLE001 - FMPy raises what it likes; all of it is told over there
        return {"error": f"{type(error).__name__}: {error}".rstrip(". ")}


def read(lines: queue.SimpleQueue[bytes]) -> None:
    """Take questions in; when there are no more, nobody waits for an answer."""
    for line in sys.stdin.buffer:
        lines.put(line)
    os._exit(0)


def main() -> None:
    """Answer until the questions end."""
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what foreign code prints is no answer
    lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    threading.Thread(target=read, args=(lines,), daemon=True).start()
    instances: list[Instance] = []
    said: dict[str, Any] = {}
    while True:
        if "error" in said:
            os.write(2, FAILED)
        out.write(json.dumps(said).encode() + b"\n")
        out.flush()
        said = answer(json.loads(lines.get()), instances)


if __name__ == "__main__":
    main()

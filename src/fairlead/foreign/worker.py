"""The process in which the code of an FMU runs: answers questions on standard input, one line of JSON each.

    {"do": "open", "file": ..., "inputs": [...], ...}    unpack, load, instantiate, set what is set before the start
    {"do": "step", "to": t, "inputs": [...]}             initialise there at first; then bring it to t, set, get
    {"do": "save"}  {"do": "load", "token": k}  {"do": "free", "token": k}

    inputs, outputs   [type, reference, elements, place, clocks] of each signal
    structure, starts [type, reference, elements, [[place, value], ...]]
    clocks            [name, reference, timing, interval or null, shift] of those that tick by themselves
    intervals         [reference, seconds] of clocks, as the netlist gives them
    watched           [reference, clocks at whose ticks alone it is asked] of output clocks

Calls under way are written to the memory that the command names (underway.py).
What the code prints goes to standard error, and a mark behind it when a question ends in an error. The process ends as
soon as its standard input does, even inside the FMU.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
from typing import Any

from fairlead.foreign.events import Told
from fairlead.foreign.instance import Instance
from fairlead.foreign.refusals import FAILED
from fairlead.foreign.underway import Underway


def answer(question: dict[str, Any], instances: list[Instance], underway: Underway) -> dict[str, Any]:
    """What is asked, done; what goes wrong in it is told."""
    try:
        match question["do"]:
            case "open":
                instances.append(Instance(question, underway))
                return {}
            case "step":
                return instances[0].step(question["to"], question["inputs"])
            case "save":
                return instances[0].save()
            case what:
                return dict(getattr(instances[0], what)(question["token"]))
    except Told as told:
        return {"error": str(told)}
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
    instances, underway = list[Instance](), Underway(sys.argv[1])
    said: dict[str, Any] = {}
    while True:
        if "error" in said:
            os.write(2, FAILED)
        out.write(json.dumps(said).encode() + b"\n")
        out.flush()
        said = answer(json.loads(lines.get()), instances, underway)


if __name__ == "__main__":
    main()

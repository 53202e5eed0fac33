"""The engine `ida`, as Python knows it."""

from __future__ import annotations

from fairlead.integrate.engine import Advance, Engine
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.problem import Instance, Run
from fairlead.integrate.rodas.engine import RODAS


def sundials_loop(problem: Instance, run: Run, memory: Memory) -> Advance:
    """Steps by SUNDIALS IDA, the rest by the compiled loop of `rodas`."""
    from fairlead.integrate.ida.loop import SundialsLoop

    return SundialsLoop(problem, run, memory)


IDA = Engine(
    "ida", RODAS.module, RODAS.sources, loop=sundials_loop, chooses_steps=True,
    not_saved="The engine ida keeps the past of a run in memory of SUNDIALS, which cannot be copied",
)  # fmt: skip

"""The engines by name."""

from __future__ import annotations

from fairlead.integrate.engine import Engine
from fairlead.integrate.ida.engine import IDA
from fairlead.integrate.problem import Run
from fairlead.integrate.rodas.engine import RODAS
from fairlead.integrate.stepping.engine import STEPPING

ENGINES = {engine.name: engine for engine in (RODAS, STEPPING, IDA)}


def engine_of(run: Run) -> Engine:
    """The engine of a run, which names one or brings its own. Raises ValueError for a name that there is not."""
    if isinstance(run.engine, Engine):
        return run.engine
    if run.engine not in ENGINES:
        raise ValueError(f"engine = {run.engine!r} must be one of {', '.join(ENGINES)}, or an Engine.")
    return ENGINES[run.engine]

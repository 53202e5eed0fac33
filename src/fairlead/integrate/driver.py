"""The Python side of a run: calls the compiled loop slice by slice and hands over what it recorded."""

from __future__ import annotations

from fairlead.integrate.protocol import OnBlock, Outcome, Problem, Run


def integrate(problem: Problem, run: Run, on_block: OnBlock | None = None) -> Outcome:
    """Integrate `problem` over `run`; hand each `Block` to `on_block`, or keep them in the outcome."""
    raise NotImplementedError

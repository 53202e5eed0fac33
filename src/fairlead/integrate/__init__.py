"""Integrators for M y' = f(t, y) with zones: one protocol, one public function."""

from fairlead.integrate.problem import Block, End, Outcome, Pattern, Problem, Run, Status
from fairlead.integrate.run import integrate

__all__ = ["Block", "End", "Outcome", "Pattern", "Problem", "Run", "Status", "integrate"]

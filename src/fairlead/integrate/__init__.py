"""Integrators for M y' = f(t, y) with zones: one protocol, one public function."""

from fairlead.integrate.driver import integrate
from fairlead.integrate.protocol import Block, End, Outcome, Pattern, Problem, Run, Status

__all__ = ["Block", "End", "Outcome", "Pattern", "Problem", "Run", "Status", "integrate"]

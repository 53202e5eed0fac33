"""Integrators for M y' = f(t, y) with zones: one protocol, one public function."""

from fairlead.integrate.driver import integrate
from fairlead.integrate.protocol import Block, Outcome, Pattern, Problem, Run, Status

__all__ = ["Block", "Outcome", "Pattern", "Problem", "Run", "Status", "integrate"]

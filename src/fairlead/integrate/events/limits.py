"""Where a guard is at its limit: so near zero that only rounding tells on which side."""

from __future__ import annotations

ROUNDING = 1e-3
"""How far below zero, in guard tolerances, a guard still counts as at its limit: further down it is inside
its zone and will cross by itself. A contact at rest just inside a border would else be sent to and fro."""

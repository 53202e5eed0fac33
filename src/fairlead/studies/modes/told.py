"""Modes as a record for JSON, and as CSV."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np

from fairlead.studies.modes.spectrum import Mode
from fairlead.studies.modes.squeal import Pattern
from fairlead.studies.modes.table import Modes

HEADER = ("mode", "real [1/s]", "imaginary [1/s]", "frequency [Hz]", "damping", "participation")


def record_of(found: Modes) -> dict[str, Any]:
    """A record for JSON, numbers in SI; a response as amplitude and phase [deg]."""
    one = found.response
    return {
        "model": found.model, "t": found.t, "zones": found.zones, "held": found.held, "at_rest": found.at_rest,
        "zeros": vars(found.zeros),
        "modes": [_mode(each) for each in found.modes], "remarks": list(found.remarks),
        "response": None if one is None else {
            "in": one.acting, "out": one.out, "unit": one.unit, "frequency": one.frequencies.tolist(),
            "amplitude": np.abs(one.values).tolist(), "phase": one.phase.tolist(),
        },
        "patterns": [_pattern(each) for each in found.patterns],
    }  # fmt: skip


def as_csv(found: Modes) -> str:
    """A line for each mode."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER)
    for number, one in enumerate(found.modes, 1):
        shares = " ".join(f"{name}={share:.4f}" for name, share in one.participation.items())
        writer.writerow([number, one.value.real, one.value.imag, one.frequency, one.damping, shares])
    return text.getvalue()


def _mode(one: Mode) -> dict[str, Any]:
    return {"real": one.value.real, "imaginary": one.value.imag, "frequency": one.frequency, "damping": one.damping,
            "participation": one.participation}  # fmt: skip


def _pattern(one: Pattern) -> dict[str, Any]:
    return {"changes": list(one.changes), "mode": None if one.mode is None else _mode(one.mode),
            "sentence": one.sentence}  # fmt: skip

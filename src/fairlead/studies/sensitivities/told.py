"""Sensitivities as a record for JSON, and as CSV."""

from __future__ import annotations

import csv
import io
from typing import Any

from fairlead.studies.sensitivities.table import Sensitivities


def record_of(found: Sensitivities) -> dict[str, Any]:
    """A record for JSON, numbers in SI."""
    return {
        "model": found.model, "runs": found.runs,
        "figures": {name: {"value": value, "unit": found.units[name], "noise": found.noise[name]}
                    for name, value in found.figures.items()},
        "parameters": dict(found.parameters),
        "derivatives": [vars(one) for one in found],
    }  # fmt: skip


def as_csv(found: Sensitivities) -> str:
    """A line for each derivative, numbers in full."""
    text = io.StringIO()
    rows = [vars(one) for one in found]
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()

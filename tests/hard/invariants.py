"""What every run must keep, whatever it shows: finite numbers, energy that adds up, contacts that do what they say."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fairlead.results import Result

CLOSURE_PER_ACCURACY = 10.0  # energy that may be missing, of what passed; 1 is what physics 8 asks at 1e-6
LEAST_ENERGY = 1e-9  # J; below it nothing passed
HELD_SLIP = 1.1e-6  # m/s; `stick_speed` is what a contact may still have when it is caught
PASSIVE = 1e-9  # of what was dissipated; rounding


def check(result: Result, treatment: str, lenient: Mapping[str, float]) -> None:
    """Raises AssertionError with a sentence. `lenient` gives factors for `closure` by name."""
    values = result.columns()
    assert np.isfinite(values).all(), "a recorded number is not finite"
    assert (np.diff(result.t) >= 0).all(), "time runs backward"
    _energy(result, treatment, lenient.get("closure", 1.0))
    if treatment == "hold":
        _held(result)


def _energy(result: Result, treatment: str, factor: float) -> None:
    energy, accuracy = result.run["energy"], result.run["settings"]["accuracy"]
    if energy["closure"] is None:
        return
    passed = max(abs(energy[name]) for name in ("supplied", "dissipated", "stored_change"))
    allowed = factor * CLOSURE_PER_ACCURACY * accuracy
    if passed > LEAST_ENERGY:
        assert energy["closure"] <= allowed, f"energy is missing: closure {energy['closure']:.2g}, above {allowed:.2g}"
    if treatment == "hold" and "energy.dissipated" in result:
        lost = result["energy.dissipated"]
        back = -np.diff(lost).min(initial=0.0)
        room = PASSIVE * max(np.abs(lost).max(), LEAST_ENERGY) + allowed * passed
        assert back <= room, f"friction gave {back:.2g} J back"


def _held(result: Result) -> None:
    """No slip while the contact holds."""
    for name in (signal.name for signal in result.signals if signal.name.endswith(".bound")):
        slip = name.removesuffix("bound") + "slip"
        if slip in result:
            worst = np.abs(result[slip][result[name] == 1]).max(initial=0.0)
            assert worst <= HELD_SLIP, f"{slip} is {worst:.2g} m/s while the contact holds"

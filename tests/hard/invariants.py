"""What every run must keep, whatever it shows: finite numbers, energy that adds up, contacts that do what they say."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from fairlead.results import Result

CLOSURE_PER_ACCURACY = 10.0  # energy that may be missing, of what passed or is nominal; physics 8 has 1
NOMINAL_ENERGY = 0.1  # J; 10 N times 10 mm, the sizes that the accuracy of a run refers to
HELD_SLIP = 1.1e-6  # m/s; `stick_speed` is what a contact may still have when it is caught
SLIP_PER_ACCURACY = 0.01  # m/s; a tenth of the 0.1 m/s that the accuracy refers to


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
    missing = abs(energy["stored_change"] + energy["dissipated"] - energy["supplied"])
    passed = missing / energy["closure"] if energy["closure"] > 0 else 0.0
    allowed = factor * CLOSURE_PER_ACCURACY * accuracy * max(passed, NOMINAL_ENERGY)
    told = (
        f"energy is missing: {missing:.2g} J of {passed:.2g} J (closure {energy['closure']:.2g}), above {allowed:.2g} J"
    )
    assert missing <= allowed, told
    if treatment == "hold" and "energy.dissipated" in result:
        back = -np.diff(result["energy.dissipated"]).min(initial=0.0)
        assert back <= allowed, f"friction gave {back:.2g} J back"


def _held(result: Result) -> None:
    """No slip while the contact holds."""
    for name in (signal.name for signal in result.signals if signal.name.endswith(".bound")):
        slip = name.removesuffix("bound") + "slip"
        if slip in result:
            worst = np.abs(result[slip][result[name] == 1]).max(initial=0.0)
            assert worst <= HELD_SLIP + SLIP_PER_ACCURACY * result.run["settings"]["accuracy"], (
                f"{slip} is {worst:.2g} m/s while the contact holds"
            )

"""Two contacts in series, against a method that knows neither zones nor events.

Device, hose and core: each contact is loaded by the friction of the other, so a wrong break-away of one
upsets the other (hazards H2, H4, H6 of physics section 1.9). `tests/reference/sandwich.py` steps through the
same scene with set-valued friction after Moreau; it shares nothing with fairlead, not even the idea of a zone.
"""

import numpy as np
import pytest

from tests.reference.sandwich import Sandwich

EVERY = 5e-3  # s, as the model records


@pytest.fixture(scope="module")
def moreau() -> dict[float, np.ndarray]:
    """Positions of hose and core (n, 2) [m] by the step h [s] of the reference."""
    return {h: Sandwich().positions(stop=6.0, step=h, every=EVERY)[:, 1:] for h in (4e-5, 2e-5)}


def positions(result) -> np.ndarray:
    """Positions of hose and core (n, 2) [m] on the grid of the reference."""
    times = np.minimum(EVERY * np.arange(round(6.0 / EVERY) + 1), result.t[-1])
    return np.stack([result.at(f"{body}.x", times) for body in ("hose", "core")], axis=1)


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Greatest distance of a body from where the other computation has it [m]."""
    return float(np.abs(one - other).max())


@pytest.fixture(scope="module")
def held(bundled) -> np.ndarray:
    """With the exact hold, converged."""
    return positions(bundled("sandwich", {"method": "hold", "run.accuracy": 1e-8}))


def test_the_reference_converges_to_the_exact_hold(moreau, held) -> None:
    """Two ways to say the same: set-valued steps of first order, and events with held contacts."""
    coarse, fine = distance(moreau[4e-5], held), distance(moreau[2e-5], held)
    assert fine < 4e-6  # of 20 mm; the hose meets a speed jump of some 0.1 m/s within a step of 20 us
    assert coarse / fine == pytest.approx(2.0, rel=0.05)
    # With the first-order error taken out (Richardson), what is left is a hundred times smaller.
    assert distance(2 * moreau[2e-5] - moreau[4e-5], held) < 1e-7


@pytest.mark.parametrize(("creep", "published"), [(1e-4, 6e-5), (1e-5, 6e-6)])
def test_binding_is_off_by_what_it_creeps(bundled, held, creep: float, published: float) -> None:
    """The specification measured 6e-5 and 6e-6 m on a scene like this one; the scale is creep times time stuck."""
    result = bundled("sandwich", {"creep": f"{creep} m/s"})
    assert distance(positions(result), held) < published


def test_the_error_of_binding_is_of_first_order_in_the_creep(bundled, held) -> None:
    errors = [distance(positions(bundled("sandwich", {"creep": f"{c} m/s"})), held) for c in (1e-4, 1e-5, 1e-6)]
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(10, rel=0.1)


def test_accuracy_changes_nothing_that_can_be_seen(bundled, held) -> None:
    rough = positions(bundled("sandwich", {"method": "hold"}))
    assert distance(rough, held) < 1e-8  # 1e-6 of the 10 mm that count as 1


@pytest.mark.parametrize("method", ["hold", "binding"])
def test_neither_contact_ever_carries_more_than_stiction(bundled, method: str) -> None:
    result = bundled("sandwich", {"method": method})
    for pad, stiction in (("outer", 100 * 0.40), ("inner", 90 * 0.50)):
        # At the left of a switch the slip is where the switch was located, to 1e-9 m/s; a bound contact turns that
        # into force with its slope of 1.25 F_s over 0.1 mm/s.
        rounding = {"hold": 1e-6, "binding": 1e-9 * 1.25 / 1e-4}[method]
        assert np.abs(result[f"{pad}.friction"]).max() <= stiction * (1 + rounding)


def test_the_contacts_do_not_play_ping_pong(bundled) -> None:
    """Four stick-slip transitions and a few relaxations in each of three periods: not hundreds of switches."""
    assert len(bundled("sandwich", {"method": "hold", "run.accuracy": 1e-8}).events) < 100
    assert len(bundled("sandwich", {"creep": "1e-4 m/s"}).events) < 250

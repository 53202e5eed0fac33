"""All engines on problems with published solutions, and on a bouncing and a sticking one with a closed form."""

from __future__ import annotations

import functools
import subprocess
import sys

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from tests.integrate import published
from tests.integrate.problems import belt_block, bent_dae, falling_ball, stick_slip_times
from tests.integrate.test_lightness import BENEATH

CHOICES = {
    "rodas5p": {}, "rodas3p": {"method": "rodas3p"}, "ida": {"engine": "ida"}, "stepping": {"engine": "stepping"},
}  # fmt: skip
LOCATING = ("rodas5p", "rodas3p", "ida")
"""Engines that locate every switch."""
ACCURACY = {"rodas5p": 1e-6, "rodas3p": 1e-4, "ida": 1e-5, "stepping": 3e-5}
"""Each engine where it is at home: of order five, three, up to five, three where no algebraic unknown varies."""
LOST = 100
"""Errors of single steps add up, and stiff problems amplify them where they turn: two decades are lost at most, as
in the work-precision diagrams of the source."""
PROBLEMS = (
    "robertson", "hires", "pollution", "van_der_pol", "akzo_nobel", "transistor_amplifier", "ring_modulator",
)  # fmt: skip
OTHER = {
    ("rodas3p", "ring_modulator"): 1e-3, ("ida", "transistor_amplifier"): 1e-4,
    ("stepping", "akzo_nobel"): 1e-3, ("stepping", "transistor_amplifier"): 1e-3,
}  # fmt: skip
"""Where that would take 80 000 or 13 000 steps; and where it is more than the stepping engine, of order two, can: its
algebraic unknowns are means over a step, so that they are right to order one at its end."""
IN_PART = {("ida", "ring_modulator"), ("stepping", "ring_modulator")}
"""150 000 steps of a multistep method whose loop is in Python: twenty seconds. And ringing whose phase a method of
order two has right at 1e-6 at last (600 000 steps). See the test of its first tenth."""


@functools.cache
def needs(engine: str) -> str:
    """Why this engine cannot be tried here, or nothing."""
    if engine != "ida":
        return ""
    try:
        import sksundae.ida  # noqa: F401
    except ImportError:
        return "the engine ida needs scikit-sundae: pip install 'fairlead[ida]'"
    return ""


def solve(problem, stop, engine, **settings):
    if reason := needs(engine):
        pytest.skip(reason)
    outcome = integrate(problem, Run(stop=stop, **CHOICES[engine], **settings))
    assert outcome.ok, outcome.sentence
    return outcome


PAIRS = [
    (name, engine) for name in PROBLEMS for engine in CHOICES
    if (engine, name) not in IN_PART
]  # fmt: skip
# Steps tried in vain may overflow an exponential or leave the domain of a root: they are tried again shorter.
steps_in_vain = pytest.mark.filterwarnings("ignore:overflow encountered", "ignore:invalid value encountered")


@steps_in_vain
@pytest.mark.parametrize(("name", "engine"), PAIRS)
def test_the_published_solution_is_reached(name, engine):
    accuracy = OTHER.get((engine, name), ACCURACY[engine])
    case = getattr(published, name)(accuracy)
    outcome = solve(case.problem, case.stop, engine, first_step=case.first_step)
    lost = outcome.counters.steps if (engine, name) == ("stepping", "robertson") else LOST
    assert case.error(outcome.y) < lost * accuracy


@steps_in_vain
@pytest.mark.parametrize("engine", LOCATING)
@pytest.mark.parametrize("name", ["hires", "akzo_nobel", "van_der_pol"])
def test_the_error_falls_with_the_accuracy(name, engine):
    errors = []
    for accuracy in (1e-3, 1e-5, 1e-7):
        case = getattr(published, name)(accuracy)
        errors.append(case.error(solve(case.problem, case.stop, engine, first_step=case.first_step).y))
    assert errors[2] < errors[0] / 100


@steps_in_vain
@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
def test_stepping_is_not_held_up_by_ringing(accuracy):
    """By the midpoint rule alone Robertson's problem took 600 000 steps, and missed. A step may err by a weight."""
    case = published.robertson(accuracy)
    outcome = solve(case.problem, case.stop, "stepping", first_step=case.first_step, max_steps=20_000)
    assert case.error(outcome.y) < outcome.counters.steps * accuracy


TENTH = [("ida", 1e-4, LOST), ("stepping", 1e-5, 1e4), ("stepping", 1e-6, 1e4)]


@pytest.mark.parametrize(("engine", "accuracy", "lost"), TENTH)
def test_the_first_tenth_of_the_ring_modulator_is_as_by_rodas(engine, accuracy, lost):
    """Of order two `stepping` loses four decades, in the phase of what rings; it gains one with each of accuracy."""
    fine, rough = published.ring_modulator(1e-8), published.ring_modulator(accuracy)
    exact = solve(fine.problem, 1e-4, "rodas5p").y
    found = solve(rough.problem, 1e-4, engine).y
    assert np.max(np.abs(found - exact) / (np.abs(exact) + rough.scale)) < lost * accuracy


@pytest.mark.parametrize("engine", LOCATING)
def test_an_algebraic_part_whose_slope_depends_on_the_state(engine):
    accuracy = ACCURACY[engine]
    problem, exact = bent_dae(absolute=accuracy, relative=accuracy)
    outcome = solve(problem, 5.0, engine)
    assert np.abs(outcome.y - exact(5.0)).max() < LOST * accuracy


@pytest.mark.parametrize("engine", LOCATING)
def test_a_ball_bounces_at_the_times_of_the_closed_form(engine):
    # g = 2, height 1: first impact at t = 1 with speed 2; flights last 2 e^n v/g.
    accuracy = ACCURACY[engine]
    outcome = solve(falling_ball(restitution=0.5, absolute=accuracy, relative=accuracy), 2.8, engine)
    np.testing.assert_allclose(outcome.events["t"], [1.0, 2.0, 2.5, 2.75], rtol=LOST * accuracy)


@pytest.mark.parametrize("engine", CHOICES)
def test_a_block_sticks_and_slips_at_the_times_of_the_closed_form(engine):
    accuracy = ACCURACY[engine]
    first, slip, stick = stick_slip_times()
    expected = [first + (k // 2) * (slip + stick) + (k % 2) * slip for k in range(12)]
    scales = {"absolute": [0.1 * accuracy, accuracy, 10 * accuracy], "relative": accuracy}
    outcome = solve(belt_block(**scales), 5.0, engine)
    assert outcome.events["after"].tolist() == [2, 0] * 6
    np.testing.assert_allclose(outcome.events["t"], expected, rtol=LOST * accuracy)


def test_nothing_else_of_fairlead_is_loaded_by_all_this():
    """The problems and every engine, in a process of their own: of fairlead only integrate and what keeps its code."""
    program = "\n".join([
        "import sys, fairlead",
        "before = set(sys.modules)",
        "from fairlead.integrate import Run, integrate",
        "from tests.integrate import problems, published",
        f"for engine in {[e for e in ('rodas', 'stepping', 'ida') if not needs(e)]}:",
        "    case = published.hires(1e-3)",
        "    assert integrate(case.problem, Run(stop=1.0, engine=engine)).ok",
        "    assert integrate(problems.belt_block(), Run(stop=1.0, engine=engine)).ok",
        "print(' '.join(name for name in set(sys.modules) - before if name.startswith('fairlead.')))",
    ])  # fmt: skip
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    loaded = done.stdout.split()
    assert "fairlead.integrate.run" in loaded
    others = {name for name in loaded if not name.startswith("fairlead.integrate")}
    assert others <= BENEATH

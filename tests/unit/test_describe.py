"""`fairlead describe TYPE`: all that a class declares, and equations as an engineer writes them."""

import functools
import re

import pytest
import sympy
from fairlead.components.friction.curve import Curve
from fairlead.components.friction.hold import Hold

from fairlead.component import (
    Component,
    Law,
    Parameter,
    Part,
    State,
    Translational,
    Unknown,
    Zones,
    guard,
    zone,
)
from fairlead.component.registry import known_types
from fairlead.component.trace import symbol
from fairlead.describe.formula import formula
from fairlead.describe.page import describe
from fairlead.errors import UsageError

TYPES = known_types()


@functools.cache
def page_of(name: str) -> str:
    """What is said of a type of the library; of Contact it takes ten seconds to write down."""
    return describe(name, TYPES)


class Stop(Component):
    """An elastic stop with a damper and a lag, for these tests."""

    exempt = {"units": "a lag of 1 s that nobody writes"}
    a, b = Translational("one end"), Translational("other end")
    stiffness = Parameter("N/m", "Force per depth.", above=0)
    gap = Parameter("m", "Free way.", default=0.01, least=0, most=1)
    pad = Part(Curve, "Friction.", default=0.3)
    depth = State("m", "A lag.")
    force = Unknown("N", "Contact force.")
    zones = Zones("apart", "pressed")

    @zone("apart")
    def apart(p, a, b, force, depth):
        """Nothing touches."""
        return Law(a=0, b=0, force=force, depth=-depth)

    @zone("pressed")
    def pressed(p, a, b, force, depth):
        """The stop pushes."""
        return Law(a=-force, b=force, force=force - p.stiffness * (b.x - a.x - p.gap), depth=b.x - a.x - depth)

    @guard("apart", to="pressed", unit="1")
    def touches(p, a, b):
        """The gap has closed."""
        return (b.x - a.x - p.gap) / p.stiffness

    @guard("pressed", to="apart", unit="N")
    def leaves(p, force):
        """It would pull."""
        return -force


@pytest.fixture(scope="module")
def stop() -> str:
    return describe("Stop", {"Stop": Stop})


def line_with(text: str, *words: str) -> str:
    """The one line that holds all words."""
    return next(line for line in text.splitlines() if all(word in line for word in words))


def test_ports_come_with_domain_and_variables(stop: str) -> None:
    assert line_with(stop, "one end", "translational", "x [m], v [m/s]; force [N]")


def test_parameters_come_with_unit_range_default_and_sentence(stop: str) -> None:
    assert line_with(stop, "stiffness", "[N/m] > 0", "required", "Force per depth.")
    assert line_with(stop, "gap", "[m] >= 0 and <= 1", "= 0.01", "Free way.")


def test_transitions_say_from_to_guard_and_when(stop: str) -> None:
    assert line_with(stop, "apart", "-> pressed", "touches", "b.x - a.x >= gap")
    assert line_with(stop, "pressed", "-> apart", "leaves", "force <= 0")
    assert line_with(stop, "touches", "The gap has closed.")


def test_a_balance_gives_its_unknown_and_a_state_has_a_rate(stop: str) -> None:
    assert "    force = stiffness*(b.x - a.x - gap)" in stop.splitlines()
    assert "    d(depth)/dt = b.x - a.x - depth" in stop.splitlines()


def test_a_zone_carries_the_sentence_of_its_law(stop: str) -> None:
    assert line_with(stop, "pressed", "The stop pushes.")


def test_kinds_of_a_part_are_listed_with_their_parameters_and_formula(stop: str) -> None:
    assert line_with(stop, "curve: stribeck")
    assert line_with(stop, "coefficient(v) = coulomb + (stiction - coulomb)*exp(-v/velocity)")


def test_a_held_motion_is_said_to_be_kept_by_its_force() -> None:
    assert "    slip is kept at 0 by force" in page_of("Contact").splitlines()


def test_laws_leave_parts_open() -> None:
    assert "normal*curve.coefficient(slip)" in describe("Hold", TYPES)


def test_inertia_and_prescribed_motion_are_told() -> None:
    assert "flange.force = mass*flange.a" in describe("Mass", TYPES)
    assert "flange does not move" in describe("Ground", TYPES)
    assert "v = motion'(t)" in describe("MotionSource", TYPES)


def test_ties_are_told_with_the_forces_they_pass_on() -> None:
    class Lever(Component):
        """Moves b twice as far."""

        a, b = Translational(), Translational()
        arm = Parameter("m", "Shift.", default=0.0)

        def law(p):
            return Law()

        def ties(p):
            return (("a", "b", 2.0, p.arm),)

    lines = describe("Lever", {"Lever": Lever}).splitlines()
    assert "  b.x = arm + 2*a.x, always" in lines
    assert "  a.force = -2*b.force" in lines


SOON = 5
"""Of so many types, one is described in `make test`; the rest in `make test-all`."""
PAGES = [pytest.param(name, marks=[pytest.mark.slow] if k % SOON else []) for k, name in enumerate(sorted(TYPES))]


@pytest.mark.parametrize("name", PAGES)
def test_every_type_has_a_page_with_its_parameters_and_traced_equations(name: str) -> None:
    page = page_of(name)
    kinds = getattr(TYPES[name], "members", {"": TYPES[name]}).values()
    assert all(parameter in page for kind in kinds for parameter in kind.declaration.parameters)
    assert "cannot be traced" not in page
    assert not re.search(r"\b(p|T|own|port|in):\w", page)  # keys of the tracer, not names of the author


@pytest.mark.slow
def test_every_guard_of_a_kind_is_in_the_table_of_contact() -> None:
    assert all(guard in page_of("Contact") for guard in Hold.declaration.guards)


def test_all_types_can_be_listed() -> None:
    page = describe("types", TYPES)
    assert all(name in page for name in TYPES)


def test_a_wrong_name_gets_a_suggestion() -> None:
    with pytest.raises(UsageError, match=r"no component type Sprng\. Did you mean Spring\?"):
        describe("Sprng", TYPES)


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        ("k*(b - a - l)", "k*(b - a - l)"),
        ("-k*v", "-k*v"),
        ("m*v**2/2", "m*v^2/2"),
        ("2*c*(k*m)**Rational(1, 2)", "2*c*sqrt(k*m)"),
        ("-c*(a - b)", "c*(b - a)"),
        ("Abs(b - a)/c", "|a - b|/c"),
        ("x**-2*k", "k/x^2"),
        ("(-x)**3", "-x^3"),
        ("k*exp(-(v/w)**2)", "k*exp(-v^2/w^2)"),
    ],
)
def test_formulas_read_like_formulas(expression: str, text: str) -> None:
    names = {n: symbol(("p:" if n in "klmcw" else "own:") + n) for n in "abcklmvwx"}
    assert formula(sympy.sympify(expression, locals=names), {}) == text

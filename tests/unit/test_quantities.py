"""Quantities: one finite number, a space, one unit; SI inside."""

import math
import re
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fairlead.quantities import (
    KINDS,
    METRIC,
    NONE,
    PLAIN,
    QuantityError,
    parse_unit,
    quantity,
    si,
    unit_text,
)

# The factors are definitions: SI brochure (9th ed., tables 4, 8); knot and pound-force as in NIST SP 811.
DEFINED = [
    ("12 kN", "N", 12e3),
    ("35 mm", "m", 0.035),
    ("1.6 kg/m", "kg/m", 1.6),
    ("8 kN/mm", "N/m", 8e6),
    ("0.1 mm/s", "m/s", 1e-4),
    ("90 deg", "rad", math.pi / 2),
    ("2 rev", "rad", 4 * math.pi),
    ("60 rpm", "rad/s", 2 * math.pi),
    ("3 rad/s", "rad/s", 3.0),
    ("2 N*m/deg", "N*m/rad", 360 / math.pi),
    ("120 N*m", "N*m", 120.0),
    ("210 bar", "Pa", 210e5),
    ("60 l/min", "m^3/s", 1e-3),
    ("2 m/s²", "m/s^2", 2.0),
    ("50 Hz", "Hz", 50.0),
    ("5 1/s", "Hz", 5.0),
    ("3 µm", "m", 3e-6),
    ("400 V", "V", 400.0),
    ("2 V*A", "W", 2.0),
    ("3 N*m", "J", 3.0),
    ("30 %", "1", 0.3),
    ("1 t", "kg", 1000.0),
    ("-1e3 ms", "s", -1.0),
    ("36 km/h", "m/s", 10.0),
    ("1 lbf", "N", 4.4482216152605),
    ("1 knot", "m/s", 1852 / 3600),
]


@pytest.mark.parametrize(("text", "unit", "expected"), DEFINED)
def test_a_quantity_is_turned_to_si(text, unit, expected):
    assert si(text, unit) == pytest.approx(
        expected, rel=1e-15 * 8
    )  # a few roundings in the product of factors


@pytest.mark.parametrize("unit", KINDS)
def test_a_bare_number_is_si_and_the_example_of_each_unit_is_accepted(unit):
    assert si(3, unit) == 3.0
    assert si("0.25", unit) == 0.25
    assert math.isfinite(si(KINDS[unit][1], unit))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_the_number_of_a_quantity_is_read_to_the_last_bit(number):
    assert si(f"{number!r} N", "N") == number


@pytest.mark.parametrize(
    ("text", "unit", "reason"),
    [
        ("12 kg", "N", "12 kg is a mass, not a force"),
        ("50 Hz", "rad/s", "50 Hz is a frequency, not an angular speed"),
        ("3 rad/s", "Hz", "3 rad/s is an angular speed, not a frequency"),
        ("5 rad", "1", "5 rad is an angle, not a plain number"),
        ("3 J", "N*m", "3 J is an energy, not a torque"),
        ("3 kJ/rad", "N*m/rad", "not a rotational stiffness"),
        ("1 W*s", "N*m", "not a torque"),
        ("1 BTU", "N*m", "not a torque"),
        ("1 N*m*s", "N*m*s/rad", "not a rotational damping coefficient"),
        ("2 N*m", "N*m/rad", "not a rotational stiffness"),
        ("5 m", "1", "5 m is a length, not a plain number"),
    ],
)
def test_another_dimension_is_refused_by_name(text, unit, reason):
    with pytest.raises(QuantityError) as caught:
        si(text, unit)
    assert reason in caught.value.what
    assert unit in caught.value.allowed or "plain number" in caught.value.allowed


@pytest.mark.parametrize(
    "text",
    [
        "",
        " ",
        "N",
        "12kN",
        "1/2 m",
        "1,5 m",
        "1_000 m",
        "nan m",
        "inf m",
        ".inf",
        "1e400 m",
        "1 m + 2 m",
        "12 kN kN",
        "1 (m)",
        "1 m^5",
        "1 m^-5",
        "1 m**99",
        "1 m^0.5",
        "1 m//s",
        "1 /s",
        "1 m*",
        "1 m^",
        "٣ m",
        "20 degC",
        "3 dB",
        "3 bit",
        "4 kNm",
        "4 Nm",
        "1 __class__",
        "1 m.s",
        "1 lambda",
        "1 import os",
        "0x10 m",
    ],
)
def test_what_is_no_length_is_refused(text):
    with pytest.raises(QuantityError):
        si(text, "m")


@pytest.mark.parametrize("value", [None, True, [1], {"a": 1}, 10**400, math.inf, math.nan, 1j, b"1 m"])
def test_what_is_no_finite_number_is_refused(value):
    with pytest.raises(QuantityError):
        si(value, "m")


@pytest.mark.parametrize(
    "text", ["1 " + "m" * 1_000_000, "9" * 1_000_000, "1 " + "m*" * 500_000 + "m", "x" * 10**6]
)
def test_a_text_of_a_megabyte_is_refused_with_a_short_message(text):
    with pytest.raises(QuantityError) as caught:
        si(text, "m")
    assert len(str(caught.value)) < 300


def test_a_unit_has_at_most_forty_characters():
    assert si("1 " + "m*m", "m^2") == 1.0
    with pytest.raises(QuantityError, match="at most 40 characters"):
        si("1 " + "m*s/s*" * 7 + "m", "m^2")


def test_a_torque_without_its_star_is_not_taken_for_a_nautical_mile():
    with pytest.raises(QuantityError, match=r"Did you mean kN\*m\?"):
        si("4 kNm", "m")


def test_an_unknown_unit_gets_a_suggestion():
    with pytest.raises(QuantityError, match=r"Did you mean kN\?"):
        si("4 KN", "N")


def test_the_table_agrees_with_pint():
    import pint

    registry = pint.application_registry
    ours = {
        "L": "liter",
        "l": "liter",
        "t": "tonne",
        "%": "percent",
        "°": "degree",
        "rev": "revolution",
        "1": "",
    }
    for name, (factor, dimension) in {**METRIC, **PLAIN}.items():
        base = registry.Quantity(1.0, ours.get(name, name)).to_base_units()
        powers = dict(base.unit_items())
        names = ("meter", "kilogram", "second", "ampere", "kelvin", "radian")
        assert base.magnitude == pytest.approx(factor, rel=1e-14), name
        assert tuple(powers.get(unit, 0) for unit in names) == dimension[:6], name


def test_usual_units_do_not_import_pint():
    code = (
        "import sys; from fairlead.quantities import si; "
        "si('12 kN', 'N'); si('90 deg', 'rad'); si('1 rpm', 'rad/s'); si('3 N*m*s/rad', 'N*m*s/rad'); "
        "assert 'pint' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize("unit", [*KINDS, "ohm*m", "V/m", "A^2*s", "N^2"])
def test_the_si_text_of_a_dimension_reads_back_as_the_same_dimension(unit):
    dimension = parse_unit(unit).dimension
    assert parse_unit(unit_text(dimension) or "1") == parse_unit(unit_text(dimension) or "1")
    assert parse_unit(unit_text(dimension) or "1").dimension == dimension
    assert parse_unit(unit_text(dimension) or "1").factor == 1.0


def test_a_dimension_with_exponents_beyond_four_has_no_unit():
    with pytest.raises(QuantityError):
        unit_text((5, 0, 0, 0, 0, 0, 0))


def test_a_quantity_of_any_dimension_can_be_read():
    assert quantity("0.35").dimension == NONE
    assert quantity("3 km/h").dimension == parse_unit("m/s").dimension
    with pytest.raises(QuantityError):
        quantity("stribeck")


@pytest.mark.parametrize(("typed", "meant"), [("kgm^2", "kg*m"), ("mms", "mm*s"), ("kNmm", "kN*mm")])
def test_units_that_run_together_get_a_sign_between(typed, meant):
    with pytest.raises(QuantityError, match=rf"Did you mean {re.escape(meant)}\?"):
        si(f"4 {typed}", "N")


@pytest.mark.parametrize(
    ("text", "meant"),
    [("\u22120.3 N", "-0.3 N"), ("\u20133 N", "-3 N"), ("3 000 N", "3000 N"), ("1'300 N", "1300 N"),
     ("1_000 N", "1000 N"), ("1.300,5 N", "1300.5 N"), ("1,300.5 N", "1300.5 N"), ("1,300,000 N", "1300000 N"),
     ("2,5 N", "2.5 N"),
     ("0x10 N", "16 N"), ("0b11", "3"), ("0o17 N", "15 N"), ("1d3 N", "1e3 N"), ("-2.5D-3 N", "-2.5e-3 N"),
     ("0,005 N", "0.005 N"), ("1/3 N", '"{1/3} N"'), ("2 * 3 N", '"{2 * 3} N"'), ("1 000 000", "1000000")],
)  # fmt: skip
def test_a_number_as_others_write_it_is_told_as_it_is_written_here(text, meant):
    with pytest.raises(QuantityError) as caught:
        si(text, "N")
    assert meant in caught.value.allowed


def test_a_comma_that_may_be_either_is_told_both_ways():
    with pytest.raises(QuantityError) as caught:
        si("1,300 N", "N")
    assert "1.300 N or 1300 N" in caught.value.allowed


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [("12 1/s", "Hz", 12.0), ("100 1", "1", 100.0), ("6 1/min", "Hz", 0.1)],
)  # fmt: skip
def test_a_unit_that_begins_with_a_one_is_no_mark_of_thousands(text, unit, value):
    assert si(text, unit) == pytest.approx(value, rel=1e-15)

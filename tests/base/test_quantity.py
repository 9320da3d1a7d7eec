import math
from contextlib import suppress
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pint
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from polhode.base import LENGTH, MASS, PURE, TIME, Quantity, UnitError, read_quantity, to_si
from polhode.base._units import UNITS

REGISTRY = pint.UnitRegistry()
REGISTRY.define("@alias turn = rev")
finite = st.floats(-1e12, 1e12)


@pytest.mark.parametrize(
    ("text", "quantity"),
    [
        ("80deg", Quantity(Fraction(4, 9), 1, PURE)),
        ("80 deg", Quantity(Fraction(4, 9), 1, PURE)),
        ("3000 rpm", Quantity(Fraction(100), 1, TIME**-1)),
        ("-0.2m", Quantity(Fraction(-1, 5), 0, LENGTH)),
        ("−0.2m", Quantity(Fraction(-1, 5), 0, LENGTH)),
        ("+.5 m", Quantity(Fraction(1, 2), 0, LENGTH)),
        ("1e-3 kg", Quantity(Fraction(1, 1000), 0, MASS)),
        ("12*mm", Quantity(Fraction(12, 1000), 0, LENGTH)),
        ("9.81 m/s^2", Quantity(Fraction(981, 100), 0, LENGTH / TIME**2)),
        ("2 pi rad/s", Quantity(Fraction(2), 1, TIME**-1)),
        ("3/s", Quantity(Fraction(3), 0, TIME**-1)),
        ("3 1/s", Quantity(Fraction(3), 0, TIME**-1)),
        ("1/3 m", Quantity(Fraction(1, 3), 0, LENGTH)),
        ("pi/2", Quantity(Fraction(1, 2), 1, None)),
        ("-2*π/3", Quantity(Fraction(-2, 3), 1, None)),
        ("7", Quantity(Fraction(7), 0, None)),
    ],
)
def test_text_is_read_exactly(text, quantity):
    assert read_quantity(text) == quantity


def test_the_value_is_in_si():
    assert read_quantity("180 deg").value == math.pi
    assert read_quantity("1 in").value == 0.0254
    assert read_quantity("60 rpm").value == pytest.approx(2 * math.pi, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "m",
        "nan",
        "inf m",
        "--3",
        "1/0 m",
        "1/0",
        "1e999",
        "1e400 m",
        ".",
        "p",
        "1 rad^-5 Gm^99",
    ],
)
def test_what_is_not_a_finite_number_is_refused(text):
    with pytest.raises(UnitError, match="is not a value; expected a finite number"):
        read_quantity(text)


@pytest.mark.parametrize("text", ["1e9999 m", "1,5 m", "0x10", "2 1", "2 m 3", "1_0", "3 **m"])
def test_what_looks_almost_like_a_number_is_refused(text):
    with pytest.raises(UnitError):
        read_quantity(text)


@given(finite, st.sampled_from(sorted(UNITS)))
def test_values_are_those_of_pint(magnitude, unit):
    text = f"{magnitude!r} {unit}"
    theirs = REGISTRY.Quantity(magnitude, unit.replace("°", "deg")).to_base_units().magnitude
    assert read_quantity(text).value == pytest.approx(theirs, rel=1e-12)


@given(finite)
def test_a_bare_number_is_si_of_whatever_is_asked(number):
    assert to_si(number, MASS, "M") == number
    assert to_si(repr(number), LENGTH / TIME, "v") == number


@given(finite, st.sampled_from(sorted(UNITS)))
def test_every_way_of_giving_a_value_agrees(magnitude, unit):
    dimension = UNITS[unit].dimension
    text = to_si(f"{magnitude!r} {unit}", dimension, "x")
    pair = to_si((magnitude, unit), dimension, "x")
    from_pint = to_si(REGISTRY.Quantity(magnitude, unit.replace("°", "deg")), dimension, "x")
    assert pair == pytest.approx(text, rel=1e-15)
    assert from_pint == pytest.approx(text, rel=1e-12)


@pytest.mark.parametrize(
    "number", [2, 2.0, Fraction(2), Decimal(2), np.float32(2), np.int64(2), sympy.Integer(2)]
)
def test_numbers_of_every_library_are_numbers(number):
    assert to_si(number, MASS, "M") == 2.0
    assert to_si((number, "g"), MASS, "M") == 0.002


def test_pint_in_another_system_of_units_is_still_understood():
    cgs = pint.UnitRegistry(system="cgs")
    assert to_si(cgs.Quantity(3, "dyne * cm"), MASS * LENGTH**2 / TIME**2, "torque") == (
        pytest.approx(3e-7, rel=1e-12)
    )


def test_a_wrong_dimension_names_the_quantity_and_both_dimensions():
    with pytest.raises(UnitError) as caught:
        to_si("3 kg", LENGTH, "a")
    assert str(caught.value) == (
        "a = '3 kg' is a quantity in kg; expected a quantity in m; "
        "give a as a bare SI number or in a unit of that dimension"
    )


def test_an_angle_is_called_an_angle():
    with pytest.raises(UnitError, match="expected a pure number or an angle"):
        to_si((3, "m"), PURE, "theta")
    with pytest.raises(UnitError, match="'2 deg' is a pure number or an angle; expected"):
        to_si("2 deg", LENGTH, "a")


@pytest.mark.parametrize(
    "value",
    [math.nan, -math.inf, "nan", (math.inf, "m"), None, 1j, [1.0], (1, 2), "x" * 500],
)
def test_what_is_not_a_value_is_refused_by_name(value):
    with pytest.raises(UnitError, match=r"^a: .* is not a value") as caught:
        to_si(value, LENGTH, "a")
    assert len(str(caught.value)) < 250


def test_an_integer_too_large_for_a_double_is_refused():
    with pytest.raises(UnitError, match="inf is not a value"):
        to_si(10**5000, LENGTH, "a")


def test_an_unknown_unit_is_refused_by_name():
    with pytest.raises(UnitError, match=r"^theta: the unit 'dog' is not known"):
        to_si((3, "dog"), PURE, "theta")


def test_a_temperature_is_not_mechanical():
    with pytest.raises(UnitError, match=r"^a: 3 kelvin has a dimension other than"):
        to_si(REGISTRY.Quantity(3, "kelvin"), LENGTH, "a")


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused_by_a_unit_error(text):
    with suppress(UnitError):
        assert math.isfinite(read_quantity(text).value)


@pytest.mark.parametrize("text", ["1" * 5000, "0." + "1" * 5000, "1/" + "3" * 5000 + " kg"])
def test_a_number_of_thousands_of_digits_is_refused(text):
    with pytest.raises(UnitError, match=r"a number of 500\d characters"):
        read_quantity(text)

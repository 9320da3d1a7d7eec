"""The one reader of values: units, formulas, and the exact number behind every double."""

import math
from decimal import Decimal
from fractions import Fraction

import pytest

import polhode as ph
from polhode.algebra import read_expression, read_value
from polhode.base import (
    LENGTH,
    MASS,
    PURE,
    TIME,
    ParseError,
    PolhodeError,
    UnitError,
    look_up,
    to_si,
)

SYMBOLS = {"m": ph.Symbol("m"), "a": ph.Symbol("a")}
DIMENSIONS = {SYMBOLS["m"]: MASS, SYMBOLS["a"]: LENGTH}
KNOWN = {SYMBOLS["m"]: 2.0, SYMBOLS["a"]: 0.5}


def value(text, dimension):
    read = read_value("q", text, SYMBOLS)
    return read.in_dimension(dimension, DIMENSIONS).rounded(KNOWN)


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("80deg", PURE, math.radians(80)),
        ("80°", PURE, math.radians(80)),
        ("pi/2", PURE, math.pi / 2),
        ("-pi/2", PURE, -math.pi / 2),
        ("0.2m", LENGTH, 0.2),
        ("0.2 m", LENGTH, 0.2),
        ("12 mm", LENGTH, 0.012),
        ("3000rpm", PURE / TIME, 100 * math.pi),
        ("2 pi rad/s", PURE / TIME, 2 * math.pi),
        ("9.81 m/s^2", LENGTH / TIME**2, 9.81),
        ("5/s", PURE / TIME, 5.0),
        ("-1.5", LENGTH, -1.5),
        ("2*m", MASS, 4.0),
        ("2m", LENGTH, 2.0),
        ("2*kg", MASS, 2.0),
        ("2*m*a**2/5", MASS * LENGTH**2, 0.2),
        ("a + 0.5", LENGTH, 1.0),
        ("sqrt(2)", PURE, math.sqrt(2)),
        ("a*sin(0.3)", LENGTH, 0.5 * math.sin(0.3)),
    ],
)
def test_a_value_in_si(text, dimension, expected):
    assert value(text, dimension) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "kind", "said"),
    [
        ("3m", UnitError, "q = '3m' is a quantity in m; expected a quantity in kg"),
        ("m*a", UnitError, "q = m*a is in kg m; expected an expression in kg"),
        ("m + a", UnitError, "adds quantities in"),
        ("3 furlong", UnitError, "q: the unit 'furlong' is not known"),
        ("2*b", ParseError, "q: at character 3 of '2*b': 'b' is not known"),
        ("nan", UnitError, "expected a finite number"),
        ("-inf", UnitError, "expected a finite number"),
        ("1e400", UnitError, "expected a finite number"),
        ("m*a/(a - 0.5)", UnitError, "no finite value"),
        ("", ParseError, "the text ends"),
    ],
)
def test_what_is_no_value_is_refused_by_name(text, kind, said):
    with pytest.raises(kind) as refusal:
        value(text, MASS)
    assert said in str(refusal.value)
    assert str(refusal.value).startswith("q")


def test_an_unknown_name_is_met_with_the_nearest():
    assert look_up("theta", {"theta": 1}, "coordinate") == 1
    with pytest.raises(PolhodeError, match=r"'thta' is no coordinate.*did you mean theta\?"):
        look_up("thta", {"theta": 1, "x": 2}, "coordinate")


@pytest.mark.parametrize(
    ("given", "exact"),
    [
        ("30 mm", Fraction(3, 100)),
        ("0.03", Fraction(3, 100)),
        ((30, "mm"), Fraction(3, 100)),
        ((Fraction(1, 3), "mm"), Fraction(1, 3000)),
        ((Decimal("0.1"), "mm"), Fraction(1, 10000)),
        (0.03, Fraction(0.03)),
        (Fraction(1, 3), Fraction(1, 3)),
        (2**60 + 1, Fraction(2**60 + 1)),
        ("80 deg", ph.pi * 4 / 9),
        ("pi/3", ph.pi / 3),
        (ph.pi / 3, ph.pi / 3),
    ],
)
def test_the_exact_number_is_the_one_that_was_written(given, exact):
    assert read_value("q", given).exact() == exact


@pytest.mark.parametrize(
    "given", ["30 mm", "0.03", (30, "mm"), (Decimal("0.1"), "mm"), 0.1, "80 deg"]
)
def test_a_double_is_the_one_that_to_si_gives(given):
    read = read_value("q", given)
    dimension = read.number.dimension or PURE
    assert read.rounded() == to_si(given, dimension, "q")


def test_a_magnitude_is_rounded_before_its_unit_is_applied():
    third = Fraction(1, 3)
    assert read_value("q", (third, "mm")).rounded() == float(Fraction(float(third)) / 1000)


def test_a_formula_follows_what_it_is_made_of():
    read = read_value("q", "m*a**2/2", SYMBOLS)
    assert read.symbols == set(SYMBOLS.values())
    assert read.rounded(KNOWN) == 2.0 * 0.5**2 / 2
    assert read.exact({s: ph.Expr.of(1) / 10 for s in SYMBOLS.values()}) == Fraction(1, 2000)


def test_a_value_is_read_once():
    read = read_value("q", "30 mm")
    assert read_value("q", read) is read


@pytest.mark.parametrize("formula", ["1/(m - 2)", "sqrt(a - 1)", "exp(1000*m)"])
def test_a_start_without_a_finite_value_is_refused_wherever_it_is_given(formula):
    value = read_expression(formula, {n: ph.Expr.generator(s) for n, s in SYMBOLS.items()})
    with pytest.raises(UnitError, match=r"q = .* has no finite value"):
        read_value("q", value).rounded(KNOWN)


def test_a_formula_of_an_unknown_quantity_is_refused():
    with pytest.raises(PolhodeError, match="b has no value"):
        read_value("q", ph.symbol("b")).rounded(KNOWN)

import math
from contextlib import suppress
from fractions import Fraction

import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, UnitError, read_unit
from polhode.base._units import UNITS

REGISTRY = pint.UnitRegistry()
REGISTRY.define("@alias turn = rev")
PINT_NAMES = {"[mass]": "mass", "[length]": "length", "[time]": "time"}

names = st.sampled_from(sorted(UNITS))
nonzero = st.integers(-3, -1) | st.integers(1, 3)
factors = st.builds(lambda name, power: f"{name}^{power}", names, nonzero) | names
compounds = st.lists(factors, min_size=1, max_size=4).flatmap(
    lambda parts: st.lists(
        st.sampled_from([" * ", "/", " "]), min_size=len(parts) - 1, max_size=len(parts) - 1
    ).map(lambda joints: "".join(a + b for a, b in zip(parts, [*joints, ""], strict=True)))
)


def assert_agrees_with_pint(text: str) -> None:
    ours = read_unit(text)
    # pint parses "°^2" by pasting "degree" in; the name it gives the degree reads everywhere.
    theirs = REGISTRY.Quantity(1.0, text.replace("°", "deg")).to_base_units()
    exponents = {PINT_NAMES[base]: power for base, power in theirs.dimensionality.items()}
    value = float(ours.coefficient) * math.pi**ours.pi_power
    assert value == pytest.approx(theirs.magnitude, rel=1e-12)
    assert {name: getattr(ours.dimension, name) for name in PINT_NAMES.values()} == {
        name: exponents.get(name, 0) for name in PINT_NAMES.values()
    }


@pytest.mark.parametrize("name", sorted(UNITS))
def test_every_name_means_what_it_means_to_pint(name):
    assert_agrees_with_pint(name)


@given(compounds)
def test_compounds_mean_what_they_mean_to_pint(text):
    assert_agrees_with_pint(text)


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("N/m s", "(N/m) s"),
        ("kg/(m s^2)", "Pa"),
        ("N·m", "J"),
        ("m s⁻²", "m/s^2"),
        ("m**2", "m^2"),
        ("kg m²/s²", "J"),
        ("/s", "1/s"),
        ("°/s", "deg/s"),
        ("  kg  m ^ 2 ", "kg m^2"),
        ("µm", "um"),
        ("μm", "um"),
    ],
)
def test_two_ways_of_writing_one_unit(text, meaning):
    assert read_unit(text) == read_unit(meaning)


def test_an_angle_is_a_pure_number():
    assert read_unit("deg").dimension == PURE


@pytest.mark.parametrize("name", ["xyz", "mdeg", "kmin", "KG", "dm"])
def test_a_name_outside_the_table_is_refused(name):
    with pytest.raises(UnitError, match=f"the unit '{name}' is not known; expected m g s rad"):
        read_unit(name)


@pytest.mark.parametrize(
    "text",
    ["", "m//s", "m^", "m^200", "(m", "m)", "()", "m*", "m^2^3", "__", "2", "m⁻", "/", "m 3"],
)
def test_malformed_text_is_refused(text):
    with pytest.raises(UnitError, match="is not a unit"):
        read_unit(text)


def test_text_out_of_all_proportion_is_refused():
    with pytest.raises(UnitError, match="is not a unit"):
        read_unit("(" * 100_000)


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused_by_a_unit_error(text):
    with suppress(UnitError):
        assert read_unit(text).coefficient > 0


whole = st.integers(-4, 4).map(Fraction)
dimensions = st.builds(Dimension, whole, whole, whole)


@pytest.mark.parametrize(
    ("dimension", "printed"),
    [
        (PURE, "1"),
        (MASS, "kg"),
        (MASS * LENGTH**2 / TIME**2, "kg m^2/s^2"),
        (TIME**-1, "1/s"),
        (MASS / (LENGTH * TIME**2), "kg/(m s^2)"),
        (LENGTH ** Fraction(1, 2), "m^(1/2)"),
    ],
)
def test_prints_as_its_si_unit(dimension, printed):
    assert str(dimension) == printed


@given(dimensions.filter(lambda dimension: dimension != PURE))
def test_what_is_printed_reads_back(dimension):
    unit = read_unit(str(dimension))
    assert (unit.coefficient, unit.pi_power, unit.dimension) == (1, 0, dimension)


@given(dimensions, dimensions, st.integers(-3, 3))
def test_powers_multiply_and_divide(one, other, exponent):
    assert one * other / other == one
    assert (one * other) ** exponent == one**exponent * other**exponent

"""Numbers drawn for exercises: reproducible, legal, to two significant figures."""

from hashlib import sha256
from itertools import permutations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.base import UnitError
from polhode.catalogue import CATALOGUE
from polhode.exercise import Builder
from polhode.exercise._draws import Draws, rounded
from polhode.exercise._numbers import draw
from polhode.exercise._quantities import Amount, number_latex, plain_amount


def test_a_draw_is_the_start_of_a_digest():
    """By hand, so that no machine and no version of Python draws anything else."""
    digest = sha256(b"exercise 3/m").digest()
    bits = int.from_bytes(digest, "big") >> (256 - 53)
    assert Draws("exercise 3").fraction("m") == bits / 2**53
    assert round(Draws("exercise 3").fraction("m"), 6) == 0.288832


def test_draws_are_independent_of_their_order():
    draws = Draws("x")
    first = [draws.fraction("a"), draws.fraction("b")]
    assert first == [draws.fraction("b"), draws.fraction("a")][::-1]
    assert sorted(draws.shuffled("s", "abcdef")) == list("abcdef")


@given(st.floats(1e-8, 1e8))
def test_two_figures_are_within_five_per_cent(value):
    assert abs(rounded(value) - value) <= 0.0501 * value
    assert len(f"{rounded(value):.10e}".split("e")[0].rstrip("0").replace(".", "")) <= 2


@pytest.fixture(scope="module")
def racquet():
    return Builder.of(CATALOGUE["tennis-racquet"]).subject


@pytest.fixture(scope="module")
def bar():
    """A bar with three letters for its moments, and nothing that says what is typical."""
    mass, length, g, *moments = ph.symbols("M b g A B C", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    body = ph.Body("bar", mass=mass, inertia=moments, axes=axes)
    system = ph.System(ph.Pivot(body, at=axes["3"] * length), ph.Gravity(g), name="swing")
    return Builder.of(system).subject


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_moments_obey_the_triangle_inequality(seed, racquet, bar):
    for subject, names in ((racquet, ("I_1", "I_2", "I_3")), (bar, ("A", "B", "C"))):
        values = {s.published: v for s, v in draw(subject, Draws(str(seed)), {}).values.items()}
        for i, j, k in permutations(values[name] for name in names):
            assert i <= (j + k) * (1 + 1e-12)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_the_order_of_typical_moments_is_kept(seed, racquet):
    values = {s.published: v for s, v in draw(racquet, Draws(str(seed)), {}).values.items()}
    assert values["I_1"] < values["I_2"] < values["I_3"]


def test_gravity_and_the_earth_are_not_drawn(bar):
    values = {s.published: v for s, v in draw(bar, Draws("1"), {}).values.items()}
    assert values["g"] == 9.81
    compass = Builder.of(CATALOGUE["gyrocompass"]).subject
    values = {s.published: v for s, v in draw(compass, Draws("1"), {}).values.items()}
    assert values["Omega"] == 7.2921159e-5
    assert values["I_3"] == pytest.approx(values["m"] * values["a"] ** 2)


def test_a_value_that_is_set_is_kept(bar):
    found = draw(bar, Draws("1"), {"M": "2 kg"})
    assert found.texts["M"] == "2.0 kg"


@pytest.mark.parametrize(
    ("text", "si"), [("7.5 g", 0.0075), ("33 rpm", 33 * 2 * 3.141592653589793 / 60), ("2", 2)]
)
def test_amounts_are_read_in_their_units(text, si):
    assert plain_amount(text).si == pytest.approx(si)


def test_formulas_are_no_amounts_and_units_are_checked():
    assert plain_amount("m*a**2/2") is None
    assert plain_amount("2/5") is None
    with pytest.raises(UnitError):
        _ = Amount(1.0, "furlong").si


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0123456, "0.0123"), (12.3456, "12.3"), (1234.56, "1235"), (-4.2e-5, r"-4.20\cdot 10^{-5}")],
)
def test_numbers_are_printed_to_three_figures(value, text):
    assert number_latex(value) == text

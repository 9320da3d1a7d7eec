"""Shorter forms on request are the same quantities, and read as on paper."""

import pickle

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import as_symbol, compile_program, lengths_written_out, named

x_1, x_2, y_1, y_2 = ph.coordinates("x_1 x_2 y_1 y_2")
theta, phi = ph.coordinates("theta phi")
omega_3 = ph.speed("omega_3")
k, I_3 = ph.symbols("k I_3", positive=True)
BETWEEN = ph.sqrt((x_1 - x_2) ** 2 + (y_1 - y_2) ** 2)


def test_a_distance_has_a_letter_and_differences_stay():
    pull = ph.shorter(k * (x_1 - x_2) / BETWEEN**3)
    assert pull.pretty() == "k (x₁ − x₂)/ρ³"
    (rho,) = pull.definitions()
    assert rho == "rho"
    assert pull.definitions()[rho].pretty() == "√((x₁ − x₂)² + (y₁ − y₂)²)"


def test_momenta_have_letters_on_request():
    row = I_3 * omega_3 * phi.dt() * ph.sin(theta) - k * theta.dt().dt() + (I_3 * omega_3) ** 2
    found = ph.shorter(row, Lambda=I_3 * omega_3)
    assert found.pretty() == "Λ φ̇ sinθ − k θ̈ + Λ²"
    assert found.definitions() == {"Lambda": I_3 * omega_3}
    assert ph.shorter(1 / row, Lambda=I_3 * omega_3).latex().count(r"\Lambda") == 2


def test_a_sum_is_divided_by_as_by_a_product():
    momentum = k * phi.dt() * ph.sin(theta) ** 2 + I_3 * omega_3 * ph.cos(theta)
    found = ph.shorter(momentum * theta.dt() + k * theta.dt().dt(), p_phi=momentum)
    assert (found - momentum * theta.dt() - k * theta.dt().dt()).is_zero
    assert "p_phi" in found.definitions()


def test_a_letter_that_is_asked_for_is_used_where_nothing_is_shorter():
    assert ph.shorter(x_1 / x_2, z=x_2).definitions() == {"z": x_2}


def test_factors_are_not_multiplied_out():
    assert ph.shorter((x_1 - x_2) ** 3 * (y_1 + k) ** 2).pretty() == "(k + y₁)² (x₁ − x₂)³"


def test_letters_of_the_expression_are_not_used_twice():
    rho = ph.symbol("rho")
    found = ph.shorter(rho / BETWEEN)
    assert found.pretty() == "ρ/r"
    assert ph.shorter(1 / BETWEEN, rho=x_1 * y_1).definitions().keys() == {"r"}


@pytest.mark.parametrize(
    ("name", "meaning"), [("x_1", k * x_2), ("L", 3), ("L", k / x_1), ("x_dot", k * x_1)]
)
def test_unusable_letters_are_refused(name, meaning):
    with pytest.raises(ph.DeclarationError):
        ph.shorter(k * x_1 / x_2, **{name: meaning})


#: A number and the powers of the factors of a term.
TERMS = st.lists(st.tuples(st.integers(-3, 3), *[st.integers(0, 2)] * 4), min_size=1, max_size=6)
_BELOW = 2  # terms of a denominator: the rate of one of six with a root would take minutes


@settings(max_examples=40)
@given(TERMS, st.booleans())
def test_the_value_is_the_same(terms, is_below):
    """Of sums of products of two angles' functions, a difference and a length."""
    terms = terms[:_BELOW] if is_below else terms
    a, b, d, r = ph.sin(theta), ph.cos(theta), x_1 - x_2, BETWEEN
    products = (c * a**i * b**j * d**m * r**n for c, i, j, m, n in terms)
    total = sum(products, start=ph.Expr.of(0))
    given_ = 1 / total if is_below and not total.is_zero else total
    found = ph.shorter(given_, s=k * ph.sin(theta), D=x_1 - x_2)
    assert (found - given_).is_zero
    assert lengths_written_out(found) == given_
    assert (found.dt() - given_.dt()).is_zero
    assert (found.subs({theta: 1}) - given_.subs({theta: 1})).is_zero
    assert pickle.loads(pickle.dumps(found)) == found


def test_programs_evaluate_them():
    given_ = k * (x_1 - x_2) * omega_3 / BETWEEN**3
    found = ph.shorter(given_, p=k * omega_3)
    values = [2.0, 1e7, 1e7 + 3, 4.0, 8.0, 0.5]
    symbols = [as_symbol(s) for s in (k, x_1, x_2, y_1, y_2, omega_3)]
    (result,) = compile_program([found], symbols).function()(*values)
    assert result == pytest.approx(-2 * 3 * 0.5 / 5**3, rel=1e-15)


def test_long_parts_are_defined_by_later_ones():
    """Every letter that is printed for an expression in named parts is explained."""
    inner = named(k * x_1 + x_2 + y_1 * y_2 + I_3)
    long = named(inner * phi + theta * x_1 + inner**2 * k + y_1)
    first, second = long.definitions().items()
    assert str(long) == first[0] == "z_1"
    assert "z_2" in str(first[1])
    assert second == ("z_2", k * x_1 + x_2 + y_1 * y_2 + I_3)


def test_letters_of_an_expression_that_was_shortened_before_keep_their_meaning():
    """A further root has another letter, and a letter cannot come to stand for something else."""
    before = ph.shorter(k * omega_3 / BETWEEN, p=k * omega_3)
    again = ph.shorter(before + 1 / ph.sqrt(x_1**2 + y_1**2))
    assert len(again.definitions()) == 3
    assert (again - k * omega_3 / BETWEEN - 1 / ph.sqrt(x_1**2 + y_1**2)).is_zero
    assert ph.shorter(before, p=k * omega_3).definitions() == before.definitions()
    with pytest.raises(ph.DeclarationError):
        ph.shorter(before, p=k * x_1)


def test_numbered_letters_of_the_expression_are_not_used_twice():
    rho_1 = ph.symbol("rho_1")
    found = ph.shorter(rho_1 * BETWEEN + ph.sqrt(x_1**2 + k**2))
    assert "rho_1" not in found.definitions()

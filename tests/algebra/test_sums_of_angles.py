"""Functions of sums of angles are printed as such wherever that is shorter, and mean the same."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import Expr, cos, read_expression, sin

alpha, beta, gamma = ph.coordinates("alpha beta gamma")
k, g = ph.symbols("k g")
ANGLES = {"alpha": alpha, "beta": beta, "gamma": gamma}

TEXTBOOK = [
    (cos(alpha) * cos(beta) + sin(alpha) * sin(beta), "cos(alpha - beta)"),
    (cos(alpha) * cos(beta) - sin(alpha) * sin(beta), "cos(alpha + beta)"),
    (sin(beta) * cos(alpha) - sin(alpha) * cos(beta), "-sin(alpha - beta)"),
    (k * sin(alpha + beta) + g * sin(alpha), "g*sin(alpha) + k*sin(alpha + beta)"),
    (k * cos(alpha - beta) ** 2, "k*cos(alpha - beta)**2"),
    (k * sin(alpha - beta) * cos(alpha - beta), "k*sin(alpha - beta)*cos(alpha - beta)"),
    (1 / (4 - cos(alpha - beta)), "1/(4 - cos(alpha - beta))"),
    # neither of these is shorter for any sum of angles
    (cos(alpha) * cos(beta), "cos(alpha)*cos(beta)"),
    (k * cos(alpha) * cos(beta) + sin(alpha) * sin(beta), None),
]


@pytest.mark.parametrize(("expression", "printed"), TEXTBOOK)
def test_printed_as_a_text_has_it(expression, printed):
    plain = "sin(alpha)*sin(beta) + k*cos(alpha)*cos(beta)"
    assert str(expression) == (printed or plain)


TERM = st.tuples(
    st.integers(-3, 3),
    st.sampled_from([alpha - beta, alpha + beta, beta - gamma, alpha, beta, 2 * beta]),
    st.sampled_from([alpha - beta, alpha + gamma, gamma]),
    st.integers(0, 2),
    st.integers(0, 2),
)


@given(st.lists(TERM, min_size=1, max_size=4))
def test_what_is_printed_means_the_same(terms):
    expression = sum((c * cos(x) ** i * sin(y) ** j for c, x, y, i, j in terms), Expr.of(0))
    assert read_expression(str(expression), ANGLES) == expression

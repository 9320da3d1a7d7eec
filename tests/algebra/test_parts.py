"""Named parts: what stands under a name means what it meant."""

import pickle
from math import cos as cosine
from math import sin as sine

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import polhode as ph
from algebra.backends import a, b, phi, theta, x, y
from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    as_symbol,
    compile_program,
    cos,
    dot,
    eliminate,
    eliminate_in_parts,
    linear_parts,
    named,
    sin,
    solve_definite,
    sqrt,
    symbol,
    total,
    under_letters,
)

LONG = (a + x * sin(theta) - y) ** 2 + 1
ROOTED = sqrt(x**2 + a**2 * cos(theta) ** 2 + 1) / (LONG + b)


@pytest.fixture(
    params=[LONG, -LONG, ROOTED, LONG / (1 + LONG)], ids=["sum", "less", "root", "ratio"]
)
def expression(request: pytest.FixtureRequest) -> Expr:
    return request.param


def test_it_is_short_and_equals_what_it_stands_for(expression: Expr) -> None:
    brief = named(expression)
    assert brief.is_polynomial
    assert sum(1 for _ in brief.terms()) <= 3
    assert brief.symbols() == expression.symbols()
    assert (brief - expression).is_zero
    assert not (brief - expression - Expr.of(1) / 10**60).is_zero


def test_derivatives_and_substitution_look_inside(expression: Expr) -> None:
    brief = named(expression)
    for one in (a, x, theta):
        assert (brief.diff(one) - expression.diff(one)).is_zero
    images = {theta: phi + x, a: b**2}
    assert (brief.subs(images) - expression.subs(images)).is_zero
    assert not (brief.subs(images) - expression).is_zero


def test_rates_stay_visible() -> None:
    rate = named(LONG * sin(theta)).dt()
    rates = [as_symbol(theta.dt()), as_symbol(phi.dt())]
    found, rest = linear_parts(rate, rates)
    expected, _ = linear_parts((LONG * sin(theta)).dt(), rates)
    assert not rest
    assert all((f - e).is_zero for f, e in zip(found, expected, strict=True))


def test_what_is_to_stay_visible_stays() -> None:
    speed = as_symbol(theta.dt())
    brief = named(LONG * theta.dt() + ROOTED, [speed])
    (slope,), rest = linear_parts(brief, [speed])
    assert (slope - LONG).is_zero
    assert (rest - ROOTED).is_zero


def test_programs_compute_it_once(expression: Expr) -> None:
    symbols = [as_symbol(s) for s in (a, b, x, y, theta, phi)]
    brief = named(expression)
    values = (0.3, 0.4, 0.5, -0.2, 1.1, 2.3)
    program = compile_program([brief, expression], symbols)
    first, second = program.function()(*values)
    assert first == pytest.approx(second, rel=1e-13)
    once, twice = (compile_program([e], symbols) for e in (brief, brief * y + brief * sin(x)))
    assert twice.operations <= once.operations + 4


def test_an_identity_of_angles_is_seen_through_names() -> None:
    first = named(sin(theta) * LONG + x) ** 2 + named(cos(theta) * LONG + y) ** 2
    whole = LONG**2 + x**2 + y**2 + 2 * LONG * (x * sin(theta) + y * cos(theta))
    assert (first - whole).is_zero
    assert not (first - whole + x / 10**50).is_zero


def test_print_gives_letters_that_no_symbol_has() -> None:
    rows, parts = under_letters((named(LONG) * symbol("z_1"), named(LONG) + named(LONG * x)))
    assert [s.name for s in parts] == ["Z_1", "Z_2"]
    assert str(rows[0]) == str(named(LONG) * symbol("z_1")) == "Z_1*z_1"
    assert str(rows[1]) == "Z_1 + Z_2"


def test_it_travels(expression: Expr) -> None:
    brief = named(expression) * x
    assert pickle.loads(pickle.dumps(brief)) == brief


def test_a_sum_at_once_is_the_sum_one_by_one() -> None:
    terms = [x, sin(theta) ** 2, cos(theta) ** 2, a * b, -x, ONE / 3]
    assert total(terms) == sum(terms, ZERO)
    assert total([ONE / x, x, ONE]) == ONE / x + x + 1


# -- linear equations ---------------------------------------------------------------------------

entries = st.sampled_from(
    [ZERO, ZERO, ONE, Expr.of(2) / 3, a, x, sin(theta), LONG, x * LONG + cos(phi)]
)


def square(size: int) -> st.SearchStrategy[list[list[Expr]]]:
    return st.lists(st.lists(entries, min_size=size, max_size=size), min_size=size, max_size=size)


@settings(max_examples=12)
@given(square(3), st.lists(entries, min_size=3, max_size=3))
def test_elimination_finds_what_the_written_out_one_finds(rows, right) -> None:
    found, written = eliminate_in_parts(rows, right), eliminate(rows, right)
    assert len(found.free) == len(written.free)
    assert bool(found.contradictory) == bool(written.contradictory)
    assume(not found.contradictory)
    values = {j: Expr.of(7 + j) for j in found.free}
    free = list(values.values())
    values |= {j: constant + dot(row, free) for j, (row, constant) in found.solved.items()}
    for row, value in zip(rows, right, strict=True):
        assert (dot(row, [values[j] for j in range(3)]) - value).is_zero


def test_it_gives_up_the_unknowns_of_low_rank_first() -> None:
    assert eliminate_in_parts([[ONE, ONE]], [x], [1, 0]).free == (0,)
    assert eliminate_in_parts([[ONE, LONG]], [x], [0, 1]).free == (1,)


def test_no_heading_is_singular() -> None:
    """The first entry vanishes at θ = 0, and elimination by it would divide by nothing there."""
    rows = [[sin(theta), LONG * cos(theta)], [LONG * cos(theta), -sin(theta)]]
    outcome = eliminate_in_parts(rows, [ONE, x])
    symbols = [as_symbol(s) for s in (a, b, x, y, theta, phi)]
    solution = compile_program([constant for _, constant in outcome.solved.values()], symbols)
    for angle in (0.0, 0.7):
        first, second = solution.function()(0.3, 0.4, 0.5, -0.2, angle, 2.3)
        long = (0.3 + 0.5 * sine(angle) + 0.2) ** 2 + 1
        assert sine(angle) * first + long * cosine(angle) * second == pytest.approx(1)
        assert long * cosine(angle) * first - sine(angle) * second == pytest.approx(0.5)


def test_a_mass_matrix_is_factorised_as_it_stands() -> None:
    mass = ((LONG + x**2, x * y), (x * y, LONG + y**2))
    found = solve_definite(mass, (a, b))
    for row, value in zip(mass, (a, b), strict=True):
        assert (dot(row, found) - value).is_zero


def test_a_coordinate_with_the_name_of_a_parameter_has_parts_of_its_own():
    """As in two systems of one session: the rate of the second was zero, or an error."""
    p, q, r, s = ph.symbols("p q r s")

    def part(u):
        return named(p * ph.sin(u) + q * u + r * u**3 + s * ph.cos(u) + p * q * u**2)

    constant, varying = part(ph.symbol("alpha")), part(ph.coordinate("alpha"))
    assert constant != varying
    assert constant.dt().is_zero
    assert varying.dt().subs({ph.coordinate("alpha"): 0}) == (p + q) * ph.coordinate("alpha").dt()

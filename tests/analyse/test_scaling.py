"""Thresholds, frequencies and integrals in other units of mass, length and time."""

from collections.abc import Callable, Iterator
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analyse.systems import equations
from polhode.algebra import FLOATS, Expr, Symbol, SymbolKind, compile_program
from polhode.analyse import Truth, invariants, stability, steady
from polhode.base import PURE, TIME, Dimension, NumericError
from polhode.derive import Equations

SYSTEMS = ["spinning-coin", "rolling-disk", "gyrocompass", "gyroscope", "gyroscope/vertical-plane"]

unit = st.floats(0.01, 100.0)
number = st.floats(0.2, 1.3)


@cache
def statements(name: str) -> tuple[Expr, ...]:
    """Conditions of existence and of stability, frequencies, and integrals."""
    return tuple(_stated_of(equations(name)))


def _stated_of(derived: Equations) -> Iterator[Expr]:
    for family in steady(derived):
        for branch in family.branches:
            yield from (c.expression for c in branch.exists if c.truth is Truth.OPEN)
        try:
            judged = stability(family)
        except NumericError:  # a singular chart, which says nothing of thresholds
            continue
        yield from (c.expression for c in judged.conditions if c.truth is Truth.OPEN)
        yield from (frequency**2 for frequency in judged.frequencies)
    yield from (integral.expression for integral in invariants(derived))


def size(dimension: Dimension, mass: float, length: float, time: float) -> float:
    """The new unit of a dimension in old ones."""
    return mass**dimension.mass * length**dimension.length * time**dimension.time


def dimension(derived: Equations, symbol: Symbol) -> Dimension:
    known = derived.dimensions
    return known[symbol] if symbol in known else known[symbol.base()] / TIME**symbol.order


def value(expression: Expr, values: dict[Symbol, float]) -> float:
    return _function(expression, tuple(values))(*values.values())[0]


@cache
def _function(expression: Expr, symbols: tuple[Symbol, ...]) -> Callable[..., list[float]]:
    return compile_program([expression], symbols).function(FLOATS)


@pytest.mark.parametrize("name", SYSTEMS)
@settings(max_examples=5, deadline=None)
@given(st.data(), unit, unit, unit)
def test_everything_scales_as_its_dimension_says(name, data, mass, length, time):
    """Numbers, not symbols: a factor lost from one term shows as a ratio that depends on them."""
    derived = equations(name)
    for expression in statements(name):
        symbols = sorted(
            (s for s in expression.symbols() if s.name != "pi"), key=lambda s: s.published
        )
        numbers = {s: data.draw(number) for s in symbols}
        units = {s: size(dimension(derived, s), mass, length, time) for s in symbols}
        scaled = {s: numbers[s] * units[s] for s in symbols}
        before, after = value(expression, numbers), value(expression, scaled)
        allowed = 1e-9 * max(abs(term) for term in _terms(expression, scaled))
        factor = size(_stated(derived, expression), mass, length, time)
        assert abs(after - factor * before) <= allowed, expression


def _terms(expression: Expr, values: dict[Symbol, float]) -> Iterator[float]:
    """Sizes of what is added up, over the denominator."""
    below = value(expression.denominator, values)
    for powers, coefficient in expression.numerator.terms():
        product = float(coefficient)
        for generator, power in powers.items():
            product *= value(Expr.generator(generator), values) ** power
        yield product / below


def _stated(derived: Equations, expression: Expr) -> Dimension:
    """From any one term, so that the others are put to the test."""
    found = [_of_one_term(derived, part) for part in (expression.numerator, expression.denominator)]
    return found[0] / found[1]


def _of_one_term(derived: Equations, polynomial: Expr) -> Dimension:
    powers, _ = next(iter(polynomial.terms()))
    total = PURE
    for generator, power in powers.items():
        if isinstance(generator, Symbol) and generator.name != "pi":
            total = total * dimension(derived, generator) ** power
    return total


def test_a_lost_factor_would_show():
    derived = equations("rolling-disk")
    a = next(s for s in derived.parameters if s.published == "a")
    assert a.kind is SymbolKind.PARAMETER
    wrong = Expr.generator(a) + 1
    small, large = value(wrong, {a: 1.0}), value(wrong, {a: 10.0})
    assert large != pytest.approx(size(_stated(derived, wrong), 1.0, 10.0, 1.0) * small)

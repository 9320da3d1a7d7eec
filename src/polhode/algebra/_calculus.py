"""Linear parts, Taylor expansion, and integrals over lengths and angles."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import comb, factorial

from polhode.algebra._expression import ONE, ZERO, Expr, ExprLike, as_symbol
from polhode.algebra._functions import CIRCULAR, Elementary, Even, cos, sin
from polhode.algebra._ring import Symbol
from polhode.base import NumericError


def linear_parts(expression: Expr, symbols: Sequence[Symbol]) -> tuple[tuple[Expr, ...], Expr]:
    """Coefficients of the symbols in an expression linear in them, and the rest.

    Raises `NumericError` where the expression is not linear in them.
    """
    ring, wanted = expression.ring, set(symbols)
    bound = (g for g in expression.generators if g not in wanted)
    if expression.denominator.symbols() & wanted or any(g.symbols() & wanted for g in bound):
        raise _not_linear(expression, symbols)
    present = [symbol for symbol in symbols if symbol in ring.index]
    parts: dict[Symbol | None, Expr] = {}
    for powers, part in ring.grouped(expression.num, [ring.index[s] for s in present]).items():
        if sum(powers) > 1:
            raise _not_linear(expression, symbols)
        key = present[powers.index(1)] if any(powers) else None
        parts[key] = Expr.fraction(ring, part, expression.den).trimmed()
    return tuple(parts.get(symbol, ZERO) for symbol in symbols), parts.get(None, ZERO)


def _not_linear(expression: Expr, symbols: Iterable[Symbol]) -> NumericError:
    names = ", ".join(s.published for s in symbols)
    return NumericError(
        f"{expression}", expected=f"an expression linear in {names}", advice="check the powers"
    )


def taylor(expression: ExprLike, symbol: Expr | Symbol, order: int, about: ExprLike = 0) -> Expr:
    """Taylor polynomial in `symbol - about`, up to and including `order`."""
    derivative, result, variable = Expr.of(expression), ZERO, as_symbol(symbol)
    distance = Expr.generator(variable) - about
    for power in range(order + 1):
        value = derivative.subs({variable: about})
        result = result + value * distance**power / factorial(power)
        derivative = derivative.diff(variable)
    return result


def integrate(
    expression: ExprLike, symbol: Expr | Symbol, lower: ExprLike, upper: ExprLike
) -> Expr:
    """Definite integral of a polynomial in a length, or of a trigonometric polynomial in an angle.

    Coefficients may depend on anything but the symbol. Raises `NumericError` for other integrands.
    """
    variable = as_symbol(symbol)
    primitive = _primitive(Expr.of(expression), variable)
    return primitive.subs({variable: upper}) - primitive.subs({variable: lower})


def _primitive(integrand: Expr, variable: Symbol) -> Expr:
    x = Expr.generator(variable)
    # Sines and cosines must be of one multiple kx of the variable; `unit` is k.
    unit = ONE
    for generator in integrand.generators:
        if generator == variable or variable not in generator.symbols():
            continue
        if not isinstance(generator, Elementary) or generator.family != CIRCULAR:
            raise _not_integrable(integrand, variable)
        unit = generator.argument / x
        if variable in unit.symbols():
            raise _not_integrable(integrand, variable)
    result = ZERO
    if variable in integrand.denominator.symbols():
        raise _not_integrable(integrand, variable)
    for powers, coefficient in integrand.terms():
        dependent = {g: p for g, p in powers.items() if variable in g.symbols()}
        rest = Expr.product({g: p for g, p in powers.items() if g not in dependent}, coefficient)
        length = dependent.pop(variable, 0)
        if length and dependent:
            raise _not_integrable(integrand, variable)
        if dependent:
            sines = sum(p for g, p in dependent.items() if not isinstance(g, Even))
            cosines = sum(p for g, p in dependent.items() if isinstance(g, Even))
            result = result + rest * _circular_primitive(sines, cosines, x * unit) / unit
        else:
            result = result + rest * x ** (length + 1) / (length + 1)
    return result / integrand.denominator


def _circular_primitive(sines: int, cosines: int, angle: Expr) -> Expr:
    """Primitive of sin^m cos^n; n ≤ 1, as normal form replaces cos² by 1 - sin²."""
    if cosines:
        return sin(angle) ** (sines + 1) / (sines + 1)
    if sines % 2:  # sin^(2k+1) = (1 - cos²)^k sin
        half = sines // 2
        powers = ((-1) ** (j + 1) * comb(half, j) for j in range(half + 1))
        return sum(
            (c * cos(angle) ** (2 * j + 1) / (2 * j + 1) for j, c in enumerate(powers)), ZERO
        )
    if not sines:
        return angle
    # m ∫ sin^m = (m - 1) ∫ sin^(m-2) - cos sin^(m-1), by parts
    lower = _circular_primitive(sines - 2, 0, angle) * (sines - 1)
    return (lower - cos(angle) * sin(angle) ** (sines - 1)) / sines


def _not_integrable(integrand: Expr, variable: Symbol) -> NumericError:
    return NumericError(
        f"the integral of {integrand} over {variable.published}",
        expected="a polynomial in it, or one in the sine and cosine of one multiple of it",
        advice="integrate it numerically",
    )

"""Where an expression vanishes, and to what order: by its irreducible factors.

Sines and cosines are rational in t = tan θ/2 (Weierstrass), so that 1 − cos θ = 2t²/(1 + t²) is
seen to have a double zero at θ = 0; a zero at θ = π lies at infinite t.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from polhode.algebra._expression import ONE, ZERO, Expr
from polhode.algebra._functions import CIRCULAR, Elementary, Even, pi
from polhode.algebra._ring import Symbol, SymbolKind
from polhode.algebra._roots import SquareRoot, factors, is_plainly_positive


@dataclass(frozen=True)
class Zero:
    """Places at which an expression vanishes.

    Attributes:
        order: the power of the factor that vanishes there.
        is_extreme: whether that factor is of one sign everywhere else, as x² + y² is.
        equation: an expression with a simple zero there; None where none is known.
    """

    order: int
    is_extreme: bool
    equation: Expr | None

    @property
    def is_simple(self) -> bool:
        """Whether the expression changes its sign there, with a gradient that does not vanish."""
        return self.order == 1 and not self.is_extreme


def zeros(expression: Expr, varies: Callable[[Symbol], bool]) -> tuple[Zero, ...]:
    """All zeros of an expression in real quantities.

    Args:
        varies: the quantities; all other symbols are constants, in general not zero.
    """
    angles = {
        generator.argument: Symbol(f"tan {generator.argument}/2", SymbolKind.PARAMETER)
        for generator in expression.generators
        if isinstance(generator, Elementary)
        and generator.family == CIRCULAR
        and any(map(varies, generator.symbols()))
    }
    rational = _in_tangents(expression, angles)
    found = []
    for factor, power in factors(rational)[1].items():
        moving = [s for s in factor.symbols() if varies(s) or s in angles.values()]
        if power > 0 and moving and (root := _root(factor)) is not None:
            found.append(Zero(power, is_extreme=True, equation=root.plain))
        elif power > 0 and moving and not _is_definite(factor):
            found.append(Zero(power, _is_semidefinite(factor), _plain(factor, angles)))
    for angle, tangent in angles.items():
        order = _degree(rational.denominator, tangent) - _degree(rational.numerator, tangent)
        if order > 0:
            found.append(Zero(order, is_extreme=False, equation=angle - pi))
    return tuple(found)


def _in_tangents(expression: Expr, angles: dict[Expr, Symbol]) -> Expr:
    """An expression with sines and cosines of some angles by the tangents of half of them."""

    def image(generator: object) -> Expr | None:
        if not (isinstance(generator, Elementary) and generator.argument in angles):
            return None
        t = Expr.generator(angles[generator.argument])
        above = 1 - t**2 if isinstance(generator, Even) else 2 * t
        return above / (1 + t**2)

    def of(polynomial: Expr) -> Expr:
        total = ZERO
        for powers, coefficient in polynomial.terms():
            term = ONE * coefficient
            for generator, power in powers.items():
                term = term * (image(generator) or Expr.generator(generator)) ** power
            total = total + term
        return total

    return of(expression.numerator) / of(expression.denominator) if angles else expression


def _root(factor: Expr) -> SquareRoot | None:
    """The root that a factor consists of, such as |x|: of one sign, with a corner at its zeros."""
    ((powers, _), *others) = factor.terms()
    roots = [g for g in powers if isinstance(g, SquareRoot)]
    return roots[0] if roots and len(powers) == 1 and not others else None


def _is_definite(factor: Expr) -> bool:
    return is_plainly_positive(factor) or is_plainly_positive(-factor)


def _is_semidefinite(factor: Expr) -> bool:
    """Whether a polynomial is a sum of squares that all have one sign."""
    signs = {
        coefficient > 0 and all(p % 2 == 0 or g.positive for g, p in powers.items())
        for side in (factor, -factor)
        if next(iter(side.terms()))[1] > 0
        for powers, coefficient in side.terms()
    }
    return signs == {True} and len(list(factor.terms())) > 1


def _degree(polynomial: Expr, symbol: Symbol) -> int:
    return max((powers.get(symbol, 0) for powers, _ in polynomial.terms()), default=0)


def _plain(factor: Expr, angles: dict[Expr, Symbol]) -> Expr | None:
    """An equation with the zeros of a factor, free of tangents of half an angle."""
    turned = {angle: t for angle, t in angles.items() if t in factor.symbols()}
    if not turned:
        return None if _is_semidefinite(factor) else factor
    ((angle, tangent), *others) = turned.items()
    t = Expr.generator(tangent)
    if not others:
        for place, value in ((t, ZERO), (t - 1, pi / 2), (t + 1, -pi / 2)):
            if (factor / place).symbols() <= {tangent} and not (factor / place).symbols():
                return angle - value
    return None

"""Quadratic forms as sums of squares, the way a kinetic energy is written on paper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, permutations
from math import lcm

from polhode.algebra import ZERO, Expr, Symbol
from polhode.solution._lines import is_sum, joined

_MOST = 5  # letters, of which all orders are tried
_LONGER = 1.25  # times which squares may be longer than the expression as it stands
_SQUARED = Symbol("square_of_a_sum")


def sum_of_squares(value: Expr, letters: Sequence[Symbol]) -> str:
    """LaTeX of an expression that is quadratic in letters, with its squares completed.

    Of all orders of the letters the one that prints shortest is taken. Without products of
    different letters, or where squares are much longer, the expression is printed as it stands.
    """
    inside = [s for s in letters if s in value.symbols()]
    plain = value.latex()
    orders = permutations(inside) if len(inside) <= _MOST and _is_mixed(value, inside) else ()
    texts = filter(None, (_completed(value, order) for order in orders))
    best = min(texts, key=len, default="")
    return best if best and len(best) < _LONGER * len(plain) else plain


def _is_mixed(value: Expr, letters: Sequence[Symbol]) -> bool:
    """Whether there are products of different letters, or single ones."""
    still = dict.fromkeys(letters, ZERO)
    slopes = {letter: value.diff(letter) for letter in letters}
    mixed = any(slopes[a].diff(b) for a, b in combinations(letters, 2))
    return mixed or any(slope.subs(still) for slope in slopes.values())


def _completed(value: Expr, order: Sequence[Symbol]) -> str:
    """The squares completed one letter after the other; empty where that is impossible."""
    terms, rest = list[str](), value
    for letter in order:
        twice = rest.diff(letter).diff(letter)
        if not twice or any(s in twice.symbols() for s in order):
            return ""
        total = rest.diff(letter) / twice  # the letter, and what is added to complete its square
        others, left = rest.subs({letter: ZERO}), rest - twice * total**2 / 2
        if total.symbol is None and _count(left) >= _count(others):
            return ""  # nothing cancels, so that the square does not belong there
        terms.append(_square(twice / 2, total))
        rest = left
    return joined([*terms, *_left(rest)])


def _count(value: Expr) -> int:
    return sum(1 for _ in value.numerator.terms()) if value else 0


def _left(rest: Expr) -> Iterator[str]:
    if rest:
        yield rest.latex()


def _square(factor: Expr, base: Expr) -> str:
    """LaTeX of a factor times a square, with a sum in brackets and no fraction in these."""
    numbers = [number for _, number in base.numerator.terms()] or [Fraction(1)]
    scale = lcm(*(number.denominator for number in numbers))
    above, below = base.numerator * scale, base.denominator * scale
    text = above.latex()
    if not is_sum(text):
        return (factor * base**2).latex()
    whole = (factor / below**2 * Expr.generator(_SQUARED) ** 2).latex()
    return whole.replace(f"{Expr.generator(_SQUARED).latex()}^2", rf"\left({text}\right)^2")

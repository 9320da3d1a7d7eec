"""Shorter forms on request: Λ sin θ for I₃ ω₃ sin θ, and sums that are not multiplied out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import isqrt, prod

from polhode.algebra._expression import ZERO, Expr, ExprLike, total
from polhode.algebra._lengths import (
    Length,
    distance_letters,
    divided,
    kept_length,
    kept_sum,
    lengths_in,
    with_letters,
)
from polhode.algebra._parts import Lettered
from polhode.algebra._ring import Generator
from polhode.algebra._roots import SquareRoot, factors
from polhode.algebra._symbols import symbol
from polhode.algebra.printing._layout import layout
from polhode.base import DeclarationError


def shorter(expression: ExprLike, **letters: ExprLike) -> Expr:
    """The same quantity in the shortest form found, to be read.

    Roots of sums become lengths ρ, sums that are factors stay as they are instead of being
    multiplied out, and quantities of which a letter is given, such as momenta, are written with it:
    ``shorter(row, Lambda=I_3 * omega_3)``. The result differs from the expression by zero, and can
    be calculated with; it is no normal form, so that two results may look different and be equal.

    Args:
        expression: any.
        letters: names and what they stand for, polynomials that are no numbers.

    Raises:
        DeclarationError: for a letter that the expression has for something else, or that stands
            for a number or a quotient.
    """
    given = Expr.of(expression)
    meanings = {name: Expr.of(meaning) for name, meaning in letters.items()}
    _refuse_other_meanings(given, meanings)
    known = {s.published for s in given.symbols()}
    with_lengths = _in_lengths(given, {*known, *given.definitions(), *meanings})
    forms = [given, with_lengths]
    for name, meaning in meanings.items():
        forms.append(_with_letter(forms[-1], name, meaning))
    forms += [_in_factors(form) for form in forms]
    # of forms of one size, the letters that were asked for
    return min(forms, key=lambda form: (layout(form).size, -_letters_in(form)))


def _letters_in(expression: Expr) -> int:
    return sum(isinstance(g, Lettered) for g in expression.generators)


def _refuse_other_meanings(given: Expr, letters: Mapping[str, Expr]) -> None:
    known, defined = {s.published for s in given.symbols()}, given.definitions()
    for name, meaning in letters.items():
        symbol(name)
        if name in known or defined.get(name, meaning) != meaning:
            raise DeclarationError(
                f"the letter {name} for {meaning}",
                expected="a letter that the expression has for nothing else",
                advice="choose another, such as Lambda or p_phi",
            )
        if not meaning.symbols() or not meaning.is_polynomial:
            raise DeclarationError(
                f"the letter {name} for {meaning}",
                expected="a product or a sum of products of its symbols",
                advice="as in Lambda=I_3 * omega_3",
            )


# -- letters that are given ------------------------------------------------------------------------


def _with_letter(expression: Expr, name: str, meaning: Expr) -> Expr:
    letter = Expr.generator(Lettered(meaning.trimmed(), name))
    above, below = expression.numerator, expression.denominator
    return _by_powers(above, meaning, letter) / _by_powers(below, meaning, letter)


def _by_powers(polynomial: Expr, meaning: Expr, letter: Expr) -> Expr:
    """A polynomial by powers of a quantity, where that leaves no more terms."""
    quotient, rest = divided(polynomial, meaning)
    if not quotient or len(quotient.num) + len(rest.num) > len(polynomial.num):
        return polynomial
    return _by_powers(quotient, meaning, letter) * letter + rest


# -- lengths ---------------------------------------------------------------------------------------


def _in_lengths(expression: Expr, taken: set[str]) -> Expr:
    """With the roots of sums under letters ρ, and the sums of squares in them as they are."""
    roots = [
        g
        for g in expression.generators
        if isinstance(g, SquareRoot) and g.plain is None and len(g.radicand.num) > 1
    ]
    found = with_letters(expression, distance_letters((root.key for root in roots), taken))
    return found.recast(dict(_by_components(found)))


def _by_components(expression: Expr) -> Iterator[tuple[Generator, Expr]]:
    """Lengths of which the square is a sum of squares, by what is squared."""
    for length in lengths_in([expression]):
        components = _squared(length.squared)
        if components and not length.components:
            again = kept_length(components, length.letter)
            if any(isinstance(g, Length) for g in again.generators):
                yield length, again


def _squared(polynomial: Expr) -> list[Expr]:
    """Polynomials whose squares add up to one; none where such are not seen."""
    parts = _independent_parts(polynomial)
    varying = [part for part in parts if part.varies]
    constant = [part for part in parts if not part.varies]
    found = list[Expr]()
    for part in varying:
        # y² − 2 l y is completed by l²
        roots = ((_root_of_square(part + term), term) for term in (ZERO, *constant))
        root, used = next(((root, term) for root, term in roots if root is not None), (None, ZERO))
        if root is None:
            return []
        found.append(root)
        constant = [term for term in constant if term is not used]
    left = _root_of_square(total(constant))
    return [] if left is None else [*found, left] if constant else found


def _independent_parts(polynomial: Expr) -> list[Expr]:
    """Sums of terms such that no two of them have a quantity that varies in common."""
    parts: list[tuple[set[Generator], Expr]] = []
    for powers, coefficient in polynomial.terms():
        term = Expr.product(powers) * coefficient
        shared = {g for g in powers if g.varies}
        joined = [part for part in parts if part[0] & shared]
        parts = [part for part in parts if not part[0] & shared]
        own = shared.union(*(generators for generators, _ in joined))
        parts.append((own, total([term, *(sum_ for _, sum_ in joined)])))
    return [part for _, part in parts]


def _root_of_square(polynomial: Expr) -> Expr | None:
    """The polynomial of which one is the square; None where there is none."""
    number, powers = factors(polynomial)
    root = Fraction(isqrt(abs(number.numerator)), isqrt(number.denominator))
    if root**2 != number or any(power % 2 for power in powers.values()):
        return None
    halves = (factor ** (power // 2) for factor, power in powers.items())
    return prod(halves, start=Expr.constant(root))


# -- factors ---------------------------------------------------------------------------------------


def _in_factors(expression: Expr) -> Expr:
    """With the factors above and below the bar as they are."""
    return kept_sum(expression.numerator) / kept_sum(expression.denominator)

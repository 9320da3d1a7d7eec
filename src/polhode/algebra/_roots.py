"""Square roots: algebraic generators, simplified as far as known signs allow."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from math import prod

from flint import fmpz

from polhode.algebra._expression import ONE, Composite, Expr, ExprLike, Rate
from polhode.algebra._forms import in_shortest_squares, shortest
from polhode.algebra._residues import FieldPoint, Residue
from polhode.algebra._ring import Ball, Generator, Polynomial, Ring, as_fraction
from polhode.base import NumericError


@dataclass(frozen=True)
class SquareRoot(Composite):
    """The non-negative square root of a polynomial; |f| where that is the square of f."""

    radicand: Expr
    positive = True

    @cached_property
    def plain(self) -> Expr | None:
        """f, where the radicand is the square of f and the root therefore |f|."""
        found = (root(self.radicand) for root in (principal_root, _seen_root, _nested_root))
        return next((f for f in found if f is not None and self not in f.generators), None)

    @cached_property
    def key(self) -> str:  # type: ignore[override]
        return f"sqrt({self.radicand.key})"

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def depth(self) -> int:
        return 1 + max((g.depth for g in self.radicand.generators), default=0)

    def companions(self) -> tuple[Generator, ...]:
        return self.radicand.generators

    def square(self, ring: Ring) -> Polynomial:
        return ring.lift(self.radicand.ring, self.radicand.num)

    def refined(self, others: tuple[Generator, ...]) -> Expr | None:
        finer = dict[Generator, Expr]()
        for generator in self.radicand.generators:
            if isinstance(generator, Composite) and (unit := generator.refined(others)) is not None:
                finer[generator] = unit
        return sqrt(self.radicand.recast(finer)) if finer else None

    @property
    def inside(self) -> Expr:
        return self.radicand

    def remade(self, inside: Expr) -> Expr:
        return sqrt(inside)

    def ball(self, state: int) -> Ball:
        return self.radicand.ball(state).sqrt()

    def residue(self, point: FieldPoint) -> Residue:
        is_number = self.radicand.rational is not None
        return point.root(self.key, self.radicand.residue(point), is_number=is_number)

    def chain(self, rate: Rate) -> Expr:
        return self.radicand.chain(rate) / (2 * Expr.generator(self))


def sqrt(x: ExprLike) -> Expr:
    """The non-negative square root.

    Factors known to be positive come out: √(a²b) = a√b for positive a. Where a sign is not known
    the root of a square stays as an absolute value. Raises `NumericError` for a negative number.
    """
    x = Expr.of(x)
    if x.is_zero:
        return x
    # √(f g) = √f √g holds only if one factor is not negative. So positive factors each have a
    # root, squares become |f|, and the factors of unknown sign stay together under one root.
    number, powers = factors(x)
    known = {f: e for f, e in powers.items() if is_plainly_positive(f)}
    open_ = {f: e for f, e in powers.items() if f not in known and e % 2}
    squares = {f: e for f, e in powers.items() if f not in known and not e % 2}
    result = _root_of_number(abs(number))
    for factor, exponent in known.items():
        result = result * (_root(factor) if exponent % 2 else ONE) * factor ** (exponent // 2)
    for factor, exponent in squares.items():
        result = result * _size(factor) ** (exponent // 2)
    return result * _root_of_unknown_sign(1 if number > 0 else -1, open_)


def principal_root(x: ExprLike) -> Expr:
    """A square root that is a plain expression wherever x is a perfect square.

    √(sin²θ) is sin θ here: the branch on which it is positive. Callers must state that choice.
    """
    x = Expr.of(x)
    number, powers = factors(x)
    if number <= 0 or any(e % 2 for f, e in powers.items() if not is_plainly_positive(f)):
        return sqrt(x)
    halves = (sqrt(f) ** e if is_plainly_positive(f) else f ** (e // 2) for f, e in powers.items())
    return prod(halves, start=_root_of_number(number))


def _seen_root(square: Expr) -> Expr | None:
    """The root of a square that shows only with cos² for some sin²: (a cos θ + b sin²θ)²."""
    ring = square.ring
    content, pairs = in_shortest_squares(ring, square.num).factor()
    if any(exponent % 2 for _, exponent in pairs):
        return None
    found = (Expr(ring, ring.reduce(f), ring.one) ** (int(e) // 2) for f, e in pairs)
    return prod(found, start=_root_of_number(as_fraction(content)))


def absolute(x: ExprLike) -> Expr:
    """|x|, resolved where the sign is known; |f g| is written |f| |g|."""
    x = Expr.of(x)
    if x.is_zero:
        return x
    number, powers = factors(x)
    return prod((_size(f) ** e for f, e in powers.items()), start=Expr.constant(abs(number)))


def _size(factor: Expr) -> Expr:
    if is_plainly_positive(factor):
        return factor
    return -factor if is_plainly_positive(-factor) else _root(factor * factor)


def is_positive(x: Expr) -> bool:
    """Whether the signs of its terms show it to be positive; sufficient, not necessary.

    With cos² for sin² where that is shorter: 5 - 4 sin²θ is 1 + 4 cos²θ.
    """
    return _seen_positive(x.numerator) and _seen_positive(x.denominator)


def is_plainly_positive(x: Expr) -> bool:
    """The same for the terms in normal form; decides which factors come out of a root."""
    return _all_positive(x.numerator) and _all_positive(x.denominator)


def _nested_root(square: Expr) -> Expr | None:
    """The root of a square in which one other root √A occurs: of A − 2 l √A + l² it is l − √A."""
    inner = (g for g in square.generators if isinstance(g, SquareRoot) and g.plain is None)
    found = (f for root in inner for f in _roots_with(root, square))
    return next((f for f in found if f * f == square), None)


def _roots_with(inner: SquareRoot, square: Expr) -> Iterator[Expr]:
    """What can be the root of p + q √A, in terms of its own generators.

    Where it is (a + b √A)², the numbers 2a² and 2b²A are p ± √(p² − q²A).
    """
    below = Expr.generator(inner)
    other = square.recast({inner: -below})
    even, odd = (square + other) / 2, (square - other) / (2 * below)
    with suppress(NumericError):  # p² − q²A or a² is negative: then there are no such a and b
        spread = principal_root(even * even - odd * odd * inner.radicand)
        for half in ((even + spread) / 2, (even - spread) / 2):
            if half:
                first = principal_root(half)
                found = first + odd / (2 * first) * below
                if set(found.generators) <= set(square.generators):
                    yield found


def _seen_positive(polynomial: Expr) -> bool:
    if _all_positive(polynomial):
        return True
    ring = polynomial.ring
    return _all_positive(Expr(ring, in_shortest_squares(ring, polynomial.num), ring.one))


def _all_positive(polynomial: Expr) -> bool:
    # a sum of non-negative terms is positive if one of them cannot vanish
    strict = False
    for powers, coefficient in polynomial.terms():
        if coefficient < 0 or any(p % 2 and not g.positive for g, p in powers.items()):
            return False
        strict = strict or all(g.positive for g in powers)
    return strict


def _root(radicand: Expr) -> Expr:
    return Expr.generator(SquareRoot(radicand.trimmed()))


def factors(x: Expr) -> tuple[Fraction, dict[Expr, int]]:
    """A number, and irreducible factors with their powers, negative ones below the bar."""
    number, powers = _factors_of(x.ring, shortest(x.ring, x.num))
    below, divisors = _factors_of(x.ring, shortest(x.ring, x.den))
    for factor, exponent in divisors.items():
        powers[factor] = powers.get(factor, 0) - exponent
    return number / below, {f: e for f, e in powers.items() if e}


def factors_of_numerator(x: Expr) -> tuple[Fraction, dict[Expr, int]]:
    """The same of a numerator, by whichever form in sines and cosines has most factors.

    a² cos²α − 2 a v sin α cos α + v² sin²α is a square, which with one of the two functions alone
    it does not look like.
    """
    form, other = shortest(x.ring, x.num), in_shortest_squares(x.ring, x.num)
    found = [_factors_of(x.ring, form) for form in ([form] if form == other else [form, other])]
    return max(found, key=lambda result: sum(result[1].values()))


def _factors_of(ring: Ring, polynomial: Polynomial) -> tuple[Fraction, dict[Expr, int]]:
    content, pairs = polynomial.factor()
    powers = dict[Expr, int]()
    for factor, exponent in pairs:
        base = Expr(ring, ring.reduce(factor), ring.one)
        powers[base] = powers.get(base, 0) + int(exponent)
    return as_fraction(content), powers


def _root_of_number(number: Fraction) -> Expr:
    # √(p/q) = √(p q)/q; a root for each prime, so that √6 = √2 √3 has one form
    outside, inside = Fraction(1, number.denominator), ONE
    for prime, exponent in fmpz(number.numerator * number.denominator).factor():
        outside *= int(prime) ** (int(exponent) // 2)
        if exponent % 2:
            inside = inside * _root(Expr.constant(int(prime)))
    return inside * outside


def _root_of_unknown_sign(sign: int, powers: dict[Expr, int]) -> Expr:
    if not powers:
        if sign < 0:
            raise NumericError(
                "the square root of a negative number",
                expected="a radicand that can be positive",
                advice="check the signs under the root",
            )
        return ONE
    if len(powers) == 1:
        ((factor, exponent),) = powers.items()
        return _root(factor * sign) ** exponent
    # all exponents e are odd: √(Π f^e) = √(Π f) / Π |f|^((1 - e)/2)
    below = prod((_size(f) ** ((1 - e) // 2) for f, e in powers.items()), start=ONE)
    return _root(prod(powers, start=Expr.constant(sign))) / below


def merged_roots(x: Expr) -> Expr:
    """The expression with |r| for √f √h where f h is the square of r.

    √(1 - cos θ) √(1 + cos θ) is |sin θ|.
    """
    roots = [g for g in x.generators if isinstance(g, SquareRoot) and g.plain is None]
    for one, other in combinations(roots, 2):
        size = sqrt(one.radicand * other.radicand)
        if all(g.plain is not None for g in size.generators if isinstance(g, SquareRoot)):
            return merged_roots(x.recast({one: size * Expr.generator(other) / other.radicand}))
    return x


# -- roots replaced --------------------------------------------------------------------------------
#
# |x| is x on one side of zero and −x on the other. Once that is substituted, x/|x| becomes 1 or −1,
# and 1/(1 + |x|) loses the denominator 1 − x² of its normal form.


def roots_in(expressions: Iterable[Expr]) -> tuple[SquareRoot, ...]:
    """Every square root that occurs, also within functions and named parts; inner ones first."""
    roots: dict[SquareRoot, None] = {}
    seen: set[Generator] = set()
    for expression in expressions:
        roots |= dict.fromkeys(_roots_in(expression, seen))
    return tuple(roots)


def _roots_in(expression: Expr, seen: set[Generator]) -> Iterator[SquareRoot]:
    for generator in expression.generators:
        if generator in seen:
            continue
        seen.add(generator)
        if isinstance(generator, Composite):
            yield from _roots_in(generator.inside, seen)
        if isinstance(generator, SquareRoot):
            yield generator


def with_roots(expression: Expr, images: Mapping[SquareRoot, Expr]) -> Expr:
    """An expression with some of its square roots replaced, also within functions and parts.

    Roots that appear only once others are replaced, as |x − 1| in ||x| − 1|, are replaced too.
    """
    if not images:
        return expression
    return _RootReplacement(images).of(expression)


class _RootReplacement:
    """Replaces roots, and caches the image of each function and part."""

    def __init__(self, images: Mapping[SquareRoot, Expr]) -> None:
        self._known: dict[Generator, Expr | None] = {r: e for r, e in images.items()}  # noqa: C416

    def of(self, expression: Expr) -> Expr:
        """The expression with its images; the same object where nothing changes."""
        images = {g: image for g in expression.generators if (image := self._image(g)) is not None}
        return expression.recast(images) if images else expression

    def _image(self, generator: Generator) -> Expr | None:
        """The image of a generator; None where it is unchanged."""
        if generator not in self._known:
            image = None
            if isinstance(generator, Composite):
                before = generator.inside
                after = self.of(before)
                image = None if after is before else self.of(generator.remade(after))
            self._known[generator] = image
        return self._known[generator]

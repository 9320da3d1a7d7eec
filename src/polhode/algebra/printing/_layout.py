"""An expression as a textbook would set it: the display tree that all printers share."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import gcd
from typing import Any, TypeVar

from flint.utils.flint_exceptions import DomainError

from polhode.algebra._arctangent import Arctangent
from polhode.algebra._expression import ONE, ZERO, Expr
from polhode.algebra._forms import (
    LONGEST_TO_FACTOR,
    Factored,
    content,
    extracted,
    factorised,
    in_shortest_squares,
    over_cosines,
    powers_of,
    products,
    terms,
)
from polhode.algebra._functions import Elementary, Exponential
from polhode.algebra._lengths import KeptSum, Length
from polhode.algebra._parts import Lettered, under_letters
from polhode.algebra._ring import Generator, Monomial, Polynomial, Ring, Symbol, as_fraction
from polhode.algebra._roots import SquareRoot, is_plainly_positive
from polhode.algebra.printing._nodes import (
    PrintCall,
    PrintLetter,
    PrintName,
    PrintNode,
    PrintNumber,
    PrintRadical,
    PrintSum,
    fraction,
    power,
    product,
    total,
)
from polhode.algebra.printing._order import (
    CONSTANT_SUM,
    EXPONENTIAL,
    VARYING_SUM,
    Rank,
    absolute_value_rank,
    factor_rank,
    is_constant,
    radical_rank,
    term_order,
    term_rank,
)
from polhode.algebra.printing._shorter import shortest_quotient
from polhode.algebra.printing._sums_of_angles import in_sums_of_angles

#: Terms are collected by constants, as in I₁(θ̇² + φ̇² sin²θ), only if the size shrinks to this.
_MUCH = 0.85

#: Of more terms than this, the form with sums of angles is taken where it has much fewer, and only
#: there; of fewer, the shorter one once both are written.
_MANY = 12

#: Of at most so many terms, some are put in brackets behind what they have in common.
_FEW = 8

_SUMS = 16384  # sums whose form is remembered

#: A factor with its rank among the others and its power.
Placed = tuple[Rank, PrintNode, int]


@lru_cache(maxsize=1024)
def layout(expression: Expr) -> PrintNode:
    """The display tree of an expression: the shortest of its textbook forms."""
    if expression.is_zero:
        return PrintNumber(0)
    if expression.ring.has_parts:
        ((expression,), _) = under_letters((expression,))
    expression = expression.trimmed()
    ring = expression.ring
    num, den = shortest_quotient(expression)
    middle, above = in_sums_of_angles(ring, num)
    wider, below = in_sums_of_angles(middle, middle.lift(ring, den))
    is_shorter, is_open = len(above) < _MUCH * len(num), len(num) <= _MANY
    forms = list[PrintNode]()
    if wider is not ring and (is_shorter or is_open):
        forms += _quotients(wider, wider.lift(middle, above), below)
    if not forms or is_open:
        forms += _quotients(ring, num, den)
    return _shortest(forms)


def _quotients(ring: Ring, num: Polynomial, den: Polynomial) -> list[PrintNode]:
    """As one fraction, and term by term."""
    below, forms = factorised(ring, den).inverse(), _products(ring, num)
    if len(num) > LONGEST_TO_FACTOR:  # which is shorter can be told without writing both
        bare = forms[0].is_bare and below.is_bare
        split = list(_split(ring, num, below)) if bare else []
        return split or [_term(ring, forms[0] * below)]
    return [*_split(ring, num, below), *(_term(ring, form * below) for form in forms)]


def _split(ring: Ring, num: Polynomial, below: Factored) -> Iterator[PrintNode]:
    """Each term over its own denominator; divisors that no term cancels are put outside."""
    if below.sums:
        return
    degrees = dict(zip(ring.generators, map(int, num.degrees()), strict=True))
    common = {g: min(p + degrees[g], 0) for g, p in below.powers.items()}
    outside = Factored(powers={g: p for g, p in common.items() if p})
    inside = _scaled_sum(ring, num, below * outside.inverse())
    if not outside.powers:
        yield inside
    elif isinstance(inside, PrintSum):
        yield _product(outside, [(VARYING_SUM, inside, 1)])


def _shortest(candidates: Iterable[PrintNode]) -> PrintNode:
    return min(candidates, key=lambda node: node.size)


# -- sums ------------------------------------------------------------------------------------------

Powers = dict[Generator, int]


@lru_cache(maxsize=_SUMS)
def _sum_of(polynomial: Expr) -> PrintNode:
    """A polynomial, collected by what varies or by the constants.

    Most sums occur in many of the forms that are compared, and in many expressions.
    """
    return _scaled_sum(polynomial.ring, polynomial.num, Factored())


@lru_cache(maxsize=_SUMS)
def _products_of(polynomial: Expr, ring: Ring) -> tuple[Factored, ...]:
    """Its forms as a product; equal polynomials may lie in different rings."""
    return tuple(products(ring, polynomial.num))


def _products(ring: Ring, polynomial: Polynomial) -> tuple[Factored, ...]:
    return _products_of(Expr(ring, polynomial, ring.one), ring)


def _scaled_sum(ring: Ring, polynomial: Polynomial, scale: Factored) -> PrintNode:
    """A polynomial times a single term."""
    polynomial, order = in_shortest_squares(ring, polynomial), term_order(ring)
    by_varying = _groups(ring, polynomial, order.varying)
    collected = _collected(ring, by_varying, scale)
    if len(polynomial) > LONGEST_TO_FACTOR:
        return collected
    gathered = _gathered_by_sum(ring, by_varying, scale)
    if gathered is not None and gathered.size < collected.size:
        collected = gathered
    for chosen, much in ((order.kept, 1.0), (order.constant, _MUCH)):
        groups = _groups(ring, polynomial, chosen)
        if 1 < len(groups) < len(polynomial):
            other = _collected(ring, groups, scale)
            collected = other if other.size < much * collected.size else collected
    if len(polynomial) <= _FEW:
        saved = (1 - _MUCH) * collected.size
        bracketed = _shortest([collected, *_bracketed(ring, polynomial, scale, saved)])
        collected = bracketed if bracketed.size < collected.size - saved else collected
    return collected


def _bracketed(
    ring: Ring, polynomial: Polynomial, scale: Factored, saved: float
) -> Iterator[PrintNode]:
    """With the terms together that have one generator in common: l θ̈ + (g + Z̈) sin θ.

    Only where that may save as many nodes.
    """
    order = term_order(ring)
    monomials = sorted(polynomial.monoms(), key=order.rank)
    for place in range(len(ring.generators)):
        shared = [m for m in monomials if m[place]]
        # 2 a² + 2 a b + b² stays as it is
        if len({int(m[place]) for m in shared}) != 1 or not 1 < len(shared) < len(monomials):
            continue
        common = [p for p in map(min, zip(*shared, strict=True)) if p]
        if (len(shared) - 1) * (len(common) + sum(p > 1 for p in common) + 1) <= saved:
            continue
        inner = _chosen(ring, polynomial, shared)
        together = _shortest(_term(ring, scale * form) for form in _products(ring, inner))
        start = monomials.index(shared[0])
        apart = monomials[:start], [m for m in monomials[start:] if not m[place]]
        first, last = (
            _groups(ring, _chosen(ring, polynomial, part), order.varying) for part in apart
        )
        before = _addends(_collected(ring, first, scale)) if first else ()
        after = _addends(_collected(ring, last, scale)) if last else ()
        yield total([*before, *_addends(together), *after])


def _chosen(ring: Ring, polynomial: Polynomial, monomials: Iterable[Monomial]) -> Polynomial:
    """Some of its terms."""
    return ring.context.from_dict({m: polynomial[m] for m in monomials})


def _gathered_by_sum(
    ring: Ring, groups: Sequence[tuple[Powers, Polynomial]], scale: Factored
) -> PrintNode | None:
    """With the terms together that have a sum of constants in common.

    (I + m a²) (φ̈ sin θ + 2 θ̇ φ̇ cos θ) has I + m a² once.
    """
    sums = [
        {str(s): s for s, _ in factorised(ring, c).sums} if len(c) > 1 else {} for _, c in groups
    ]
    often = Counter(key for found in sums for key in found)
    name = next((key for found in sums for key in found if often[key] > 1), None)
    if name is None:
        return None
    shared = next(found[name] for found in sums if name in found)
    before, after = list[tuple[Powers, Polynomial]](), list[tuple[Powers, Polynomial]]()
    inner = ring.zero
    for (outer, coefficient), found in zip(groups, sums, strict=True):
        if name in found:
            product = Expr.product(outer) * Expr(ring, coefficient / shared, ring.one)
            inner = inner + ring.lift(product.ring, product.num)
        else:
            (before if inner == 0 else after).append((outer, coefficient))
    common = scale * Factored(sums=((shared, 1),))
    together = _shortest(_term(ring, common * form) for form in _products(ring, inner))
    first, last = (
        _addends(_collected(ring, apart, scale)) if apart else () for apart in (before, after)
    )
    return total([*first, *_addends(together), *last])


def _groups(
    ring: Ring, polynomial: Polynomial, chosen: Sequence[int]
) -> list[tuple[Powers, Polynomial]]:
    """Every product of the generators at chosen places, with its coefficient, as printed."""
    order = term_order(ring)
    groups: dict[Monomial, dict[Monomial, Any]] = defaultdict(dict)
    first = dict[Monomial, Rank]()
    for monomial, coefficient in polynomial.to_dict().items():
        inner, outer = list(monomial), [0] * len(monomial)
        for place in chosen:
            outer[place], inner[place] = monomial[place], 0
        product, rank = tuple(outer), order.rank(monomial)
        groups[product][tuple(inner)] = coefficient
        first[product] = min(rank, first.get(product, rank))
    return [
        (powers_of(ring, outer), ring.context.from_dict(groups[outer]))
        for outer in sorted(groups, key=first.__getitem__)
    ]


def _collected(
    ring: Ring, groups: Iterable[tuple[Powers, Polynomial]], scale: Factored
) -> PrintNode:
    nodes: list[PrintNode] = []
    for outer, coefficient in groups:
        if outer:
            common = scale * Factored(powers=outer)
            forms = (_term(ring, common * form) for form in _products(ring, coefficient))
            nodes += _addends(_shortest(forms))
        else:
            scaled = (scale * term for term in terms(ring, coefficient))
            ordered = sorted(scaled, key=lambda term: term_rank(term.powers))
            written = total([_term(ring, term) for term in ordered])
            if nodes:
                bracket = _term(ring, scale * extracted(ring, coefficient))
                written = _shortest([written, bracket])
            nodes += _addends(written)
    return total(nodes)


def _addends(node: PrintNode) -> tuple[PrintNode, ...]:
    return node.terms if isinstance(node, PrintSum) else (node,)


# -- products --------------------------------------------------------------------------------------


def _term(ring: Ring, factored: Factored) -> PrintNode:
    sums = []
    for polynomial, exponent in factored.sums:
        used = zip(ring.generators, polynomial.degrees(), strict=True)
        constant = all(is_constant(g) for g, degree in used if degree > 0)
        rank = CONSTANT_SUM if constant else VARYING_SUM
        sums.append((rank, _sum_of(Expr(ring, polynomial, ring.one)), exponent))
    return _product(factored, sums)


def _product(factored: Factored, sums: list[Placed]) -> PrintNode:
    """A product with one fraction bar; the sums of `factored` are given as nodes."""
    radicals = _gathered(factored.number, factored.powers)
    number = radicals.number
    number, sums = _turned(number, sums, lambda _, signs: all(signs))
    number, sums = _turned(number, sums, lambda outside, signs: outside < 0 and any(signs))
    placed = [*_powers(radicals.powers), *_roots(radicals), *sums]
    placed.sort(key=lambda factor: factor[0])
    above = [power(node, p) for _, node, p in placed if p > 0]
    below = [power(node, -p) for _, node, p in placed if p < 0]
    return fraction(product(number.numerator, above), product(number.denominator, below))


def _turned(
    number: Fraction, sums: list[Placed], wrong: Callable[[Fraction, list[bool]], bool]
) -> tuple[Fraction, list[Placed]]:
    """Sums negated where `wrong` says so, and the number's sign changed to match.

    `wrong` decides by the number and by which terms of the sum are negative.
    """
    turned = []
    for rank, node, exponent in sums:
        if exponent % 2 and wrong(number, [term.is_negative for term in _addends(node)]):
            number, node = -number, total(list(_addends(node.negated())))
        turned.append((rank, node, exponent))
    return number, turned


def _roots(radicals: _Radicals) -> Iterator[Placed]:
    if radicals.power:
        radicand = PrintRadical(layout(radicals.radicand))
        yield radical_rank(radicals.radicand.generators), radicand, radicals.power
    for size, exponent in radicals.sizes.items():
        yield absolute_value_rank(size.generators), PrintCall("abs", layout(size)), exponent
    for root, exponent in radicals.loose.items():
        yield factor_rank(root), PrintRadical(layout(root.radicand)), exponent


def _powers(powers: Powers) -> Iterator[Placed]:
    exponents = ZERO
    for generator, exponent in powers.items():
        if isinstance(generator, Exponential):
            exponents = exponents + generator.argument * exponent
        else:
            yield factor_rank(generator), _generator(generator), exponent
    if exponents:
        yield EXPONENTIAL, PrintCall("exp", layout(exponents)), 1


@lru_cache(maxsize=4096)
def _generator(generator: Generator) -> PrintNode:
    match generator:
        case Elementary():
            return PrintCall(generator.name, layout(generator.argument))
        case Arctangent():
            return PrintCall("atan", layout(generator.inside))
        case Symbol():
            return PrintName(generator)
        case KeptSum():
            return layout(generator.meaning)
        case Length():
            letter: PrintNode = PrintName(Symbol(generator.letter.name))
            if generator.letter.of_velocity:
                letter = PrintCall("abs", letter)
            return PrintLetter(letter, layout(generator.meaning))
        case Lettered():
            return PrintLetter(PrintName(Symbol(generator.letter)), layout(generator.meaning))
    raise TypeError(f"{generator.key} is no symbol or function")


# -- the roots of one term: √g/√a is printed √(g/a), and √(f²) is |f| ------------------------------

K = TypeVar("K")


@dataclass(frozen=True)
class _Radicals:
    """number · √radicand^power · Π |size|^power · Π loose root^power · Π generator^power."""

    number: Fraction
    radicand: Expr
    power: int
    sizes: dict[Expr, int]
    loose: dict[SquareRoot, int]
    powers: dict[Generator, int]


def _gathered(number: Fraction, powers: Mapping[Generator, int]) -> _Radicals:
    """The roots of a term under one root, where that is valid whatever the signs.

    It is for roots of positive radicands, and for one more of unknown sign.
    """
    roots = {g: p for g, p in powers.items() if isinstance(g, SquareRoot)}
    others = {g: p for g, p in powers.items() if g not in roots}
    absolute = {root: _absolute_of(root) for root in roots}
    sizes = {f: roots[root] for root, f in absolute.items() if f is not None}
    below = {g: Expr.generator(g) for g, p in others.items() if p < 0 and p % 2 == 0}
    squares = {below[g]: others[g] for g in below if below[g] in sizes}  # |f|/f² is 1/|f|
    others = {g: p for g, p in others.items() if below.get(g) not in squares}
    sizes = {f: p + squares.get(f, 0) for f, p in sizes.items()}
    plain = {root: p for root, p in roots.items() if absolute[root] is None}
    safe = {root: p for root, p in plain.items() if is_plainly_positive(root.radicand)}
    loose = {root: p for root, p in plain.items() if root not in safe}
    if list(loose.values()) == [1]:
        safe, loose = plain, {}
    power = max(safe.values(), default=0)
    radicand = ONE
    for root, exponent in safe.items():
        radicand = radicand * root.radicand ** (exponent * power)
    if power > 0:
        number, radicand = _with_number_below(number, radicand)
        radicand, sizes = _with_divisors_inside(radicand, {f: f for f in sizes}, sizes)
        positive = {g: Expr.generator(g) for g in others if g.positive}
        radicand, others = _with_divisors_inside(radicand, positive, others)
    return _Radicals(number, radicand, power, sizes, loose, others)


def _with_number_below(number: Fraction, radicand: Expr) -> tuple[Fraction, Expr]:
    """√(2g)/2 is √(g/2)."""
    inside = content(as_fraction(c) for c in radicand.num.coeffs()).numerator
    shared = gcd(inside, number.denominator)
    if shared == 1 or radicand.rational is not None:
        return number, radicand
    return number * shared, radicand / shared**2


def _with_divisors_inside(
    radicand: Expr, values: Mapping[K, Expr], powers: dict[K, int]
) -> tuple[Expr, dict[K, int]]:
    """√(q r)/q is √(r/q), for values q that are not negative."""
    found = dict(powers)
    for key, value in values.items():
        if found[key] < 0 and (radicand.numerator / value).is_polynomial:
            radicand = radicand / value**2
            found[key] += 1
    return radicand, {key: p for key, p in found.items() if p}


@lru_cache(maxsize=1024)
def _absolute_of(root: SquareRoot) -> Expr | None:
    """The expression whose absolute value the root is, if it is one."""
    ring, num = root.radicand.ring, root.radicand.num
    for form in (num, over_cosines(ring, num), in_shortest_squares(ring, num)):
        with suppress(DomainError):  # not a square
            return Expr(ring, ring.reduce(form.sqrt()), ring.one)
    return None

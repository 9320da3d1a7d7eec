"""An expression as a text would set it: the display tree that all printers share."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from functools import lru_cache

from polhode.algebra._arrange import (
    CONSTANT_SUM,
    VARYING_SUM,
    Rank,
    factor_rank,
    is_constant,
    radical_rank,
    term_rank,
)
from polhode.algebra._expression import ZERO, Expr
from polhode.algebra._factored import Factored, extracted, factorisations, factorised, terms
from polhode.algebra._functions import Elementary, Exponential
from polhode.algebra._generators import Generator, Symbol
from polhode.algebra._nodes import (
    Call,
    Name,
    Node,
    Number,
    Radical,
    Sum,
    fraction,
    power,
    product,
    total,
)
from polhode.algebra._quotient import shortest_quotient
from polhode.algebra._radicals import gathered
from polhode.algebra._ring import Monomial, Polynomial, Ring
from polhode.algebra._roots import Root
from polhode.algebra._squares import in_shortest_squares

#: A factor, where it stands among the others, and its power.
Placed = tuple[Rank, Node, int]


def layout(expression: Expr) -> Node:
    """The display tree of an expression: the shortest of its textbook forms."""
    if expression.is_zero:
        return Number(0)
    ring = expression.ring
    num, den = shortest_quotient(expression)
    below = factorised(ring, den).inverse()
    forms = (extracted(ring, num), *factorisations(ring, num))
    candidates = [_term(ring, form * below) for form in forms]
    if not below.sums:
        candidates.insert(0, _sum(ring, num, below))
    return _shortest(candidates)


def _shortest(candidates: list[Node]) -> Node:
    return min(candidates, key=lambda node: node.size)


# --- sums ---


def _sum(ring: Ring, polynomial: Polynomial, scale: Factored) -> Node:
    """A polynomial times a single term, collected by what varies."""
    groups = sorted(
        _groups(ring, in_shortest_squares(ring, polynomial)),
        key=lambda group: term_rank(group[0].powers),
    )
    nodes = [_group(ring, varying * scale, constant) for varying, constant in groups]
    return total([term for node in nodes for term in _addends(node)])


def _groups(ring: Ring, polynomial: Polynomial) -> Iterator[tuple[Factored, Polynomial]]:
    """Every product of varying quantities, with its constant coefficient."""
    varies = [not is_constant(g) for g in ring.generators]
    groups: dict[Monomial, dict[Monomial, object]] = defaultdict(dict)
    for monomial, coefficient in polynomial.terms():
        pairs = list(zip(monomial, varies, strict=True))
        constant = tuple(0 if v else p for p, v in pairs)
        groups[tuple(p if v else 0 for p, v in pairs)][constant] = coefficient
    for monomial, coefficients in groups.items():
        (varying,) = terms(ring, ring.context.from_dict({monomial: 1}))
        yield varying, ring.context.from_dict(coefficients)


def _group(ring: Ring, varying: Factored, constant: Polynomial) -> Node:
    if len(constant) == 1:
        return _term(ring, varying * next(terms(ring, constant)))
    forms = (extracted(ring, constant), *factorisations(ring, constant))
    if varying.powers:
        return _shortest([_term(ring, varying * form) for form in forms])
    ordered = sorted(terms(ring, constant), key=lambda term: term_rank(term.powers))
    flat = total([_term(ring, varying * term) for term in ordered])
    products = [_term(ring, varying * form) for form in forms if not form.is_sum]
    return _shortest([flat, *products])


def _addends(node: Node) -> tuple[Node, ...]:
    return node.terms if isinstance(node, Sum) else (node,)


# --- products ---


def _term(ring: Ring, factored: Factored) -> Node:
    """A product with one fraction bar."""
    roots = {g: p for g, p in factored.powers.items() if isinstance(g, Root)}
    radicals = gathered(factored.number, roots)
    number = radicals.number
    placed = list(_powers(factored.powers))
    if radicals.power:
        rank = radical_rank(all(is_constant(g) for g in radicals.radicand.generators))
        placed.append((rank, Radical(layout(radicals.radicand)), radicals.power))
    placed += [((4,), Call("abs", layout(f)), p) for f, p in radicals.sizes.items()]
    placed += [(factor_rank(g), Radical(layout(g.radicand)), p) for g, p in radicals.loose.items()]
    for polynomial, exponent in factored.sums:
        node = _sum(ring, polynomial, Factored())
        if exponent % 2 and _prefers_negation(node, number < 0):
            number, node = -number, total(list(_addends(node.negated())))
        placed.append((_sum_rank(ring, polynomial), node, exponent))
    placed.sort(key=lambda factor: factor[0])
    above = [power(node, p) for _, node, p in placed if p > 0]
    below = [power(node, -p) for _, node, p in placed if p < 0]
    return fraction(product(number.numerator, above), product(number.denominator, below))


def _prefers_negation(node: Node, outside: bool) -> bool:
    """Whether most terms are negative, or half of them where a minus sign stands outside."""
    addends = _addends(node)
    negative = sum(term.is_negative for term in addends)
    return 2 * negative + outside > len(addends)


def _sum_rank(ring: Ring, polynomial: Polynomial) -> Rank:
    used = zip(ring.generators, polynomial.degrees(), strict=True)
    constant = all(is_constant(g) for g, degree in used if degree)
    return CONSTANT_SUM if constant else VARYING_SUM


def _powers(powers: dict[Generator, int]) -> Iterator[Placed]:
    exponent = ZERO
    for generator, exponent_here in powers.items():
        if isinstance(generator, Exponential):
            exponent = exponent + generator.argument * exponent_here
        elif not isinstance(generator, Root):
            yield factor_rank(generator), _generator(generator), exponent_here
    if exponent:
        yield (3,), Call("exp", layout(exponent)), 1


@lru_cache(maxsize=4096)
def _generator(generator: Generator) -> Node:
    match generator:
        case Symbol():
            return Name(generator)
        case Elementary(argument=argument):
            return Call(generator.name, layout(argument))
    raise TypeError(f"no display for {generator!r}")

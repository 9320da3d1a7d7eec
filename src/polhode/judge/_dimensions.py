"""Dimensional analysis of a claim, as far as the declaration determines dimensions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

from polhode.algebra import Expr, Generator, Ring, Symbol, SymbolKind, Vector, under_name
from polhode.base import LENGTH, MASS, PURE, TIME, ByIdentity, Dimension, PolhodeError, read_unit
from polhode.derive import Equations
from polhode.judge._notation import Notation
from polhode.judge._verdict import MemberAtOdds
from polhode.judge.balance._declared import declared, reaction_symbol
from polhode.judge.latex._names import spelled
from polhode.judge.latex._tree import Name, Node, Number, UnitSymbol, walk
from polhode.judge.meaning._initial_values import initial_value
from polhode.judge.meaning._meaning import Meaning, Tensor
from polhode.judge.meaning._relations import BoundRelation, components
from polhode.judge.states._bound_claim import BoundClaim

FORCE = MASS * LENGTH / TIME**2
_UNIT = "unit "  # before the name of a unit, in that of the symbol for it


def dimensions_at_odds(claim: BoundClaim) -> tuple[MemberAtOdds, ...]:
    """The members whose terms differ in dimension."""
    odd = _members_at_odds(claim.equations, claim.members)
    for place, member in enumerate(claim.members):
        if odd and _puts_in_numbers(member):  # in SI units
            odd.pop(place, None)
    return tuple(MemberAtOdds(member, frozenset(found)) for member, found in odd.items())


def _puts_in_numbers(relation: BoundRelation) -> bool:
    """Whether a side is a calculation with bare numbers, as between mg sin θ = 2 · 9.81 · 0.5 = ...

    A single number without its unit may be wrong for the want of it.
    """
    sides = (relation.printed.left, relation.printed.right) if relation.printed else ()
    pieces = [list(walk(side)) for side in sides]
    return any(
        sum(isinstance(p, Number) for p in found) > 1
        and not any(isinstance(p, Name | UnitSymbol) for p in found)
        for found in pieces
    )


def in_words(odd: Iterable[MemberAtOdds]) -> str:
    """What members have terms of different dimensions."""
    listed = (f"{' and '.join(member.units)} in member {member.member + 1}" for member in odd)
    return f"terms of different dimensions: {'; '.join(listed)}"


def defined_at_odds(equations: Equations, defined: Iterable[Meaning]) -> tuple[MemberAtOdds, ...]:
    """Of the values that a text defines letters as, those whose terms differ in dimension.

    A bare number among the terms is in SI units.
    """
    analysis = _analysis_of(ByIdentity(equations))
    if analysis is None:
        return ()
    odd = []
    for place, value in enumerate(defined):
        parts = value.components if isinstance(value, Vector) else (value,)
        found = {d for e in parts if isinstance(e, Expr) for d in analysis.terms(e)} - {PURE}
        if len(found) > 1:
            odd.append(MemberAtOdds(place, frozenset(found)))
    return tuple(odd)


def are_homogeneous(equations: Equations, relations: Iterable[BoundRelation]) -> bool:
    """Whether all terms of every relation have the same dimension.

    Raises `ParseError` for a scalar set against a vector.
    """
    return not _members_at_odds(equations, relations)


def prints_units(claim: BoundClaim) -> bool:
    """Whether a member of a claim has a unit of measurement in it."""
    return any(_units(relation) for relation in claim.members)


def _units(relation: BoundRelation) -> set[UnitSymbol]:
    sides = (relation.printed.left, relation.printed.right) if relation.printed else ()
    return {p for side in sides for p in walk(side) if isinstance(p, UnitSymbol)}


def _measured(relation: BoundRelation) -> tuple[BoundRelation, dict[Symbol, Dimension]]:
    """The relation with symbols for units and for letters whose value the text gives as a number.

    Numbers alone have no dimension. With it the dimensions of these letters, as far as they are
    known.
    """
    printed = relation.printed
    if printed is None:
        return relation, {}
    letters = printed.evaluator.vocabulary.measured
    numbers = {n: Symbol(f"number {spelled(n)}", SymbolKind.PARAMETER) for n in letters}
    found = _as_symbols(_units(relation))
    found |= {n: Expr.generator(symbol) for n, symbol in numbers.items()}
    known = {s: d for n, s in numbers.items() if (d := letters[n]) is not None}
    return _stating(relation, found), known


def dimension_of_number(notation: Notation, side: Node) -> Dimension | None:
    """The dimension of a number with its unit; None for one without, or with letters in it."""
    pieces = list(walk(side))
    units = {p for p in pieces if isinstance(p, UnitSymbol)}
    if not units or any(isinstance(p, Name) for p in pieces):
        return None
    value = notation.stating(_as_symbols(units)).value(side)
    return dimension_of(value, {}) if isinstance(value, Expr) else None


def _as_symbols(units: Iterable[UnitSymbol]) -> dict[Node, Meaning]:
    """A symbol for each unit, under a name that says which it is."""
    return {u: Expr.generator(Symbol(f"{_UNIT}{u.text}", SymbolKind.PARAMETER)) for u in units}


def _stating(relation: BoundRelation, letters: Mapping[Node, Meaning]) -> BoundRelation:
    """The relation with another meaning for some letters, as far as it is known how it reads."""
    printed = relation.printed
    if not letters or printed is None:
        return relation
    vocabulary = printed.evaluator.vocabulary.stating(letters)
    evaluator = replace(printed.evaluator, vocabulary=vocabulary)
    left, right = evaluator.value(printed.left), evaluator.value(printed.right)
    if isinstance(left, Tensor) or isinstance(right, Tensor):
        return relation
    return replace(relation, left=left, right=right)


def would_fit(claim: BoundClaim, letter: Node, dimension: Dimension) -> bool:
    """Whether all terms have one dimension if a letter has another than as it is read."""
    symbol = Symbol("of another dimension", SymbolKind.PARAMETER)
    relations = [_stating(r, {letter: Expr.generator(symbol)}) for r in claim.members]
    return not _members_at_odds(claim.equations, relations, {symbol: dimension})


def _members_at_odds(
    equations: Equations,
    relations: Iterable[BoundRelation],
    letters: Mapping[Symbol, Dimension] | None = None,
) -> dict[int, set[Dimension]]:
    """The members whose terms have several dimensions, with these dimensions.

    Args:
        equations: of the system.
        relations: the members.
        letters: dimensions of further symbols in them.
    """
    analysis = _analysis_of(ByIdentity(equations))
    if analysis is None:
        return {}
    known = analysis.known
    odd: dict[int, set[Dimension]] = {}
    for member, printed in enumerate(relations):
        relation, of_numbers = _measured(printed)
        if letters or of_numbers:
            analysis = _DimensionalAnalysis({**known, **(letters or {}), **of_numbers})
        # A vector has one dimension along all its axes.
        parts = components(member, relation.left, relation.right)
        sides = [side for part in parts for side in (part.left, part.right)]
        found = {d for side in sides for d in analysis.terms(side)}
        for inside in (d for side in sides for d in analysis.arguments(side)):
            found |= {PURE, inside}
        if len(found) > 1:
            odd[member] = found
    return odd


@lru_cache(maxsize=16)
def _analysis_of(key: ByIdentity[Equations]) -> _DimensionalAnalysis | None:
    """Dimensions by all symbols of a system; None where its declaration contradicts itself."""
    equations = key.subject
    try:
        known = {**equations.dimensions, **_of_reactions(equations)}
    except PolhodeError:
        return None
    for symbol, value in equations.dependent.items():
        follows = None if symbol in known else dimension_of(value, known)
        if follows is not None:
            known[symbol] = follows
    return _DimensionalAnalysis(known | _of_initial_values(equations, known))


def _of_reactions(equations: Equations) -> dict[Symbol, Dimension]:
    """Forces and couples of supports, under the symbols that claims have, and their friction."""
    laws = declared(equations.system).frictions.values()
    coefficients = (f.coefficient for own in laws for f in own if not f.is_couple)
    return {s: PURE for c in coefficients if (s := c.symbol) is not None} | {
        reaction_symbol(line.name): FORCE * LENGTH if line.restraint.is_couple else FORCE
        for line in equations.lines
    }


def _of_initial_values(
    equations: Equations, known: Mapping[Symbol, Dimension]
) -> dict[Symbol, Dimension]:
    """Of coordinates and of their rates at the start, under the symbols that claims have."""
    coordinates = [q for q in declared(equations.system).coordinates if q in known]
    return {initial_value(q): known[q] for q in coordinates} | {
        initial_value(q.derivative()): known[q] / TIME for q in coordinates
    }


def dimension_of(expression: Expr, known: Mapping[Symbol, Dimension]) -> Dimension | None:
    """The dimension of an expression, from its first term; None where it is not known."""
    return next(_DimensionalAnalysis(known).terms(expression), None) if expression else None


class _DimensionalAnalysis:
    """Dimensions of expressions from those of the symbols, computed once for each generator."""

    def __init__(self, known: Mapping[Symbol, Dimension]) -> None:
        self.known = known
        self._found: dict[Generator, Dimension | None] = {}
        self._product = lru_cache(maxsize=4096)(self._multiplied)

    def terms(self, side: Expr) -> Iterator[Dimension]:
        """The dimension of each term of the numerator, divided by that of the denominator."""
        # The denominator is taken as homogeneous: its first term stands for all of them.
        below = PURE if side.is_polynomial else self._product(side.ring, side.den.monoms()[0])
        for powers in side.num.monoms():
            above = self._product(side.ring, powers)
            if above is not None and below is not None:
                yield above if below == PURE else above / below

    def arguments(self, side: Expr) -> Iterator[Dimension]:
        """The dimensions of what stands in sines, exponentials and the like, where it has one."""
        for generator in side.generators:
            if _is_of_number(generator):
                for argument in generator.arguments:
                    yield from (d for d in self.terms(argument) if d != PURE)

    def _multiplied(self, ring: Ring, powers: tuple[int, ...]) -> Dimension | None:
        """The dimension of a product of powers; None if a factor has none that is known."""
        whole = PURE
        for generator, power in zip(ring.generators, map(int, powers), strict=True):
            if not power:
                continue
            if generator not in self._found:
                self._found[generator] = self._dimension(generator)
            found = self._found[generator]
            if found is None:
                return None
            whole = whole * (found if power == 1 else found**power)
        return whole

    def _dimension(self, generator: Generator) -> Dimension | None:
        if isinstance(generator, Symbol):
            if generator.name.startswith(_UNIT):
                return read_unit(generator.name.removeprefix(_UNIT)).dimension
            base = PURE if generator.name == "pi" else self.known.get(generator.base())
            return None if base is None else base / TIME**generator.order
        if under_name(generator) is not None:
            return None  # a named subexpression, which would have to be expanded
        if _is_of_number(generator):
            return PURE
        # What remains is a square root: half the exponents of its radicand.
        radicand = generator.arguments[0]
        inside = (self._product(radicand.ring, powers) for powers in radicand.num.monoms())
        found = next(filter(None, inside), None)
        return None if found is None else found ** Fraction(1, 2)


def _is_of_number(generator: Generator) -> bool:
    """Whether it is sin, cos, sinh, cosh or exp, a pure number of one."""
    is_function = not isinstance(generator, Symbol) and under_name(generator) is None
    return is_function and (not generator.depth or generator.partner() is not None)

"""Steady motions: essential coordinates and all speeds constant; exact, and for given numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import count
from typing import Any

from flint import fmpq, fmpq_poly

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    OutgrownError,
    Symbol,
    SymbolKind,
    as_symbol,
    cos,
    eliminate,
    factors,
    is_positive,
    linear_parts,
    lowest_numerator,
    pi,
    roots_in,
    sin,
    solve,
    sqrt,
    taylor,
    written_out,
)
from polhode.analyse._conditions import Condition, Truth, positive
from polhode.analyse._given import (
    TO_STEADY,
    Given,
    following_speeds,
    refuse_following,
    values_given,
)
from polhode.analyse._reduced import Reduced, reduced_in_parts
from polhode.base import NumericError, Shown
from polhode.derive import Equations, equations_only

Values = Mapping[Symbol, Expr]

_ASIDE = Symbol("aside")


@dataclass(frozen=True)
class Branch(Shown):
    """A relation solved for one quantity.

    Attributes:
        quantity: solved for: a speed, or the sine or cosine of an angle.
        value: of the quantity.
        exists: conditions for the value to be real.
    """

    quantity: Expr
    value: Expr
    exists: tuple[Condition, ...]


@dataclass(frozen=True)
class SteadyMotion(Shown):
    """A family of steady motions.

    Attributes:
        reduced: the system it belongs to.
        fixed: quantities with a definite value on the family.
        relations: further expressions that vanish on it.
    """

    reduced: Reduced
    fixed: dict[Symbol, Expr]
    relations: tuple[Expr, ...]

    @property
    def free(self) -> tuple[Symbol, ...]:
        """State variables that the family leaves open, up to its relations."""
        return tuple(s for s in self.reduced.state if s not in self.fixed)

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """The relation solved for one quantity, with all roots; none for several relations."""
        if len(self.relations) != 1:
            return ()
        return _branches(self.relations[0], self.reduced)

    @property
    def conditions(self) -> tuple[Expr, ...]:
        """Expressions that vanish on the family."""
        fixed = (Expr.generator(symbol) - value for symbol, value in self._told.items())
        return (*fixed, *self.relations)

    def latex(self) -> str:
        """LaTeX of the conditions on the family."""
        pieces = [f"{Expr.generator(s).latex()} = {v.latex()}" for s, v in self._told.items()]
        pieces += [f"{relation.latex()} = 0" for relation in self.relations]
        return r", \quad ".join(pieces) or "0 = 0"

    @property
    def _told(self) -> Mapping[Symbol, Expr]:
        """What is fixed, without the essential coordinates' rates unless there is nothing else."""
        rates = {q.derivative() for q in self.reduced.essential}
        beside = {s: value for s, value in self.fixed.items() if s not in rates}
        return beside if beside or self.relations else self.fixed

    def __repr__(self) -> str:
        return f"SteadyMotion: {self}"

    def __str__(self) -> str:
        pieces = [f"{s.published} = {v}" for s, v in self._told.items()]
        return ", ".join([*pieces, *(f"{r} = 0" for r in self.relations)]) or "every state"


def steady(equations: Equations, at: Mapping[Any, Given] | None = None) -> tuple[SteadyMotion, ...]:
    """All families of steady motions.

    Args:
        equations: derived equations, autonomous.
        at: values of coordinates, speeds or parameters: by name or symbol, as an expression, an SI
            number or text with a unit. The value of a speed that follows from others, such as a
            rate of spin ψ̇ = ω₃ - φ̇ cos θ, restricts these.

    Raises:
        DeclarationError: for a name the system does not have.
        NumericError: where there is no steady motion, or the value of a speed is given that
            depends on a coordinate which steady motion leaves free.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    equations_only(equations, "steady motions")
    given = values_given(equations, at)
    _check_values(equations, given)
    _refuse_outside(equations, given)
    forcing = _written(equations.forcing, equations, given)
    system = reduced_in_parts(equations)
    restrictions = _restrictions(system, given)
    # Of closed loops only those count that no ignorable coordinate, such as a place, can close.
    ignorable = set(equations.coordinates).difference(system.essential)
    closures = equations.closures if equations.motion_in_parts else ()
    closed = [closure for closure in closures if not closure.symbols() & ignorable]
    still = _written((*system.rates, *closed, *restrictions), equations, given)
    rows = [*still, *forcing]
    # x/|x|, as in friction, has no value where its numerator x |x| vanishes
    rows = [row.numerator if any(roots_in([row])) else row for row in rows]
    found, singular, outside = list[SteadyMotion](), list[SteadyMotion](), dict[Symbol, Expr]()
    for fixed, relations in _families(rows, system):
        family = SteadyMotion(system, {**given, **fixed}, _solved_together(relations, system))
        if broken_sign(equations, family.fixed) is not None:
            outside = outside or family.fixed
        elif not _never_exists(family):
            (singular if _breaks_away(system, family.fixed) else found).append(family)
    # from the widest family to the narrowest, which is dropped if it is a special case
    families: list[SteadyMotion] = []
    for family in sorted(found, key=lambda f: len(f.fixed)):
        if not any(_contains(other, family) for other in families):
            families.append(family)
    if not families:
        if outside and not singular:
            _refuse_outside(equations, outside)
        raise _none(equations, singular)
    return tuple(families)


def _restrictions(system: Reduced, given: Values) -> list[Expr]:
    """What vanishes where speeds that follow from the independent ones have the values given.

    Raises:
        NumericError: for a speed that depends on a coordinate which steady motion leaves free, as
            x' = -a ω₃ cos φ does.
    """
    equations = system.equations
    resting = dict.fromkeys((q.derivative() for q in system.essential), ZERO)
    found = []
    for symbol, value in following_speeds(equations, given).items():
        restriction = value - given[symbol]
        moving = {*equations.coordinates} - {*system.essential}
        changing = sorted(q.published for q in value.subs(resting).symbols() & moving)
        if changing:
            raise NumericError(
                f"a value of {symbol.published} in steady motions of {equations.system.name}",
                expected=f"speeds without coordinates that they leave free; {symbol.published} = "
                f"{value} depends on {', '.join(changing)}",
                advice="give values of the speeds that it follows from",
            )
        found.append(restriction)
    return found


def _written(expressions: Sequence[Expr], equations: Equations, given: Values) -> list[Expr]:
    """Expressions at given values, multiplied out."""
    try:
        return [written_out(expression.subs(given)) for expression in expressions]
    except OutgrownError as error:
        raise NumericError(
            f"steady motions of {equations.system.name}, whose equations are in named parts",
            expected="values with which they can be written out: of most parameters, and of "
            "coordinates that are zero",
            advice="give them with at=; linearise finds the eigenvalues about one motion",
        ) from error
    except ZeroDivisionError as error:
        raise NumericError(
            f"steady motions of {equations.system.name} at {_listed(given)}, where coefficients of "
            "its equations are infinite",
            expected="coordinates and independent speeds that are not singular there",
            advice="choose other speeds with independent=, or give other values",
        ) from error


def _listed(values: Values) -> str:
    return ", ".join(f"{symbol.published} = {value}" for symbol, value in values.items())


def _never_exists(family: SteadyMotion) -> bool:
    """Whether its relation has no real root, as a φ̇² sin θ + g = 0 has none where sin θ > 0."""
    conditions = [branch.exists for branch in family.branches]
    return bool(conditions) and all(
        any(condition.truth is Truth.NEVER for condition in exists) for exists in conditions
    )


def broken_sign(equations: Equations, given: Values) -> Expr | None:
    """What is assumed to be positive and is not at these values."""
    signs = (*equations.assumed_positive, *equations.limits)
    values = ((sign, sign.subs(given).rational) for sign in signs)
    outside = (sign for sign, value in values if value is not None and value <= 0)
    return next(outside, None)


def _refuse_outside(equations: Equations, given: Values) -> None:
    """Refuse a configuration without a single point of contact; say what accelerations tend to."""
    sign = broken_sign(equations, given)
    if sign is None:
        return
    finite = {s: a for s, a in equations.accelerations.items() if a.denominator.subs(given)}
    limits = {s.published: a.subs(given) for s, a in finite.items()}
    settled = {n: v for n, v in limits.items() if v and not v.varies}
    tends = [f"{name} tends to {value}" for name, value in settled.items()]
    close = f"; close to it {' and '.join(tends)}" if tends else ""
    raise NumericError(
        f"steady motions of {equations.system.name} at {_listed(given)}, "
        f"where {sign} = {sign.subs(given)}",
        expected=f"{sign} > 0: elsewhere the body does not touch at the point that was declared, "
        f"and lies flat where {sign} = 0{close}",
        advice="give other values, or none",
    )


class NoSteadyMotionError(NumericError):
    """Conditions that no steady motion meets, since they contradict one another."""


def _none(equations: Equations, singular: Sequence[SteadyMotion]) -> NumericError:
    what = f"steady motions of {equations.system.name}"
    if singular:
        return NumericError(
            f"{what} with {singular[0]}",
            expected="coordinates that are not singular there: the conditions hold only because "
            "they have been multiplied by a factor that vanishes, and close to it the "
            "accelerations grow without bound",
            advice="describe the attitude by other angles, such as two tilts, or give other values",
        )
    return NoSteadyMotionError(
        what,
        expected="at least one; the conditions contradict one another",
        advice="give other values, or none",
    )


def _check_values(equations: Equations, given: Values) -> None:
    """Refuse non-positive values of positive parameters.

    The strength of a load, such as g, may be zero: the load is then absent.
    """
    of_bodies = equations.kinetic_energy.symbols()
    for symbol in equations.parameters:
        value = given[symbol].rational if symbol.positive and symbol in given else None
        is_absent = value == 0 and symbol not in of_bodies
        if value is not None and value <= 0 and not is_absent:
            raise NumericError(
                f"{symbol.published} = {value}",
                expected=f"a positive {symbol.published}, as it is declared",
            )


def _families(
    rows: list[Expr], system: Reduced
) -> Iterator[tuple[dict[Symbol, Expr], tuple[Expr, ...]]]:
    """Branch over the factors of the shortest condition that is not yet satisfied.

    A factor that determines a speed or an angle is substituted into the other conditions; any other
    is kept as a relation. The shortest first, as every factor starts a branch of its own.
    """
    pending = [row for row in rows if row]
    if not pending:
        yield {}, ()
        return
    row = min(pending, key=lambda e: len(e.num))
    rest = [other for other in pending if other is not row]
    # In lowest terms: above the bar of a normal form stand factors that vanish below it as well.
    for factor in factors(lowest_numerator(row))[1]:
        if _never_vanishes(factor, system):
            continue
        solutions = list(_solved(factor, system))
        for symbol, value in solutions:
            narrowed = [_at(other, {symbol: value}) for other in rest]
            for fixed, relations in _families(narrowed, system):
                yield {symbol: value.subs(fixed), **fixed}, relations
        if not solutions:
            others = [other for other in rest if factor not in factors(other.numerator)[1]]
            for fixed, relations in _families(others, system):
                yield from _beside(factor, fixed, relations, system)


def _beside(
    factor: Expr, fixed: dict[Symbol, Expr], relations: tuple[Expr, ...], system: Reduced
) -> Iterator[tuple[dict[Symbol, Expr], tuple[Expr, ...]]]:
    """What a factor that determines nothing by itself requires beside the other conditions.

    With their values it may be a product: ω₁ cos ψ - ω₂ sin ψ is -ω₂ sin ψ where ω₁ = 0.
    """
    kept = _at(factor, fixed)
    if kept == factor or not kept:
        yield fixed, ((kept, *relations) if kept else relations)
        return
    for further, left in _families([kept, *relations], system):
        yield {s: value.subs(further) for s, value in fixed.items()} | further, left


def _solved_together(relations: tuple[Expr, ...], system: Reduced) -> tuple[Expr, ...]:
    """Relations with those that are linear in several coordinates solved for them.

    Two masses between springs rest at x₁ = x₂ = 0 only. From (k₁ + k₂) x₁ = k₂ x₂ and the like one
    by one, a stiffness could be eliminated instead, as where the determinant vanishes.
    """
    unknowns = [q for q in system.essential if any(q in r.symbols() for r in relations)]
    linear: dict[Expr, tuple[tuple[Expr, ...], Expr]] = {}
    for relation in relations:
        with suppress(NumericError):  # not linear
            linear[relation] = linear_parts(relation, unknowns)
    if len(linear) < 2 or any({*system.state} & e.symbols() for r, _ in linear.values() for e in r):
        return relations
    found = eliminate([row for row, _ in linear.values()], [-rest for _, rest in linear.values()])
    if found.contradictory:  # as equations for the parameters
        return relations
    values = found.in_free(unknowns).items()
    solved = tuple(lowest_numerator(Expr.generator(q) - value) for q, value in values)
    return (*solved, *(r for r in relations if r not in linear))


def _never_vanishes(factor: Expr, system: Reduced) -> bool:
    """Whether no state makes a factor vanish, or only one where a length below the bar does."""
    equations = system.equations
    if not factor.symbols() & set(system.state) or factor in equations.assumed_positive:
        return True
    if any((factor / root.radicand).rational for root in roots_in(equations.forcing)):
        return True
    is_negative = is_positive(-factor) and not any(roots_in([factor]))  # |x| may vanish
    return is_negative or is_positive(factor)


def _at(condition: Expr, values: Values) -> Expr:
    """A condition at some values; its numerator alone where it is 0/0 there."""
    try:
        return condition.subs(values)
    except ZeroDivisionError:
        return condition.numerator.subs(values)


def _breaks_away(system: Reduced, fixed: Values) -> bool:
    """Whether the conditions hold only because the coordinates are singular there.

    The equations of motion may have been multiplied by a factor that vanishes there, as sin θ does
    for an upright top. Near a true steady motion accelerations are small; near such a point they
    are unbounded. Coordinates approach it at different rates, so that no cancellation is special;
    for the same reason parameters have unrelated values, with which this takes less than a second.
    """
    equations = system.equations
    numbers = (Expr.of(Fraction(10 + i, 7 + 2 * i)) for i in count())
    typical = dict(zip(equations.parameters, numbers, strict=False))
    there = {s: value.subs(typical) for s, value in fixed.items()}

    def mass_at(values: Values) -> list[list[Expr]]:
        rows = equations.mass.rows
        return [[written_out(e.subs({**typical, **values})) for e in row] for row in rows]

    with suppress(ZeroDivisionError):  # where not even the entries are finite
        mass = mass_at(there)
        if not eliminate(mass, [ZERO] * len(mass)).free:
            return False
    places = [q for q in system.essential if q in fixed]
    aside = {q: there[q] + (i + 1) * Expr.generator(_ASIDE) for i, q in enumerate(places)}
    near = {**typical, **there, **aside}
    try:
        mass = mass_at(near)
        nearby = solve(mass, [force.subs(near) for force in equations.forcing])
        return any(a and _order(a.numerator) < _order(a.denominator) for a in nearby)
    except (ZeroDivisionError, OutgrownError) as error:
        named = ", ".join(f"{q.published} = {fixed[q]}" for q in places)
        raise NumericError(
            f"whether {equations.system.name} can move steadily at {named}, where its mass "
            "matrix is singular",
            expected="accelerations short enough to be written out",
            advice="give numbers with at=, or use linearise at a motion with given numbers",
        ) from error


def _order(expression: Expr) -> int:
    """Order of its zero on the family, in a small departure from it."""
    order = 0
    while not expression.subs({_ASIDE: ZERO}):
        expression, order = expression.diff(_ASIDE), order + 1
    return order


def _solved(factor: Expr, system: Reduced) -> Iterator[tuple[Symbol, Expr]]:
    """Zeros of a factor: a speed, if its coefficient depends on no state, or an angle.

    An angle is also given by another one, as where the bodies of a chain are in line.
    """
    for speed in system.speeds:
        slope = factor.diff(speed)
        if slope and not slope.symbols() & set(system.state):
            yield speed, -(factor - slope * Expr.generator(speed)) / slope
            return
    for i, angle in enumerate(system.essential):
        for base in (ZERO, *map(Expr.generator, system.essential[:i])):
            from_base = Expr.generator(angle) - base
            if factor in (sin(from_base), -sin(from_base)):
                yield from ((angle, base), (angle, base + pi))
            if factor in (cos(from_base), -cos(from_base)):
                yield from ((angle, base + pi / 2), (angle, base - pi / 2))


def _contains(wide: SteadyMotion, narrow: SteadyMotion) -> bool:
    """Whether one family is a special case of another."""
    fixed = all(
        narrow.fixed.get(s, Expr.generator(s)) == value.subs(narrow.fixed)
        for s, value in wide.fixed.items()
    )
    kept = set(narrow.relations)
    return fixed and all(
        not r.subs(narrow.fixed) or r.subs(narrow.fixed) in kept for r in wide.relations
    )


def _branches(relation: Expr, system: Reduced) -> tuple[Branch, ...]:
    """The relation solved for the first speed in which it is linear or quadratic.

    Rates of ignorable coordinates come first: textbooks solve for the rate of precession.
    """
    inside = [s for s in system.speeds if s in relation.symbols()]
    for symbol in sorted(inside, key=lambda s: (s.kind is SymbolKind.SPEED, s.published)):
        if not _is_quadratic(relation, symbol):
            continue
        slope, at_zero = relation.diff(symbol), {symbol: ZERO}
        a, b, c = slope.diff(symbol) / 2, slope.subs(at_zero), relation.subs(at_zero)
        quantity = Expr.generator(symbol)
        if not a:
            return (Branch(quantity, -c / b, ()),)
        discriminant = b * b - 4 * a * c
        exists = positive(discriminant, system.equations.assumed_positive)
        # Of √(D/s²) and √D/s either may be taken, since both signs of the root are: what a and b
        # share goes under the root, and cancels there.
        shared = _shared(a, b) if b else a
        root = sqrt(discriminant / shared**2)
        values = ((-b / shared + sign * root) * shared / (2 * a) for sign in (ONE, -ONE))
        return tuple(Branch(quantity, value, (exists,)) for value in values)
    return ()


def _is_quadratic(relation: Expr, symbol: Symbol) -> bool:
    """Whether a relation is a polynomial in a speed, at most quadratic.

    A relation with friction is not: the slip speed occurs in its denominator, or in a root.
    """
    within = (Expr.generator(g) for g in relation.generators if g != symbol)
    if symbol in relation.denominator.symbols() or any(symbol in e.symbols() for e in within):
        return False
    return not relation - taylor(relation, symbol, 2)


def _shared(one: Expr, other: Expr) -> Expr:
    """The factors that two expressions have in common, without those of them that are numbers."""
    (_, first), (_, second) = factors(one), factors(other)
    return math.prod((f ** min(e, second[f]) for f, e in first.items() if f in second), start=ONE)


# For given numbers: all real roots of the one remaining relation.

#: Relations of a higher degree in the unknown are refused.
LARGEST_DEGREE = 24


@dataclass(frozen=True)
class SteadyValues(Shown):
    """All values of one quantity on a family of steady motions.

    Attributes:
        quantity: the one left open.
        values: all real roots, ascending; angles in (-π, π].
        degree: of the polynomial they are roots of, which bounds their number.
    """

    quantity: Symbol
    values: tuple[float, ...]
    degree: int


def steady_values(family: SteadyMotion, at: Mapping[Any, Given]) -> SteadyValues:
    """All values of one quantity when all others are numbers.

    The roots are isolated in exact arithmetic: none is missed and none is spurious.

    Args:
        family: with one relation.
        at: numbers for all parameters and all state variables but one: by name or symbol, in SI
            units or as text with a unit.
    """
    given = values_given(family.reduced.equations, at)
    refuse_following(family.reduced.equations, given, TO_STEADY)
    relations = [r for e in family.relations if (r := e.subs(family.fixed).subs(given))]
    unknown = sorted({s for r in relations for s in r.symbols()}, key=lambda s: s.published)
    if len(relations) != 1 or len(unknown) != 1:
        names = ", ".join(s.published for s in unknown) or "nothing"
        raise NumericError(
            f"a steady motion with {names} left open",
            expected="one relation in one unknown",
            advice="give numbers for all other quantities with at=",
        )
    (symbol,) = unknown
    polynomial, is_half_tangent = _polynomial(relations[0], symbol)
    # Isolated in ball arithmetic: non-real roots come in conjugate pairs with disjoint balls, so a
    # ball that meets the real axis encloses a real root.
    isolated: Any = polynomial.complex_roots() if polynomial.degree() > 0 else []
    roots = [float(root.real.mid()) for root, _ in isolated if root.imag.contains(0)]
    if is_half_tangent:
        roots = [2 * math.atan(root) for root in roots]
        if not relations[0].subs({symbol: pi}):  # π itself has no half tangent
            roots.append(math.pi)
    return SteadyValues(symbol, tuple(sorted(roots)), polynomial.degree())


def _polynomial(relation: Expr, symbol: Symbol) -> tuple[fmpq_poly, bool]:
    """The relation as a polynomial in the symbol, or in t = tan(symbol/2).

    With cos = (1 - t²)/(1 + t²) and sin = 2t/(1 + t²).
    """
    tangent = Expr.generator(Symbol("half_tangent"))
    below = 1 + tangent**2
    images = {}
    for generator in relation.generators:
        for function in generator.companions():
            is_even = function.partner() is not None
            images[function] = ((1 - tangent**2) if is_even else 2 * tangent) / below
    variable = as_symbol(tangent) if images else symbol
    expression = relation.recast(images).numerator if images else relation.numerator
    coefficients = [fmpq(0)] * (LARGEST_DEGREE + 1)
    for powers, number in expression.terms():
        degree = powers.pop(variable, 0)
        if powers or degree > LARGEST_DEGREE:
            raise NumericError(
                f"the relation {relation} = 0",
                expected=f"an algebraic one of degree {LARGEST_DEGREE} at most in one unknown",
                advice="give the angle, and ask for the speed",
            )
        coefficients[degree] = fmpq(number.numerator, number.denominator)
    return fmpq_poly(coefficients), bool(images)

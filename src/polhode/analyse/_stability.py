"""Linear stability of steady motions, on the reduced space and modulo the steady family itself.

Linearised about the family, B ẋ = A x has the characteristic polynomial det(λ B - A). Its roots at
zero belong to the family and its parameters. The rest is a product of a polynomial in λ², for modes
without dissipation, whose roots must be real and negative, and one for which the Routh-Hurwitz
criterion decides. Frequencies that coincide whatever the parameters are (a bob on a string, seen
from above) are stable unless they share one eigenvector: then a departure grows as t cos ωt.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from math import prod
from typing import Any

from polhode.algebra import (
    ONE,
    PI,
    ZERO,
    Expr,
    Matrix,
    OutgrownError,
    Row,
    Symbol,
    compile_program,
    eliminate,
    length,
    solve,
    sqrt,
    written_out,
)
from polhode.analyse._conditions import Condition, Truth, positive
from polhode.analyse._given import TO_STEADY, Given, refuse_following, values_given
from polhode.analyse._steady import SteadyMotion
from polhode.base import NumericError, Shown

_EXPONENT = Symbol("exponent")
_ROUNDING = 1e-9  # by which a value in decimals may differ from the one that is meant
_MOST_TERMS = 10**7  # of a determinant: the largest in the tests has a tenth of it

#: What linearisation proves and what it leaves open.
PROVES = (
    "Exponents with positive real part prove instability. Purely imaginary ones leave stability "
    "open to the terms of higher order; energy or numbers must decide."
)


@dataclass(frozen=True, repr=False)
class Stability(Shown):
    """Exponents of small departures from a steady motion.

    Attributes:
        family: the steady motion.
        polynomial: coefficients of the characteristic polynomial, lowest power first.
        neutral: multiplicity of the exponent zero.
        directions: number of independent departures that neither grow nor oscillate: along the
            family itself and its parameters. Fewer than `neutral` means steady drift.
        is_marginal: whether, at the values given, further exponents are zero than on the whole
            family, with departures that grow in proportion to time: exactly the threshold.
    """

    family: SteadyMotion
    polynomial: Row
    neutral: int
    directions: int
    is_marginal: bool = False

    @property
    def drifts(self) -> bool:
        """Whether some departure grows in proportion to time."""
        return self.directions < self.neutral

    @cached_property
    def oscillating(self) -> Row:
        """The polynomial without its roots at zero; normalised to a positive leading one."""
        return self.polynomial[self.neutral :]

    @property
    def is_even(self) -> bool:
        """Whether exponents come in pairs ±, as where nothing dissipates."""
        return all(vanishes(c, self.family) for c in self.oscillating[1::2])

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        """Together equivalent to linear stability; those that always hold are left out."""
        if self.is_marginal:
            return (Condition(-ONE),)
        demanded = self._demanded
        if demanded is None:
            return (Condition(-ONE),)
        assumed = self.family.reduced.equations.assumed_positive
        found = dict.fromkeys(_condition(e, self.family, assumed) for e in demanded)
        if any(c.truth is Truth.NEVER for c in found):
            return (Condition(-ONE),)
        return tuple(c for c in found if c.truth is Truth.OPEN)

    @property
    def _demanded(self) -> tuple[Expr, ...] | None:
        """What has to be positive; None if a repeated frequency makes a departure grow."""
        damped: Row = (ONE,)
        if self.is_even:
            paired = self.oscillating[::2]
        else:
            determinants = _hurwitz_determinants(self.oscillating)
            # The last but one vanishes for all parameters if roots come in pairs ±λ (Orlando's
            # formula; Gantmacher, The Theory of Matrices, vol. 2, ch. XV): some modes are undamped.
            if len(determinants) < 2 or not vanishes(determinants[-2], self.family):
                return determinants
            paired, damped = _pairs_apart(self.oscillating, self.family)
        distinct = _without_repetition(paired, self.family)
        if len(distinct) < len(paired) and not self._is_annulled_by(distinct, damped):
            return None
        return (*_undamped(distinct), *_hurwitz_determinants(damped))

    def _is_annulled_by(self, distinct: Row, damped: Row) -> bool:
        """Whether N = B⁻¹ A satisfies λᵏ distinct(λ²) damped(λ) = 0, with k all its roots at zero.

        Then every repeated root of a pair has as many eigenvectors as its multiplicity.
        """
        left, right = (
            [[_on(e, self.family) for e in row] for row in m] for m in linear_matrices(self.family)
        )
        columns = [solve(left, column) for column in zip(*right, strict=True)]
        motion = Matrix.of(list(zip(*columns, strict=True)))
        for start in Matrix.diagonal([ONE] * len(left)).rows:
            left_over: Row = start
            for factor in (*[(ZERO, ONE)] * self.neutral, _in_squares(distinct), damped):
                value: Row = (ZERO,) * len(left)
                for coefficient in reversed(factor):  # Horner's rule
                    pairs = zip(motion.times(value), left_over, strict=True)
                    value = tuple(moved + coefficient * entry for moved, entry in pairs)
                left_over = value
            if not all(vanishes(entry, self.family) for entry in left_over):
                return False
        return True

    @property
    def truth(self) -> Truth:
        """Stable always, never, or depending on the parameters."""
        if not self.conditions:
            return Truth.ALWAYS
        return self.conditions[0].truth

    @cached_property
    def frequencies(self) -> tuple[Expr, ...]:
        """Angular frequencies of small oscillations where stable, rad/s."""
        return self._real_roots([-square for square in self.squares])

    @cached_property
    def growth(self) -> tuple[Expr, ...]:
        """Rates of exponential growth where unstable, 1/s."""
        return self._real_roots(list(self.squares))

    def _real_roots(self, squares: Sequence[Expr]) -> tuple[Expr, ...]:
        assumed = self.family.reduced.equations.assumed_positive
        possible = (s for s in squares if positive(s, assumed).truth is not Truth.NEVER)
        return tuple(sqrt(square) for square in possible)

    @cached_property
    def squares(self) -> tuple[Expr, ...]:
        """λ² of the modes exp(λt), as far as they are found in closed form, 1/s²."""
        if not self.is_even:
            return ()
        coefficients = self.oscillating[::2]
        if len(coefficients) == 2:
            return (-coefficients[0] / coefficients[1],)
        if len(coefficients) == 3:
            c, b, a = coefficients
            root = sqrt(b * b - 4 * a * c)
            return ((-b + root) / (2 * a), (-b - root) / (2 * a))
        return ()

    @property
    def loss(self) -> str | None:
        """How stability is lost; None if it does not depend on the parameters."""
        if self.truth is not Truth.OPEN:
            return None
        if not self.is_even:
            return "growth, with or without oscillation"
        if len(self.oscillating) == 3:
            return "divergence: one pair of exponents becomes real"
        return "divergence where an exponent passes zero, flutter where two frequencies merge"

    def __str__(self) -> str:
        if self.truth is Truth.OPEN:
            return "stable when " + " and ".join(map(str, self.conditions))
        return "stable" if self.truth is Truth.ALWAYS else "unstable"

    def __repr__(self) -> str:
        return f"Stability: {self}"


def stability(family: SteadyMotion, at: Mapping[Any, Given] | None = None) -> Stability:
    """Linearise about a family of steady motions.

    Args:
        family: from `steady`.
        at: further values of coordinates, speeds or parameters: by name or symbol, as an
            expression, an SI number or text with a unit.

    Raises:
        DeclarationError: for a name the system does not have.
        NumericError: where the coordinates are singular on the family.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    given = values_given(family.reduced.equations, at)
    refuse_following(family.reduced.equations, given, TO_STEADY)
    given = _left_open(family, given)
    if not given:
        return _linearised_about(family)
    fixed = {s: v.subs(given) for s, v in family.fixed.items()} | dict(given)
    relations = tuple(r for e in family.relations if (r := e.subs(given)))
    special = _linearised_about(SteadyMotion(family.reduced, fixed, relations))
    if not special.drifts or special.neutral < 2:
        return special
    # Drift along the whole family (a change of speed shifts the phase) is no instability. Only a
    # larger defect of the exponent zero than on the family in general marks the threshold.
    with suppress(NumericError):  # without the values the relations may not be linear
        general = _linearised_about(family)
        shortfall = general.neutral - general.directions
        return replace(special, is_marginal=special.neutral - special.directions > shortfall)
    return special


def _left_open(family: SteadyMotion, given: Mapping[Symbol, Expr]) -> dict[Symbol, Expr]:
    """The values that a family does not have anyway.

    Raises:
        NumericError: for values that it excludes.
    """
    found = dict(given)
    # A parameter may be given another value; what moves has that of the steady motion.
    for symbol in (s for s in given if s in family.fixed and s.kind.varies):
        known = family.fixed[symbol].subs(given)
        difference = known - given[symbol]
        if _is_beyond_rounding(difference):
            raise NumericError(
                f"{symbol.published} = {given[symbol]} in the steady motion {family}",
                expected=f"{symbol.published} = {known}, or values that it leaves free",
            )
        if difference.symbols() <= {PI}:
            del found[symbol]
    for relation in family.relations:
        if _is_beyond_rounding(left := relation.subs(found)):
            raise NumericError(
                f"{relation} = 0 with the values given, where it is {left}",
                expected=f"values with which the steady motion {family} is possible",
            )
    return found


def _is_beyond_rounding(difference: Expr) -> bool:
    """Whether an expression is a number that is not zero, nor the error of an angle in decimals."""
    is_number = difference.symbols() <= {PI}
    return is_number and abs(compile_program([difference], ()).function()()[0]) > _ROUNDING


def _linearised_about(family: SteadyMotion) -> Stability:
    """The characteristic polynomial, where the equations can be linearised.

    Raises:
        NumericError: where they cannot.
    """
    try:
        return _exponents_about(family)
    except ZeroDivisionError as error:
        raise _not_smooth(family) from error


def _not_smooth(family: SteadyMotion) -> NumericError:
    return NumericError(
        f"linear equations about {family} of {family.reduced.equations.system.name}",
        expected="forces that are smooth there",
        advice="a length that vanishes, as that of a slip without slip or of a spring between "
        "points that meet, has no direction: simulate motions close to it",
    )


def _exponents_about(family: SteadyMotion) -> Stability:
    """The characteristic polynomial det(λ B - A), its roots at zero, and their eigenvectors."""
    left, right = linear_matrices(family)
    size = range(len(left))
    exponent = Expr.generator(_EXPONENT)
    matrix = tuple(tuple(exponent * left[i][j] - right[i][j] for j in size) for i in size)
    determinant = _determinant(matrix)
    coefficients, scale = [ZERO] * (len(left) + 1), ONE / determinant.denominator
    for powers, number in determinant.terms():
        degree = powers.pop(_EXPONENT, 0)
        coefficients[degree] = coefficients[degree] + Expr.product(powers, number) * scale
    values = _explicit_values(family)
    polynomial = tuple(coefficient.subs(values) for coefficient in coefficients)
    if vanishes(polynomial[-1], family):
        raise NumericError(
            f"stability of {family} of {family.reduced.equations.system.name}",
            expected="coordinates that are not singular there",
            advice="describe the attitude by other angles, such as two tilts for an upright top",
        )
    # Algebraic multiplicity of the exponent zero, and below, from the rank of A, its geometric one:
    # where they differ there is a Jordan block, and a departure grows in proportion to time.
    neutral = next(i for i, c in enumerate(polynomial) if not vanishes(c, family))
    frozen = [[_on(entry, family) for entry in row] for row in right]
    rank = len(eliminate(frozen, [ZERO] * len(frozen)).solved)
    return Stability(family, polynomial, neutral, len(left) - rank)


def linear_matrices(family: SteadyMotion) -> tuple[tuple[Row, ...], tuple[Row, ...]]:
    """Matrices B, A of B x' = A x for small departures x of the reduced state.

    In δ(M u̇) = M δu̇ + δM u̇ the last term vanishes, as u̇ = 0 on the family: only the forcing is
    differentiated.
    """
    system = family.reduced
    flow = (*system.rates, *system.equations.forcing)
    try:
        columns = [_slopes(flow, symbol, family.fixed) for symbol in system.state]
    except ZeroDivisionError as error:
        raise _not_smooth(family) from error
    right = tuple(zip(*columns, strict=True))
    coordinates = len(system.essential)
    left = []
    for i in range(len(flow)):
        if i < coordinates:
            row = [ONE if j == i else ZERO for j in range(len(flow))]
        else:
            mass = system.equations.mass.rows[i - coordinates]
            row = [ZERO] * coordinates + [written_out(entry.subs(family.fixed)) for entry in mass]
        left.append(tuple(row))
    return tuple(left), right


def _slopes(flow: Sequence[Expr], symbol: Symbol, fixed: Mapping[Symbol, Expr]) -> Row:
    """Derivatives on the family; other values that are constant go in first, as less is left."""
    constant = {s: value for s, value in fixed.items() if s != symbol and not value.varies}
    along = (component.subs(constant) for component in flow)
    return tuple(written_out(component.diff(symbol).subs(fixed)) for component in along)


def _condition(expression: Expr, family: SteadyMotion, assumed: Collection[Expr]) -> Condition:
    """The condition that it is positive, directly or by a relation of the family."""
    plain = expression.subs(family.fixed)
    condition = positive(plain, assumed)
    for relation in family.relations:
        for symbol, value in _linear_in(relation):
            # solving may divide by zero somewhere: used only if it then holds always or never
            solved = positive(plain.subs({symbol: value}), assumed)
            if condition.truth is Truth.OPEN and solved.truth is not Truth.OPEN:
                condition = solved
    return condition


def vanishes(expression: Expr, family: SteadyMotion) -> bool:
    """Whether an expression is zero on the whole family."""
    return not _on(expression, family)


def _on(expression: Expr, family: SteadyMotion) -> Expr:
    """An expression with one quantity eliminated by each relation of the family."""
    result = expression.subs(family.fixed)
    for relation in family.relations:
        solved = next(iter(_linear_in(relation)), None)
        if solved is None:
            raise NumericError(
                f"the relation {relation} = 0 of a steady motion",
                expected="one that is linear in some quantity",
                advice="fix an angle with at=, such as theta = pi/2",
            )
        try:
            result = result.subs(dict([solved]))
        except ZeroDivisionError as error:
            raise NumericError(
                f"{solved[0]} eliminated by the relation {relation} = 0 of a steady motion",
                expected="relations that leave all rates finite",
                advice="fix a coordinate with at=, such as theta = pi/2",
            ) from error
    return result


def _explicit_values(family: SteadyMotion) -> dict[Symbol, Expr]:
    """The coordinates and speeds that a relation of the family gives a constant value, as s = 0."""
    found: dict[Symbol, Expr] = {}
    for relation in family.relations:
        moving = [s for s in relation.symbols() if s.kind.varies]
        solved = dict(_linear_in(relation))
        if len(moving) == 1 and moving[0] in solved:
            found[moving[0]] = solved[moving[0]]
    return found


@lru_cache(maxsize=256)
def _linear_in(relation: Expr) -> tuple[tuple[Symbol, Expr], ...]:
    """Every symbol that a relation is linear in, and its value."""
    found = []
    for symbol in sorted(relation.symbols(), key=lambda s: s.published):
        slope = relation.diff(symbol)
        if slope and symbol not in slope.symbols():
            constant = relation - slope * Expr.generator(symbol)
            if symbol not in constant.symbols():
                found.append((symbol, -constant / slope))
    return tuple(found)


def _determinant(matrix: Sequence[Row]) -> Expr:
    """By minors along the rows, each computed once; exact and without division.

    Laplace's expansion with at most 2ⁿ minors: without division no entry leaves polynomial form.

    Raises:
        OutgrownError: for one that would have too many terms.
    """
    if (most := prod(max(sum(map(length, row)), 1) for row in matrix)) > _MOST_TERMS:
        raise OutgrownError(
            f"a condition of stability that has up to {most:.0e} terms when written out",
            expected=f"at most {_MOST_TERMS:.0e}",
            advice="give values of parameters; linearise finds the exponents at given numbers",
        )

    @cache
    def minor(columns: tuple[int, ...]) -> Expr:
        if not columns:
            return ONE
        row = matrix[len(matrix) - len(columns)]
        total = ZERO
        for position, column in enumerate(columns):
            if row[column]:
                rest = columns[:position] + columns[position + 1 :]
                term = row[column] * minor(rest)
                total = total - term if position % 2 else total + term
        return total

    return minor(tuple(range(len(matrix))))


# -- polynomials whose coefficients are expressions on a family, lowest power first ---------------


def _pairs_apart(coefficients: Row, family: SteadyMotion) -> tuple[Row, Row]:
    """A polynomial as paired(λ²) · rest(λ), where the rest has no roots in pairs ±λ.

    In p(λ) = e(λ²) + λ o(λ²) both parts vanish for a pair: it is a common root of e and o.
    """
    paired = _common(coefficients[::2], _trimmed(coefficients[1::2], family), family)
    return paired, _divided(coefficients, _in_squares(paired), family)[0]


def _without_repetition(coefficients: Row, family: SteadyMotion) -> Row:
    """The polynomial with the same roots, each once: divided by what it shares with its slope."""
    slope = tuple(power * c for power, c in enumerate(coefficients))[1:]
    shared = _common(coefficients, slope, family)
    return _divided(coefficients, shared, family)[0] if len(shared) > 1 else coefficients


def _common(first: Row, second: Row, family: SteadyMotion) -> Row:
    """The greatest common divisor, with leading coefficient one, by Euclid's algorithm."""
    while second:
        first, second = second, _divided(first, second, family)[1]
    return tuple(_on(c / first[-1], family) for c in first)


def _divided(dividend: Row, divisor: Row, family: SteadyMotion) -> tuple[Row, Row]:
    """Quotient and remainder."""
    rest = list(dividend)
    quotient = [ZERO] * max(len(dividend) - len(divisor) + 1, 0)
    for shift in reversed(range(len(quotient))):
        quotient[shift] = _on(rest[shift + len(divisor) - 1] / divisor[-1], family)
        for i, coefficient in enumerate(divisor):
            rest[shift + i] = rest[shift + i] - quotient[shift] * coefficient
    return tuple(quotient), _trimmed(tuple(rest[: len(divisor) - 1]), family)


def _trimmed(coefficients: Row, family: SteadyMotion) -> Row:
    """Without leading coefficients that vanish."""
    last = max((i for i, c in enumerate(coefficients) if not vanishes(c, family)), default=-1)
    return coefficients[: last + 1]


def _in_squares(coefficients: Row) -> Row:
    """A polynomial in λ² as one in λ."""
    spread = [ZERO] * (2 * len(coefficients) - 1)
    spread[::2] = coefficients
    return tuple(spread)


# -- criteria ------------------------------------------------------------------------------------


def _undamped(coefficients: Row) -> tuple[Expr, ...]:
    """Positive where all roots of a polynomial in λ² are real, distinct and negative.

    Coefficients of one sign (Descartes) exclude positive roots and zero. Up to degree three in λ²,
    a positive discriminant excludes complex and double ones; beyond, it would not suffice.
    """
    lead = coefficients[-1]
    signs = tuple(c * lead for c in coefficients[:-1])
    if len(coefficients) <= 2:
        return signs
    if len(coefficients) == 3:
        c, b, a = coefficients
        return (*signs, b * b - 4 * a * c)
    if len(coefficients) == 4:
        d, c, b, a = coefficients
        discriminant = 18 * a * b * c * d - 4 * b**3 * d + b * b * c * c - 4 * a * c**3
        return (*signs, discriminant - 27 * a * a * d * d)
    raise NumericError(
        f"a characteristic polynomial of degree {2 * len(coefficients) - 2}",
        expected="degree six at most",
        advice="give numbers with at= and look at the roots",
    )


def _hurwitz_determinants(coefficients: Row) -> tuple[Expr, ...]:
    """Leading minors of Hurwitz's matrix: positive where all roots have negative real parts.

    The Routh-Hurwitz criterion: with a₀ > 0, entry (i, j) is a_{2j-i}, counted from one
    (Gantmacher, The Theory of Matrices, vol. 2, ch. XV). All coefficients are multiplied by the
    leading one, whose sign may be open.
    """
    degree = len(coefficients) - 1
    falling = tuple(c * coefficients[-1] for c in reversed(coefficients))

    def entry(i: int, j: int) -> Expr:
        k = 2 * (j + 1) - (i + 1)
        return falling[k] if 0 <= k <= degree else ZERO

    return tuple(
        _determinant(tuple(tuple(entry(i, j) for j in range(n)) for i in range(n)))
        for n in range(1, degree + 1)
    )

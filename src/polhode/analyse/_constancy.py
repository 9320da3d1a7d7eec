"""Whether a quantity keeps its value along every motion, decided without solving for accelerations.

The rate of a quantity is linear in the accelerations u̇, which are the solution of M u̇ = f. At a
random point of a prime field that is a small linear system of numbers, however long the entries of
M and f are, and however much longer the accelerations would be.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from flint import fmpz_mod_ctx, fmpz_mod_mat

from polhode.algebra import (
    PRIME,
    Expr,
    FieldPoint,
    NoResidueError,
    Residue,
    has_parts,
    length,
    linear_parts,
    vanishing,
)
from polhode.base import NumericError
from polhode.derive import Equations

#: Terms of the mass matrix above which solving for three or more accelerations is not tried: those
#: of the rattleback would have 74 000.
_LONGEST = 200

_FIELD = fmpz_mod_ctx(PRIME)


def has_closed_accelerations(equations: Equations) -> bool:
    """Whether the accelerations are short enough to be written out."""
    terms = sum(length(entry) for row in equations.mass.rows for entry in row)
    coupled = len(equations.speeds) > 2  # elimination multiplies lengths with every further row
    if equations.motion_in_parts or (coupled and terms > _LONGEST):
        return False
    try:
        return not any(map(has_parts, equations.accelerations.values()))
    except NumericError:  # of too many coupled speeds
        return False


def is_constant(equations: Equations, expression: Expr) -> bool:
    """Whether the rate of an expression vanishes along every motion.

    A wrong answer is less likely than 10⁻²⁰ (`algebra._residues`). Where the rate has no value in
    the field, it is not taken to vanish.
    """
    motion = equations.kinetics
    rate = motion.on_speeds(expression).chain(motion.rate)
    slopes, rest = linear_parts(rate, equations.acceleration_symbols)
    if not any(slopes):
        return rest.is_zero

    def value(point: FieldPoint) -> Residue:
        rows = [_residues(row, point) for row in equations.mass.rows]
        right, along = _residues(equations.forcing, point), _residues(slopes, point)
        last = rest.residue(point)
        every = [*(entry for row in rows for entry in row), *right, *along, last]
        mass = fmpz_mod_mat([[int(e.value) for e in row] for row in rows], _FIELD)
        forces = fmpz_mod_mat([[int(e.value)] for e in right], _FIELD)
        accelerations = mass.solve(forces).entries()  # `ZeroDivisionError` where it is singular
        pairs = zip(along, accelerations, strict=True)
        total = last.value + sum(slope.value * each for slope, each in pairs)
        # by Cramer's rule, each solution is a quotient of determinants of the entries
        degree = 2 * (len(rows) + 1) * sum(entry.degree for entry in every)
        return Residue(total, degree, frozenset().union(*(entry.roots for entry in every)))

    try:
        return vanishing(value, _point).is_zero
    except NoResidueError:
        return False


def _residues(expressions: Sequence[Expr], point: FieldPoint) -> list[Residue]:
    return [expression.residue(point) for expression in expressions]


@lru_cache(maxsize=64)
def _point(number: int) -> FieldPoint:
    return FieldPoint(f"motion {number}")

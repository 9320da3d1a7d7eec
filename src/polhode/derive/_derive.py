"""Derivation: the balance of every body, projected on the motions the constraints allow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from polhode.algebra import (
    ZERO,
    Expr,
    Matrix,
    OutgrownError,
    Row,
    Symbol,
    Vector,
    linear_parts,
    total,
)
from polhode.base import DeclarationError
from polhode.derive._balance import Wrench, demands
from polhode.derive._equations import Equations
from polhode.derive._form import CLOSED, IN_PARTS, Form
from polhode.derive._motion import Kinematics, motion_of
from polhode.derive._names import refuse_shared_names, refuse_unknown_coordinates
from polhode.derive._reactions import ReactionColumn, lines, solve_reactions
from polhode.derive._unbalanced import refuse_unbalanced
from polhode.model import Body, System


def derive(system: System) -> Equations:
    """Exact equations of motion and reactions of a system as declared.

    Newton's and Euler's equations of every body are projected on the motions that the velocity
    constraints allow (Jourdain's principle), which removes all reactions that do no work. Where
    that grows too long to be written out, long expressions stand under names of their own.

    Raises:
        ConstraintError: for constraints that contradict one another.
        DeclarationError: for bodies that share coordinates or reactions that share names.
    """
    if not isinstance(system, System):
        raise DeclarationError(
            f"derive of {system!r}",
            expected="a System",
            advice="put bodies, contacts and loads together in a System(...) first",
        )
    try:
        return _derived(system, CLOSED)
    except OutgrownError:
        return _derived(system, IN_PARTS)


def equations_only(given: object, what: str) -> None:
    """Refuse to learn something of anything but equations.

    Raises:
        DeclarationError: for anything else.
    """
    if not isinstance(given, Equations):
        raise DeclarationError(
            f"{what} of a {type(given).__name__}",
            expected="equations of motion",
            advice="derive them first: ph.derive(system)",
        )


def _derived(system: System, form: Form) -> Equations:
    motion = motion_of(system, form)
    needs = demands(motion)
    refuse_shared_names(motion, needs)
    refuse_unknown_coordinates(motion, needs)
    columns = lines(motion)
    rows = _projected(motion, needs)
    rubbing = [c for c in columns if c.leans]
    if rubbing:
        values = solve_reactions(motion, needs, columns).values
        rows = tuple(
            row - sum((values[c.name] * _virtual_power(motion, c, u) for c in rubbing), ZERO)
            for row, u in zip(rows, motion.speeds, strict=True)
        )
    parts = [linear_parts(row, motion.accelerations) for row in rows]
    mass = _mirrored([coefficients for coefficients, _ in parts])
    forcing = tuple(-rest for _, rest in parts)
    equations = Equations(system, motion, needs, columns, rows, mass, forcing)
    refuse_unbalanced(equations)
    return equations


def _mirrored(rows: Sequence[Row]) -> Matrix:
    """The matrix, of two entries that mirror each other and are equal one written twice."""

    def entry(i: int, j: int) -> Expr:
        above, below = rows[min(i, j)][max(i, j)], rows[max(i, j)][min(i, j)]
        return rows[i][j] if above - below else above

    size = range(len(rows))
    return Matrix(tuple(tuple(entry(i, j) for j in size) for i in size))


def _projected(motion: Kinematics, needs: Mapping[Body, Wrench]) -> tuple[Expr, ...]:
    """One row per independent speed: power of all demands in a unit of that speed alone."""
    rows = []
    for speed in motion.speeds:
        row = total(_share(motion, body, need, speed) for body, need in needs.items())
        rows.append(motion.form.keep(row, motion.accelerations))
        motion.form.settle(rows)
    return tuple(rows)


def _share(motion: Kinematics, body: Body, need: Wrench, speed: Symbol) -> Expr:
    velocity, angular = (_partial(v, speed) for v in motion.velocities[body])
    return velocity.dot(need.force) + angular.dot(need.couple)


def _partial(vector: Vector, speed: Symbol) -> Vector:
    return Vector(tuple(c.diff(speed) for c in vector.components), vector.triad)


def _virtual_power(motion: Kinematics, line: ReactionColumn, speed: Symbol) -> Expr:
    total = ZERO
    for body in (line.restraint.body, line.restraint.other):
        wrench = line.on(body) if body is not None else None
        if body is not None and wrench is not None:
            total = total + _share(motion, body, wrench, speed)
    return total

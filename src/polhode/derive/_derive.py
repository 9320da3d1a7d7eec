"""Derivation: the balance of every body, projected on the motions the constraints allow."""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import ZERO, Expr, Matrix, Symbol, Vector, linear_parts
from polhode.base import DeclarationError
from polhode.derive._balance import Wrench, demands
from polhode.derive._equations import Equations
from polhode.derive._motion import Motion, motion_of
from polhode.derive._names import refuse_shared_names
from polhode.derive._reactions import Line, lines, solve_reactions
from polhode.model import Body, System


def derive(system: System) -> Equations:
    """Exact equations of motion and reactions of a system as declared.

    Newton's and Euler's equations of every body are projected on the motions that the velocity
    constraints allow (Jourdain's principle), which removes all reactions that do no work.

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
    motion = motion_of(system)
    needs = demands(motion)
    refuse_shared_names(motion, needs)
    columns = lines(motion)
    rows = _projected(motion, needs)
    rubbing = [c for c in columns if c.direction != c.restraint.direction]
    if rubbing:
        values = solve_reactions(motion, needs, columns).values
        rows = tuple(
            row - sum((values[c.name] * _virtual_power(motion, c, u) for c in rubbing), ZERO)
            for row, u in zip(rows, motion.speeds, strict=True)
        )
    parts = [linear_parts(row, motion.accelerations) for row in rows]
    mass = Matrix(tuple(coefficients for coefficients, _ in parts))
    return Equations(system, motion, needs, columns, rows, mass, tuple(-rest for _, rest in parts))


def _projected(motion: Motion, needs: Mapping[Body, Wrench]) -> tuple[Expr, ...]:
    """One row per independent speed: power of all demands in a unit of that speed alone."""
    return tuple(
        sum((_share(motion, body, need, speed) for body, need in needs.items()), ZERO)
        for speed in motion.speeds
    )


def _share(motion: Motion, body: Body, need: Wrench, speed: Symbol) -> Expr:
    velocity, angular = (_partial(v, speed) for v in motion.velocities[body])
    return velocity.dot(need.force) + angular.dot(need.couple)


def _partial(vector: Vector, speed: Symbol) -> Vector:
    return Vector(tuple(c.diff(speed) for c in vector.components), vector.triad)


def _virtual_power(motion: Motion, line: Line, speed: Symbol) -> Expr:
    total = ZERO
    for body in (line.restraint.body, line.restraint.other):
        wrench = line.on(body) if body is not None else None
        if body is not None and wrench is not None:
            total = total + _share(motion, body, wrench, speed)
    return total

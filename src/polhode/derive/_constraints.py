"""Velocity constraints: which speeds they leave free, and the others in terms of those."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Row, Symbol, Vector, dot, eliminate, linear_parts
from polhode.base import ConstraintError
from polhode.derive._form import Form
from polhode.model import Body, Restraint

Velocities = Mapping[Body, tuple[Vector, Vector]]
Speeds = tuple[Symbol, ...]


def against(restraint: Restraint, velocities: Velocities, form: Form, speeds: Speeds) -> Vector:
    """Velocity of the restrained point, or of the body's rotation, against the other body."""

    def of(body: Body, arm: Vector | None) -> Vector:
        velocity, angular = velocities[body]
        if arm is None:
            return angular
        turned = form.kept(angular.cross(arm), speeds)
        return velocity + form.express(turned, velocity.triad)

    own = of(restraint.body, restraint.arm)
    if restraint.other is None:
        return own
    return own - of(restraint.other, restraint.other_arm)


@dataclass(frozen=True)
class _Constraint:
    """One linear equation in the speeds: coefficients · speeds = right."""

    name: str
    coefficients: Row
    right: Expr


def dependent_speeds(
    restraints: Sequence[Restraint],
    velocities: Velocities,
    rates: Mapping[Symbol, Expr],
    ranks: Mapping[Symbol, int],
    form: Form,
) -> dict[Symbol, Expr]:
    """The speeds that the constraints give, in terms of the independent ones.

    Args:
        restraints: what contacts and joints prescribe.
        velocities: of every body, in terms of all speeds.
        rates: of the coordinates that are not speeds themselves.
        ranks: all speeds, and how readily each is given up, low first.
        form: closed, or in named parts.

    Raises:
        ConstraintError: for constraints that no motion obeys, by name.
        NumericError: for loops whose exact solution is too long to be of use.
    """
    speeds = tuple(ranks)
    equations = [e for r in restraints if (e := _equation(r, velocities, rates, speeds, form))]
    rows, right = [e.coefficients for e in equations], [e.right for e in equations]
    outcome = form.eliminate(rows, right, list(ranks.values()), ())
    for i in outcome.contradictory:
        raise _contradiction(equations[i], [e for e in equations if e is not equations[i]])
    free = [Expr.generator(speeds[j]) for j in outcome.free]
    return {speeds[j]: dot(row, free) + known for j, (row, known) in outcome.solved.items()}


def _equation(
    restraint: Restraint,
    velocities: Velocities,
    rates: Mapping[Symbol, Expr],
    speeds: tuple[Symbol, ...],
    form: Form,
) -> _Constraint | None:
    """What a restraint demands of the speeds; nothing if it holds whatever they are."""
    slip = (against(restraint, velocities, form, speeds) - restraint.velocity).dot(
        restraint.direction
    )
    coefficients, rest = linear_parts(form.keep(slip.subs(rates), speeds), speeds)
    demands = any(coefficients) or rest
    return _Constraint(restraint.name, coefficients, -rest) if demands else None


def _contradiction(one: _Constraint, others: list[_Constraint]) -> ConstraintError:
    """Names a constraint together with those that say otherwise, each of which it takes."""
    columns = list(zip(*(other.coefficients for other in others), strict=True))
    shares = eliminate(columns, one.coefficients).solved if others else {}
    involved = [other.name for j, other in enumerate(others) if j in shares and shares[j][1]]
    return ConstraintError(
        f"constraints that contradict one another, at {', '.join([*involved, one.name])}",
        expected="constraints that some motion obeys",
        advice="remove one of them, or let the support move as the others demand",
    )

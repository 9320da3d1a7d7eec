"""Velocity constraints: which speeds stay independent, and all others in terms of those.

Every restraint of a contact or joint, holonomic or not, is one linear equation in the speeds
(Neimark and Fufaev, Dynamics of Nonholonomic Systems, 1972; the motion constraints of Kane and
Levinson, Dynamics: Theory and Applications, 1985). Those of a rolling contact say that the material
point of the body at the contact has the velocity of the support there (problem set, eqs. (29) and
(43)). The reactions that enforce the constraints are in `derive._balance`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Row, Symbol, Vector, eliminate, linear_parts, total
from polhode.base import ConstraintError, DeclarationError
from polhode.derive._form import Form
from polhode.model import Body, Restraint

Velocities = Mapping[Body, tuple[Vector, Vector]]
Speeds = tuple[Symbol, ...]


def elimination_ranks(
    rates: Iterable[Symbol],
    rotations: Iterable[Symbol],
    translations: Mapping[Symbol, Body],
    chosen: Iterable[Symbol],
    independent: Iterable[Symbol],
) -> dict[Symbol, int]:
    """The order in which the constraints eliminate speeds: low ranks first.

        0  velocities of centres of mass
        1  angular velocities
        2  velocities of centres of mass of balls
        3  rates of coordinates, such as those of angles
        4  speeds that the user chose
        5  speeds declared independent

    Textbooks eliminate in this order: they describe a disk by its rotation and eliminate the
    velocity of its centre (problem set, eq. (33)), but a ball, whose attitude does not matter, by
    the velocity of its centre (eqs. (45) to (47)). Within a rank the simplest pivot is taken, which
    keeps expressions short.

    Args:
        rates: speeds that are rates of coordinates.
        rotations: components of angular velocities.
        translations: components of the velocities of centres of mass, each with its body.
        chosen: the user's own.
        independent: speeds to be kept if possible, as declared.

    Raises:
        DeclarationError: for a speed declared independent that does not exist.
    """
    ranks = dict.fromkeys(rates, 3) | dict.fromkeys(rotations, 1)
    ranks |= {speed: 2 if body.is_isotropic else 0 for speed, body in translations.items()}
    ranks |= dict.fromkeys(chosen, 4)
    for symbol in independent:
        if symbol not in ranks:
            raise DeclarationError(
                f"independent={symbol.published}",
                expected=f"one of the speeds {', '.join(s.published for s in ranks)}",
                advice="name the rate of a coordinate, as in theta.dt()",
            )
    return ranks | dict.fromkeys(independent, 5)


def partial_velocity(velocity: Vector, speed: Symbol) -> Vector:
    """Change of a velocity, linear or angular, per unit of a speed (Kane and Levinson)."""
    return velocity.diff(speed)


def relative_velocity(
    restraint: Restraint, velocities: Velocities, form: Form, speeds: Speeds
) -> Vector:
    """Velocity of the restrained point, or of the body's rotation, relative to the other body."""

    own = velocity_at(restraint.body, restraint.arm, velocities, form, speeds)
    if restraint.other is None:
        return own
    return own - velocity_at(restraint.other, restraint.other_arm, velocities, form, speeds)


def further_velocity(
    restraint: Restraint, velocities: Velocities, form: Form, speeds: Speeds
) -> Expr:
    """What further points and rotations contribute to the velocity that a restraint prescribes."""
    return total(
        share.direction.dot(velocity_at(share.body, share.arm, velocities, form, speeds))
        for share in restraint.more
    )


def velocity_at(
    body: Body, arm: Vector | None, velocities: Velocities, form: Form, speeds: Speeds
) -> Vector:
    """Velocity of a point of a body; without an arm, its angular velocity."""
    velocity, angular = velocities[body]
    if arm is None:
        return angular
    turned = form.kept(angular.cross(arm), speeds)
    return velocity + form.express(turned, velocity.triad)


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
    """The speeds that the constraints determine, in terms of the independent ones.

    Args:
        restraints: what contacts and joints prescribe.
        velocities: of every body, in terms of all speeds.
        rates: of the coordinates that are not speeds themselves.
        ranks: of all speeds, from `elimination_ranks`.
        form: closed, or in named parts.

    Raises:
        ConstraintError: for constraints that no motion satisfies, naming them.
        NumericError: for loops whose exact solution is too long to be of use.
    """
    speeds = tuple(ranks)
    equations = []
    for restraint in restraints:
        excluded = excluded_velocity(restraint, velocities, rates, form, speeds)
        coefficients, rest = linear_parts(excluded, speeds)
        if any(coefficients) or rest:  # otherwise it holds for any speeds
            equations.append(_Constraint(restraint.name, coefficients, -rest))
    rows, right = [e.coefficients for e in equations], [e.right for e in equations]
    outcome = form.eliminate(rows, right, list(ranks.values()), ())
    for i in outcome.contradictory:
        raise _contradiction(equations[i], [e for e in equations if e is not equations[i]])
    return outcome.in_free(speeds)


def excluded_velocity(
    restraint: Restraint,
    velocities: Velocities,
    rates: Mapping[Symbol, Expr],
    form: Form,
    speeds: Speeds,
) -> Expr:
    """What a restraint keeps at zero, in terms of all speeds."""
    slip = relative_velocity(restraint, velocities, form, speeds) - restraint.velocity
    along = slip.dot(restraint.direction) + further_velocity(restraint, velocities, form, speeds)
    return form.keep(along.subs(rates), speeds)


def refuse_redundant(
    constraints: Mapping[str, Sequence[Restraint]],
    restraints: Sequence[Restraint],
    velocities: Velocities,
    rates: Mapping[Symbol, Expr],
    ranks: Mapping[Symbol, int],
    form: Form,
) -> None:
    """Refuse equations given by the user that hold by the other constraints already.

    Args:
        constraints: the restraints of these equations, by the name of the constraint.
        restraints: what contacts, joints and constraints prescribe.
        velocities, rates, ranks, form: as for `dependent_speeds`.

    Raises:
        ConstraintError: naming the constraint.
    """
    speeds = tuple(ranks)
    for name, own in constraints.items():
        others = [r for r in restraints if r not in own]
        dependent = dependent_speeds(others, velocities, rates, ranks, form)
        left = (excluded_velocity(r, velocities, rates, form, speeds) for r in own)
        if not any(form.keep(e.subs(dependent), speeds) for e in left):
            raise ConstraintError(
                f"{name!r}, whose rate of change is zero by the other contacts and joints",
                expected="an equation that restrains the motion further",
                advice="leave it out: it either holds already or contradicts them",
            )


def _contradiction(one: _Constraint, others: list[_Constraint]) -> ConstraintError:
    """The error for a constraint, naming those others whose combination contradicts it."""
    # Σ shareⱼ · coefficientsⱼ = the constraint's own coefficients; the right-hand sides then differ
    columns = list(zip(*(other.coefficients for other in others), strict=True))
    shares = eliminate(columns, one.coefficients).solved if others else {}
    involved = [other.name for j, other in enumerate(others) if j in shares and shares[j][1]]
    return ConstraintError(
        f"constraints that contradict one another, at {', '.join([*involved, one.name])}",
        expected="constraints that some motion satisfies",
        advice="remove one of them, or make the support move as the others require",
    )

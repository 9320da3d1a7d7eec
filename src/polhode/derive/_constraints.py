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

        0  velocities of centres of mass; of bodies on curved supports, the rates of u and v
        1  angular velocities
        2  velocities of centres of mass of balls
        3  rates of coordinates, such as those of angles
        4  speeds that the user chose
        5  speeds declared independent: of more than the constraints leave, the last ones first

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
    kept = tuple(independent)
    for symbol in kept:
        if symbol not in ranks:
            raise DeclarationError(
                f"independent={symbol.published}",
                expected=f"one of the speeds {', '.join(s.published for s in ranks)}",
                advice="name the rate of a coordinate, as in theta.dt()",
            )
    return ranks | {symbol: 5 + i for i, symbol in enumerate(reversed(kept))}


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
class VelocityConstraint:
    """One linear equation in the speeds: coefficients · speeds = right.

    Attributes:
        restraint: that prescribes it.
        excluded: the velocity that it keeps at zero, in terms of all speeds.
        coefficients: of all speeds, in their order.
        right: the rest.
    """

    restraint: Restraint
    excluded: Expr
    coefficients: Row
    right: Expr

    @property
    def name(self) -> str:
        """That of the restraint."""
        return self.restraint.name


def velocity_constraints(
    restraints: Iterable[Restraint],
    velocities: Velocities,
    rates: Mapping[Symbol, Expr],
    form: Form,
    speeds: Speeds,
) -> tuple[VelocityConstraint, ...]:
    """What restraints prescribe.

    Args:
        restraints: of contacts, joints and constraints.
        velocities: of every body, in terms of all speeds.
        rates: of the coordinates that are not speeds themselves.
        form: closed, or in named parts.
        speeds: all of them.
    """

    def constraint(restraint: Restraint) -> VelocityConstraint:
        slip = relative_velocity(restraint, velocities, form, speeds) - restraint.velocity
        further = further_velocity(restraint, velocities, form, speeds)
        along = slip.dot(restraint.direction) + further
        excluded = form.keep(along.subs(rates), speeds)
        coefficients, rest = linear_parts(excluded, speeds)
        return VelocityConstraint(restraint, excluded, coefficients, -rest)

    return tuple(map(constraint, restraints))


def dependent_speeds(
    constraints: Iterable[VelocityConstraint], ranks: Mapping[Symbol, int], form: Form
) -> dict[Symbol, Expr]:
    """The speeds that the constraints determine, in terms of the independent ones.

    Args:
        constraints: of all contacts and joints.
        ranks: of all speeds, in their order, from `elimination_ranks`.
        form: closed, or in named parts.

    Raises:
        ConstraintError: for constraints that no motion satisfies, naming them.
        NumericError: for loops whose exact solution is too long to be of use.
    """
    # others hold for any speeds
    equations = [c for c in constraints if any(c.coefficients) or c.right]
    rows, right = [e.coefficients for e in equations], [e.right for e in equations]
    outcome = form.eliminate(rows, right, list(ranks.values()), ())
    for i in outcome.contradictory:
        raise _contradiction(equations[i], [e for e in equations if e is not equations[i]])
    return outcome.in_free(tuple(ranks))


def refuse_redundant(
    given: Mapping[str, Sequence[Restraint]],
    constraints: Sequence[VelocityConstraint],
    ranks: Mapping[Symbol, int],
    form: Form,
) -> None:
    """Refuse equations given by the user that hold by the other constraints already.

    Args:
        given: the restraints of these equations, by their name.
        constraints, ranks, form: as for `dependent_speeds`.

    Raises:
        ConstraintError: naming the equation.
    """
    for name, restraints in given.items():
        own = [c for c in constraints if c.restraint in restraints]
        dependent = dependent_speeds((c for c in constraints if c not in own), ranks, form)
        if not any(form.keep(c.excluded.subs(dependent), tuple(ranks)) for c in own):
            raise ConstraintError(
                f"{name!r}, whose rate of change is zero by the other contacts and joints",
                expected="an equation that restrains the motion further",
                advice="leave it out: it either holds already or contradicts them",
            )


def _contradiction(one: VelocityConstraint, others: list[VelocityConstraint]) -> ConstraintError:
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

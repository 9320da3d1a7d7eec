"""What a blow does: the speeds just after it, and the impulses of contacts and joints.

A blow is a force so short that nothing moves meanwhile, and so strong that all others are nothing
beside it. Integrated over it the equations of motion M u̇ = f + J P δ(t) give M Δu = J P, and the
balances of the bodies give the impulses of the reactions (Routh, Elementary Rigid Dynamics, 1905,
ch. VIII; Kane and Levinson, Dynamics, 1985, sect. 4.11).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, linear_parts, total
from polhode.base import DeclarationError, NumericError, Shown
from polhode.derive import Equations, derive, equations_only
from polhode.model import BodyPoint, Force, with_loads

#: The blow as a force, N: what is linear in it is the effect of a unit impulse.
_BLOW = Symbol("blow_", SymbolKind.PARAMETER)


@dataclass(frozen=True)
class Blow(Shown):
    """The effect of an impulse at a point of a body.

    Attributes:
        changes: of every speed, dependent ones and rates of coordinates included, m/s or rad/s.
        reactions: impulses of contacts and joints by the names of their components, N s or N m s.
        undetermined: names of those that the laws of motion leave open.
        work: done by the blow, J: its impulse times the mean of the velocities before and after.
    """

    changes: Mapping[Symbol, Expr]
    reactions: Mapping[str, Expr]
    undetermined: tuple[str, ...]
    work: Expr

    def __str__(self) -> str:
        lines = ["Changes of the speeds"]
        changed = [(s, value) for s, value in self.changes.items() if value]
        lines += [f"  Δ{Expr.generator(s).pretty()} = {value.pretty()}" for s, value in changed]
        lines += [] if changed else ["  none"]
        if self.reactions:
            lines.append("Impulses of the reactions")
        lines += [
            f"  ∫ {Expr.generator(Symbol(name)).pretty()} dt = {value.pretty()}"
            for name, value in self.reactions.items()
        ]
        if self.undetermined:
            lines.append(f"Not determined: {', '.join(self.undetermined)}")
        return "\n".join([*lines, "Work of the blow", f"  {self.work.pretty()}"])


def strike(equations: Equations, point: BodyPoint, impulse: Vector) -> Blow:
    """The effect of a blow on a system that is connected as declared.

    Contacts and joints hold during the blow, whatever that takes: where the impulse of a contact
    comes out as a pull, it would open.

    Args:
        equations: of the system.
        point: of a body.
        impulse: N s.

    Raises:
        DeclarationError: for a point of a body that is not in the system, and for friction or
            loads in proportion to reactions, whose impulse is not known.
        NumericError: for equations too long to be written out.
    """
    equations_only(equations, "a blow")
    system = equations.system
    if point.body not in system.bodies:
        raise DeclarationError(
            f"a blow on {point.body.name!r}, which is not in {system.name!r}",
            expected=f"a point of {', '.join(body.name for body in system.bodies)}",
        )
    _refuse_unknown_impulses(equations)
    blow = Force(point, impulse * Expr.generator(_BLOW), name=_BLOW.name)
    struck = derive(with_loads(system, blow))
    if struck.motion_in_parts:
        raise NumericError(
            f"a blow on {system.name!r}, whose equations have long expressions under names",
            expected="equations that can be written out",
            advice="simulate a short strong force",
        )
    jumps = {u: _share(struck.accelerations[u.derivative()]) for u in struck.speeds}
    following = {**struck.dependent, **struck.kinematics}
    changes = jumps | {s: _jump(e, jumps) for s, e in following.items() if s not in jumps}
    reactions = {
        name: _share(struck.on_shell(value))
        for name, value in struck.components.items()
        if name not in struck.undetermined
    }
    velocity, angular = struck.kinetics.velocities[point.body]
    along = (velocity + angular.cross(point.offset)).dot(impulse)
    return Blow(changes, reactions, struck.undetermined, along + _jump(along, jumps) / 2)


def _refuse_unknown_impulses(equations: Equations) -> None:
    laws = [e.name for e in equations.kinetics.elements if e.friction(equations.kinetics.places)]
    laws += [line.name for line in equations.lines if line.loads]
    if laws:
        raise DeclarationError(
            f"a blow on {equations.system.name!r}, with friction or loads in proportion to "
            f"reactions at {', '.join(laws)}",
            expected="contacts that roll or have no friction: the impulse of friction depends on "
            "the course of the slip",
            advice="simulate a short strong force, or declare the contact Rolling or Smooth",
        )


def _share(expression: Expr) -> Expr:
    """What goes with the blow."""
    ((share,), _) = linear_parts(expression, (_BLOW,))
    return share


def _jump(expression: Expr, jumps: Mapping[Symbol, Expr]) -> Expr:
    """How much something that is linear in the speeds changes."""
    slopes, _ = linear_parts(expression, tuple(jumps))
    return total(slope * jump for slope, jump in zip(slopes, jumps.values(), strict=True))

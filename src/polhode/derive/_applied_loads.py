"""Forces and couples of the loads, with those that are proportional to reactions apart.

A brake's torque μ N R, sliding friction in a guide or rolling resistance depends on a reaction that
is itself unknown. Such a load is linear in the reactions: what goes with one unit of a reaction is
part of its column in the balances of the bodies (`derive._balance`), and is solved for with it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, variables
from polhode.base import DeclarationError, NumericError
from polhode.derive._motion import Kinematics
from polhode.model import Action, Load

#: Solves for the reaction components, sliding friction included: their values by name.
ReactionValues = Callable[[], Mapping[str, Expr]]


@dataclass(frozen=True)
class AppliedLoads:
    """The forces and couples of all loads.

    Attributes:
        given: those that do not depend on reactions.
        proportional: those per unit of a reaction component, by its name.
    """

    given: tuple[Action, ...]
    proportional: Mapping[str, tuple[Action, ...]]


def applied_loads(motion: Kinematics) -> AppliedLoads:
    """The forces and couples of all loads.

    Raises:
        DeclarationError: for a load that depends on reactions that do not exist, that is not linear
            in them, or whose point of application depends on them.
    """
    given: list[Action] = []
    proportional: dict[str, tuple[Action, ...]] = {}
    for load in motion.system.loads:
        for action in _actions(motion, load):
            names = sorted(action.reactions, key=lambda s: s.published)
            if not names:
                given.append(action)
                continue
            _refuse_unknown(motion, load, names)
            units, rest = _split(load, action, names)
            given.append(rest)
            for symbol, unit in zip(names, units, strict=True):
                proportional[symbol.name] = (*proportional.get(symbol.name, ()), unit)
    return AppliedLoads(tuple(given), proportional)


def actions_of(motion: Kinematics, load: Load, values: ReactionValues) -> tuple[Action, ...]:
    """The forces and couples of a load, with the values of the reactions that it depends on."""
    actions = _actions(motion, load)
    if not any(action.reactions for action in actions):
        return actions
    known = {**dict.fromkeys(_absent(motion), ZERO), **values()}
    table = {Symbol(name, SymbolKind.REACTION): value for name, value in known.items()}
    return tuple(action.subs(table) for action in actions)


def _actions(motion: Kinematics, load: Load) -> tuple[Action, ...]:
    """Of a load, with rates of coordinates and dependent speeds given by the independent speeds."""
    actions = load.actions(motion.system.bodies, motion.places, motion.velocities)
    return tuple(a.mapped(motion.form.lengths).subs(motion.in_speeds) for a in actions)


def _absent(motion: Kinematics) -> Iterator[str]:
    """Names of reactions of contacts that are open."""
    for element in motion.elements:
        yield from element.absent()


def _split(load: Load, action: Action, names: list[Symbol]) -> tuple[tuple[Action, ...], Action]:
    used = variables(action.arm.components)
    try:
        if not used.isdisjoint(names):
            raise NumericError(f"the point of {load.name!r}", expected="a place of its own")
        return action.per_unit(names)
    except NumericError as error:
        listed = ", ".join(s.published for s in names)
        raise DeclarationError(
            f"{load.name!r}, which is not linear in the reaction {listed}",
            expected="a force or couple that is proportional to reactions, such as mu*N",
            advice="for friction against the resultant of several reactions declare the contact "
            "Coulomb, or give the sign of the reaction: mu*N where N is positive",
        ) from error


def _refuse_unknown(motion: Kinematics, load: Load, names: list[Symbol]) -> None:
    known = [r.name for group in motion.restraints.values() for r in group]
    for element in motion.elements:
        known += [name for f in element.friction(motion.places) for name in f.names]
    allowed = {*known, *_absent(motion)}
    for symbol in names:
        if symbol.order or symbol.name not in allowed:
            raise DeclarationError(
                f"{load.name!r}, which depends on the reaction {symbol.published}",
                expected=f"one of the reactions {', '.join(known)}"
                if known
                else "a system with contacts or joints",
                advice="the names are those of equations.components; rates of reactions cannot "
                "occur in loads",
            )


def refuse_reactions_outside_loads(motion: Kinematics) -> None:
    """Refuse reactions in anything but the forces and couples of loads.

    Raises:
        DeclarationError: naming the reaction.
    """
    reactions = (s for s in variables(_without_loads(motion)) if s.kind is SymbolKind.REACTION)
    if names := sorted(s.published for s in reactions):
        raise DeclarationError(
            f"the reaction {', '.join(names)}, on which a position, a velocity, an energy or a "
            "coefficient depends",
            expected="reactions in the force or couple of a Force, a Torque or a load of your own",
            advice="declare the force itself, as in Force(body.point(), lab['x'] * (-mu * N))",
        )


def _without_loads(motion: Kinematics) -> Iterator[Expr]:
    """The expressions of a declaration other than forces and couples."""
    for body in motion.system.bodies:
        yield from motion.places[body].components
        for velocity in motion.velocities[body]:
            yield from velocity.components
    yield from motion.kinematics.values()
    yield from motion.dependent.values()
    for element in motion.elements:
        yield from element.closures(motion.places)
        yield from (friction.coefficient for friction in element.friction(motion.places))
    for restraint in (r for group in motion.restraints.values() for r in group):
        yield from (*restraint.direction.components, *restraint.velocity.components)
        for share in restraint.shares():
            yield from (*share.direction.components, *(share.arm.components if share.arm else ()))
    for load in motion.system.loads:
        potential = motion.potential(load)
        if potential is not None:
            yield potential

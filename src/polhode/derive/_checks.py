"""Checks after the kinematics: clashing names, unknown coordinates, missing reactions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from polhode.algebra import ZERO, LetterParts, Symbol, SymbolKind, dependent_columns, variables
from polhode.base import ConstraintError, DeclarationError, NumericError
from polhode.derive._balance import ReactionColumn, Wrench
from polhode.derive._constraints import partial_velocity
from polhode.derive._equations import Equations
from polhode.derive._motion import Kinematics
from polhode.derive._reactions import Reactions
from polhode.derive._unconstrained import depends_on_motion
from polhode.model import OWN_COORDINATES, Body


def refuse_shared_names(motion: Kinematics, required: Mapping[Body, Wrench]) -> None:
    """Refuse two symbols with one name, and reactions named like another or like a symbol."""
    owners: dict[str, str] = {}
    for element in motion.elements:
        names = [restraint.name for restraint in motion.restraints[element.name]]
        for friction in element.friction(motion.places):
            names += friction.names
        for name in names:
            if name in owners:
                raise _shared(name, f"both {owners[name]!r} and {element.name!r}")
            owners[name] = element.name
    components = (c for w in required.values() for v in (w.force, w.couple) for c in v.components)
    symbols = sorted(symbol.published for symbol in variables(components))
    for first, second in pairwise(symbols):
        if first == second:
            raise DeclarationError(
                f"two different quantities are both called {first!r}",
                expected="one meaning for one name",
                advice="rename one of them",
            )
    for name in symbols:
        if name in owners:
            raise _shared(name, f"{owners[name]!r}, and a symbol of the declaration")
    _refuse_alike([*symbols, *owners])


def _refuse_alike(names: Iterable[str]) -> None:
    """Refuse names that are printed as one letter, such as x1 and x_1."""
    printed: dict[LetterParts, str] = {}
    for name in names:
        other = printed.setdefault(LetterParts.of(name), name)
        if other != name:
            raise DeclarationError(
                f"the names {other} and {name}, which are printed as one letter",
                expected="names that can be told apart on paper",
                advice="rename one of them",
            )


def _shared(name: str, owners: str) -> DeclarationError:
    return DeclarationError(
        f"{name}, a reaction of {owners}",
        expected="a different name for every reaction component and symbol",
        advice="give one another letter, such as force='G' or torque='sigma', or its body a tag",
    )


def refuse_unknown_coordinates(motion: Kinematics, required: Mapping[Body, Wrench]) -> None:
    """Refuse coordinates on which no body's position or attitude depends: they have no equation."""
    wrenches = (c for w in required.values() for v in (w.force, w.couple) for c in v.components)
    used = variables((*wrenches, *motion.kinematics.values(), *motion.dependent.values()))
    coordinates = {s.base() for s in used if s.kind is SymbolKind.COORDINATE}
    unknown = sorted(s.published for s in coordinates - set(motion.coordinates))
    if unknown:
        raise DeclarationError(
            f"the coordinate {', '.join(unknown)}, on which no body's position or attitude depends",
            expected=f"one of {', '.join(s.published for s in motion.coordinates)}",
            advice=f"{OWN_COORDINATES}; for a prescribed motion, use functions(...) or an "
            "expression of time",
        )


def refuse_undetermined(solved: Reactions, working: Iterable[ReactionColumn]) -> None:
    """Refuse friction and loads in proportion to reactions that Newton's laws leave open.

    Raises:
        ConstraintError: naming these reactions.
    """
    found = [column.name for column in working if column.name in solved.undetermined]
    if found:
        raise ConstraintError(
            f"friction or a load in proportion to {', '.join(found)}, which the balances of the "
            "bodies leave undetermined",
            expected="reactions that are determined",
            advice="leave out a support that is redundant, or name a law by which contacts share "
            'a load, System(..., sharing="equal stiffness"); a load that cancels the effect of the '
            "reaction also leaves it open, as a brake that locks does; for friction along a curve "
            "declare the curve as a Constraint, whose reaction is perpendicular to it",
        )


def refuse_misaligned(motion: Kinematics) -> None:
    """Refuse parts that need a geometry that the rest of the system does not keep.

    Raises:
        DeclarationError: naming the rope or the rack.
    """
    for element in motion.elements:
        for stray in element.strays(motion.places):
            if motion.form.keep(motion.on_speeds(stray), motion.speeds):
                raise element.misaligned(stray)


def refuse_unresisted(equations: Equations) -> None:
    """Refuse speeds that no mass or inertia resists, such as the spin of a thin rod.

    Raises:
        NumericError: naming the bodies and the speeds.
    """
    motion, mass = equations.kinetics, equations.mass
    # The mass matrix is positive semidefinite: a zero on its diagonal is a whole row of zeros.
    # Massless bodies may also leave a combination of speeds without inertia.
    loose: Sequence[int] = [
        j for j, row in enumerate(mass.rows) if not any(row) or (mass == mass.T and not row[j])
    ]
    massless = [body for body in motion.system.bodies if body.is_massless]
    if massless and not loose:
        loose = dependent_columns(mass.rows)
    if not loose:
        return
    speeds = [motion.speeds[j] for j in loose]
    moving = [
        body for body in motion.system.bodies if not motion.speeds_of(body).isdisjoint(speeds)
    ]
    suspects = [body for body in moving if body.is_massless] or massless or moving
    bodies = ", ".join(body.name for body in suspects)
    raise NumericError(
        f"{bodies}, whose motion with {', '.join(s.published for s in speeds)} no "
        "mass or inertia resists",
        expected="massless bodies that move only together with others, and rods and particles with "
        "axes that turn as far as the motion needs",
        advice="give the body a mass and moments of inertia, hold it with one more joint, or leave "
        "out an angle of its axes",
    )


def refuse_unbalanced(equations: Equations) -> None:
    """Refuse moving supports whose reactions cannot keep the body in the motion they allow.

    A support may move with coordinates of the body it holds, as at the end of a massless rod. The
    equations of motion then hold by d'Alembert's principle, and so does the balance of every body,
    unless a reaction is needed that is not declared, such as a couple that turns it with the rod.

    Raises:
        DeclarationError: naming the contact or joint.
    """
    motion = equations.kinetics
    works: dict[str, list[Symbol]] = {}
    for name, restraints in motion.restraints.items():
        for restraint in (r for r in restraints if depends_on_motion(r.velocity)):
            moved, along = motion.resolve(restraint.velocity), restraint.direction
            if speeds := [s for s in motion.speeds if partial_velocity(moved, s).dot(along)]:
                works[name] = speeds
    if works and not _is_balanced(equations):
        name, speeds = next(iter(works.items()))
        raise DeclarationError(
            f"{name!r}, whose support moves with {', '.join(s.published for s in speeds)}: its "
            "reactions cannot keep the body in that motion",
            expected="a support that moves with time alone, or a body",
            advice="name the body that carries it: to=body.point(offset), or to=body",
        )


def _is_balanced(equations: Equations) -> bool:
    """Whether all balances hold along the motion, and the reactions do no work on the whole."""
    try:
        if any(map(equations.on_shell, equations.unexplained)):
            return False
        moved = [
            (column, equations.kinetics.resolve(column.restraint.velocity))
            for column in equations.lines
            if depends_on_motion(column.restraint.velocity)
        ]
        for speed in equations.speeds:
            works = (
                equations.components[c.name] * partial_velocity(v, speed).dot(c.direction)
                for c, v in moved
            )
            if equations.on_shell(sum(works, ZERO)):
                return False
    except NumericError:  # without accelerations it cannot be decided; refused, to be safe
        return False
    return True

"""Places that a body moves by its own coordinates: whether what holds it there supplies enough."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import ZERO, Expr, Symbol, Vector
from polhode.base import DeclarationError, NumericError
from polhode.derive._equations import Equations
from polhode.derive._motion import Kinematics
from polhode.derive._unconstrained import is_moved
from polhode.model import Restraint


def refuse_unbalanced(equations: Equations) -> None:
    """Refuse contacts and joints that do work on the motions they leave, and lack a force for it.

    A place may move with coordinates of the body it holds, as along a light rod. The equations of
    motion then hold by d'Alembert's principle, and so does the balance of every body, unless the
    body would need more than is declared: a couple that turns it with the rod, say.

    Raises:
        DeclarationError: naming the contact or joint.
    """
    motion = equations.kinetics
    works = {
        name: found
        for name, restraints in motion.restraints.items()
        for restraint in restraints
        if (found := _work(motion, restraint))
    }
    if works and not _is_balanced(equations):
        name, speeds = next(iter(works.items()))
        raise DeclarationError(
            f"{name!r}, whose support moves with {', '.join(s.published for s in speeds)}: what it "
            "supplies is not enough to keep the body in that motion",
            expected="a support that moves with time alone, or a body",
            advice="name the body that carries it: to=body.point(offset), or to=body",
        )


def _work(motion: Kinematics, restraint: Restraint) -> list[Symbol]:
    """The independent speeds with which its place moves along its reaction."""
    if not is_moved(restraint.velocity):
        return []
    moved = motion.resolve(restraint.velocity)
    return [speed for speed in motion.speeds if _slope(moved, speed).dot(restraint.direction)]


def _slope(vector: Vector, speed: Symbol) -> Vector:
    by = Expr.generator(speed)
    return Vector(tuple(c.diff(by) for c in vector.components), vector.triad)


def _is_balanced(equations: Equations) -> bool:
    """Whether all balances hold along the motion, and the reactions do no work on the whole."""
    try:
        return not any(equations.on_shell(rest) for rest in _left(equations))
    except NumericError:
        return False  # not to be decided


def _left(equations: Equations) -> Iterator[Expr]:
    yield from equations.unexplained
    moved = [
        (line, equations.kinetics.resolve(line.restraint.velocity))
        for line in equations.lines
        if is_moved(line.restraint.velocity)
    ]
    for speed in equations.speeds:
        works = (
            equations.components[line.name] * _slope(velocity, speed).dot(line.direction)
            for line, velocity in moved
        )
        yield sum(works, ZERO)

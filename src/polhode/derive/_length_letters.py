"""Letters for the lengths in equations: ρ, or ρ₁ and ρ₂, for distances; |v| for speeds.

A slip speed has its letter from its contact (`derive._balance`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress

from polhode.algebra import (
    Expr,
    LengthLetter,
    SquareRoot,
    Symbol,
    dimension_of,
    distance_letters,
    lengths_in,
    numbered,
)
from polhode.base import LENGTH, TIME, Dimension, UnitError
from polhode.derive._motion import Kinematics

_SPEEDS = ("v", "u", "w", "speed")


def letters_of_lengths(
    motion: Kinematics,
    known: Iterable[Symbol],
    dimensions: Callable[[], Mapping[Symbol, Dimension]],
) -> dict[str, LengthLetter]:
    """Letters for the lengths of loads, ropes and equations between coordinates.

    By the keys of what they stand for: distances between points, and square roots of the user that
    are lengths or speeds.

    Args:
        motion: of the system.
        known: symbols that have letters already.
        dimensions: of all symbols; asked for only where there are roots of the user.
    """
    involved = list(_involved(motion))
    distances, speeds = [part.meaning.key for part in lengths_in(involved)], list[str]()
    for root in _roots_of_sums(involved):
        with suppress(UnitError):
            dimension = dimension_of(root.radicand, dimensions())
            distances += [root.key] * (dimension == LENGTH**2)
            speeds += [root.key] * (dimension == (LENGTH / TIME) ** 2)
    taken = {symbol.published for symbol in known}
    speed = next(letter for letter in _SPEEDS if letter not in taken)
    return {
        **distance_letters(distances, taken),
        **{key: LengthLetter(name, of_velocity=True) for key, name in numbered(speed, speeds)},
    }


def _involved(motion: Kinematics) -> Iterator[Expr]:
    """The forces and couples of loads, and the directions of reactions, as declared."""
    for load in motion.system.loads:
        for action in load.actions(motion.system.bodies, motion.places, motion.velocities):
            yield from (*action.force.components, *action.couple.components)
    for element in motion.elements:
        for restraint in element.restraints(motion.places):
            for share in restraint.shares():
                yield from share.direction.components


def _roots_of_sums(expressions: Iterable[Expr]) -> Iterator[SquareRoot]:
    """The square roots of sums that vary."""
    found = dict.fromkeys(g for e in expressions for g in e.generators)
    for root in found:
        if isinstance(root, SquareRoot) and root.plain is None and root.varies:
            radicand = root.radicand
            if len(radicand.num) > 1 and not radicand.ring.has_parts:
                yield root

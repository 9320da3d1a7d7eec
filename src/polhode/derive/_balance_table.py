"""The balances of all bodies as linear equations for the reactions, to be solved in numbers.

At one position reactions may be determined that are open at others: of contacts at one height, the
normal forces do not depend on the friction.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Vector
from polhode.derive._balance import Wrench
from polhode.derive._equations import Equations


@dataclass(frozen=True)
class BalanceTable:
    """The balances, six for every body.

    Attributes:
        expressions: row by row, what the reactions must supply, what one unit of each supplies,
            and what one unit of each normal force does without the friction that goes with it.
        names: of the reactions.
        pushes: the places of the normal forces among them.
    """

    expressions: tuple[Expr, ...]
    names: tuple[str, ...]
    pushes: tuple[int, ...]


def balance_table(equations: Equations) -> BalanceTable:
    """The balances of a system, in terms of accelerations too."""
    lines, motion = equations.lines, equations.kinetics
    contacts = {element.push for element in motion.elements} - {None}
    pushes = tuple(j for j, line in enumerate(lines) if line.name in contacts)
    ideal = [lines[j].without_friction for j in pushes]

    def entries() -> Iterator[Expr]:
        for body, needed in equations.required.items():
            columns = [line.with_loads.get(body) for line in (*lines, *ideal)]
            for part in (_force, _couple):
                yield from _rows(part(needed), [None if c is None else part(c) for c in columns])

    found = tuple(map(motion.on_speeds, entries()))
    return BalanceTable(found, tuple(line.name for line in lines), pushes)


def _force(wrench: Wrench) -> Vector:
    return wrench.force


def _couple(wrench: Wrench) -> Vector:
    return wrench.couple


def _rows(needed: Vector, supplied: list[Vector | None]) -> Iterator[Expr]:
    """The balances of one body along three axes."""
    along = [None if v is None else v.express(needed.triad) for v in supplied]
    for axis in range(3):
        yield needed.components[axis]
        for vector in along:
            yield ZERO if vector is None else vector.components[axis]

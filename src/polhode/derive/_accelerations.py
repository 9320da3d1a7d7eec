"""Accelerations from the mass matrix, inverted exactly block by block."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import (
    Expr,
    Matrix,
    Row,
    Symbol,
    eliminate,
    eliminate_in_parts,
    solve_definite,
)
from polhode.base import NumericError

#: A block of the mass matrix that couples more speeds than this is not inverted symbolically: its
#: determinant has up to n! terms.
LARGEST_SYMBOLIC = 5


def accelerations_in_parts(mass: Matrix, forcing: Row) -> Row:
    """The accelerations of all speeds, with long expressions under names."""
    if mass == mass.T:
        return solve_definite(mass.rows, forcing)
    solved = eliminate_in_parts(mass.rows, forcing).solved
    return tuple(value for _, value in solved.values())


def solve_accelerations(speeds: tuple[Symbol, ...], mass: Matrix, forcing: Row) -> Row:
    """The accelerations of all speeds, block by block.

    Raises:
        NumericError: for a block of more than five speeds, and for speeds without inertia.
    """
    values: dict[int, Expr] = {}
    for block in _blocks(mass):
        if len(block) > LARGEST_SYMBOLIC:
            raise NumericError(
                f"accelerations of {len(block)} coupled speeds in closed form",
                expected=f"at most {LARGEST_SYMBOLIC}",
                advice="use mass and forcing, which are factorised numerically",
            )
        outcome = eliminate(
            [[mass[i, j] for j in block] for i in block], [forcing[i] for i in block]
        )
        if outcome.free:
            names = ", ".join(speeds[block[k]].published for k in outcome.free)
            raise NumericError(
                f"accelerations of {names}, which no mass or inertia resists",
                expected="a mass matrix that can be inverted",
                advice="give the body a mass and inertia, or constrain it",
            )
        values |= {block[k]: value for k, (_, value) in outcome.solved.items()}
    return tuple(values[i] for i in range(len(speeds)))


def _blocks(mass: Matrix) -> Iterator[list[int]]:
    """Groups of speeds that the mass matrix couples, directly or through others."""
    pending = list(range(len(mass.rows)))
    while pending:
        block = [pending.pop(0)]
        for i in block:
            joined = [j for j in pending if mass[i, j] or mass[j, i]]
            block += joined
            pending = [j for j in pending if j not in joined]
        yield sorted(block)

"""Values of the nodes of a formula at many states, and how a change is carried up to its side."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.claims.latex import _tree as tree
from polhode.claims.latex._tree import Node, Piece
from polhode.claims.states._numeric import Array


@dataclass(frozen=True, eq=False)
class Figure:
    """A quantity by numbers.

    Attributes:
        rank: 0 for a scalar, 1 for a vector, 2 for a tensor.
        array: (trials, states) with (3,) in front for every rank, along one triad for all.
    """

    rank: int
    array: Array

    def __add__(self, other: Figure) -> Figure:
        zero = next((f for f in (self, other) if f.rank == 0 and not f.array.any()), None)
        if self.rank != other.rank and zero is None:  # a bare 0 stands for a vector
            raise _unlike("+")
        return Figure(max(self.rank, other.rank), self.array + other.array)

    def __neg__(self) -> Figure:
        return Figure(self.rank, -self.array)

    def __mul__(self, other: Figure) -> Figure:
        match self.rank, other.rank:
            case (0, rank) | (rank, 0):
                return Figure(rank, self.array * other.array)
            case 2, 1:
                return Figure(1, np.einsum("ij...,j...->i...", self.array, other.array))
        raise _unlike("beside")

    def cross(self, other: Figure) -> Figure:
        """The vector product; of scalars, the product."""
        if self.rank == other.rank == 1:
            return Figure(1, _crossed(self.array, other.array))
        return self * other

    def dot(self, other: Figure) -> Figure:
        """The scalar product."""
        if self.rank == other.rank == 1:
            return Figure(0, (self.array * other.array).sum(axis=0))
        return self * other

    def over(self, other: Figure) -> Figure:
        """The quotient by a scalar."""
        if other.rank:
            raise _unlike("over")
        return self * Figure(0, 1 / other.array)

    def size(self) -> Figure:
        """The length of a vector."""
        if self.rank != 1:
            raise _unlike("the length of")
        return Figure(0, np.sqrt(self.dot(self).array))

    def raised(self, exponent: Figure) -> Figure:
        """A power; of a vector, of its length."""
        base = self if self.rank == 0 else self.size()
        if exponent.rank:
            raise _unlike("to the power")
        return Figure(0, base.array**exponent.array)

    def through(self, function: Callable[[Array], Array]) -> Figure:
        """A function of a scalar."""
        if self.rank:
            raise _unlike("a function of")
        return Figure(0, function(self.array))


def _crossed(one: Array, other: Array) -> Array:
    (a, b, c), (x, y, z) = one, other
    return np.array([b * z - c * y, c * x - a * z, a * y - b * x])


def scalar(array: Array) -> Figure:
    """A scalar by its values: (states,) or (trials, states)."""
    return Figure(0, np.atleast_2d(array))


def together(figures: Sequence[Figure]) -> Figure:
    """Several of one rank as trials of one."""
    shape = np.broadcast_shapes(*(figure.array.shape for figure in figures))
    alike = [np.broadcast_to(figure.array, shape) for figure in figures]
    return Figure(figures[0].rank, np.concatenate(alike, axis=-2))


_FUNCTIONS: Mapping[str, Callable[[Array], Array]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "sec": lambda x: 1 / np.cos(x),
    "csc": lambda x: 1 / np.sin(x),
    "cot": lambda x: 1 / np.tan(x),
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "exp": np.exp,
}


_FORMED: Mapping[type[Piece], Callable[..., Figure]] = {
    tree.Sum: lambda *terms: reduce(Figure.__add__, terms),
    tree.Product: lambda *factors: reduce(Figure.__mul__, factors),
    tree.Negative: Figure.__neg__,
    tree.Cross: Figure.cross,
    tree.Dot: Figure.dot,
    tree.Quotient: Figure.over,
    tree.Power: Figure.raised,
    tree.Magnitude: Figure.size,
    tree.Root: lambda of: of.through(np.sqrt),
}


_ARITHMETIC = (tree.Sum, tree.Product, tree.Negative, tree.Quotient, tree.Cross, tree.Dot)


def is_arithmetic(node: Piece) -> bool:
    """Whether its value follows from those of its parts with no choice of a branch."""
    return isinstance(node, _ARITHMETIC)


def formed(node: Piece, inside: Sequence[Figure]) -> Figure:
    """What a node makes of the figures of its parts.

    Raises `NumericError` for nodes that need more than numbers, such as rates.
    """
    with np.errstate(all="ignore"):
        match node:
            case tree.PlusMinus(sign=sign):
                return inside[0] if sign == "±" else -inside[0]
            case tree.Call(function=name) if name in _FUNCTIONS:
                return inside[0].through(_FUNCTIONS[name])
            case _ if type(node) in _FORMED:
                return _FORMED[type(node)](*inside)
    raise NumericError(f"{type(node).__name__} by numbers", expected="a formula without rates")


def carried(
    root: Piece, path: Sequence[int], new: Figure, known: Callable[[Node], Figure]
) -> Figure:
    """The figure of a whole in which another quantity stands at a place.

    Args:
        root: the whole, such as a side.
        path: of the place in it.
        new: what stands there instead.
        known: figures of all that is unchanged.
    """
    if not path:
        return new
    first, *rest = path
    inside: list[Any] = [
        carried(part, rest, new, known) if i == first else known(part)  # type: ignore[arg-type]
        for i, part in enumerate(root.parts)
    ]
    return formed(root, inside)


def _unlike(sign: str) -> NumericError:
    return NumericError(f"two kinds of quantity with {sign}", expected="kinds that go together")

"""A statement by numbers: residuals of its members when another quantity stands at a place."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import product
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, Triad, Vector
from polhode.base import NumericError
from polhode.judge.latex import _tree as tree
from polhode.judge.latex._tree import Node, Piece, Statement
from polhode.judge.meaning._meaning import Meaning, Tensor
from polhode.judge.meaning._relations import BoundRelation, triad_of
from polhode.judge.repair._places import MemberSides, NodePosition
from polhode.judge.repair._trials import RepairNotation
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._numeric import NO_VALUE, Array
from polhode.judge.states._sample_points import SamplePoints

_CLOSE_ENOUGH = 1e-5  # of candidates that are judged exactly later; states may be integrated
_CLOSE = 1e-7  # relative; residuals of sums of many terms, in doubles


class NumericEvaluator:
    """Values of one statement and its parts at sample points.

    Args:
        statement: the statement, as parsed.
        claim: the claim it makes.
        sides: its members and their sides.
        notation: how it is read.
        samples: the states.
    """

    def __init__(
        self,
        statement: Statement,
        claim: BoundClaim,
        sides: MemberSides,
        notation: RepairNotation,
        samples: SamplePoints,
    ) -> None:
        self._statement, self._members, self._sides = statement, claim.members, sides
        self._notation, self._samples = notation, samples
        self._values: dict[Node, NumericTensor] = {}
        self._rotations: dict[tuple[Triad, Triad], Array] = {}
        triads = (triad_of(r.left, r.right) for r in claim.members)
        self._triad = next((triad for triad in triads if triad is not None), None)

    def of(self, node: Node) -> NumericTensor:
        """The value of a node by itself; raises one of `NO_VALUE` where it has none."""
        if node not in self._values:
            self._values[node] = self._found(node)
        return self._values[node]

    def _found(self, node: Node) -> NumericTensor:
        """Its value from those of its parts where possible, which is faster than exactly."""
        if is_arithmetic(node):
            try:
                return combined(node, [self.of(part) for part in node.parts])  # type: ignore[arg-type]
            except NO_VALUE:
                pass
        return self._evaluated(self._notation.value(node), self._samples.values)

    def function(self, node: Node, letter: Symbol) -> Callable[[Array], NumericTensor]:
        """The value of a node as a function of a letter in it: of (trials, states)."""
        value = self._notation.value(node, {letter.name: Expr.generator(letter)})
        parts = value.components if isinstance(value, Vector) else (value,)
        of_letter = self._samples.function(parts, letter)
        return lambda at: self._evaluated(value, lambda _: of_letter(at))

    def _evaluated(
        self, value: Meaning, numbers: Callable[[Sequence[Expr]], Array]
    ) -> NumericTensor:
        """A quantity from the values of its components."""
        match value:
            case Expr():
                return scalar(numbers([value])[0])
            case Vector(components, triad):
                along = numbers(components).reshape(3, -1, self._samples.size)
                return NumericTensor(1, np.einsum("ijs,jbs->ibs", self._rotation(triad), along))
            case Tensor(matrix, triad):
                rotation = self._rotation(triad)
                entries = numbers([e for row in matrix.rows for e in row])
                square = entries.reshape(3, 3, -1)
                array = np.einsum("iks,kls,jls->ijs", rotation, square, rotation)  # R I Rᵀ
                return NumericTensor(2, array[:, :, None])
        raise NumericError(f"{value}", expected="a scalar, a vector or a tensor")

    def residuals(self, changed: Statement, members: Sequence[int]) -> Array:
        """Residuals of members of a changed statement: (rows, trials, states)."""
        found = []
        for member in members:
            sides = (changed.relations[i].sides[k] for i, k in self._sides.sides(member))
            one, other = map(self.of, sides)
            found.append(self._difference(member, one, other))
        return np.concatenate(found)

    def around(self, place: NodePosition) -> NodePosition:
        """The outermost node around a place that has a value, but not by those of its parts.

        Raises `NumericError` where there is none.
        """
        node: Piece = self._statement.relations[place.relation]
        for depth, step in enumerate(place.path[1:-1], 2):
            parent, node = node, node.parts[step]
            if isinstance(node, Node) and not is_combined(node):
                return NodePosition(place.path[:depth], node, parent)
        raise NumericError(f"{place.node}", expected="something inside of a rate")

    def rows(self, place: NodePosition, new: NumericTensor, members: Sequence[int]) -> Array:
        """Residuals of members with another quantity at a place: (rows, trials, states).

        A member of vectors has three rows, along the triad that its residuals are along.
        """
        relation, side, *inside = place.path
        whole = self._statement.relations[relation].sides[side]
        changed = with_replaced(whole, inside, new, self.of)
        residuals = [self._residual(member, (relation, side), changed) for member in members]
        trials = np.broadcast_shapes(*(rows.shape[1:] for rows in residuals))
        return np.concatenate([np.broadcast_to(r, (len(r), *trials)) for r in residuals])

    def fitting(
        self, place: NodePosition, others: Sequence[Node], members: Sequence[int]
    ) -> list[Node]:
        """Those of some nodes of one rank that make all members hold when put at a place."""
        if not others:
            return []
        rows = self.rows(place, stacked([self.of(node) for node in others]), members)
        holds = np.abs(rows).max(axis=(0, 2)) < _CLOSE_ENOUGH
        return [node for i, node in enumerate(others) if holds[i]]

    def amounts(self, place: NodePosition, terms: NumericTensor, members: Sequence[int]) -> Array:
        """The missing multiple of each term at a place: (terms, states); nan for unsuited terms.

        Raises `NumericError` if the residuals are not linear in the added term.
        """
        present, size = self.of(place.node), 3**terms.rank
        shape = (*(3,) * terms.rank, 1, 1)
        axes = [NumericTensor(terms.rank, unit.reshape(shape)) for unit in np.eye(size)]
        # Trials: nothing added, each unit component added, and the first one twice for linearity.
        tried = [present, *(present + axis for axis in axes), present + axes[0] + axes[0]]
        rest, *steps, twice = np.moveaxis(self.rows(place, stacked(tried), members), 1, 0)
        slopes = np.array([step - rest for step in steps])
        if not np.allclose(twice - rest, 2 * slopes[0], rtol=_CLOSE, atol=_CLOSE):
            raise NumericError("a change", expected="one in proportion to what is added")
        parts = terms.array.reshape(len(axes), *terms.array.shape[-2:])
        effects = np.einsum("irs,its->trs", slopes, parts)
        with np.errstate(all="ignore"):
            # Least squares of rest + amount · effect over the rows, at each state by itself.
            found = -(effects * rest).sum(axis=1) / (effects * effects).sum(axis=1)
        left = np.abs(rest + effects * found[:, None]).max(axis=(1, 2))
        fits = left <= _CLOSE * (1 + np.abs(rest).max())
        return np.where(fits[:, None], found, np.nan)

    def _residual(self, member: int, side: tuple[int, int], changed: NumericTensor) -> Array:
        """Left minus right side of a member, one of whose sides is changed."""
        first, second = self._sides.sides(member)
        sides = self._statement.relations[first[0]].sides
        one, other = (changed if s == side else self.of(sides[s[1]]) for s in (first, second))
        return self._difference(member, one, other)

    def _difference(self, member: int, one: NumericTensor, other: NumericTensor) -> Array:
        """Left minus right side of a member."""
        difference = one + -other
        if difference.rank == 0:
            return difference.array[None]
        relation: BoundRelation = self._members[member]
        triad = triad_of(relation.left, relation.right)
        if difference.rank != 1 or triad is None:
            raise NumericError("a member", expected="two scalars or two vectors")
        rotation = self._rotation(triad)  # its transpose leads back to the triad of the residuals
        return np.asarray(np.einsum("jis,jbs->ibs", rotation, difference.array))

    def _rotation(self, triad: Triad) -> Array:
        """Matrix from components along a triad to those along the common one: (3, 3, states)."""
        if self._triad is None:
            self._triad = triad
        key = triad, self._triad
        if key not in self._rotations:
            matrix = triad.rotation_to(self._triad)
            entries = [matrix[i, j] for i, j in product(range(3), range(3))]
            self._rotations[key] = self._samples.values(entries).reshape(3, 3, -1)
        return self._rotations[key]


# -- quantities by numbers, and the operations of nodes on them ------------------------------------


@dataclass(frozen=True, eq=False)
class NumericTensor:
    """A scalar, vector or tensor at many states, in several trials.

    Attributes:
        rank: 0 for a scalar, 1 for a vector, 2 for a tensor.
        array: (trials, states) with (3,) in front for every rank, along one triad for all.
    """

    rank: int
    array: Array

    def __add__(self, other: NumericTensor) -> NumericTensor:
        zero = next((q for q in (self, other) if q.rank == 0 and not q.array.any()), None)
        if self.rank != other.rank and zero is None:  # a bare 0 stands for a vector
            raise _unlike("+")
        return NumericTensor(max(self.rank, other.rank), self.array + other.array)

    def __neg__(self) -> NumericTensor:
        return NumericTensor(self.rank, -self.array)

    def __mul__(self, other: NumericTensor) -> NumericTensor:
        match self.rank, other.rank:
            case (0, rank) | (rank, 0):
                return NumericTensor(rank, self.array * other.array)
            case 2, 1:
                return NumericTensor(1, np.einsum("ij...,j...->i...", self.array, other.array))
        raise _unlike("beside")

    def cross(self, other: NumericTensor) -> NumericTensor:
        """The vector product; of scalars, the product."""
        if self.rank == other.rank == 1:
            (a, b, c), (x, y, z) = self.array, other.array
            return NumericTensor(1, np.array([b * z - c * y, c * x - a * z, a * y - b * x]))
        return self * other

    def dot(self, other: NumericTensor) -> NumericTensor:
        """The scalar product."""
        if self.rank == other.rank == 1:
            return NumericTensor(0, (self.array * other.array).sum(axis=0))
        return self * other

    def over(self, other: NumericTensor) -> NumericTensor:
        """The quotient by a scalar."""
        if other.rank:
            raise _unlike("over")
        return self * NumericTensor(0, 1 / other.array)

    def size(self) -> NumericTensor:
        """The length of a vector."""
        if self.rank != 1:
            raise _unlike("the length of")
        return NumericTensor(0, np.sqrt(self.dot(self).array))

    def raised(self, exponent: NumericTensor) -> NumericTensor:
        """A power; of a vector, of its length."""
        base = self if self.rank == 0 else self.size()
        if exponent.rank:
            raise _unlike("to the power")
        return NumericTensor(0, base.array**exponent.array)

    def through(self, function: Callable[[Array], Array]) -> NumericTensor:
        """A function of a scalar."""
        if self.rank:
            raise _unlike("a function of")
        return NumericTensor(0, function(self.array))


def scalar(array: Array) -> NumericTensor:
    """A scalar by its values: (states,) or (trials, states)."""
    return NumericTensor(0, np.atleast_2d(array))


def stacked(quantities: Sequence[NumericTensor]) -> NumericTensor:
    """Several quantities of one rank as trials of one quantity."""
    shape = np.broadcast_shapes(*(quantity.array.shape for quantity in quantities))
    alike = [np.broadcast_to(quantity.array, shape) for quantity in quantities]
    return NumericTensor(quantities[0].rank, np.concatenate(alike, axis=-2))


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
    "coth": lambda x: 1 / np.tanh(x),
    "sech": lambda x: 1 / np.cosh(x),
    "csch": lambda x: 1 / np.sinh(x),
    "arcsin": np.arcsin,
    "arccos": np.arccos,
    "arctan": np.arctan,
    "ln": np.log,
    "exp": np.exp,
}
_COMBINED: Mapping[type[Piece], Callable[..., NumericTensor]] = {
    tree.Sum: lambda *terms: reduce(NumericTensor.__add__, terms),
    tree.Product: lambda *factors: reduce(NumericTensor.__mul__, factors),
    tree.Negative: NumericTensor.__neg__,
    tree.Cross: NumericTensor.cross,
    tree.Dot: NumericTensor.dot,
    tree.Quotient: NumericTensor.over,
    tree.Power: NumericTensor.raised,
    tree.Magnitude: NumericTensor.size,
    tree.Root: lambda of: of.through(np.sqrt),
}
_ARITHMETIC = (tree.Sum, tree.Product, tree.Negative, tree.Quotient, tree.Cross, tree.Dot)


def is_combined(node: Piece) -> bool:
    """Whether its value follows from those of its parts by numbers."""
    is_known = isinstance(node, tree.Call) and node.function in _FUNCTIONS
    return is_known or isinstance(node, tree.PlusMinus) or type(node) in _COMBINED


def is_arithmetic(node: Piece) -> bool:
    """Whether its value follows from those of its parts without choosing a branch of a root."""
    return isinstance(node, _ARITHMETIC)


def combined(node: Piece, inside: Sequence[NumericTensor]) -> NumericTensor:
    """The value of a node from those of its parts.

    Raises `NumericError` for nodes that need more than numbers, such as rates.
    """
    with np.errstate(all="ignore"):
        match node:
            case tree.PlusMinus(sign=sign):
                return inside[0] if sign == "±" else -inside[0]
            case tree.Call(function=name) if name in _FUNCTIONS:
                return inside[0].through(_FUNCTIONS[name])
            case _ if type(node) in _COMBINED:
                return _COMBINED[type(node)](*inside)
    raise NumericError(f"{type(node).__name__} by numbers", expected="a formula without rates")


def with_replaced(
    root: Piece, path: Sequence[int], new: NumericTensor, known: Callable[[Node], NumericTensor]
) -> NumericTensor:
    """The value of a tree in which another quantity stands at a place.

    Args:
        root: the tree, such as a side.
        path: of the place in it.
        new: the quantity put there.
        known: gives the values of unchanged nodes.
    """
    if not path:
        return new
    first, *rest = path
    inside: list[Any] = [
        with_replaced(part, rest, new, known) if i == first else known(part)  # type: ignore[arg-type]
        for i, part in enumerate(root.parts)
    ]
    return combined(root, inside)


def _unlike(sign: str) -> NumericError:
    return NumericError(f"two kinds of quantity with {sign}", expected="kinds that can be combined")

"""A statement that fails, with the letters and values that the search for a correction uses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np

from polhode.algebra import Expr, SymbolKind, Vector
from polhode.derive import Equations
from polhode.judge.latex._tree import Cross, Derivative, Dots, Name, Node, Statement
from polhode.judge.meaning._meaning import Side
from polhode.judge.repair._edits import letters, other_function, relabelled
from polhode.judge.repair._multiplier import Products
from polhode.judge.repair._numeric_evaluator import NumericEvaluator, NumericTensor, stacked
from polhode.judge.repair._places import NodePosition, places, put
from polhode.judge.repair._trials import RepairNotation, Trials
from polhode.judge.states._numeric import NO_VALUE, Array

_CLOSE = 1e-7  # relative; values in doubles at sample points
_MOST_VECTORS = 40  # of which all pairs are crossed: 780 products
_UPWARD = Name("z", decoration="hat")


def is_foreign(value: Expr | None, equations: Equations) -> bool:
    """Whether a letter stands for a reaction or an acceleration.

    No referee brings one into a line that does not speak of it.
    """
    symbol = None if value is None else value.symbol
    if symbol is None:
        return False
    if symbol.name in equations.components:
        return True
    return symbol.order + (symbol.kind is SymbolKind.SPEED) > 1


@dataclass(frozen=True, eq=False)
class RepairContext:
    """A statement with the letters of its text and their values.

    Attributes:
        statement: the statement, as parsed.
        notation: how statements are read.
        trials: where it is to hold, exactly and at sample points.
        evaluator: its values at these points.
    """

    statement: Statement
    notation: RepairNotation
    trials: Trials
    evaluator: NumericEvaluator

    def value(self, node: Node) -> Side | None:
        """The meaning of a node, or None."""
        try:
            return self.notation.value(node)
        except NO_VALUE:
            return None

    def has_value(self, node: Node) -> bool:
        """Whether a node is a scalar that is finite at the sample points."""
        try:
            found = self.evaluator.of(node)
        except NO_VALUE:
            return False
        return found.rank == 0 and bool(np.isfinite(found.array).all())

    def vanishing(
        self, changed: Statement, members: Sequence[int], extra: dict[str, Expr]
    ) -> list[Expr]:
        """Exact residuals of some members of a changed statement."""
        return self.trials.vanishing(self.notation.read_claim(changed, extra), members)

    def fitting(
        self, place: NodePosition, others: Sequence[Node], members: Sequence[int]
    ) -> list[Node]:
        """Nodes, among others of one rank, with which all members hold when put at a place."""
        try:
            return self.evaluator.fitting(place, others, members)
        except NO_VALUE:
            return [node for node in others if self._fits(place, node, members)]

    def _fits(self, place: NodePosition, node: Node, members: Sequence[int]) -> bool:
        return self.holds(put(self.statement, place.path, node), members, _CLOSE)

    def holds(self, changed: Statement, members: Sequence[int], within: float) -> bool:
        """Whether members of a changed statement hold at the sample points."""
        try:
            if self._is_plain:
                return bool(np.abs(self.evaluator.residuals(changed, members)).max() < within)
        except NO_VALUE:
            pass
        try:
            left = self.trials.samples.values(self.vanishing(changed, members, {}))
            return bool(left.size) and bool(np.abs(left).max() < within)
        except NO_VALUE:
            return False

    @cached_property
    def _is_plain(self) -> bool:
        """Whether the residuals are the differences of the printed sides."""
        members = range(len(self.notation.read_claim(self.statement, {}).members))
        try:
            by_numbers = self.evaluator.residuals(self.statement, members)[:, 0]
            exact = self.trials.samples.values(self.vanishing(self.statement, members, {}))
        except NO_VALUE:
            return False
        return by_numbers.shape == exact.shape and np.allclose(by_numbers, exact, _CLOSE, _CLOSE)

    # -- letters ---------------------------------------------------------------------------------

    @cached_property
    def own(self) -> tuple[Node, ...]:
        """Letters and functions of the statement."""
        found = (n for place in places(self.statement) for n in letters(place.node))
        return tuple(dict.fromkeys(found))

    @cached_property
    def vocabulary(self) -> dict[Node, Expr | None]:
        """Letters of the claim and of the text, each with its value if that is a nonzero scalar."""
        functions = [other for n in self.own if (other := other_function(n)) is not None]
        indexed = [other for n in self.own for other in relabelled(n)]
        found: dict[Node, Expr | None] = {}
        for node in dict.fromkeys([*self.own, *functions, *indexed, *self.notation.names]):
            value = self.value(node)
            found[node] = value if isinstance(value, Expr) and value else None
        return found

    @cached_property
    def scalars(self) -> list[tuple[Node, Array]]:
        """Scalars that never vanish, with their values: (states,)."""
        found = []
        for node in (n for n, e in self.vocabulary.items() if e is not None):
            try:
                values = self.evaluator.of(node).array[0]
            except NO_VALUE:
                continue
            if np.isfinite(values).all() and values.all():
                found.append((node, values))
        return found

    @cached_property
    def scalar_values(self) -> Array:
        """The values of the scalars: (scalars, states)."""
        return np.array([values for _, values in self.scalars])

    @cached_property
    def products(self) -> Products:
        """Products of the scalars; authors divide by no force, and by no acceleration."""
        return Products(self.scalars, [node for node, _ in self.scalars if self.is_foreign(node)])

    def is_foreign(self, node: Node) -> bool:
        """Whether it is a reaction or an acceleration that does not occur in the claim.

        A line that has one component of a reaction may lack another.
        """
        value = self.vocabulary.get(node)
        if node in self.own or (isinstance(node, Name) and node in self._other_components):
            return False
        return is_foreign(value, self.trials.states.equations)

    @cached_property
    def _other_components(self) -> frozenset[Node]:
        return frozenset(other for n in self.own for other in relabelled(n))

    @cached_property
    def on_domain(self) -> dict[Node, Expr]:
        """The scalars on the states where the claim should hold."""
        known = {node: e for node, e in self.vocabulary.items() if e is not None}
        return {n: value for n, e in known.items() if (value := self._on_domain(e)) is not None}

    def _on_domain(self, value: Expr) -> Expr | None:
        """A scalar on the states where the claim should hold.

        None if it has no value there, and where the motion gives it as a long expression, of which
        nothing is a short multiple.
        """
        equations = self.trials.states.equations
        if equations.in_parts and is_foreign(value, equations):
            return None
        try:
            return self.trials.states.on(value)
        except NO_VALUE:
            return None

    @cached_property
    def spellings(self) -> dict[Expr, Node]:
        """The letter of each scalar; the first one, if several letters stand for the same."""
        known = reversed(self.on_domain)  # later entries of a dictionary override earlier ones
        return {e: node for node in known if (e := self.vocabulary[node]) is not None}

    # -- vectors ---------------------------------------------------------------------------------

    @cached_property
    def other_vectors(self) -> list[Node]:
        """Vectors of the claim and of the text that do not vanish."""
        named = (n for n, e in self.vocabulary.items() if e is None and isinstance(n, Name | Dots))
        found: list[Node] = []
        for node in named:
            value = self.value(node)
            if isinstance(value, Vector) and any(map(self._on_domain, value.components)):
                found.append(node)
        return found

    @cached_property
    def directions(self) -> list[Node]:
        """Unit vectors along which a term may stand."""
        wide = [*self.own, *self.notation.names, _UPWARD]
        wide += [other for n in self.own for other in relabelled(n)]
        named = (n for n in wide if isinstance(n, Name) and n.decoration == "hat")
        return [n for n in dict.fromkeys(named) if isinstance(self.value(n), Vector)]

    @cached_property
    def vectors(self) -> VectorTerms:
        """Distinct vectors that a missing term may be formed of, followed by their rates."""
        found: dict[Node, NumericTensor] = {}
        for node in dict.fromkeys([*self.own, *self.notation.vectors]):
            if isinstance(node, Name) and isinstance(self.value(node), Vector):
                self._add_if_new(node, found)
        for node in tuple(found):
            self._add_if_new(Derivative(node, Name("t")), found)
        return VectorTerms(tuple((node,) for node in found), stacked(list(found.values())))

    def _add_if_new(self, node: Node, found: dict[Node, NumericTensor]) -> None:
        """Add a vector, unless it vanishes or equals one that was found before."""
        try:
            vector = self.evaluator.of(node)
        except NO_VALUE:
            return
        array = vector.array
        if not np.isfinite(array).all() or np.abs(array).max() <= _CLOSE:
            return
        others = (other.array for other in found.values())
        if not any((np.abs(array - b) <= _CLOSE * (1 + np.abs(b))).all() for b in others):
            found[node] = vector

    @cached_property
    def crossed(self) -> VectorTerms:
        """Vector products of two of these vectors."""
        singles = [nodes[0] for nodes in self.vectors.nodes[:_MOST_VECTORS]]
        first, second = np.triu_indices(len(singles), 1)
        one, other = (NumericTensor(1, self.vectors.values.array[:, i]) for i in (first, second))
        pairs = tuple((singles[i], singles[j]) for i, j in zip(first, second, strict=True))
        return VectorTerms(pairs, one.cross(other))


@dataclass(frozen=True, eq=False)
class VectorTerms:
    """Vectors that a formula may lack.

    Attributes:
        nodes: for each, the one vector it is, or the two it is the vector product of.
        values: values of all of them, as trials of one quantity.
    """

    nodes: tuple[tuple[Node, ...], ...]
    values: NumericTensor

    def __len__(self) -> int:
        return len(self.nodes)

    def __getitem__(self, i: int) -> Node:
        return reduce(Cross, self.nodes[i])

"""One statement that fails, with all that is known of it while a correction is looked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

import numpy as np

from polhode.algebra import Expr, SymbolKind, Vector
from polhode.claims.latex._tree import Cross, Derivative, Dots, Name, Node, Statement
from polhode.claims.meaning._components import Side
from polhode.claims.repair._edits import letters, relabelled, turned
from polhode.claims.repair._multiplier import Products
from polhode.claims.repair._numeric_evaluator import UNKNOWN, Figure, NumericEvaluator, together
from polhode.claims.repair._places import NodePosition, places, put
from polhode.claims.repair._trials import RepairNotation, Trials
from polhode.claims.states._numeric import Array

_CLOSE = 1e-7
_MOST_VECTORS = 40
_UPRIGHT = Name("z", decoration="hat")


@dataclass(frozen=True, eq=False)
class RepairContext:
    """A statement on the bench.

    Attributes:
        statement: read.
        reading: how statements are read.
        tried: where it is to hold, exactly and at states.
        tally: its figures at these states.
    """

    statement: Statement
    reading: RepairNotation
    tried: Trials
    tally: NumericEvaluator

    def value(self, node: Node) -> Side | None:
        """What a node stands for, if it stands for something."""
        try:
            return self.reading.value(node)
        except UNKNOWN:
            return None

    def _vanishes(self, node: Node) -> bool:
        """Whether a vector is zero in these circumstances, or has no value there."""
        value = self.value(node)
        if not isinstance(value, Vector):
            return False
        return not any(map(self._settled, value.components))

    def _settled(self, value: Expr) -> Expr | None:
        """A scalar as it is in these circumstances; None where it has no value there."""
        try:
            return self.tried.states.on(value)
        except UNKNOWN:
            return None

    def fitting(
        self, place: NodePosition, others: Sequence[Node], members: Sequence[int]
    ) -> list[Node]:
        """Those of some nodes of one rank that make all members hold when put at a place."""
        try:
            return self.tally.fitting(place, others, members)
        except UNKNOWN:
            return [node for node in others if self._fits(place, node, members)]

    def _fits(self, place: NodePosition, node: Node, members: Sequence[int]) -> bool:
        changed = put(self.statement, place.path, node)
        try:
            left = self.left(changed, members, {})
            values = self.tried.bench.values
            return bool(left) and all(np.abs(values([e])).max() < _CLOSE for e in left)
        except UNKNOWN:
            return False

    def left(
        self, changed: Statement, members: Sequence[int], extra: dict[str, Expr]
    ) -> list[Expr]:
        """What must vanish for some members of a changed statement, exactly."""
        return self.tried.left(self.reading.asked(changed, extra), members)

    # -- letters ---------------------------------------------------------------------------------

    @cached_property
    def own(self) -> tuple[Node, ...]:
        """Letters and functions of the statement."""
        found = (n for place in places(self.statement) for n in letters(place.node))
        return tuple(dict.fromkeys(found))

    @cached_property
    def vocabulary(self) -> dict[Node, Expr | None]:
        """Letters of the claim and of the text, and the scalars they stand for."""
        turns = [t for n in self.own if (t := turned(n)) is not None]
        indexed = [other for n in self.own for other in relabelled(n)]
        wide = dict.fromkeys([*self.own, *turns, *indexed, *self.reading.names])
        return {node: self._scalar(node) for node in wide}

    def _scalar(self, node: Node) -> Expr | None:
        value = self.value(node)
        return value if isinstance(value, Expr) and value else None

    @cached_property
    def known(self) -> list[tuple[Node, Array]]:
        """Values of the scalars, of those that never vanish."""
        found = []
        for node in (n for n, e in self.vocabulary.items() if e is not None):
            try:
                values = self.tally.of(node).array[0]
            except UNKNOWN:
                continue
            if np.isfinite(values).all() and values.all():
                found.append((node, values))
        return found

    @cached_property
    def products(self) -> Products:
        """Products of these scalars; authors divide by no force, and by no acceleration."""
        return Products(self.known, [node for node, _ in self.known if self.is_strange(node)])

    def is_strange(self, node: Node) -> bool:
        """Whether it is a reaction or an acceleration that the claim does not speak of."""
        value = self.vocabulary.get(node)
        symbol = None if value is None else value.symbol
        if symbol is None or node in self.own:
            return False
        if symbol.name in self.tried.states.equations.components:
            return True
        return symbol.order + (symbol.kind is SymbolKind.SPEED) > 1

    @cached_property
    def figures(self) -> Array:
        """The same values alone: (scalars, states)."""
        return np.array([values for _, values in self.known])

    @cached_property
    def other_vectors(self) -> list[Node]:
        """Vectors of the claim and of the text that do not vanish."""
        named = (n for n, e in self.vocabulary.items() if e is None and isinstance(n, Name | Dots))
        bold = (n for n in named if isinstance(self.value(n), Vector))
        return [n for n in bold if not self._vanishes(n)]

    @cached_property
    def directions(self) -> list[Node]:
        """Unit vectors along which a term may stand."""
        wide = [*self.own, *self.reading.names, _UPRIGHT]
        wide += [other for n in self.own for other in relabelled(n)]
        named = (n for n in wide if isinstance(n, Name) and n.decoration == "hat")
        return [n for n in dict.fromkeys(named) if isinstance(self.value(n), Vector)]

    @cached_property
    def settled(self) -> dict[Node, Expr]:
        """The scalars as they are in these circumstances."""
        known = {node: e for node, e in self.vocabulary.items() if e is not None}
        return {n: value for n, e in known.items() if (value := self._settled(e)) is not None}

    @cached_property
    def plain(self) -> dict[Expr, Node]:
        """How scalars are written, the first of several letters for one."""
        known = reversed(self.settled)
        return {e: node for node in known if (e := self.vocabulary[node]) is not None}

    @cached_property
    def vectors(self) -> StatementTerms:
        """Different vectors a missing term may be formed of, and then their rates."""
        found: dict[Node, Figure] = {}
        for node in dict.fromkeys([*self.own, *self.reading.vectors]):
            if isinstance(node, Name) and isinstance(self.value(node), Vector):
                self._enter(node, found)
        for node in tuple(found):
            self._enter(Derivative(node, Name("t")), found)
        return StatementTerms(tuple((node,) for node in found), together(list(found.values())))

    @cached_property
    def crossed(self) -> StatementTerms:
        """Products of two of these vectors."""
        singles = [nodes[0] for nodes in self.vectors.nodes[:_MOST_VECTORS]]
        first, second = np.triu_indices(len(singles), 1)
        one, other = (Figure(1, self.vectors.figures.array[:, i]) for i in (first, second))
        pairs = tuple((singles[i], singles[j]) for i, j in zip(first, second, strict=True))
        return StatementTerms(pairs, one.cross(other))

    def _enter(self, node: Node, found: dict[Node, Figure]) -> None:
        try:
            figure = self.tally.of(node)
        except UNKNOWN:
            return
        finite = np.isfinite(figure.array).all() and np.abs(figure.array).max() > _CLOSE
        if finite and not any(_alike(figure.array, f.array) for f in found.values()):
            found[node] = figure


def _alike(one: Array, other: Array) -> bool:
    return bool((np.abs(one - other) <= _CLOSE * (1 + np.abs(other))).all())


@dataclass(frozen=True, eq=False)
class StatementTerms:
    """Vectors a formula may lack.

    Attributes:
        nodes: for every one the vectors it is the product of; one or two.
        figures: of all of them, as trials of one.
    """

    nodes: tuple[tuple[Node, ...], ...]
    figures: Figure

    def __len__(self) -> int:
        return len(self.nodes)

    def __getitem__(self, i: int) -> Node:
        return reduce(Cross, self.nodes[i])

"""The ways in which derivatives and Poisson brackets of a text may be taken, as readings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from polhode.judge.latex import _tree as tree
from polhode.judge.meaning._evaluate import RATES, SLOPES, TIME, Evaluator, moving
from polhode.judge.meaning._meaning import BindingError
from polhode.judge.meaning._poisson_bracket import BRACKET, SIGNS
from polhode.judge.meaning._vocabulary import Reading, Vocabulary


def derivative_readings(vocabulary: Vocabulary, pieces: Iterable[tree.Piece]) -> Iterator[Reading]:
    """The ways in which derivatives and Poisson brackets in some pieces of text may be taken."""
    evaluator = Evaluator(vocabulary)
    for piece in pieces:
        for node in tree.walk(piece):
            match node:
                case tree.Derivative(by=by) if _is_unclear(evaluator, node):
                    yield _reading(vocabulary, tree.Differential(by), SLOPES)
                case tree.PoissonBracket():
                    yield _reading(vocabulary, BRACKET, SIGNS)
                case tree.Sum():
                    for rate in _beside_transport(node):
                        yield _reading(vocabulary, rate, RATES)


def _reading(vocabulary: Vocabulary, letter: tree.Node, ways: tuple[str, ...]) -> Reading:
    return Reading(letter, vocabulary.way(letter, ways), vocabulary.allowed.get(letter, ways))


def _is_unclear(evaluator: Evaluator, node: tree.Derivative) -> bool:
    """Whether dE/dθ may be taken along the motion as well as at fixed speeds."""
    if node.partial or node.by == TIME:
        return False
    try:
        variable = evaluator.scalar(node.by).symbol
        varying = {s for s in evaluator.scalar(node.of).symbols() if s.kind.varies}
    except BindingError:
        return False
    return variable is not None and variable in varying and len(varying) > 1


def _beside_transport(node: tree.Sum) -> Iterator[tree.Dots]:
    """The rates in a sum that also has ω × the same vector, as in Euler's equations for **L**."""
    carried = {
        p.right
        for p in node.terms
        if isinstance(p, tree.Cross)
        and isinstance(p.left, tree.Name)
        and p.left.letter in ("omega", "Omega")
    }
    for term in node.terms:
        for piece in tree.walk(term):
            if isinstance(piece, tree.Dots) and piece.of in carried:
                yield moving(piece)

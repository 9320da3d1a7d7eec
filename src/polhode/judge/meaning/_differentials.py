"""Differentials in a formula: dθ = θ̇ dt has one in every term, and L = τ/dt has not.

They are read per unit of time: of an equation between differentials along the motion, such as
dV = mgl sin θ dθ, the quotient by dt says the same. So are variations, of what does not depend on
time itself: the rates of coordinates are then as arbitrary as they are.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from polhode.algebra import Expr, as_symbol, time
from polhode.judge.latex import _tree as tree
from polhode.judge.latex._tree import Name, Node, Number, Relation, Statement, walk
from polhode.judge.meaning._vocabulary import Vocabulary

#: Signs of what is read per unit of time.
VARIATIONS = ("d", "δ")
_TIME = Name("t")
_ZERO = Number("0")


def are_rates(statement: Statement, vocabulary: Vocabulary) -> bool:
    """Whether differentials are read per unit of time.

    They are beside a dt, and where each term has one, of a coordinate or a function of the state;
    others, such as dm and the dF on it, may be elements of a body. Variations are those of
    coordinates and of functions of them.
    """
    found = [p for p in walk(statement) if isinstance(p, tree.Differential)]
    if any(p.of == _TIME for p in found):
        return True
    if len({p.sign for p in found}) != 1 or found[0].sign not in VARIATIONS:
        return False
    if not all(_is_of_state(p, vocabulary) for p in found):
        return False
    relations = (*statement.relations, *statement.conditions, *statement.assumptions)
    try:
        return all(_common(relation.sides) == 1 for relation in relations)
    except ArithmeticError:
        return False


def _is_of_state(node: tree.Differential, vocabulary: Vocabulary) -> bool:
    """Whether it is that of a coordinate, or of a function of coordinates and speeds."""
    value = None if vocabulary.has(node) else vocabulary.find(node.of)
    equations = vocabulary.mechanics.equations
    state = {*equations.coordinates}
    if node.sign == "d":
        state |= {*equations.speeds, *(q.derivative() for q in equations.coordinates)}
    used = value.symbols() if isinstance(value, Expr) else frozenset()
    varying = {s for s in used if s.kind.varies}
    is_fixed = node.sign == "d" or as_symbol(time) not in used
    return bool(varying) and varying <= state and is_fixed


def unequal_differentials(statement: Statement) -> str:
    """A sentence on relations whose terms differ in their number of differentials; else empty.

    Where dt is printed, a differential is read per unit of time, so that dt has the value 1. An
    equation says something only if all of its terms then have the same factor of dt.
    """
    pieces = (p for relation in statement.relations for p in walk(relation))
    if not any(isinstance(p, tree.Differential) and p.of == _TIME for p in pieces):
        return ""
    odd = [i for i, relation in enumerate(statement.relations, 1) if _is_odd(relation)]
    if not odd:
        return ""
    listed = ", ".join(map(str, odd))
    return f"terms with different numbers of differentials in relation {listed}"


def _is_odd(relation: Relation) -> bool:
    try:
        _common(relation.sides)
    except ArithmeticError:
        return True
    return False


def _common(nodes: Iterable[Node]) -> Fraction:
    """The number of differentials in each of some terms; raises `ArithmeticError` if it differs."""
    found = {_count(node) for node in nodes if node != _ZERO}
    if len(found) > 1:
        raise ArithmeticError
    return found.pop() if found else Fraction(0)


def _count(node: Node) -> Fraction:
    match node:
        case tree.Differential(of, sign) if sign in VARIATIONS:
            return 1 + _count(of)
        case tree.Sum(terms):
            return _common(terms)
        case tree.Product(factors):
            return sum(map(_count, factors), Fraction(0))
        case tree.Cross(left, right) | tree.Dot(left, right):
            return _count(left) + _count(right)
        case tree.Quotient(above, below):
            return _count(above) - _count(below)
        case tree.Power(base, Number(text)) if text.isdigit():
            return _count(base) * int(text)
        case tree.Root(of, None):
            return _count(of) / 2
        case tree.Negative(of) | tree.PlusMinus(of) | tree.Magnitude(of) | tree.Derivative(of):
            return _count(of)
    return Fraction(0)

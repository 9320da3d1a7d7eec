"""Claims with one slip: a sign, a factor, a power, sin for cos, a term, an index, a dot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from polhode.judge.latex import Statement
from polhode.judge.latex._tree import Call, Dots, Name, Node, Number, Power, Product, Sum
from polhode.judge.repair._places import NodePosition, negated, places, put, raised, times

_TURNED = {"sin": "cos", "cos": "sin", "tan": "cot", "sinh": "cosh", "cosh": "sinh"}
_AXES = (("1", "2", "3"), ("x", "y", "z"), ("rho", "phi", "z"))


@dataclass(frozen=True)
class Mutant:
    """A statement with one slip.

    Attributes:
        slip: which kind.
        statement: what it says now.
    """

    slip: str
    statement: Statement


def mutants(statement: Statement) -> Iterator[Mutant]:
    """All statements that differ by one slip."""
    for place in places(statement):
        for slip, node in _slips(place):
            yield Mutant(slip, put(statement, place.path, node))


def _slips(place: NodePosition) -> Iterator[tuple[str, Node]]:
    node = place.node
    if place.is_term and node != Number("0"):
        yield "sign", negated(node)
        yield "factor", times(Number("2"), node)
    match node:
        case Number(text) if text.isdigit() and text != "0" and not _is_exponent(place):
            yield "factor", Number(str(int(text) + 1))
        case Power(base, Number(text)) if text.isdigit():
            yield "power", raised(base, int(text) + 1)
            yield "power", raised(base, int(text) - 1)
        case Call(function) if function in _TURNED:
            yield "sin and cos", replace(node, function=_TURNED[function])
        case Sum(terms):
            for i in range(len(terms)):
                rest = (*terms[:i], *terms[i + 1 :])
                yield "term dropped", rest[0] if len(rest) == 1 else Sum(rest)
        case Dots(of, count):
            yield "dot dropped", of if count == 1 else Dots(of, count - 1)
        case Name(subscript=label):
            yield from (("index", replace(node, subscript=o)) for o in _others(label))
            yield from (("index", replace(node, letter=o)) for o in _others(node.letter, node))
            if isinstance(place.parent, Product | Sum) and not node.is_marked_vector:
                yield "power", Power(node, Number("2"))


def _is_exponent(place: NodePosition) -> bool:
    return isinstance(place.parent, Power) and place.parent.exponent == place.node


def _others(label: str, hat: Name | None = None) -> list[str]:
    if hat is not None and hat.decoration != "hat":
        return []
    return [o for axes in _AXES if label in axes for o in axes if o != label]

"""An angle taken from the wrong axis: its sine and cosine exchanged wherever they stand."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.claims.latex._tree import Call, Statement
from polhode.claims.repair._edits import Edit, replaced, turned
from polhode.claims.repair._places import NodePosition, places

_SIZE = 2.0  # of all changes together: one slip, but not a small one


def exchanged(statement: Statement) -> Iterator[tuple[Edit, ...]]:
    """For every angle of which both occur, the changes that exchange them."""
    calls: dict[object, list[NodePosition]] = {}
    for place in places(statement):
        if isinstance(place.node, Call) and place.node.function in ("sin", "cos"):
            calls.setdefault(place.node.argument, []).append(place)
    for alike in calls.values():
        functions = {place.node.function for place in alike if isinstance(place.node, Call)}
        if len(functions) > 1:
            others = [(place, turned(place.node)) for place in alike]
            yield tuple(replaced(p, node, _SIZE / len(alike)) for p, node in others if node)

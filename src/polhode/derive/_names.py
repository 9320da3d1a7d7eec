"""One name for one thing: reactions against one another, and against all other symbols."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

from polhode.algebra import SymbolKind, variables
from polhode.base import DeclarationError
from polhode.derive._balance import Wrench
from polhode.derive._motion import Kinematics
from polhode.model import Body


def refuse_shared_names(motion: Kinematics, demands: Mapping[Body, Wrench]) -> None:
    """Refuse two symbols of one name, and reactions called as another one or as a symbol."""
    owners: dict[str, str] = {}
    for name, element in _components(motion):
        if name in owners:
            raise _shared(name, f"both {owners[name]!r} and {element!r}")
        owners[name] = element
    for first, second in pairwise(_names(demands)):
        if first == second:
            raise DeclarationError(
                f"two different quantities are both called {first!r}",
                expected="one meaning for one name",
                advice="rename one of them",
            )
    for name in _names(demands):
        if name in owners:
            raise _shared(name, f"{owners[name]!r}, and a symbol of the declaration")


def refuse_unknown_coordinates(motion: Kinematics, demands: Mapping[Body, Wrench]) -> None:
    """Refuse coordinates that no body is placed or turned by: nothing tells how they move."""
    wrenches = (c for w in demands.values() for v in (w.force, w.couple) for c in v.components)
    used = variables((*wrenches, *motion.kinematics.values(), *motion.dependent.values()))
    coordinates = {s.base() for s in used if s.kind is SymbolKind.COORDINATE}
    unknown = sorted(s.published for s in coordinates - set(motion.coordinates))
    if unknown:
        raise DeclarationError(
            f"the coordinate {', '.join(unknown)}, by which no body is placed or turned",
            expected=f"one of {', '.join(s.published for s in motion.coordinates)}",
            advice="for a motion that is given, take functions(...) or an expression of time",
        )


def _components(motion: Kinematics) -> Iterator[tuple[str, str]]:
    """Every scalar component with the contact or joint that it is of."""
    for element in motion.elements:
        for restraint in motion.restraints[element.name]:
            yield restraint.name, element.name
        for friction in element.friction(motion.places):
            yield from ((name, element.name) for name, _ in friction.directions)


def _names(demands: Mapping[Body, Wrench]) -> list[str]:
    """Of all symbols that occur, sorted; twice where two different ones share it."""
    wrenches = ((w.force, w.couple) for w in demands.values())
    components = (c for pair in wrenches for vector in pair for c in vector.components)
    return sorted(symbol.published for symbol in variables(components))


def _shared(name: str, owners: str) -> DeclarationError:
    return DeclarationError(
        f"{name}, a reaction of {owners}",
        expected="a name of its own for every reaction component and symbol",
        advice="give one another letter, such as force='G' or torque='sigma', or its body a tag",
    )

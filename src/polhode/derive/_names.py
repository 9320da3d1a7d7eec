"""One name for one thing: reactions against one another, and against all other symbols."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from polhode.algebra import variables
from polhode.base import DeclarationError
from polhode.derive._balance import Wrench
from polhode.derive._motion import Motion
from polhode.model import Body


def refuse_shared_names(motion: Motion, demands: Mapping[Body, Wrench]) -> None:
    """Refuse reaction components that are called as another one, or as a symbol in use."""
    owners: dict[str, str] = {}
    for name, element in _components(motion):
        if name in owners:
            raise _shared(name, f"both {owners[name]!r} and {element!r}")
        owners[name] = element
    for symbol in _symbols(demands):
        if symbol in owners:
            raise _shared(symbol, f"{owners[symbol]!r}, and a symbol of the declaration")


def _components(motion: Motion) -> Iterator[tuple[str, str]]:
    """Every scalar component with the contact or joint that it is of."""
    for element in motion.elements:
        for restraint in motion.restraints[element.name]:
            yield restraint.name, element.name
        for friction in element.friction(motion.places):
            yield from ((name, element.name) for name, _ in friction.directions)


def _symbols(demands: Mapping[Body, Wrench]) -> Iterator[str]:
    for wrench in demands.values():
        used = variables((*wrench.force.components, *wrench.couple.components))
        yield from sorted(symbol.published for symbol in used)


def _shared(name: str, owners: str) -> DeclarationError:
    return DeclarationError(
        f"{name}, a reaction of {owners}",
        expected="a name of its own for every reaction component and symbol",
        advice="give one another letter, such as force='G' or torque='sigma', or its body a tag",
    )

"""A system as it is declared, and with its contacts rolling, without friction, or with friction."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import polhode as ph
from polhode.analyse import Ansatz, invariants
from polhode.base import DeclarationError, NumericError
from polhode.catalogue import CatalogueEntry, Parameter
from polhode.derive import Automaton, Equations, automaton
from polhode.model import Contact, Coulomb, Rolling, Smooth, System, with_elements, with_friction

MU = Parameter("mu", "", "0.3", "coefficient of friction")


@dataclass(frozen=True)
class Variant:
    """A system with its contacts in one way.

    Attributes:
        entry: with mu among its parameters where there is friction.
        system: the declaration.
    """

    entry: CatalogueEntry
    system: System

    @property
    def has_friction(self) -> bool:
        """Whether a contact can slide against friction."""
        return any(isinstance(element, Coulomb) for element in self.system.elements)

    @cached_property
    def modes(self) -> Automaton:
        """Contact modes."""
        return automaton(self.system)

    @property
    def equations(self) -> Equations:
        """Of motion with every contact touching, and sticking where it can."""
        return self.modes.together.equations

    @cached_property
    def watched(self) -> dict[str, ph.Expr]:
        """Energy, momenta and speeds that stay constant, where no friction changes them."""
        if self.has_friction:
            return {}
        try:
            found = invariants(self.equations, Ansatz(0, 0, 0))
        except NumericError:  # a system too large to be solved for its accelerations
            return {}
        return {invariant.name: invariant.expression for invariant in found}


def variant(entry: CatalogueEntry, contact: str) -> Variant:
    """A system with all its contacts of a kind; as declared where none is named.

    Raises:
        DeclarationError: for a kind of contact that is asked of a system without any.
    """
    system = entry.build()
    if contact in ("", declared_contact(system)):
        return Variant(entry, system)
    if not declared_contact(system):
        raise DeclarationError(
            f"{contact} contacts of {entry.name!r}", expected="a system in which something touches"
        )
    if contact == "friction":
        rough = with_friction(system, ph.symbol(MU.name))
        return Variant(replace(entry, parameters=(*entry.parameters, MU)), rough)
    kind = {"rolling": Rolling, "smooth": Smooth}[contact]
    changed = {
        c.name: kind(c.body, on=c.on, name=c.name, force=c.force, restitution=c.restitution)
        for c in _contacts(system)
    }
    return Variant(entry, with_elements(system, dict(changed)))


def declared_contact(system: System) -> str:
    """What the first contact is: rolling, smooth or friction; empty where nothing touches."""
    for contact in _contacts(system):
        if isinstance(contact, Coulomb):
            return "friction"
        return "rolling" if isinstance(contact, Rolling) else "smooth"
    return ""


def _contacts(system: System) -> list[Contact]:
    return [element for element in system.elements if isinstance(element, Contact)]

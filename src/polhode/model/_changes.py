"""The same system with one thing changed."""

from __future__ import annotations

from polhode.algebra import Expr, ExprLike
from polhode.base import DeclarationError
from polhode.model._contacts import Contact, Coulomb
from polhode.model._element import Element
from polhode.model._supports import Sheet
from polhode.model._system import System


def with_elements(system: System, elements: dict[str, Element]) -> System:
    """The same system with other contacts or joints under some of the names."""
    changed = [elements.get(element.name, element) for element in system.elements]
    kept = [Expr.generator(symbol) for symbol in system.independent]
    return System(*system.bodies, *changed, *system.loads, name=system.name, independent=kept)


def with_friction(system: System, mu: ExprLike, mu_static: ExprLike | None = None) -> System:
    """The same system with Coulomb friction at every contact.

    Raises:
        DeclarationError: for a system without a contact, and for impossible coefficients.
    """
    contacts = [element for element in system.elements if isinstance(element, Contact)]
    if not contacts:
        raise DeclarationError(
            f"friction for {system.name!r}, in which nothing touches a support",
            expected="a system with a contact",
            advice="leave out mu, or declare a contact",
        )
    return with_elements(system, {c.name: _rough(c, mu, mu_static) for c in contacts})


def _rough(contact: Contact, mu: ExprLike, mu_static: ExprLike | None) -> Coulomb:
    return Coulomb(
        contact.body,
        on=contact.on,
        mu=mu,
        mu_static=mu_static,
        name=contact.name,
        force=contact.force,
        restitution=contact.restitution,
    )


def with_edge(system: System, edge: ExprLike) -> System:
    """The same system with every sheet ending at an edge (m); beyond lies a table at rest.

    Raises:
        DeclarationError: for a system without a sheet.
    """
    contacts = [
        element
        for element in system.elements
        if isinstance(element, Contact) and isinstance(element.on, Sheet)
    ]
    if not contacts:
        raise DeclarationError(
            f"an edge for {system.name!r}, in which nothing lies on a sheet",
            expected="a system with a contact on a Sheet",
        )
    cut = {c.name: c.on_support(c.on.ending(edge)) for c in contacts if isinstance(c.on, Sheet)}
    return with_elements(system, dict(cut))

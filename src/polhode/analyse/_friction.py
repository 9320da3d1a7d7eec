"""What a contact asks of friction, and where it would open."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, sqrt
from polhode.base import DeclarationError, Shown
from polhode.derive import Equations, equations_only
from polhode.model import Contact


@dataclass(frozen=True)
class ContactForces(Shown):
    """Forces at a contact along true motions.

    Attributes:
        normal: pressing the surfaces together, N; the contact opens where it vanishes.
        tangential: magnitude of the friction force, N.
    """

    normal: Expr
    tangential: Expr

    @property
    def friction_needed(self) -> Expr:
        """The coefficient of friction below which it would slip."""
        return self.tangential / self.normal


def contact_forces(equations: Equations, name: str) -> ContactForces:
    """Normal and friction force of a contact, in terms of coordinates and speeds.

    Raises `DeclarationError` for a joint, which holds on both sides.
    """
    equations_only(equations, "contact forces")
    element = equations.system.element(name)
    if not isinstance(element, Contact):
        raise DeclarationError(
            f"friction needed at {name!r}, which is no contact",
            expected="a Rolling, Smooth or Coulomb contact",
        )
    force = equations.reactions[name].force
    support = element.on
    along = [equations.on_shell(force.dot(support.axes[label])) for label in support.tangents]
    squared = sum((component * component for component in along), ZERO)
    return ContactForces(equations.on_shell(force.dot(support.up)), sqrt(squared))

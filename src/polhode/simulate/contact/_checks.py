"""What contacts are refused for once the numbers are known."""

from __future__ import annotations

from polhode.base import DeclarationError, NumericError
from polhode.derive import Automaton
from polhode.model import Contact, Coulomb
from polhode.simulate.contact._hybrid_system import HybridSystem

_LEAST, _MOST = 1e-9, 1e9  # of friction: beyond, its forces drown in rounding, or drown all else


def can_be_followed(modes: Automaton) -> bool:
    """Whether the forces that tell when contacts change are determined.

    Raises:
        NumericError: where they are not, and friction makes the motion depend on them.
    """
    loose = set(modes.together.equations.undetermined)
    held = [contact for contact in modes.contacts if loose & set(_components(contact))]
    rubbing = [contact.name for contact in held if isinstance(contact, Coulomb)]
    if rubbing:
        raise NumericError(
            f"undetermined forces at {', '.join(rubbing)}, on which friction depends",
            expected="contacts whose normal and friction forces Newton's laws determine",
            advice="declare the contacts Rolling or Smooth, or take one of them away",
        )
    return not held


def _components(contact: Contact) -> list[str]:
    return [contact.component(label) for label in (*contact.on.tangents, contact.on.normal)]


def check_numbers(machine: HybridSystem) -> None:
    """Refuse coefficients that no contact can have.

    Raises:
        DeclarationError: with the contact and the value.
    """
    for contact in machine.automaton.contacts:
        restitution = machine.value(contact.restitution)
        if not 0 <= restitution <= 1:
            raise _impossible("restitution", restitution, contact, "a number from 0 to 1")
        if isinstance(contact, Coulomb):
            _check_friction(machine, contact)


def _check_friction(machine: HybridSystem, contact: Coulomb) -> None:
    kinetic, static = (machine.value(mu) for mu in (contact.mu, contact.mu_static))
    if kinetic < 0:
        raise _impossible("friction coefficient mu", kinetic, contact, "zero or more")
    for what, value in (("mu", kinetic), ("mu_static", static)):
        if value and not _LEAST <= value <= _MOST:
            expected = f"zero, or a number from {_LEAST:g} to {_MOST:g}"
            raise _impossible(f"friction coefficient {what}", value, contact, expected)
    if static < kinetic:
        raise _impossible(
            "friction coefficient mu_static", static, contact, f"no less than mu = {kinetic:g}"
        )


def _impossible(what: str, value: float, contact: Contact, expected: str) -> DeclarationError:
    return DeclarationError(f"{what} = {value:g} of contact {contact.name!r}", expected=expected)

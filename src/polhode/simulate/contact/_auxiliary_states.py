"""States integrated besides coordinates and speeds: work, slips, heights, distances to edges.

The last three follow from the coordinates and speeds, but as differences: near zero nothing but
rounding would be left. As states they keep their relative accuracy, and so do the times of the
events at which they vanish.
"""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, sqrt
from polhode.derive import Automaton, Mode
from polhode.model import ContactLaw, DryFriction, Slipping
from polhode.simulate._dynamics import WORK, Dynamics


def dynamics_of(
    modes: Automaton,
    mode: Mode,
    prescribed: Mapping[Symbol, Expr],
    constants: Mapping[Symbol, float],
) -> Dynamics:
    """The equations of a contact mode with its auxiliary states, and all shared states."""
    auxiliary, meanings = _auxiliary(mode)
    known = dict(mode.embedding)
    # Reactions of open contacts are zero.
    own = mode.equations.reaction_names
    known |= {Symbol(n): ZERO for n in modes.reaction_names if n not in own}
    # Slip velocities of closed contacts follow from the state unless they are integrated.
    for touch, phase in zip(mode.touches, mode.phases, strict=True):
        slips = () if phase.flies else zip(slip_symbols(touch.contact), touch.slip, strict=True)
        known |= {symbol: slip for symbol, slip in slips if symbol not in auxiliary}
    return Dynamics(mode.equations, prescribed, tuple(constants), auxiliary, meanings, known)


def slip_symbols(contact: ContactLaw) -> tuple[Symbol, Symbol]:
    """The slip velocity of a sliding contact."""
    first, second = (
        Symbol(f"slip_{label}_{contact.spelled}", SymbolKind.SPEED) for label in contact.on.tangents
    )
    return first, second


def gap_symbol(contact: ContactLaw) -> Symbol:
    """The height of a body above its support."""
    return Symbol(f"gap_{contact.spelled}", SymbolKind.COORDINATE)


def edge_distance_symbol(contact: ContactLaw) -> Symbol:
    """The distance of a contact to the edge of its support."""
    return Symbol(f"room_{contact.spelled}", SymbolKind.COORDINATE)


def _auxiliary(mode: Mode) -> tuple[dict[Symbol, Expr], dict[Symbol, Expr]]:
    """Rates of the auxiliary states; and slip speed and direction in terms of these."""
    auxiliary: dict[Symbol, Expr] = {WORK: mode.equations.power}
    meanings: dict[Symbol, Expr] = {}
    motion = mode.equations.kinetics
    for touch, phase in zip(mode.touches, mode.phases, strict=True):
        contact = touch.contact
        if phase.flies and not contact.is_beside:
            auxiliary[gap_symbol(contact)] = touch.closing
        elif touch.reserve:
            auxiliary[edge_distance_symbol(contact)] = touch.edge_distance.chain(motion.rate)
        if phase.slides and isinstance(contact, DryFriction):
            element = mode.element(contact)
            if not isinstance(element, Slipping):
                continue
            # The speed and direction of slip in the friction force refer to the integrated slip:
            # with the slip of the rounded state the direction would be arbitrary near zero.
            slips = slip_symbols(contact)
            auxiliary |= {
                s: slip.chain(motion.rate) for s, slip in zip(slips, touch.slip, strict=True)
            }
            along, across = (Expr.generator(s) for s in slips)
            speed = Expr.generator(element.slip_speed)
            meanings[element.slip_speed] = sqrt(along * along + across * across)
            meanings[element.direction[0]] = along / speed
            meanings[element.direction[1]] = across / speed
            meanings[element.slowness] = contact.slowness(speed)
    return auxiliary, meanings

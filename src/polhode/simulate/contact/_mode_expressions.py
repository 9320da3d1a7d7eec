"""Expressions by which contact modes end and follow each other.

`CompiledMode` and `GuardMonitor` evaluate them here; live pages have kernels that do.
"""

from __future__ import annotations

from polhode.algebra import ZERO, Expr, linear_parts
from polhode.derive import Guard, Mode
from polhode.simulate.contact._auxiliary_states import edge_distance_symbol, gap_symbol


def vanishing_expression(guard: Guard, near_flat: float) -> Expr:
    """The expression whose zero ends a mode: for heights and edges, an integrated state.

    Args:
        guard: of the mode.
        near_flat: value at which an expression that must stay positive counts as zero.
    """
    if guard.kind == "touches down" and guard.contact is not None:
        return Expr.generator(gap_symbol(guard.contact))
    if guard.kind == "crosses the edge" and guard.contact is not None:
        return Expr.generator(edge_distance_symbol(guard.contact))
    if guard.ends_before:
        return guard.positive - near_flat
    return guard.positive


def shared_state_of(mode: Mode, separated: Mode) -> list[Expr]:
    """The coordinates and speeds of the mode in which nothing touches, in terms of a mode's."""
    equations, known = separated.equations, mode.embedding
    return [known.get(s, Expr.generator(s)) for s in (*equations.coordinates, *equations.speeds)]


def projection_of(mode: Mode, separated: Mode) -> tuple[list[Expr], list[Expr]]:
    """The shared speeds in a mode, rest + P u: `rest`, and the matrix P row by row."""
    motion = mode.equations.kinetics
    speeds = shared_state_of(mode, separated)[len(separated.equations.coordinates) :]
    parts = [linear_parts(motion.on_speeds(speed), motion.speeds) for speed in speeds]
    return [rest for _, rest in parts], [c for row, _ in parts for c in row]


def contact_forces_of(mode: Mode) -> list[Expr]:
    """Force along the two tangents and the normal of every contact; zero where it is open."""
    components = mode.equations.components
    found: list[Expr] = []
    for touch, phase in zip(mode.touches, mode.phases, strict=True):
        contact = touch.contact
        names = map(contact.component, (*contact.on.tangents, contact.on.normal))
        found += [ZERO if phase.flies else components.get(name, ZERO) for name in names]
    return found


def slip_rates_of(mode: Mode) -> tuple[Expr, ...]:
    """Rates of the slip velocities of all contacts, m/s²."""
    rate = mode.equations.kinetics.rate
    return tuple(slip.chain(rate) for touch in mode.touches for slip in touch.slip)


def closing_rates_of(mode: Mode) -> list[Expr]:
    """Normal acceleration of every contact, m/s²."""
    rate = mode.equations.kinetics.rate
    return [touch.closing.chain(rate) for touch in mode.touches]

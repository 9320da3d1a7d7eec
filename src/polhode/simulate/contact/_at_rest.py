"""Bodies at rest on contacts whose forces Newton's laws leave open, as a ladder on floor and wall.

Where all speeds and their rates vanish and nothing changes with time, bodies stay at rest if the
contacts can hold them: if some of the forces that balance the loads lie within all cones of
friction. Which of these they are stays open, but the motion does not depend on it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from polhode.algebra import Expr, SymbolKind
from polhode.derive import Mode
from polhode.model import DryFriction
from polhode.simulate._open_reactions import null_space
from polhode.simulate.contact._cones import Affine, FrictionCone, can_hold
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.integrate._arrays import Array

_EQUILIBRIUM = 1e-12  # of the largest load: what is left over of the balances is rounding


def rests(hybrid: HybridSystem, entry: ModeState) -> bool | None:
    """Whether the contacts of a mode can hold everything at rest; None where it is not at rest."""
    mode = hybrid.mode(entry.phases)
    if entry.slips:
        return None
    expressions = mode.mode.balances.expressions
    if np.any(np.asarray(entry.speeds) != 0) or any(map(_changes, expressions)):
        return None
    rates = [Expr.generator(s.derivative()) for s in mode.mode.equations.speeds]
    if np.any(mode.function(rates)(entry.state, entry.shared.time, ()) != 0):
        return None
    table = mode.balances(entry.state, entry.shared.time, ())
    names = mode.mode.balances.names
    width = 1 + len(names) + len(mode.mode.balances.pushes)
    table = np.asarray(table, dtype=float).reshape(-1, width)
    required, columns = table[:, 0], table[:, 1 : 1 + len(names)]
    size = np.max(np.abs(required), initial=0.0)
    particular = np.asarray(np.linalg.lstsq(columns, required, rcond=None)[0], dtype=float)
    if np.max(np.abs(columns @ particular - required), initial=0.0) > _EQUILIBRIUM * size:
        return None
    free = null_space(columns)
    cones = [
        FrictionCone(most, *(_affine(particular, free, names, n) for n in (normal, *along)))
        for most, normal, along in _limits(hybrid, mode.mode)
    ]
    scale = float(np.max(np.abs(particular), initial=0.0))
    return can_hold(cones, free.shape[1], scale)


def _changes(expression: Expr) -> bool:
    """Whether it changes with time even at rest."""
    return any(s.kind in (SymbolKind.FUNCTION, SymbolKind.TIME) for s in expression.symbols())


def _limits(hybrid: HybridSystem, mode: Mode) -> Iterator[tuple[float, str, list[str]]]:
    """Of each contact its coefficient, infinite without slip, and the names of its forces."""
    for contact, phase in zip(hybrid.automaton.contacts, mode.phases, strict=True):
        if phase.flies:
            continue
        normal, *along = contact.components
        if isinstance(contact, DryFriction):
            yield float(hybrid.value(contact.mu_static)), normal, along
        else:
            yield np.inf, normal, []


def _affine(particular: Array, free: Array, names: Sequence[str], name: str) -> Affine:
    """A reaction as a constant, and its changes with the free ones."""
    if name not in names:  # of a frictionless contact there is no force along the support
        return 0.0, np.zeros(free.shape[1])
    place = names.index(name)
    return float(particular[place]), free[place]

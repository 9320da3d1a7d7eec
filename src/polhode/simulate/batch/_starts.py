"""Numbers and start values of many motions, and whether there is any doubt about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Matrix, Symbol
from polhode.model import Contact, Coulomb
from polhode.simulate._dynamics import Dynamics
from polhode.simulate.integrate._rows import rows
from polhode.simulate.integrate._stepping import Array

_ROUNDING = 1e-9  # relative, of principal moments that a flat body is at the limit of

Mask = NDArray[np.bool_]


def filled(
    symbols: Sequence[Symbol],
    common: Mapping[Symbol, float],
    columns: Mapping[str, Array],
    count: int,
) -> dict[Symbol, Array]:
    """Values of symbols for every motion: what differs, what is common, or zero."""
    return {
        s: np.asarray(columns.get(s.published, np.full(count, common.get(s, 0.0))), dtype=float)
        for s in symbols
    }


@dataclass(frozen=True)
class BatchStart:
    """Many motions at time 0.

    Attributes:
        dynamics: the equations of the mode in which they start.
        states: by symbol, shape (motions,).
        constants: of all parameters, likewise.
        contacts: whose coefficients count.
    """

    dynamics: Dynamics
    states: Mapping[Symbol, Array]
    constants: Mapping[Symbol, Array]
    contacts: Sequence[Contact]

    @property
    def _count(self) -> int:
        return len(next(iter((*self.states.values(), *self.constants.values()))))

    def possible(self) -> Mask:
        """Numbers that bodies and contacts can have."""
        fine = np.ones(self._count, dtype=bool)
        for symbol, values in self.constants.items():
            fine &= np.isfinite(values) & ((values > 0) | (not symbol.positive))
        for body in getattr(self.dynamics.equations.system, "bodies", ()):
            fine &= self._values([body.mass])[0] > 0
            first, second, third = self._moments(body.inertia, fine).T
            fine &= (first >= 0) & (first + second >= third * (1 - _ROUNDING))
        for contact in self.contacts:
            (restitution,) = self._values([contact.restitution])
            fine &= (restitution >= 0) & (restitution <= 1)
            if isinstance(contact, Coulomb):
                kinetic, static = self._values([contact.mu, contact.mu_static])
                fine &= (kinetic >= 0) & (static >= kinetic)
        return fine

    def regular(self) -> Mask:
        """Starts from which all rates are finite, with a positive definite mass matrix."""
        fine = np.all(np.isfinite(self._values(self.dynamics.rates)), axis=0)
        mass = self.dynamics.equations.mass
        if mass == mass.T:
            fine &= self._moments(mass, fine)[:, 0] > 0
        return np.asarray(fine)

    def _moments(self, matrix: Matrix, fine: Mask) -> Array:
        """Eigenvalues of a symmetric matrix for every motion, rising; shape (motions, size)."""
        size = len(matrix.rows)
        entries = self._values([e for row in matrix.rows for e in row])
        usual = np.where(fine & np.all(np.isfinite(entries), axis=0), entries, _unit(size)).T
        return np.asarray(np.linalg.eigvalsh(usual.reshape(-1, size, size)))

    def _values(self, expressions: Sequence[Expr]) -> Array:
        """Shape (expressions, motions)."""
        states = [self.states[s] for s in self.dynamics.states]
        constants = [self.constants[s] for s in self.dynamics.parameters]
        with np.errstate(all="ignore"):
            found = self.dynamics.function(expressions)(*states, *constants, 0.0)
        values: Array = rows(found, self._count)
        return values


def _unit(size: int) -> Array:
    return np.eye(size).reshape(-1, 1)

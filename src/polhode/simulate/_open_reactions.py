"""Reactions of a system in which Newton's laws leave some of them open, at single instants.

Which are determined nevertheless is seen from the balances of the bodies: those that no change of
the reactions which the bodies do not feel changes. Normal forces that are open, as of a box on
four corners, are shared by the law that the system names.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.derive import BalanceTable
from polhode.simulate.integrate._arrays import Array

_INDEPENDENT = 1e-10  # of the largest singular value: smaller ones are rounding
_SAME = 1e-9  # of a reaction: changes that are smaller are none


@dataclass(frozen=True)
class OpenReactions:
    """Reactions at one instant: those of least size, and their changes that the bodies do not feel.

    Attributes:
        values: shape (reactions,).
        free: shape (reactions, changes).
    """

    values: Array
    free: Array

    def are_determined(self, places: int | list[int]) -> bool:
        """Whether the reactions at some places are the same in all choices."""
        return bool(np.max(np.abs(self.free[places]), initial=0.0) <= _SAME)


def open_reactions(table: BalanceTable, values: Array, *, is_shared: bool) -> OpenReactions:
    """The reactions that balance.

    Args:
        table: the balances.
        values: of its expressions.
        is_shared: whether equally stiff supports share what is open of normal forces.
    """
    count, pushes = len(table.names), list(table.pushes)
    rows = np.asarray(values, dtype=float).reshape(-1, 1 + count + len(pushes))
    required, columns = rows[:, 0], rows[:, 1 : 1 + count]
    if is_shared:
        # perpendicular to all normal forces that the bodies do not feel: equal stiffness
        unfelt = null_space(rows[:, 1 + count :])
        law = np.zeros((unfelt.shape[1], count))
        law[:, pushes] = unfelt.T * np.max(np.abs(columns), initial=0.0)
        required, columns = np.append(required, np.zeros(len(law))), np.vstack([columns, law])
    least = np.linalg.lstsq(columns, required, rcond=_INDEPENDENT)[0]
    return OpenReactions(np.asarray(least, dtype=float), null_space(columns))


def null_space(columns: Array) -> Array:
    """Changes of the unknowns that the equations do not feel, shape (unknowns, changes)."""
    _, sizes, rows = np.linalg.svd(columns)
    rank = int(np.sum(sizes > _INDEPENDENT * np.max(sizes, initial=0.0)))
    return np.asarray(rows[rank:].T)

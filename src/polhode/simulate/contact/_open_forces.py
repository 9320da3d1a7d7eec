"""Contacts at which Newton's laws leave forces open, though not the motion.

Of the two corners over which a box tips, only the sum of the forces of friction along the line
between them is determined; whether they stick is nevertheless. The friction that given normal
forces allow is a convex set, and of all slips it opposes that of most power: what it can hold
stays (S. Goyal, A. Ruina and J. Papadopoulos, Wear 143, 1991). Normal forces that are open, as of
a box on four corners, are shared by the law that the system names, or the mode is not followed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from polhode.algebra import ONE
from polhode.base import bisected
from polhode.derive import BalanceTable, Guard, Mode
from polhode.model import ContactLaw, DryFriction
from polhode.simulate._open_reactions import OpenReactions, open_reactions
from polhode.simulate.contact._cones import FrictionCone, can_hold, strained
from polhode.simulate.integrate._arrays import Array

_SAME = 1e-9  # of a reaction: changes that are smaller are none
_PULLS = 1e-10  # of the largest force: less than this is rounding of a contact that opens
_LEAST = 1e-12  # of the largest limit: contacts with less carry nothing
_LOOKS = 8  # in every step of an integration


@dataclass(frozen=True)
class GivesWay(Guard):
    """Ends a mode where a contact would have to pull, or several can no longer stick.

    Attributes:
        places: those that can no longer stick, by their places in the declaration.
    """

    places: frozenset[int] = frozenset()


class OpenForces:
    """The contacts of a mode that touch, if some of their forces are open.

    Args:
        mode: the mode.
        contacts: of the automaton.
    """

    def __init__(self, mode: Mode, contacts: Sequence[ContactLaw]) -> None:
        self._mode = mode
        self._contacts = contacts
        self._touching = [i for i, phase in enumerate(mode.phases) if not phase.flies]
        self._sticking = [
            i
            for i in self._touching
            if mode.phases[i].rolls and isinstance(contacts[i], DryFriction)
        ]

    @cached_property
    def table(self) -> BalanceTable:
        """The balances, in whose values the forces are found."""
        return self._mode.balances

    def are_decided(self, values: Array) -> bool:
        """Whether the normal forces are determined, so that it is known what sticks.

        Args:
            values: of the expressions of the table.
        """
        forces = self._forces(values)
        if any(self._contacts[i].is_beside for i in self._touching):
            return False
        normal = [self._reaction(i, self._contacts[i].on.normal) for i in self._touching]
        return forces.are_determined(normal)

    def objection(self, values: Array, coefficients: Sequence[float]) -> str | None:
        """Why the contacts cannot exert the forces they need; None if they can.

        Args:
            coefficients: of static friction, of all contacts.
        """
        forces = self._forces(values)
        if pulling := self._pulling(forces, _PULLS):
            return f"{self._mode.name} would need {self._contacts[min(pulling)].name} to pull"
        if self._stick(forces, coefficients):
            return None
        names = ", ".join(self._contacts[i].name for i in self._sticking)
        return f"{self._mode.name} would need more friction than {names} have"

    def first_failure(
        self, values: Callable[[Array], Array], knots: Array, coefficients: Sequence[float]
    ) -> tuple[float, Guard] | None:
        """The last place at which the contacts hold, and what ends it; None where all hold.

        Args:
            values: of the expressions of the table, shape (expressions, places).
            knots: the places between which everything is smooth.
        """
        shares = np.arange(_LOOKS) / _LOOKS
        places = np.append((knots[:-1, None] + np.diff(knots)[:, None] * shares).ravel(), knots[-1])
        tables = values(places).T
        failing = (k for k, t in enumerate(tables) if self.objection(t, coefficients))
        if (first := next(failing, None)) is None:
            return None
        before, after = float(places[max(first - 1, 0)]), float(places[first])

        def held(place: float) -> float:
            return -1.0 if self.objection(values(np.array([place]))[:, 0], coefficients) else 1.0

        last = before if first == 0 else bisected(held, before, after)
        while held(last) < 0 and last > before:  # the end of the bracket on which they hold
            last = float(np.nextafter(last, -np.inf))
        return last, self._guard(self._forces(values(np.array([last]))[:, 0]), coefficients)

    def _guard(self, forces: OpenReactions, coefficients: Sequence[float]) -> Guard:
        """What happens where the contacts are at a limit."""
        if pulling := self._pulling(forces, -_SAME):
            return GivesWay(self._contacts[min(pulling)], "lifts off", ONE)
        cones, scale = self._cones(forces, coefficients)
        slipping = [self._sticking[k] for k in strained(cones, forces.free.shape[1], scale)]
        return GivesWay(self._contacts[slipping[0]], "slips", ONE, frozenset(slipping))

    # -- at one instant ----------------------------------------------------------------------------

    def _forces(self, values: Array) -> OpenReactions:
        is_shared = bool(self._mode.equations.system.sharing)
        return open_reactions(self.table, values, is_shared=is_shared)

    def _reaction(self, i: int, label: str) -> int:
        return self.table.names.index(self._contacts[i].component(label))

    def _pulling(self, forces: OpenReactions, share: float) -> list[int]:
        """The contacts whose normal force is below zero by a share of the largest force."""
        least = -share * np.max(np.abs(forces.values), initial=0.0)
        normal = {i: self._reaction(i, self._contacts[i].on.normal) for i in self._touching}
        return [i for i, j in normal.items() if forces.values[j] < least]

    def _stick(self, forces: OpenReactions, coefficients: Sequence[float]) -> bool:
        cones, scale = self._cones(forces, coefficients)
        return can_hold(cones, forces.free.shape[1], scale)

    def _cones(
        self, forces: OpenReactions, coefficients: Sequence[float]
    ) -> tuple[list[FrictionCone], float]:
        """The discs of friction, and the size of the forces.

        Friction in proportion to the limits, as far as that balances, is where to begin: it is
        right where nothing turns.
        """
        normal = [self._reaction(i, self._contacts[i].on.normal) for i in self._sticking]
        places = [
            [self._reaction(i, label) for label in self._contacts[i].on.tangents]
            for i in self._sticking
        ]
        most = np.array([coefficients[i] for i in self._sticking])
        limits = most * np.maximum(forces.values[normal], 0.0)
        along, slopes = forces.values[places], forces.free[places]
        weights = 1 / np.sqrt(np.maximum(limits, _LEAST * np.max(limits, initial=1.0)))
        weighted = (slopes * weights[:, None, None]).reshape(-1, slopes.shape[-1])
        first = np.linalg.lstsq(weighted, -(along * weights[:, None]).ravel(), rcond=None)[0]
        along, fixed = along + slopes @ first, np.zeros(slopes.shape[-1])
        cones = [
            FrictionCone(1.0, (limit, fixed), *zip(force.tolist(), changes, strict=True))
            for limit, force, changes in zip(limits.tolist(), along, slopes, strict=True)
        ]
        return cones, float(max(np.max(limits, initial=0.0), np.max(np.abs(along), initial=0.0)))

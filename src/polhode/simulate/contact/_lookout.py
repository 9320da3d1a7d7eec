"""Where a stretch of a motion ends, since a guard of its contact mode falls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from polhode.algebra import Expr
from polhode.base import NumericError
from polhode.derive import Guard
from polhode.simulate._dynamics import CLOCK
from polhode.simulate._segment import Part
from polhode.simulate.contact._machine import Machine, ModeMachine, gap_symbol
from polhode.simulate.contact._rise import Rise
from polhode.simulate.contact._settle import Entry, painleve
from polhode.simulate.contact._touching import Meeting
from polhode.simulate.contact._transition import beyond, index_of
from polhode.simulate.integrate._crossing import first_fall
from polhode.simulate.integrate._driver import Stop, stuck
from polhode.simulate.integrate._integrators import Array
from polhode.simulate.integrate._rows import rows

_JAMMED = 1e-6  # of what sliding has in reserve before it jams: as good as none


@dataclass(frozen=True)
class Lookout:
    """Looks at the guards of a mode along a stretch of the motion.

    Attributes:
        machine: the modes.
        near_flat: value at which an expression that must stay positive counts as gone.
        mode: the one that the motion is in.
        entry: where it was entered.
    """

    machine: Machine
    near_flat: float
    mode: ModeMachine
    entry: Entry

    @cached_property
    def meetings(self) -> list[Meeting]:
        """What meets where the mode is entered."""
        return self.machine.touching.at(self.entry.place, beyond(self.entry.phases))

    def cut(self, part: Part) -> tuple[Part, Guard | None]:
        """The part up to the first guard that falls, and that guard."""
        solution, mode = part.solution, self.mode
        watched = [g for g in mode.mode.guards if g.kind != "sticks"]
        jams = mode.can_jam
        fall = None
        if watched or jams:
            values = self._values(part, watched)
            fall = first_fall(values, solution.steps)
        if fall is not None:
            if fall.guard == len(watched):
                raise painleve(", ".join(e.name for e in mode.sliding), fall.time)
            return replace(part, end=fall.time), watched[fall.guard]
        if solution.stop is Stop.STUCK:
            raise self._jammed(part) or stuck(solution)
        return part, self._landing(part)

    def _jammed(self, part: Part) -> NumericError | None:
        """Where a part ends because forces grow beyond all bounds: Painlevé's paradox, if it is."""
        if not self.mode.can_jam:
            return None
        reserves = self._values(part, [])(part.solution.steps)[-1]
        if reserves[-1] > _JAMMED * np.max(reserves):
            return None
        return painleve(", ".join(e.name for e in self.mode.sliding), part.end)

    def _values(self, part: Part, watched: list[Guard]) -> Callable[[Array], Array]:
        """Values of the guards, and how far sliding is from jamming."""
        mode = self.mode
        expressions = [self._looked_at(guard) for guard in watched]
        size = len(mode.mode.equations.speeds)
        masses = [e for row in mode.mode.equations.mass.rows for e in row] if mode.can_jam else []
        arguments = (*part.solution.symbols, *mode.dynamics.parameters, CLOCK)
        wanted = [*expressions, *masses]
        function = mode.dynamics.function(wanted, arguments, part.solution.turned)
        leaving = self._leaving(watched)

        def looked(times: Array) -> Array:
            with np.errstate(all="ignore"):
                found = function(*part.solution.at(times), *part.constants, times)
            values: Array = rows(found, len(times))
            for k, rise in leaving.items():
                values[k] = rise.mean(values[k], times)
            own = values[: len(expressions)]
            if not mode.can_jam:
                return own
            matrices = values[len(expressions) :].T.reshape(-1, size, size)
            return np.vstack([own, np.linalg.det(matrices)])

        return looked

    def _leaving(self, watched: list[Guard]) -> dict[int, Rise]:
        """The guards of contacts that have just opened, and how these rise."""
        found, entry = {}, self.entry
        for k, guard in enumerate(watched):
            i = index_of(guard, self.machine)
            if guard.kind == "touches down" and entry.gaps.get(i) == 0.0:
                meeting = self.meetings[i]
                found[k] = Rise(entry.place.time, float(meeting.velocity[2]), meeting.scale)
        return found

    def _looked_at(self, guard: Guard) -> Expr:
        if guard.kind == "touches down" and guard.contact is not None:
            return Expr.generator(gap_symbol(guard.contact))
        if guard.kind == "near-flat":
            return guard.positive - self.near_flat
        return guard.positive

    def _landing(self, part: Part) -> Guard | None:
        """The contact whose slip velocity vanishes at the end of a part."""
        if part.solution.vanished is None:
            return None
        i = sorted(self.entry.slips)[part.solution.vanished]
        name = self.machine.automaton.contacts[i].name
        return next(
            g
            for g in self.mode.mode.guards
            if g.kind == "sticks" and g.contact and g.contact.name == name
        )

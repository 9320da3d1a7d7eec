"""Many motions at once, through their contact modes.

Only what cannot go wrong is done here: a motion about which there is any doubt is left to be
followed by itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol
from polhode.derive import Automaton
from polhode.simulate._dynamics import EquationsOfMotion
from polhode.simulate._names import Name, by_name, published
from polhode.simulate._values import read_values
from polhode.simulate.batch._batch_results import BatchResults
from polhode.simulate.batch._batch_system import BatchSystem, Plan, all_modes, one_mode
from polhode.simulate.batch._mode_batch import Group, Starts
from polhode.simulate.batch._starts import BatchStart, filled
from polhode.simulate.contact._checks import can_be_followed
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._stepping import Array


@dataclass(frozen=True)
class BatchSolution:
    """Many motions.

    Attributes:
        kept: which of them are complete; the others are to be followed by themselves.
        seen: where they were, and what happened to them.
    """

    kept: NDArray[np.bool_]
    seen: BatchResults


class SingleModeBatch:
    """Many motions of one system at once.

    Args:
        subject: what is followed.
        start: SI start values of one motion, where all of them are states of the first mode.
    """

    def __init__(self, subject: BatchSystem, start: Mapping[Symbol, float] | None) -> None:
        self._subject = subject
        self._start = start

    @property
    def keeps_to_one_mode(self) -> bool:
        """Whether nobody looks after the contacts."""
        return not self._subject.contacts

    def follow(
        self,
        count: int,
        columns: Mapping[str, Array],
        times: Array,
        starts: Starts,
    ) -> BatchSolution:
        """All motions together.

        Args:
            count: of motions.
            columns: SI values of what differs, by published name, shape (motions,).
            times: of the looks, s, increasing from 0 to the duration.
            starts: start values of one motion, as `simulate` takes them.
        """
        subject, dynamics = self._subject, self._subject.dynamics
        constants = filled(tuple(subject.numbers), subject.numbers, columns, count)
        states = filled(dynamics.states, self._start or {}, columns, count)
        at_once = subject.stretches.from_then(np.zeros(count))
        begun = BatchStart(dynamics, states, constants | at_once, subject.contacts)
        possible = begun.possible()
        usual = possible & begun.regular() & (self._start is not None)
        first = subject.stay(subject.phases).mode
        sightings = BatchResults.of(count, times, constants, subject.stretches, first)
        company = subject.company(sightings, starts)
        company.together(subject.phases, _group(np.flatnonzero(usual), states))
        for row in np.flatnonzero(possible & ~usual).tolist():
            company.start(row)
        company.run()
        possible[sorted(company.lost)] = False
        return BatchSolution(possible, company.sightings)


def _group(rows: NDArray[np.intp], states: Mapping[Symbol, Array]) -> Group:
    """Motions at their start."""
    rest = np.zeros(len(rows))
    own = {s: values[rows] for s, values in states.items()}
    return Group(rows, rest, own, rest, [None] * len(rows), [0] * len(rows))


def abreast(subject: Automaton | EquationsOfMotion, plan: Plan) -> SingleModeBatch | None:
    """A system for many motions; None where they cannot be followed at once.

    Raises:
        DeclarationError: for numbers that are not known, missing or impossible.
    """
    integrator = chosen()
    if integrator.name != "heyoka":
        return None
    if isinstance(subject, Automaton) and not (subject.contacts and can_be_followed(subject)):
        subject = subject.together.equations
    found: BatchSystem | None
    if isinstance(subject, Automaton):
        found = all_modes(subject, plan, integrator)
    else:
        found = one_mode(subject, plan)
    if found is None or found.dynamics.undecided:
        return None  # absolute values are followed from side to side, one motion by itself
    names = by_name(found.dynamics.states)
    start: dict[Name, Any] = {published(name): value for name, value in plan.start.items()}
    if not start.keys() <= names.keys():
        return SingleModeBatch(found, None)
    dimensions = getattr(found.dynamics.equations, "dimensions", {})
    values = read_values(start, names, "state of this mode", dimensions, found.numbers)
    return SingleModeBatch(found, values)

"""Some members of an ensemble, followed one after the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.base import DeclarationError, PolhodeError
from polhode.derive import Automaton, Equations, automaton, derive
from polhode.model import System
from polhode.simulate import NEAR_FLAT, Experiment, refuse_doubt
from polhode.simulate.batch import Plan, SingleModeBatch, abreast
from polhode.study._columns import Array, Members
from polhode.study._event_outputs import OF_EVENTS
from polhode.study._motions import Motions
from polhode.study._output import CodeTable, Quick, legend_of
from polhode.study._outputs import Outputs
from polhode.study._reasons import Reason, reason_of, told

_FEW = 8  # members that are followed one by one before lanes for them are compiled
MOST_TOLD = 1000
"""Failures of a block that are kept in words; of further ones the code alone."""

Subject: TypeAlias = System | Automaton | Equations
Tick: TypeAlias = Callable[[int], None]


@dataclass(frozen=True)
class EnsembleSpec:
    """What is asked of every member.

    Attributes:
        subject: the system, its automaton, or equations derived from it.
        duration: s, or text with a unit.
        outputs: what is kept.
        options: of `simulate`: forcing, tolerance, near_flat, events.
    """

    subject: Subject
    duration: Any
    outputs: Outputs
    options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.subject, System | Automaton | Equations):
            raise DeclarationError(
                f"{self.subject!r} to be followed"[:200],
                expected="a System, its automaton, or equations derived from it",
            )

    def __reduce__(self) -> tuple[Any, ...]:
        # Worker processes derive again: declarations are small, equations are not.
        kept = isinstance(self.subject, Equations)
        system = self.subject if isinstance(self.subject, System) else self.subject.system
        return _received, (system, kept, self.duration, dict(self.outputs), dict(self.options))

    @cached_property
    def derived(self) -> Automaton | Equations:
        """The system with its contact modes, derived as they are needed."""
        return automaton(self.subject) if isinstance(self.subject, System) else self.subject

    @cached_property
    def legend(self) -> CodeTable:
        """What the codes among the outputs stand for."""
        return legend_of(self.derived, tuple(self.options.get("events") or ()))

    def experiment(self) -> Experiment:
        """The system, set up to be run."""
        return Experiment(self.derived, self.duration, samples=2, **self.options)


def options_of(**given: Any) -> dict[str, Any]:
    """Options of `simulate` that are given; one event alone stands for itself."""
    until = given.get("until")
    named = {**given, "until": (until,) if isinstance(until, str) else until}
    return {name: value for name, value in named.items() if value is not None}


def _received(
    system: System, kept: bool, duration: Any, outputs: Outputs, options: Mapping[str, Any]
) -> EnsembleSpec:
    return EnsembleSpec(derive(system) if kept else system, duration, outputs, options)


@dataclass(frozen=True)
class ResultChunk:
    """What came of some members.

    Attributes:
        values: by output, shape (members, *shape of the output); not-a-number, and -1 for codes,
            where there is no result.
        reason: a `Reason` per member.
        told: why members failed, in words, by their place.
    """

    values: Mapping[str, Array]
    reason: NDArray[np.int8]
    told: Mapping[int, str]

    @classmethod
    def empty(cls, order: EnsembleSpec, count: int) -> ResultChunk:
        """Of members none of which has been followed yet."""
        values = {
            name: np.full((count, *output.shape), -1.0 if output.labels(order.legend) else np.nan)
            for name, output in order.outputs.items()
        }
        return cls(values, np.full(count, Reason.NOT_YET, dtype=np.int8), {})

    def put(self, rows: NDArray[np.intp], part: ResultChunk) -> ResultChunk:
        """The block with the results of some of its members put in their places."""
        for name, values in part.values.items():
            self.values[name][rows] = values
        self.reason[rows] = part.reason
        words = {int(rows[i]): text for i, text in part.told.items()}
        kept = dict(sorted({**self.told, **words}.items())[:MOST_TOLD])
        return ResultChunk(self.values, self.reason, kept)


class EnsembleRunner:
    """Follows members, compiled for the first of them. Not to be shared by threads."""

    def __init__(self, order: EnsembleSpec) -> None:
        self._order = order
        self._experiment = order.experiment()
        self._together = BatchRunner(order)

    def follow(self, members: Members, tick: Tick) -> ResultChunk:
        """Follow many members at once as far as that goes, and the others by themselves.

        Args:
            tick: told the number of members that are done.
        """
        block = ResultChunk.empty(self._order, members.count)
        alone = self._together.follow(members, block, tick)
        return block.put(alone, self._one_by_one(members.rows(alone), tick))

    def _one_by_one(self, members: Members, tick: Tick) -> ResultChunk:
        """One that fails does not stop the rest."""
        order, experiment = self._order, self._experiment
        block = ResultChunk.empty(order, members.count)
        words: dict[int, str] = {}
        for i in range(members.count):
            try:
                run = experiment.run(members.parameters_of(i), members.start_of(i))
                refuse_doubt(run)
                found = {name: o.of(run, order.legend) for name, o in order.outputs.items()}
            except Exception as error:  # whatever it is, it is this member's alone
                block.reason[i] = reason_of(error)
                if len(words) < MOST_TOLD:
                    words[i] = told(error)
            else:
                block.reason[i] = Reason.DONE
                for name, values in found.items():
                    block.values[name][i] = values
            tick(1)
        return ResultChunk(block.values, block.reason, words)


class BatchRunner:
    """Members integrated side by side, where outputs and numbers allow it."""

    def __init__(self, order: EnsembleSpec) -> None:
        self._order = order
        quick = {n: o for n, o in order.outputs.items() if isinstance(o, Quick)}
        self._outputs = quick if len(quick) == len(order.outputs) else {}
        self._mode: SingleModeBatch | None = None
        self._tried = False

    def follow(self, members: Members, block: ResultChunk, tick: Tick) -> NDArray[np.intp]:
        """Put results of members into a block; returns those that are left."""
        everybody = np.arange(members.count)
        columns = members.si_columns()
        if not self._outputs or columns is None or members.count < _FEW:
            return everybody
        if not self._tried:
            self._mode, self._tried = self._prepared(members), True
        if self._mode is None:
            return everybody
        times = self._times()
        flights = self._mode.follow(members.count, columns, times, members.start_of)
        motions = Motions(flights.seen)
        for name, output in self._outputs.items():
            values = output.of_many(motions, self._order.legend)
            block.values[name][flights.kept] = values[flights.kept]
        block.reason[flights.kept] = Reason.DONE
        tick(int(np.sum(flights.kept)))
        return everybody[~flights.kept]

    def _prepared(self, members: Members) -> SingleModeBatch | None:
        order, options = self._order, dict(self._order.options)
        if options.get("events") or members.has_expressions:
            return None
        plan = Plan(
            parameters=members.parameters_of(0),
            start=members.start_of(0),
            duration=order.experiment().duration,
            forcing=options.get("forcing") or {},
            tolerance=options.get("tolerance"),
            near_flat=options.get("near_flat", NEAR_FLAT),
            until=options.get("until") or (),
            quantities=[q for output in self._outputs.values() for q in output.reads],
        )
        try:
            mode = abreast(order.derived, plan)
        except PolhodeError:
            return None  # it is told member by member
        events = any(isinstance(output, OF_EVENTS) for output in self._outputs.values())
        return None if mode is not None and mode.keeps_to_one_mode and events else mode

    def _times(self) -> Array:
        """Start, times of series, and end, s."""
        end = self._order.experiment().duration
        asked = {t for output in self._outputs.values() for t in output.looks if 0 < t < end}
        return np.array([0.0, *sorted(asked), end])


def _nobody(count: int) -> None:
    """Is told nothing."""

"""Members of an ensemble, simulated as a batch where possible and one by one otherwise."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.base import DeclarationError, PolhodeError
from polhode.derive import Automaton, Equations, automaton, derive
from polhode.model import System
from polhode.simulate import NEAR_FLAT, Experiment, refuse_doubt
from polhode.simulate.batch import Plan, SingleModeBatch, batch_of
from polhode.study._columns import Array, Members
from polhode.study._output import CodeTable, Motions, Quick, legend_of
from polhode.study._outputs import OF_EVENTS, Outputs

_FEW = 8  # with fewer members, compiling a batch costs more than it saves
MOST_FAILURES = 1000
"""Failures per chunk whose message is kept; further ones keep only the code."""

Subject: TypeAlias = System | Automaton | Equations
Tick: TypeAlias = Callable[[int], None]


class Reason(IntEnum):
    """Why a member has no result, as stores keep it.

    DONE: it has one; it was simulated to its end, which may come early, as for a disk falling flat.
    """

    DONE = 0
    DECLARATION = 1
    CONSTRAINT = 2
    UNIT = 3
    PARSE = 4
    NUMERIC = 5
    STORE = 6
    UNFORESEEN = 7
    NOT_YET = -1


def reason_of(error: Exception) -> Reason:
    """The code of an error, that of its class: NUMERIC of a `NumericError`."""
    kind = type(error).__name__.removesuffix("Error").upper()
    known = isinstance(error, PolhodeError) and kind in Reason.__members__
    return Reason[kind] if known else Reason.UNFORESEEN


def in_words(error: Exception) -> str:
    """An error in words."""
    return str(error) if isinstance(error, PolhodeError) else f"{type(error).__name__}: {error}"


@dataclass(frozen=True)
class EnsembleSpec:
    """The motions of an ensemble and the outputs kept of each.

    Attributes:
        subject: the system, its automaton, or equations derived from it.
        duration: s, or text with a unit.
        outputs: by name.
        options: of `simulate`: forcing, tolerance, near_flat, events.
    """

    subject: Subject
    duration: Any
    outputs: Outputs
    options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not isinstance(self.subject, System | Automaton | Equations):
            raise DeclarationError(
                f"{self.subject!r} to be simulated"[:200],
                expected="a System, its automaton, or equations derived from it",
            )

    def __reduce__(self) -> tuple[Any, ...]:
        # Worker processes derive the equations again: a declaration is small, equations are not.
        in_one_mode = isinstance(self.subject, Equations)
        system = self.subject if isinstance(self.subject, System) else self.subject.system
        given = (system, in_one_mode, self.duration, dict(self.outputs), dict(self.options))
        return _derived_again, given

    @cached_property
    def derived(self) -> Automaton | Equations:
        """The system with its contact modes, derived as they are needed."""
        return automaton(self.subject) if isinstance(self.subject, System) else self.subject

    @cached_property
    def legend(self) -> CodeTable:
        """Meanings of the codes among the outputs."""
        return legend_of(self.derived, tuple(self.options.get("events") or ()))

    def experiment(self) -> Experiment:
        """The system, ready to be simulated."""
        return Experiment(self.derived, self.duration, samples=2, **self.options)


def options_of(**given: Any) -> dict[str, Any]:
    """The options of `simulate` that are not None; `until` may be a single event."""
    until = given.get("until")
    named = {**given, "until": (until,) if isinstance(until, str) else until}
    return {name: value for name, value in named.items() if value is not None}


def _derived_again(
    system: System, in_one_mode: bool, duration: Any, outputs: Outputs, options: Mapping[str, Any]
) -> EnsembleSpec:
    return EnsembleSpec(derive(system) if in_one_mode else system, duration, outputs, options)


@dataclass(frozen=True)
class ResultChunk:
    """Results of some members.

    Attributes:
        values: by output, shape (members, *shape of the output); not-a-number, and -1 for codes,
            where there is no result.
        reason: a `Reason` per member.
        failures: why members failed, in words, by their index.
    """

    values: Mapping[str, Array]
    reason: NDArray[np.int8]
    failures: Mapping[int, str]

    @classmethod
    def empty(cls, spec: EnsembleSpec, count: int) -> ResultChunk:
        """Results before any member is simulated."""
        values = {
            name: np.full((count, *output.shape), -1.0 if output.labels(spec.legend) else np.nan)
            for name, output in spec.outputs.items()
        }
        return cls(values, np.full(count, Reason.NOT_YET, dtype=np.int8), {})

    def put(self, rows: NDArray[np.intp], part: ResultChunk) -> ResultChunk:
        """These results with those of some of the members filled in."""
        for name, values in part.values.items():
            self.values[name][rows] = values
        self.reason[rows] = part.reason
        words = {int(rows[i]): text for i, text in part.failures.items()}
        kept = dict(sorted({**self.failures, **words}.items())[:MOST_FAILURES])
        return ResultChunk(self.values, self.reason, kept)


class EnsembleRunner:
    """Simulates members; compiles the equations for the first of them. Not thread-safe."""

    def __init__(self, spec: EnsembleSpec) -> None:
        self._spec = spec
        self._experiment = spec.experiment()
        self._batch = BatchRunner(spec)

    def follow(self, members: Members, tick: Tick) -> ResultChunk:
        """Simulate members in a batch as far as possible, and the others one by one.

        Args:
            tick: called with the number of members that have just been completed.
        """
        results = ResultChunk.empty(self._spec, members.count)
        remaining = self._batch.follow(members, results, tick)
        return results.put(remaining, self._one_by_one(members.rows(remaining), tick))

    def _one_by_one(self, members: Members, tick: Tick) -> ResultChunk:
        """Simulate members one after another; one that fails does not stop the rest."""
        spec, experiment = self._spec, self._experiment
        results = ResultChunk.empty(spec, members.count)
        words: dict[int, str] = {}
        for i in range(members.count):
            try:
                run = experiment.run(members.parameters_of(i), members.start_of(i))
                refuse_doubt(run)
                outputs = {name: o.of(run, spec.legend) for name, o in spec.outputs.items()}
            except Exception as error:  # of any kind: it concerns this member alone
                results.reason[i] = reason_of(error)
                if len(words) < MOST_FAILURES:
                    words[i] = in_words(error)
            else:
                results.reason[i] = Reason.DONE
                for name, values in outputs.items():
                    results.values[name][i] = values
            tick(1)
        return ResultChunk(results.values, results.reason, words)


class BatchRunner:
    """Members integrated together as arrays, where outputs and numbers allow it."""

    def __init__(self, spec: EnsembleSpec) -> None:
        self._spec = spec
        # A single output that needs the whole trajectory takes every member out of the batch.
        quick = {n: o for n, o in spec.outputs.items() if isinstance(o, Quick)}
        self._outputs = quick if len(quick) == len(spec.outputs) else {}
        self._mode: SingleModeBatch | None = None
        self._is_prepared = False

    def follow(self, members: Members, results: ResultChunk, tick: Tick) -> NDArray[np.intp]:
        """Fill in the results of members; returns the rows of those it could not simulate."""
        all_rows = np.arange(members.count)
        columns = members.si_columns()
        if not self._outputs or columns is None or members.count < _FEW:
            return all_rows
        if not self._is_prepared:
            self._mode, self._is_prepared = self._prepared(members), True
        if self._mode is None:
            return all_rows
        end = self._spec.experiment().duration
        inner = {t for output in self._outputs.values() for t in output.sample_times if 0 < t < end}
        times = np.array([0.0, *sorted(inner), end])
        batch = self._mode.follow(members.count, columns, times, members.start_of)
        motions = Motions(batch.seen)
        for name, output in self._outputs.items():
            values = output.of_many(motions, self._spec.legend)
            results.values[name][batch.kept] = values[batch.kept]
        results.reason[batch.kept] = Reason.DONE
        tick(int(np.sum(batch.kept)))
        return all_rows[~batch.kept]

    def _prepared(self, members: Members) -> SingleModeBatch | None:
        spec, options = self._spec, dict(self._spec.options)
        if options.get("events") or members.has_expressions:
            return None
        plan = Plan(
            parameters=members.parameters_of(0),
            start=members.start_of(0),
            duration=spec.experiment().duration,
            forcing=options.get("forcing") or {},
            tolerance=options.get("tolerance"),
            near_flat=options.get("near_flat", NEAR_FLAT),
            until=options.get("until") or (),
            quantities=[q for output in self._outputs.values() for q in output.reads],
        )
        try:
            mode = batch_of(spec.derived, plan)
        except PolhodeError:
            return None  # the error is reported member by member
        # A batch kept to one mode does not look for contacts that pull, an event that an output
        # may name, or that may end the motion.
        events = any(isinstance(output, OF_EVENTS) for output in self._outputs.values())
        events = events or bool(plan.until)
        return None if mode is not None and mode.keeps_to_one_mode and events else mode

"""Some members of an ensemble, followed one after the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.derive import Automaton, Equations, automaton, derive
from polhode.model import System
from polhode.simulate import Experiment
from polhode.study._columns import Array, Members
from polhode.study._outputs import Legend, Outputs, legend_of
from polhode.study._reasons import Reason, reason_of, told

MOST_TOLD = 1000
"""Failures of a block that are kept in words; of further ones the code alone."""

Subject: TypeAlias = System | Automaton | Equations
Tick: TypeAlias = Callable[[int], None]


@dataclass(frozen=True)
class Order:
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
    def legend(self) -> Legend:
        """What the codes among the outputs stand for."""
        return legend_of(self.derived, tuple(self.options.get("events") or ()))

    def experiment(self) -> Experiment:
        """The system, set up to be run."""
        return Experiment(self.derived, self.duration, samples=2, **self.options)


def _received(
    system: System, kept: bool, duration: Any, outputs: Outputs, options: Mapping[str, Any]
) -> Order:
    return Order(derive(system) if kept else system, duration, outputs, options)


@dataclass(frozen=True)
class Block:
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
    def empty(cls, order: Order, count: int) -> Block:
        """Of members none of which has been followed yet."""
        values = {
            name: np.full((count, *output.shape), -1.0 if output.labels(order.legend) else np.nan)
            for name, output in order.outputs.items()
        }
        return cls(values, np.full(count, Reason.NOT_YET, dtype=np.int8), {})

    def put(self, rows: NDArray[np.intp], part: Block) -> Block:
        """The block with the results of some of its members put in their places."""
        for name, values in part.values.items():
            self.values[name][rows] = values
        self.reason[rows] = part.reason
        words = {int(rows[i]): text for i, text in part.told.items()}
        kept = dict(sorted({**self.told, **words}.items())[:MOST_TOLD])
        return Block(self.values, self.reason, kept)


def followed(order: Order, members: Members, experiment: Experiment, tick: Tick) -> Block:
    """Follow every member by itself; one that fails does not stop the rest.

    Args:
        tick: told the number of members that are done.
    """
    block = Block.empty(order, members.count)
    words: dict[int, str] = {}
    for i in range(members.count):
        try:
            run = experiment.run(members.parameters_of(i), members.start_of(i))
            found = {name: output.of(run, order.legend) for name, output in order.outputs.items()}
        except Exception as error:  # whatever it is, it is this member's alone
            block.reason[i] = reason_of(error)
            if len(words) < MOST_TOLD:
                words[i] = told(error)
        else:
            block.reason[i] = Reason.DONE
            for name, values in found.items():
                block.values[name][i] = values
        tick(1)
    return Block(block.values, block.reason, words)

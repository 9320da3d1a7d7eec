"""The task of a simulation, and its result."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from polhode.base import Progress
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._event import ModeSwitch
from polhode.simulate._names import Name
from polhode.simulate._segment import Segment
from polhode.simulate._start import Start
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._stepping import Integrator

if TYPE_CHECKING:
    from polhode.simulate.contact._description_changes import SpeedChange
    from polhode.simulate.contact._hybrid_system import HybridSystem

AS_DECLARED = "as declared"


@dataclass(frozen=True)
class Task:
    """A simulation to run: numbers, a start, and how to integrate from it."""

    given: Mapping[Name, Any]
    start: Mapping[Name, Any]
    forcing: Mapping[Name, Any]
    end: float
    integrator: Integrator
    tolerance: float | None
    near_flat: float
    seconds: dict[str, float]
    until: frozenset[str] = frozenset()


@dataclass(frozen=True)
class InitialState:
    """The start as it was read, and the equations in which it was read."""

    dynamics: Dynamics
    start: Start


@dataclass(frozen=True)
class Guarded:
    """The contact modes that a motion was followed through.

    Attributes:
        hybrid: the modes, with numbers.
        separated: contacts that start at a given height.
        speed_changes: where other speeds became independent, with the times.
    """

    hybrid: HybridSystem
    separated: frozenset[int]
    speed_changes: tuple[tuple[float, SpeedChange], ...] = ()


@dataclass(frozen=True)
class MotionResult:
    """A motion that was integrated.

    Attributes:
        unguarded: whether the contacts were kept as declared, without events where they change.
        initial: how the start was read.
        drive: the prescribed motions.
        guarded: the contact modes, unless contacts were kept as declared.
    """

    segments: tuple[Segment, ...]
    changes: tuple[ModeSwitch, ...]
    ending: str
    parameters: Mapping[str, float]
    assumed: Mapping[str, float]
    unguarded: bool
    initial: InitialState
    drive: PrescribedMotion
    guarded: Guarded | None = None


class Prepared(Protocol):
    """A system with its equations compiled, ready for any numbers and any start."""

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        """The motion from its start to its end.

        Args:
            task: only its values and start may differ from those it was prepared for.
        """


@contextmanager
def timed(task: Task, what: str) -> Iterator[None]:
    began = time.perf_counter()
    yield
    task.seconds[what] = task.seconds.get(what, 0.0) + time.perf_counter() - began

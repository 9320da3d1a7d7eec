"""Between a trajectory and what is kept of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import groupby, pairwise
from math import inf
from pathlib import Path

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError, PolhodeError, StoreError, Tell, within
from polhode.derive import Automaton, automaton, derive
from polhode.model import System, read_declaration, write_declaration
from polhode.simulate._absolute_values import sides_in_order
from polhode.simulate._dynamics import WORK, Dynamics
from polhode.simulate._event import placed
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.files._archive import Archive, ChebyshevPiece, series_of
from polhode.simulate.files._details import (
    Details,
    details_of,
    label,
    read_details,
    read_event,
    symbol,
)
from polhode.simulate.files._sampling import samples_of
from polhode.simulate.files._store import read_archive, write_archive
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._number_types import DOUBLES
from polhode.simulate.integrate._stepping import chosen
from polhode.simulate.integrate._stop_criteria import Stop

LONGEST = 60.0  # s of processor time


def save(run: Trajectory, path: str | Path) -> None:
    """Keep a motion in a file, with all that it was made of.

    Raises:
        StoreError: where the file cannot be written, h5py is not installed, or the system has
            parts of classes that are not polhode's own.
    """
    if run.precision != DOUBLES.name:
        raise StoreError(
            f"a motion in {run.precision} precision, to be kept in doubles",
            expected="a motion in doubles",
            advice="save run.rounded(), or its samples with to_csv, which keeps all digits",
        )
    write_archive(path, archive_of(run), samples_of(run))


def load(path: str | Path, *, seconds: float | None = LONGEST) -> Trajectory:
    """The motion that was kept in a file, known at every instant as it was.

    Its equations are derived again from the declaration in the file; nothing in it is run. A file
    may have been made to declare what takes for ever: so they are derived first in a process that
    is ended where it takes too long. On macOS and Windows that is interrupted instead, between
    steps of Python and in the main thread alone.

    Args:
        path: of the file.
        seconds: of processor time that the equations may take; None for a file that is trusted,
            for as long as they take.

    Raises:
        StoreError: for a file that is damaged, or that polhode did not write, and for one whose
            equations take longer, or too much memory.
    """
    archive = read_archive(path)
    if seconds is not None:
        _rehearse(archive, seconds)
    return trajectory_of(archive)


def _rehearse(archive: Archive, seconds: float) -> None:
    """See in a process of its own that a motion can be had in time."""
    if not 0 < seconds < inf:
        raise StoreError(f"{seconds!r} s to load in", expected="some time, or None for no bound")

    def rehearsed(tell: Tell[None]) -> None:
        trajectory_of(archive)

    try:
        within(seconds, rehearsed, advice="allow more with load(path, seconds=...)")
    except NumericError as error:
        raise _unfit(str(error)) from error


# -- from a trajectory -----------------------------------------------------------------------------


def archive_of(run: Trajectory) -> Archive:
    """What is kept of a motion.

    Raises:
        StoreError: for a system with parts of classes that are not polhode's own.
    """
    parts = [
        (i, segment, part)
        for i, segment in enumerate(run.segments)
        for part in segment.parts
        if part.begin < part.end
    ]
    return Archive(
        declaration=write_declaration(run.system),
        parameters=run.parameters,
        stretches=tuple(_stretch(i, segment, part) for i, segment, part in parts),
        events=tuple(event.as_json() for event in run.events),
        times=run.t,
        details=details_of(run).as_json(),
    )


def _stretch(number: int, segment: Segment, part: TrajectoryPiece) -> ChebyshevPiece:
    solution = part.solution
    steps = np.append(solution.steps[solution.steps < part.end], part.end)
    knots, series = series_of(solution.at, steps)
    names = (symbol.published for symbol in segment.dynamics.parameters)
    return ChebyshevPiece(
        segment=number,
        mode=segment.mode,
        states=tuple(map(label, solution.symbols)),
        constants=dict(zip(names, part.constants.tolist(), strict=True)),
        steps=steps,
        knots=knots,
        series=series,
    )


# -- and back --------------------------------------------------------------------------------------


def trajectory_of(archive: Archive) -> Trajectory:
    """The motion again, its equations derived anew from the declaration.

    Raises:
        StoreError: for an archive that does not fit together.
    """
    system = read_declaration(archive.declaration)
    try:
        details = read_details(archive.details)
        _refuse_gaps(archive, details.duration)
        segments = tuple(_segments(archive, system, details))
        events = (read_event(event, details.duration) for event in archive.events)
        return Trajectory(
            system=system,
            segments=segments,
            parameters=archive.parameters,
            duration=details.duration,
            t=archive.times,
            mode=details.mode,
            events=placed(events, segments),
            assumed=details.assumed,
            seconds=details.seconds,
            integrator=details.integrator,
            invariants=details.invariants,
            resolution=details.resolution,
            doubt=details.doubt,
        )
    except (ArithmeticError, AttributeError, LookupError, RecursionError) as error:
        raise _unfit(str(error)) from error
    except (PolhodeError, TypeError, ValueError) as error:
        raise _unfit(str(error)) from error


def _unfit(what: str) -> StoreError:
    return StoreError(
        f"a motion whose parts do not fit together: {what[:200]}", expected="one that polhode kept"
    )


def _refuse_gaps(archive: Archive, duration: float) -> None:
    """See that the stretches are one motion, from 0 to its end, with samples along it."""
    stretches = archive.stretches
    if not stretches:
        raise ValueError("there is nothing in it")
    ends = [0.0, *(stretch.end for stretch in stretches)]
    if any(s.begin != end for s, end in zip(stretches, ends, strict=False)) or ends[-1] != duration:
        raise ValueError("stretches that do not follow one another from 0 to the end")
    numbers = [0, *(stretch.segment for stretch in stretches)]
    if any(after - before not in (0, 1) for before, after in pairwise(numbers)):
        raise ValueError("segments that do not follow one another")
    if not np.all((archive.times >= 0) & (archive.times <= duration)):
        raise ValueError("samples outside the motion")


def _segments(archive: Archive, system: System, details: Details) -> Iterable[Segment]:
    known = _Modes(automaton(system), details.prescribed)
    for _, group in groupby(archive.stretches, lambda stretch: stretch.segment):
        own = list(group)
        if len({stretch.mode for stretch in own}) > 1:
            raise ValueError("a segment in several modes")
        dynamics = known.dynamics(own[0])
        dynamics = dynamics.on(sides_in_order(dynamics, details.sides.get(own[0].segment, ())))
        parts = tuple(_part(stretch, dynamics, details.turned) for stretch in own)
        yield Segment(own[0].mode, parts[0].begin, parts[-1].end, dynamics, parts)


class _Modes:
    """The equations behind each contact mode."""

    def __init__(self, modes: Automaton, prescribed: Mapping[Symbol, Expr]) -> None:
        self._modes = modes
        self._prescribed = prescribed
        self._known: dict[str, Dynamics] = {}

    def dynamics(self, stretch: ChebyshevPiece) -> Dynamics:
        """Of the mode of a stretch."""
        if stretch.mode not in self._known:
            self._known[stretch.mode] = self._made(stretch)
        return self._known[stretch.mode]

    def _made(self, stretch: ChebyshevPiece) -> Dynamics:
        constants = {Symbol(name): value for name, value in stretch.constants.items()}
        if stretch.mode == AS_DECLARED:
            return Dynamics(derive(self._modes.system), self._prescribed, tuple(constants))
        machine = HybridSystem(
            self._modes, PrescribedMotion(self._prescribed, {}), constants, chosen(), tolerance=None
        )
        return machine.mode(self._modes.named(stretch.mode)).dynamics


def _part(
    stretch: ChebyshevPiece, dynamics: Dynamics, turned: Mapping[Symbol, Symbol]
) -> TrajectoryPiece:
    symbols = tuple(map(symbol, stretch.states))
    missing = set(dynamics.states) - set(symbols) - {WORK}
    if missing or len(set(symbols)) < len(symbols):
        raise ValueError("states that are not those of the system")
    solution = SegmentSolution(
        symbols,
        {angle: less for angle, less in turned.items() if less in symbols},
        stretch.steps,
        Stop.TIME,
        None,
        stretch.at,
    )
    constants = np.array([stretch.constants[s.published] for s in dynamics.parameters])
    return TrajectoryPiece(stretch.begin, stretch.end, solution, constants)

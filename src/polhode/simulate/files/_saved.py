"""Motions loaded from files: their equations are derived again, and no code in a file is run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import groupby, pairwise
from math import inf
from pathlib import Path

import numpy as np

from polhode.algebra import Symbol
from polhode.base import ByIdentity, NumericError, PolhodeError, StoreError, Tell, within
from polhode.derive import automaton, derive, on_independent
from polhode.model import Phase, System, read_declaration
from polhode.simulate._absolute_values import sides_in_order
from polhode.simulate._dynamics import WORK, Dynamics
from polhode.simulate._event import placed
from polhode.simulate._gimbal_lock import NumericAttitude, attitudes_of
from polhode.simulate._other_angles import OtherAngles
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._trajectory import Trajectory
from polhode.simulate._turned_angles import TurnedEquations
from polhode.simulate._turned_piece import turned_piece
from polhode.simulate.contact._hybrid_system import Chart, HybridSystem
from polhode.simulate.files._archive import Archive, ChebyshevPiece
from polhode.simulate.files._details import (
    Details,
    read_details,
    read_event,
    symbol,
)
from polhode.simulate.files._store import read_archive
from polhode.simulate.forcing._prescribed_motion import PrescribedMotion
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._stop_criteria import Stop

LONGEST = 60.0  # s of processor time


def load(path: str | Path, *, seconds: float | None = LONGEST) -> Trajectory:
    """Load a motion from a file, known at every instant as when it was saved.

    Its equations are derived again from the declaration in the file; no code in it is run. A
    malicious file may declare a system that takes forever to derive, so a process with a time limit
    derives it first. On macOS and Windows the derivation is interrupted instead, which works only
    between steps of Python and in the main thread.

    Args:
        path: of the file.
        seconds: processor time allowed for the equations; None, for a file that is trusted, sets
            no limit.

    Raises:
        StoreError: for a file that is damaged, was not written by polhode, or whose equations
            take too long or too much memory.
    """
    archive = read_archive(path)
    if seconds is not None:
        _try_in_process(archive, seconds)
    return trajectory_of(archive)


def _try_in_process(archive: Archive, seconds: float) -> None:
    """Check in a separate process that a motion can be loaded in time."""
    if not 0 < seconds < inf:
        raise StoreError(
            f"a limit of {seconds!r} s", expected="a positive time, or None for no limit"
        )

    def trial(tell: Tell[None]) -> None:
        trajectory_of(archive)

    try:
        within(seconds, trial, advice="allow more with load(path, seconds=...)")
    except NumericError as error:
        raise _inconsistent(str(error)) from error


def trajectory_of(archive: Archive) -> Trajectory:
    """The motion of an archive, with its equations derived again from the declaration.

    Raises:
        StoreError: for an archive that is inconsistent.
    """
    system = read_declaration(archive.declaration)
    try:
        details = read_details(archive.details)
        # The stretches must be one motion from 0 to its end, and the samples within it.
        stretches = archive.stretches
        if not stretches:
            raise ValueError("it is empty")
        ends = [0.0, *(stretch.end for stretch in stretches)]
        if (
            any(s.begin != end for s, end in zip(stretches, ends, strict=False))
            or ends[-1] != details.duration
        ):
            raise ValueError("stretches that are not contiguous from 0 to the end")
        numbers = [0, *(stretch.segment for stretch in stretches)]
        if any(after - before not in (0, 1) for before, after in pairwise(numbers)):
            raise ValueError("segments out of order")
        if not np.all((archive.times >= 0) & (archive.times <= details.duration)):
            raise ValueError("samples outside the motion")
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
        raise _inconsistent(str(error)) from error
    except (PolhodeError, TypeError, ValueError) as error:
        raise _inconsistent(str(error)) from error


def _inconsistent(what: str) -> StoreError:
    return StoreError(f"an inconsistent motion: {what[:200]}", expected="one that polhode saved")


@dataclass(frozen=True)
class _Mode:
    """The equations of the stretches in one mode.

    Attributes:
        dynamics: in the declared angles.
        attitudes: those whose angles can be counted otherwise.
        turned: makes the same equations with the angles of some attitudes, given by their places,
            counted from turned axes.
    """

    dynamics: Dynamics
    attitudes: tuple[NumericAttitude, ...]
    turned: Callable[[Chart], OtherAngles]

    def in_place_of(self, angles: Iterable[Symbol]) -> OtherAngles:
        """The equations in which others were integrated in place of some angles."""
        own = {q.base() for q in angles}
        chart = tuple(i for i, a in enumerate(self.attitudes) if own.issuperset(a.angles))
        if not chart or own != {q for i in chart for q in self.attitudes[i].angles}:
            raise ValueError("angles that are not those of an attitude")
        return self.turned(chart)


def _as_declared(dynamics: Dynamics) -> _Mode:
    attitudes = attitudes_of(ByIdentity(dynamics.equations))

    def turned(chart: Chart) -> OtherAngles:
        return TurnedEquations(dynamics, (attitudes[i] for i in chart), chosen(), None).angles

    return _Mode(dynamics, attitudes, cache(turned))


def _contact_mode(hybrid: HybridSystem, phases: tuple[Phase, ...]) -> _Mode:
    dynamics = hybrid.mode(phases).dynamics

    def turned(chart: Chart) -> OtherAngles:
        return hybrid.angles_between(dynamics, hybrid.dynamics_in(chart, phases), chart)

    return _Mode(dynamics, hybrid.attitudes, turned)


def _segments(archive: Archive, system: System, details: Details) -> Iterable[Segment]:
    modes, known = automaton(system), dict[tuple[str, tuple[Symbol, ...]], _Mode]()
    prescribed = details.prescribed
    for _, group in groupby(enumerate(archive.stretches), lambda item: item[1].segment):
        own = list(group)
        if len({stretch.mode for _, stretch in own}) > 1:
            raise ValueError("a segment in several modes")
        _, first = own[0]
        speeds = tuple(details.independent.get(first.segment, ()))
        key = first.mode, speeds
        if key not in known:
            constants = {Symbol(name): value for name, value in first.constants.items()}
            if first.mode == AS_DECLARED:
                equations = on_independent(system, speeds) if speeds else derive(modes.system)
                known[key] = _as_declared(Dynamics(equations, prescribed, tuple(constants)))
            else:
                motion = PrescribedMotion(prescribed, {})
                hybrid = HybridSystem(modes, motion, constants, chosen(), tolerance=None)
                hybrid.on_speeds(speeds)
                known[key] = _contact_mode(hybrid, modes.named(first.mode))
        mode = known[key]
        sides = details.sides.get(first.segment, ())
        dynamics = mode.dynamics.on(sides_in_order(mode.dynamics, sides))
        parts = list[TrajectoryPiece]()
        for k, stretch in own:
            before = details.replaced.get(k)
            angles = mode.in_place_of(before) if before else None
            integrated = dynamics if angles is None else angles.turned
            part = _part(stretch, integrated, details.turned)
            if angles is not None and before is not None:
                part = turned_piece(angles, part, before, _constants(stretch, dynamics))
            parts.append(part)
        yield Segment(first.mode, parts[0].begin, parts[-1].end, dynamics, tuple(parts))


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
    constants = _constants(stretch, dynamics)
    return TrajectoryPiece(stretch.begin, stretch.end, solution, constants)


def _constants(stretch: ChebyshevPiece, dynamics: Dynamics) -> Array:
    return np.array([stretch.constants[s.published] for s in dynamics.parameters])

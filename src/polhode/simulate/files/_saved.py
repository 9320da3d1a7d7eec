"""Between a trajectory and what is kept of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from polhode.algebra import SHAPES, Expr, Kind, Symbol
from polhode.base import Codec, PolhodeError, Shape, StoreError
from polhode.derive import Automaton, automaton, derive
from polhode.model import System, read_declaration, write_declaration
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._event import Event, placed
from polhode.simulate._segment import Part, Segment
from polhode.simulate._sides import sides_in_order
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.contact._machine import Machine
from polhode.simulate.files._archive import Archive, Sampled, Stretch, series_of
from polhode.simulate.files._sampling import samples_of
from polhode.simulate.files._store import read_archive, write_archive
from polhode.simulate.forcing._drive import Drive
from polhode.simulate.integrate._driver import Solution
from polhode.simulate.integrate._integrators import chosen
from polhode.simulate.integrate._numbers import DOUBLES
from polhode.simulate.integrate._watched import Stop


@dataclass(frozen=True)
class _Table:
    """Expressions under symbols or names."""

    rows: tuple[tuple[Symbol | str, Expr], ...]


def _table(rows: tuple[tuple[Any, Any], ...]) -> _Table:
    for name, expression in rows:
        if not isinstance(name, Symbol | str) or not isinstance(expression, Expr):
            raise ValueError("a table of something else than expressions")
    return _Table(rows)


_CODEC = Codec((*SHAPES, Shape("table", (_Table,), lambda table: {"rows": table.rows}, _table)))


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
    write_archive(path, archive_of(run, samples_of(run)))


def load(path: str | Path) -> Trajectory:
    """The motion that was kept in a file, known at every instant as it was.

    Its equations are derived again from the declaration in the file; nothing in it is run.

    Raises:
        StoreError: for a file that is damaged, or that polhode did not write.
    """
    return trajectory_of(read_archive(path))


# -- from a trajectory -----------------------------------------------------------------------------


def archive_of(run: Trajectory, samples: Mapping[str, Sampled]) -> Archive:
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
    turned = {_label(s): _label(t) for *_, p in parts for s, t in p.solution.turned.items()}
    return Archive(
        declaration=write_declaration(run.system),
        parameters=run.parameters,
        stretches=tuple(_stretch(i, segment, part) for i, segment, part in parts),
        events=tuple(event.as_json() for event in run.events),
        times=run.t,
        samples=samples,
        details={
            "duration": run.duration,
            "mode": run.mode,
            "assumed": dict(run.assumed),
            "seconds": dict(run.seconds),
            "integrator": run.integrator,
            "turned": turned,
            "forcing": _CODEC.write(_Table(tuple(run.dynamics.prescribed.items()))),
            "invariants": _CODEC.write(_Table(tuple(run.invariants.items()))),
            **_sides(run.segments),
            **({"doubt": run.doubt} if run.doubt else {}),
        },
    )


def _sides(segments: Sequence[Segment]) -> dict[str, Any]:
    """Of absolute values, by segment; nothing where there are none."""
    found = {str(k): list(s.dynamics.sides.values()) for k, s in enumerate(segments)}
    return {"sides": found} if any(found.values()) else {}


def _stretch(number: int, segment: Segment, part: Part) -> Stretch:
    solution = part.solution
    steps = np.append(solution.steps[solution.steps < part.end], part.end)
    knots, series = series_of(solution.at, steps)
    names = (symbol.published for symbol in segment.dynamics.parameters)
    return Stretch(
        segment=number,
        mode=segment.mode,
        states=tuple(map(_label, solution.symbols)),
        constants=dict(zip(names, part.constants.tolist(), strict=True)),
        steps=steps,
        knots=knots,
        series=series,
    )


def _label(symbol: Symbol) -> str:
    return f"{symbol.kind.value} {symbol.order} {symbol.name}"


# -- and back --------------------------------------------------------------------------------------


def trajectory_of(archive: Archive) -> Trajectory:
    """The motion again, its equations derived anew from the declaration.

    Raises:
        StoreError: for an archive that does not fit together.
    """
    system = read_declaration(archive.declaration)
    if not archive.stretches:
        raise _unfit("there is nothing in it")
    details = archive.details
    try:
        invariants = dict(_CODEC.read(details["invariants"], _Table).rows)
        segments = tuple(_segments(archive, system))
        events = (Event(e["time"], e["kind"], e["from"], e["to"]) for e in archive.events)
        return Trajectory(
            system=system,
            segments=segments,
            parameters=archive.parameters,
            duration=float(details["duration"]),
            t=archive.times,
            mode=details["mode"],
            events=placed(events, segments),
            assumed=details["assumed"],
            seconds=details["seconds"],
            integrator=details["integrator"],
            invariants={str(name): value for name, value in invariants.items()},
            doubt=str(details.get("doubt", "")),
        )
    except (PolhodeError, LookupError, TypeError, ValueError) as error:
        raise _unfit(str(error)) from error


def _unfit(what: str) -> StoreError:
    return StoreError(
        f"a motion whose parts do not fit together: {what[:200]}", expected="one that polhode kept"
    )


def _segments(archive: Archive, system: System) -> Iterable[Segment]:
    forcing = dict(_CODEC.read(archive.details["forcing"], _Table).rows)
    prescribed = {s: e for s, e in forcing.items() if isinstance(s, Symbol)}
    turned = {_symbol(a): _symbol(b) for a, b in archive.details["turned"].items()}
    known = _Modes(automaton(system), prescribed)
    sides = archive.details.get("sides", {})
    numbers = sorted({stretch.segment for stretch in archive.stretches})
    for number in numbers:
        own = [stretch for stretch in archive.stretches if stretch.segment == number]
        dynamics = known.dynamics(own[0])
        dynamics = dynamics.on(sides_in_order(dynamics, sides.get(str(number), ())))
        parts = tuple(_part(stretch, dynamics, turned) for stretch in own)
        yield Segment(own[0].mode, parts[0].begin, parts[-1].end, dynamics, parts)


class _Modes:
    """The equations behind each contact mode."""

    def __init__(self, modes: Automaton, prescribed: Mapping[Symbol, Expr]) -> None:
        self._modes = modes
        self._prescribed = prescribed
        self._known: dict[str, Dynamics] = {}

    def dynamics(self, stretch: Stretch) -> Dynamics:
        """Of the mode of a stretch."""
        if stretch.mode not in self._known:
            self._known[stretch.mode] = self._made(stretch)
        return self._known[stretch.mode]

    def _made(self, stretch: Stretch) -> Dynamics:
        constants = {Symbol(name): value for name, value in stretch.constants.items()}
        if stretch.mode == AS_DECLARED:
            return Dynamics(derive(self._modes.system), self._prescribed, tuple(constants))
        machine = Machine(
            self._modes, Drive(self._prescribed, {}), constants, chosen(), tolerance=None
        )
        return machine.mode(self._modes.named(stretch.mode)).dynamics


def _part(stretch: Stretch, dynamics: Dynamics, turned: Mapping[Symbol, Symbol]) -> Part:
    symbols = tuple(map(_symbol, stretch.states))
    solution = Solution(
        symbols,
        {angle: less for angle, less in turned.items() if less in symbols},
        stretch.steps,
        Stop.TIME,
        None,
        stretch.at,
    )
    constants = np.array([stretch.constants[s.published] for s in dynamics.parameters])
    return Part(stretch.begin, stretch.end, solution, constants)


def _symbol(label: str) -> Symbol:
    kind, order, name = label.split(" ", 2)
    return Symbol(name, Kind(kind), int(order))

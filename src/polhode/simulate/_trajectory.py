"""A computed motion, with every quantity at any time, its tables and its file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError, Shown, StoreError, look_up
from polhode.derive import BalanceTable, Equations, balance_table
from polhode.model import System, write_declaration
from polhode.simulate._drift import Drift, drift_of
from polhode.simulate._dynamics import Dynamics, EquationsOfMotion, readable
from polhode.simulate._event import Event, placed
from polhode.simulate._open_reactions import OpenReactions, open_reactions
from polhode.simulate._segment import Segment, TrajectoryPiece
from polhode.simulate._units import unit_in
from polhode.simulate.files._archive import Archive, ChebyshevPiece, Sampled, series_of
from polhode.simulate.files._details import Details, label
from polhode.simulate.files._store import write_archive
from polhode.simulate.files._tables import to_pandas, to_xarray, write_csv
from polhode.simulate.integrate._arrays import occurring
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._stepping import Array

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class Trajectory(Shown):
    """A motion over [0, duration], known at every instant.

    Quantities are read by published name (`run["theta"]`, `run["F_z"]`, `run["energy"]`), or as
    expressions in symbols of the system. All are in SI units.

    At an instant at which the mode changes, the values are those just after it.

    Attributes:
        system: the declaration of the system.
        segments: one for each stay in a contact mode, in order.
        parameters: value of every parameter by name.
        duration: s; shorter than requested where the motion could not continue.
        t: times of the samples, s.
        mode: name of the contact mode it ends in.
        events: start, changes of contact mode, requested events, end.
        assumed: start values that were not given, by name; and zero for the overlap of each pair
            of bodies whose shapes are not watched.
        seconds: time spent to derive, compile and integrate.
        integrator: name of the integrator.
        invariants: expressions that the motion should conserve, checked by `drift`.
        resolution: of prescribed motions given as Python functions, by name, s: shorter changes may
            have been missed.
        doubt: why the motion is doubtful: a drift that rounding does not explain, or bodies that
            pass through each other. Empty otherwise.
    """

    system: Any
    segments: tuple[Segment, ...]
    parameters: Mapping[str, float]
    duration: float
    t: Array
    mode: str
    events: tuple[Event, ...]
    assumed: Mapping[str, float]
    seconds: Mapping[str, float]
    integrator: str
    invariants: Mapping[str, Expr]
    resolution: Mapping[str, float] = field(default_factory=dict)
    doubt: str = ""

    def __repr__(self) -> str:
        modes = ", ".join(dict.fromkeys(segment.mode for segment in self.segments))
        unseen = "".join(f"; {n} resolved to {time:.3g} s" for n, time in self.resolution.items())
        summary = (
            f"Trajectory of {self.system.name!r} over {float(self.duration):.6g} s: {modes}; "
            f"{len(self.events)} events{unseen}"
        )
        return f"{summary}; CANNOT BE RELIED ON: {self.doubt}" if self.doubt else summary

    @property
    def dynamics(self) -> Dynamics:
        """The equations of the first mode and the prescribed functions."""
        return self.segments[0].dynamics

    @property
    def equations(self) -> EquationsOfMotion:
        """The equations of motion of the first mode."""
        return self.dynamics.equations

    @cached_property
    def quantities(self) -> dict[str, Expr]:
        """Every quantity that has a name, as an expression in the first mode.

        "power" is that of all forces without a potential, "work" their work since the start.
        """
        return self._readable[0]

    @cached_property
    def _readable(self) -> list[dict[str, Expr]]:
        """By segment."""
        known: dict[int, dict[str, Expr]] = {}
        for segment in self.segments:
            if id(segment.dynamics) not in known:
                known[id(segment.dynamics)] = readable(segment.dynamics, self.invariants)
        tables = [known[id(segment.dynamics)] for segment in self.segments]
        names = {name: None for table in tables for name in table}
        return [{name: table.get(name, _NOTHING) for name in names} for table in tables]

    @property
    def precision(self) -> str:
        """The precision of its numbers: double, extended, quadruple, or a number of digits."""
        return self._numbers.name

    def rounded(self) -> Trajectory:
        """The same motion in double precision."""
        segments = tuple(segment.rounded() for segment in self.segments)
        double = DOUBLES.array
        return replace(
            self,
            segments=segments,
            duration=segments[-1].end,
            t=double(self.t),
            events=placed((replace(e, time=float(e.time)) for e in self.events), segments),
        )

    @property
    def _numbers(self) -> NumberType:
        return self.segments[0].numbers

    def at(self, t: float | Array) -> dict[str, Array]:
        """Coordinates, speeds and rates at one or more times, by name; shaped like `t`."""
        return self.table(self.states, t)

    def __getitem__(self, name: str | Symbol | Expr) -> Array:
        """A quantity at the sample times `t`, shape (samples,)."""
        return self.evaluate(name)

    def evaluate(self, quantity: str | Symbol | Expr, t: float | Array | None = None) -> Array:
        """A quantity, by name or as an expression, at some times (the samples); shaped like them.

        A reaction of a contact that is open is zero, and nan while Newton's laws leave it open.

        Raises:
            DeclarationError: for a name or symbol that the system does not have.
            NumericError: for a time outside the motion, or a reaction that is never determined.
        """
        times = self.t if t is None else self._times(t)
        return np.asarray(self._values([quantity], times)[0])

    def table(self, names: Iterable[str], t: float | Array | None = None) -> dict[str, Array]:
        """Several quantities by name, computed together."""
        times, names = self.t if t is None else self._times(t), list(names)
        return dict(zip(names, self._values(names, times), strict=True))

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the reaction components that are determined, of all modes.

        By Newton's laws, or by the law by which supports of the system share a load.
        """
        found: dict[str, None] = {}
        for i, segment in enumerate(self.segments):
            names = segment.dynamics.equations.components
            found |= dict.fromkeys(n for n in names if not self._is_undetermined(n, i))
        return tuple(found)

    @cached_property
    def final(self) -> dict[str, Any]:
        """Coordinates, speeds, rates, reactions and the energy at the end, and the last mode.

        Reactions that Newton's laws leave open there are left out.
        """
        last = len(self.segments) - 1
        known = (name for name in self.reactions if not self._is_undetermined(name, last))
        names = (*self.states, *known, "energy")
        values = self.table(names, self.duration)
        scalar = self._numbers.scalar
        return {**{name: scalar(value) for name, value in values.items()}, "mode": self.mode}

    @cached_property
    def drift(self) -> Drift:
        """Largest drift of energy, constraints and invariants over the steps and samples."""
        return drift_of(self.segments, self.invariants, self.t)

    def to_csv(self, path: str | Path, names: Iterable[str] | None = None) -> None:
        """Write the samples: by default coordinates, speeds, rates, reactions and energy.

        The first line begins with # and describes the computation. An existing file is replaced
        only when the new one is complete.

        Raises:
            StoreError: where the file cannot be written.
        """
        chosen = list(names) if names is not None else [*self.states, *self.reactions, "energy"]
        write_csv(Path(path), {"t": self.t, **self.table(chosen)}, self._origin)

    def to_xarray(self, names: Iterable[str] | None = None) -> xarray.Dataset:
        """The samples over the coordinate `t` (s), each with its unit as an attribute.

        Args:
            names: published names; by default coordinates, speeds, rates, reactions, energy, power,
                work and the invariants watched.

        Raises:
            StoreError: where xarray is not installed.
        """
        return to_xarray(self.t, samples_of(self, names), self._origin)

    def to_pandas(self, names: Iterable[str] | None = None) -> pandas.DataFrame:
        """The samples as a table with the times `t` (s) as its index.

        Its `attrs` describe the computation and hold, under "units", the unit of every column.

        Args:
            names: as for `to_xarray`.

        Raises:
            StoreError: where pandas is not installed.
        """
        return to_pandas(self.t, samples_of(self, names), self._origin)

    def save(self, path: str | Path) -> None:
        """Save the whole motion in a file that `polhode.load` reads.

        The file also holds the declaration, the parameters and the samples, which other tools read
        as HDF5 or NetCDF-4.

        Raises:
            StoreError: where the file cannot be written, h5py is not installed, or the system has
                parts of classes that are not polhode's own.
        """
        if self.precision != DOUBLES.name:
            raise StoreError(
                f"a motion in {self.precision} precision cannot be saved: files hold doubles",
                expected="a motion in double precision",
                advice="save run.rounded(), or write its samples with to_csv, which keeps all "
                "digits",
            )
        write_archive(path, archive_of(self), samples_of(self))

    @property
    def _origin(self) -> dict[str, Any]:
        """A description of the computation, stored with the samples."""
        return {
            "system": self.system.name,
            "mode": self.mode,
            "parameters": dict(self.parameters),
            "assumed": dict(self.assumed),
            "integrator": self.integrator,
            **({"resolution": dict(self.resolution)} if self.resolution else {}),
        }

    @cached_property
    def states(self) -> tuple[str, ...]:
        """Coordinates, speeds and rates, of all modes."""
        found: dict[str, None] = {}
        for segment in self.segments:
            equations = segment.dynamics.equations
            own = (*equations.coordinates, *equations.speeds)
            for symbol in (*own, *equations.kinematics, *equations.dependent):
                found.setdefault(symbol.published)
        return tuple(found)

    def _expression(self, quantity: str | Symbol | Expr, segment: int) -> Expr:
        if isinstance(quantity, Symbol):
            return self._readable[segment].get(quantity.published, Expr.generator(quantity))
        if not isinstance(quantity, str):
            return Expr.of(quantity)
        if self._is_undetermined(quantity, segment):
            raise NumericError(
                f"the reaction {quantity} is not determined by Newton's laws",
                expected=f"one of {', '.join(self.reactions)}" if self.reactions else "a quantity",
                advice="evaluate equations.least[...] for the reactions of least norm",
            )
        return look_up(quantity, self._readable[segment], "quantity of this system")

    def _is_undetermined(self, name: str, segment: int) -> bool:
        """Whether a reaction is open in a mode."""
        is_open = name in self.segments[segment].dynamics.equations.undetermined
        return is_open and name not in self._shared[segment]

    def _is_shared(self, quantity: str | Symbol | Expr, segment: int) -> bool:
        """Whether it is a reaction that the equations of a mode leave open, though it is known."""
        if not isinstance(quantity, str):
            return False
        is_open = quantity in self.segments[segment].dynamics.equations.undetermined
        return is_open and quantity in self._shared[segment]

    @cached_property
    def _balances(self) -> tuple[BalanceTable | None, ...]:
        """Of each mode the balances of its bodies, where its equations leave reactions open."""
        modes = [cast(Equations, segment.dynamics.equations) for segment in self.segments]
        known = {id(m): balance_table(m) for m in modes if self._may_be_shared(m)}
        return tuple(known.get(id(mode)) for mode in modes)

    def _may_be_shared(self, mode: Equations) -> bool:
        is_declared = isinstance(self.system, System)
        return is_declared and bool(mode.undetermined) and self.precision == DOUBLES.name

    @cached_property
    def _shared(self) -> tuple[frozenset[str], ...]:
        """Of each mode the reactions that its equations leave open, though they are determined."""
        found = []
        for segment, table in zip(self.segments, self._balances, strict=True):
            names = table.names if table is not None else ()
            at_begin = np.array([segment.begin])
            for forces in _open_reactions_in(segment, table, at_begin) if table else ():
                names = tuple(n for j, n in enumerate(names) if forces.are_determined(j))
            found.append(frozenset(names))
        return tuple(found)

    def _is_open(self, quantity: str | Symbol | Expr, segment: int) -> bool:
        """Whether it is a reaction that is open in this mode, but not in all."""
        if not isinstance(quantity, str) or not self._is_undetermined(quantity, segment):
            return False
        return quantity in self.reactions

    def _times(self, t: float | Array) -> Array:
        times: Array = self._numbers.array(t)
        if not np.all((times >= 0) & (times <= self.duration)):
            raise NumericError(
                f"times from {float(np.min(times)):g} s to {float(np.max(times)):g} s",
                expected=f"times within the motion, from 0 to {float(self.duration):g} s",
            )
        return times

    def _values(self, quantities: Iterable[str | Symbol | Expr], times: Array) -> Array:
        """Values of quantities, shape (quantities, *shape of times)."""
        wanted, flat = list(quantities), times.ravel()
        begins = np.array([segment.begin for segment in self.segments])
        which = np.clip(np.searchsorted(begins, flat, "right") - 1, 0, None)
        found = np.empty((len(wanted), len(flat)), dtype=self._numbers.dtype)
        for i in occurring(which):
            here = which == i
            open_ = [k for k, quantity in enumerate(wanted) if self._is_open(quantity, int(i))]
            shared = [k for k, quantity in enumerate(wanted) if self._is_shared(quantity, int(i))]
            expressions = [
                _NOTHING if k in (*open_, *shared) else self._expression(quantity, int(i))
                for k, quantity in enumerate(wanted)
            ]
            segment = self.segments[i]
            found[:, here] = segment.values(expressions, flat[here])
            found[np.ix_(open_, here)] = np.nan
            table = self._balances[i]
            if shared and table is not None:
                places = [table.names.index(cast(str, wanted[k])) for k in shared]
                forces = _open_reactions_in(segment, table, flat[here])
                found[np.ix_(shared, here)] = np.transpose([f.values[places] for f in forces])
        return found.reshape(len(wanted), *times.shape)


def _open_reactions_in(
    segment: Segment, table: BalanceTable, times: Array
) -> Iterator[OpenReactions]:
    """The reactions of a mode at instants, where its equations leave some of them open."""
    is_shared = bool(cast(Equations, segment.dynamics.equations).system.sharing)
    for values in segment.values(table.expressions, times).T:
        yield open_reactions(table, values, is_shared=is_shared)


#: The value of a quantity in a mode without it, such as the force of an open contact.
_NOTHING = Expr.of(0)


# -- samples with their units ----------------------------------------------------------------------

_WORDS = {"energy": "J", "work": "J", "power": "W"}


def samples_of(run: Trajectory, names: Iterable[str] | None = None) -> dict[str, Sampled]:
    """Quantities at the sample times of a motion.

    Args:
        run: the motion.
        names: published names; by default coordinates, speeds, rates, reactions, energy, power,
            work and the invariants watched.
    """
    if names is None:
        names = dict.fromkeys((*run.states, *run.reactions, *_WORDS, *run.invariants))
    table = run.table(names)
    return {name: Sampled(unit_of(run, name), values) for name, values in table.items()}


def unit_of(run: Trajectory, name: str) -> str:
    """SI unit of a quantity of a motion; empty for a pure number, and where it is not known."""
    if name in _WORDS:
        return _WORDS[name]
    if name in run.reactions:
        modes = (cast(Equations, segment.dynamics.equations) for segment in run.segments)
        return "N m" if any(name in mode.couples for mode in modes) else "N"
    return unit_in(cast(Equations, run.equations), run.quantities[name])


# -- the contents of a file ------------------------------------------------------------------------


def archive_of(run: Trajectory) -> Archive:
    """The data of a motion that are stored in a file.

    Raises:
        StoreError: for a system with parts of classes that are not polhode's own.
    """
    parts = [
        (i, segment, part)
        for i, segment in enumerate(run.segments)
        for part in segment.parts
        if part.begin < part.end
    ]
    solutions = [part.as_integrated(segment.dynamics)[1].solution for _, segment, part in parts]
    sides = {i: tuple(s.dynamics.sides.values()) for i, s in enumerate(run.segments)}
    details = Details(
        duration=run.duration,
        mode=run.mode,
        assumed=run.assumed,
        seconds=run.seconds,
        integrator=run.integrator,
        resolution=run.resolution,
        turned={s: t for solution in solutions for s, t in solution.turned.items()},
        prescribed=run.dynamics.prescribed,
        invariants=run.invariants,
        sides={i: s for i, s in sides.items() if s},
        independent={i: s for i, s in _other_speeds(run).items() if s},
        replaced={
            k: angles for k, (*_, part) in enumerate(parts) if (angles := part.replaced_at_start)
        },
        doubt=run.doubt,
    )
    return Archive(
        declaration=write_declaration(run.system),
        parameters=run.parameters,
        stretches=tuple(_chebyshev(i, segment, part) for i, segment, part in parts),
        events=tuple(event.as_json() for event in run.events),
        times=run.t,
        details=details.as_json(),
    )


def _other_speeds(run: Trajectory) -> dict[int, tuple[Symbol, ...]]:
    """The independent speeds of segments in which others are kept than the declaration says."""
    declared = getattr(run.system, "independent", ())
    found = {}
    for i, segment in enumerate(run.segments):
        kept = getattr(getattr(segment.dynamics.equations, "system", None), "independent", ())
        found[i] = kept if kept != declared else ()
    return found


def _chebyshev(number: int, segment: Segment, part: TrajectoryPiece) -> ChebyshevPiece:
    dynamics, own = part.as_integrated(segment.dynamics)
    solution = own.solution
    steps = np.append(solution.steps[solution.steps < part.end], part.end)
    knots, series = series_of(solution.at, steps)
    names = (symbol.published for symbol in dynamics.parameters)
    return ChebyshevPiece(
        segment=number,
        mode=segment.mode,
        states=tuple(map(label, solution.symbols)),
        constants=dict(zip(names, own.constants.tolist(), strict=True)),
        steps=steps,
        knots=knots,
        series=series,
    )

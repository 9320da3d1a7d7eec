"""Many motions of one system, with different parameters and start values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr
from polhode.base import Progress, Shown, SilentProgress, extra, look_up
from polhode.study._columns import Array, Column, Name, members_of, random_seed, whole
from polhode.study._compute import in_shares
from polhode.study._ensemble_runner import EnsembleSpec, Reason, Subject, options_of
from polhode.study._grid import start_name
from polhode.study._output import Output, Quantity
from polhode.study._outputs import outputs_of
from polhode.study._refused import refuse_mistakes

if TYPE_CHECKING:
    import xarray

#: The default outputs.
USUAL = ("mode",)


@dataclass(frozen=True, repr=False)
class Ensemble(Shown):
    """Results of many motions; `ensemble[name]` is one output of all members.

    Attributes:
        values: by output, shape (members, *shape of the output); not-a-number, and -1 for codes,
            of members without a result.
        labels: meanings of the codes, for outputs that are codes.
        reason: a `Reason` per member, 0 for those simulated to their end.
        failures: why members failed, in words, for the first thousand.
        numbers: parameters and start values that differ, shape (members,), as given; one with the
            same name as an output is called `..._start`.
        seed: of the random values.
    """

    values: Mapping[str, Array]
    labels: Mapping[str, tuple[str, ...]]
    reason: NDArray[np.int8]
    failures: Mapping[int, str]
    numbers: Mapping[str, Column]
    seed: int

    def __len__(self) -> int:
        return len(self.reason)

    def __repr__(self) -> str:
        return f"Ensemble of {len(self)} members, {self.failed} failed: {', '.join(self.values)}"

    def __getitem__(self, name: str) -> Array:
        """One output, or parameter or start value that differs, of all members.

        Raises:
            DeclarationError: for an unknown name.
        """
        known = {**{n: column.values for n, column in self.numbers.items()}, **self.values}
        return look_up(name, known, "output of this ensemble")

    @property
    def done(self) -> NDArray[np.bool_]:
        """Which members were simulated to their end, shape (members,)."""
        return np.asarray(self.reason == Reason.DONE)

    @property
    def failed(self) -> int:
        """How many members have no result."""
        return int(np.sum(~self.done))

    def named(self, name: str) -> list[str]:
        """An output that is a code, in words; "" where there is no result.

        Raises:
            DeclarationError: for an output that is not a code.
        """
        words = look_up(name, self.labels, "output of this ensemble that is a code")
        return [words[int(code)] if code >= 0 else "" for code in self.values[name].ravel()]

    def to_xarray(self) -> xarray.Dataset:
        """The ensemble as an xarray data set over the dimension `member`.

        Raises:
            StoreError: where xarray is not installed.
        """
        with extra("xarray", "study"):
            import xarray
        columns = {
            name: (
                ("member", *(f"{name}_{axis}" for axis in range(values.ndim - 1))),
                values,
                {"labels": list(self.labels[name])} if name in self.labels else {},
            )
            for name, values in self.values.items()
        }
        numbers = {
            name: ("member", column.values, {"units": column.unit} if column.unit else {})
            for name, column in self.numbers.items()
        }
        reason = {"reason": ("member", self.reason)}
        return xarray.Dataset({**columns, **reason}, coords=numbers, attrs={"seed": self.seed})


def ensemble(
    subject: Subject,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    outputs: Mapping[str, Output | Quantity] | Sequence[Output | Quantity] = USUAL,
    count: int | None = None,
    seed: int | None = None,
    workers: int = 1,
    forcing: Mapping[Name, Any] | None = None,
    tolerance: float | None = None,
    near_flat: float | None = None,
    until: Sequence[str] | None = None,
    events: Mapping[str, Expr] | None = None,
    progress: Progress | None = None,
) -> Ensemble:
    """Simulate many motions, through their contact modes, and keep chosen outputs of each.

    The results are those of `simulate` for the same numbers. A member that fails is recorded with
    the reason, and the others continue.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        parameters: the value of every parameter: one for all, or an array with one per member,
            or a distribution of scipy.stats. Arrays and distributions that are not in SI units
            come with their unit: `(values, "deg")`.
        start: coordinates and speeds, likewise.
        duration: s.
        outputs: results to keep, by name. A quantity alone stands for its value at the end, "mode"
            for the mode at the end.
        count: number of members, unless an array gives it.
        seed: of random values; by default a new one. Every quantity has its own random numbers,
            which depend on the seed and its name alone.
        workers: number of worker processes.
        until: events that end a motion, such as "slips", or names of those in `events`.
        forcing, tolerance, near_flat, events: as in `simulate`.
        progress: called for every member.

    Raises:
        DeclarationError: for ambiguous members or outputs.
        NumericError: for an invalid tolerance.
        UnitError: for a duration that cannot be read.
    """
    chosen_seed = random_seed(seed)
    size = None if count is None else whole(count, "members")
    members = members_of(parameters, start, size, chosen_seed)
    options = options_of(
        forcing=forcing, tolerance=tolerance, near_flat=near_flat, until=until, events=events
    )
    spec = EnsembleSpec(subject, duration, outputs_of(outputs), options)
    refuse_mistakes(spec, members.parameters, members.start)
    whole(workers, "workers")
    shown = progress or SilentProgress()
    shown.begin("members", members.count)
    try:
        results = in_shares(spec, members, workers, shown.advance)
    finally:
        shown.finish()
    labels = {name: output.labels(spec.legend) for name, output in spec.outputs.items()}
    return Ensemble(
        values=results.values,
        labels={name: words for name, words in labels.items() if words},
        reason=results.reason,
        failures=results.failures,
        numbers={start_name(n, spec.outputs): c for n, c in members.columns.items()},
        seed=chosen_seed,
    )

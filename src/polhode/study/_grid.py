"""The axes of a sweep, and the members of each of its chunks."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import product
from math import ceil, prod
from typing import Any

import numpy as np

from polhode.base import DeclarationError
from polhode.study._columns import (
    Column,
    Distribution,
    Members,
    Name,
    drawn,
    is_many,
    published_names,
    split_unit,
    whole,
)

SAMPLE = "sample"
"""The axis of random values."""

_LEAST_IN_CHUNK = 64  # members: fewer do not fill a batch
_MOST_IN_CHUNK = 1024  # members whose results are lost if the sweep is killed
_CHUNKS = 64  # of a whole sweep, if their size allows: enough to share among workers


@dataclass(frozen=True)
class Grid:
    """Every combination of the values of some axes.

    Attributes:
        columns: values of every quantity that differs, by published name.
        called: names of these values in the results.
        axis: name of the axis of each: its own, or that of the samples.
        chunk: members of a chunk along every axis.
    """

    columns: Mapping[str, Column]
    called: Mapping[str, str]
    axis: Mapping[str, str]
    chunk: tuple[int, ...]

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes, in order."""
        return tuple(dict.fromkeys(self.axis.values()))

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes."""
        lengths = {self.axis[name]: len(column.values) for name, column in self.columns.items()}
        return tuple(lengths[axis] for axis in self.axes)

    @property
    def size(self) -> int:
        """How many members there are."""
        return prod(self.shape)

    @property
    def chunks(self) -> tuple[int, ...]:
        """How many chunks there are along every axis."""
        return tuple(ceil(n / c) for n, c in zip(self.shape, self.chunk, strict=True))

    def places(self) -> list[tuple[int, ...]]:
        """Indices of all chunks in the grid of chunks, in order."""
        return list(product(*(range(n) for n in self.chunks)))

    def region(self, place: tuple[int, ...]) -> tuple[slice, ...]:
        """The part of the grid that a chunk covers."""
        ends = zip(place, self.chunk, self.shape, strict=True)
        return tuple(slice(p * c, min((p + 1) * c, n)) for p, c, n in ends)

    def members(
        self, place: tuple[int, ...], parameters: Mapping[str, Any], start: Mapping[str, Any]
    ) -> Members:
        """The members of a chunk, in the order of its elements.

        Args:
            parameters: their common values; axes replace them.
            start: likewise; an axis that is not a parameter is a start value.
        """
        rows = np.meshgrid(*(np.arange(r.start, r.stop) for r in self.region(place)), indexing="ij")
        along = dict(zip(self.axes, (row.ravel() for row in rows), strict=True))
        own = {n: column.rows(along[self.axis[n]]) for n, column in self.columns.items()}
        return Members(
            rows[0].size,
            {n: own.pop(n, value) for n, value in parameters.items()},
            {**start, **own},
        )


def grid_of(
    axes: Mapping[Name, Any],
    samples: int | None,
    seed: int,
    chunk: int | None,
    outputs: Collection[str] = (),
) -> Grid:
    """The grid over arrays and distributions.

    Args:
        samples: number of values drawn from distributions.
        chunk: approximate number of members of a chunk.

    Raises:
        DeclarationError: for an axis that is neither, or is empty.
    """
    given = published_names(axes)
    columns = {name: _column(name, value, samples, seed) for name, value in given.items()}
    called = {name: start_name(name, outputs) for name in columns}
    axis = {
        name: SAMPLE if isinstance(split_unit(given[name])[0], Distribution) else called[name]
        for name in columns
    }
    if not columns:
        raise DeclarationError("no axes", expected="at least one quantity that differs")
    if chunk is not None:
        whole(chunk, "members in a chunk")
    single = Grid(columns, called, axis, (1,) * len(set(axis.values())))
    whole(single.size, "members of a sweep")
    return Grid(columns, called, axis, _chunk(single.shape, chunk))


def _column(name: str, value: Any, samples: int | None, seed: int) -> Column:
    many, unit = split_unit(value)
    if isinstance(many, Distribution):
        if samples is None or samples < 1:
            raise DeclarationError(
                f"random values of {name} without their number",
                expected="samples=, at least one",
            )
        return Column(drawn(name, many, samples, seed), unit)
    values = np.asarray(many) if is_many(many) else np.empty(0)
    if values.ndim != 1 or not len(values) or values.dtype.kind not in "fiu":
        raise DeclarationError(
            f"the axis {name} = {value!r}"[:200],
            expected="a list or array of numbers, or a distribution of scipy.stats",
            advice="give the unit of the numbers beside them, as in (values, 'deg')",
        )
    return Column(values.astype(float), unit)


def _chunk(shape: tuple[int, ...], wanted: int | None) -> tuple[int, ...]:
    """Lengths of a chunk along the axes, as equal as the axes allow."""
    usual = min(max(prod(shape) // _CHUNKS, _LEAST_IN_CHUNK), _MOST_IN_CHUNK)
    left = wanted or usual
    lengths = dict[int, int]()
    # Shortest axis first: what it cannot take of its share goes to the longer ones.
    for rank, axis in enumerate(sorted(range(len(shape)), key=lambda i: shape[i])):
        side = max(1, round(left ** (1 / (len(shape) - rank))))
        lengths[axis] = min(side, shape[axis])
        left = max(1, left // lengths[axis])
    return tuple(lengths[i] for i in range(len(shape)))


def start_name(name: str, outputs: Collection[str]) -> str:
    """The name of given values in the results, distinct from an output of the final value."""
    return f"{name}_start" if name in outputs else name


def split_axes(names: Collection[str], parameters: Collection[str]) -> tuple[list[str], list[str]]:
    """Axes that are parameters, and those that are start values."""
    return [n for n in names if n in parameters], [n for n in names if n not in parameters]

"""The values of an ensemble: common to all members, or one per member."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from numbers import Integral
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import DeclarationError, read_quantity

Array: TypeAlias = NDArray[np.float64]
Name: TypeAlias = str | Symbol | Expr

_MOST = 100_000_000  # members of one study: their numbers alone take gigabytes


def whole(value: Any, what: str, least: int = 1) -> int:
    """A whole number that counts something.

    Raises:
        DeclarationError: for anything else.
    """
    counts = isinstance(value, Integral) and not isinstance(value, bool)
    if not counts or not least <= value <= _MOST:
        raise DeclarationError(
            f"{value!r} {what}", expected=f"a whole number from {least} to {_MOST}"
        )
    return int(value)


def random_seed(seed: int | None) -> int:
    """The given seed, or a new one.

    Raises:
        DeclarationError: for a seed that is not a whole number, zero or more.
    """
    if seed is None:
        # short enough for a signed 64-bit integer
        return int(np.random.SeedSequence().entropy) % 2**62  # type: ignore[arg-type]
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise DeclarationError(f"the seed {seed!r}", expected="a whole number, zero or more")
    return int(seed)


def several(names: Sequence[Name] | Name, what: str) -> tuple[Name, ...]:
    """Names given as a sequence, or a single name.

    Raises:
        DeclarationError: for an empty sequence.
    """
    every = (names,) if isinstance(names, Name) else tuple(names)
    if not every:
        raise DeclarationError(f"nothing {what}", expected="at least one name")
    return every


@runtime_checkable
class Distribution(Protocol):
    """A source of random values, such as a frozen distribution of scipy.stats."""

    def rvs(self, *, size: int, random_state: np.random.Generator) -> Any:
        """As many values as `size`."""


@dataclass(frozen=True)
class Column:
    """One value per member, in the order of the members.

    Attributes:
        values: numbers, or texts with a unit.
        unit: of the numbers; empty for SI.
    """

    values: NDArray[Any]
    unit: str = ""

    def value(self, member: int) -> Any:
        """The value of one member, as `simulate` takes it."""
        value = self.values[member].item()
        return (value, self.unit) if self.unit else value

    @property
    def si(self) -> Array:
        """The numbers in SI units."""
        factor = read_quantity(f"1 {self.unit}").value if self.unit else 1.0
        return np.asarray(self.values, dtype=float) * factor

    def rows(self, rows: slice | NDArray[np.intp]) -> Column:
        """The column of some members."""
        return replace(self, values=self.values[rows])


@dataclass(frozen=True)
class Members:
    """The numbers of every member, by published name.

    Attributes:
        count: of members.
        parameters: a `Column` where members differ, otherwise the common value.
        start: likewise.
    """

    count: int
    parameters: Mapping[str, Any]
    start: Mapping[str, Any]

    def parameters_of(self, member: int) -> dict[Any, Any]:
        """The parameters of one member."""
        return _of(self.parameters, member)

    def start_of(self, member: int) -> dict[Any, Any]:
        """The start values of one member."""
        return _of(self.start, member)

    def rows(self, rows: slice | NDArray[np.intp]) -> Members:
        """Some of the members."""
        count = len(np.arange(self.count)[rows])
        return Members(count, _rows(self.parameters, rows), _rows(self.start, rows))

    def si_columns(self) -> dict[str, Array] | None:
        """SI values of the columns, by name; None if any holds texts."""
        columns = self.columns
        if any(column.values.dtype.kind == "U" for column in columns.values()):
            return None
        return {name: column.si for name, column in columns.items()}

    @property
    def has_expressions(self) -> bool:
        """Whether a common value may depend on those that differ."""
        return any(isinstance(v, Expr) for v in (*self.parameters.values(), *self.start.values()))

    @property
    def columns(self) -> dict[str, Column]:
        """The values that differ, by name."""
        both = {**self.parameters, **self.start}
        return {name: value for name, value in both.items() if isinstance(value, Column)}


def _of(values: Mapping[str, Any], member: int) -> dict[Any, Any]:
    return {n: v.value(member) if isinstance(v, Column) else v for n, v in values.items()}


def _rows(values: Mapping[str, Any], rows: slice | NDArray[np.intp]) -> dict[str, Any]:
    return {n: v.rows(rows) if isinstance(v, Column) else v for n, v in values.items()}


def members_of(
    parameters: Mapping[Name, Any], start: Mapping[Name, Any], count: int | None, seed: int
) -> Members:
    """Members from arrays, distributions and single values.

    Raises:
        DeclarationError: unless arrays and count agree on the number of members.
    """
    given = (published_names(parameters), published_names(start))
    size = _count([*given[0].items(), *given[1].items()], count)
    read = ({n: _column(n, v, size, seed) for n, v in part.items()} for part in given)
    return Members(size, *read)


def published_names(values: Mapping[Name, Any]) -> dict[str, Any]:
    """Values by the published names of their quantities."""
    return {k if isinstance(k, str) else as_symbol(k).published: v for k, v in values.items()}


def drawn(name: str, distribution: Distribution, count: int, seed: int) -> Array:
    """Values from a distribution.

    They depend on the seed and the name alone, not on other random values.
    """
    # The name seeds too: adding a random quantity must not change the values of the others.
    generator = np.random.default_rng([seed, *name.encode()])
    return np.asarray(distribution.rvs(size=count, random_state=generator), dtype=float)


def split_unit(value: Any) -> tuple[Any, str]:
    """Many values and their unit; empty for SI."""
    match value:
        case (values, str(unit)) if is_many(values) or isinstance(values, Distribution):
            return values, unit
        case _:
            return value, ""


def is_many(value: Any) -> bool:
    """Whether these are values of several members."""
    return isinstance(value, list | range) or (isinstance(value, np.ndarray) and value.ndim > 0)


def _count(given: Iterable[tuple[str, Any]], count: int | None) -> int:
    lengths = {n: len(v) for n, value in given if is_many(v := split_unit(value)[0])}
    sizes = {*lengths.values(), *([count] if count is not None else [])}
    if len(sizes) == 1 and (size := sizes.pop()) > 0:
        return int(size)
    if not sizes:
        raise DeclarationError(
            "an ensemble with an unknown number of members",
            expected="an array of values, or count=",
            advice="add count=1000, for instance",
        )
    given_lengths = ", ".join(f"{n}: {length}" for n, length in lengths.items())
    raise DeclarationError(
        f"arrays and a count that do not agree ({given_lengths or 'none'}; count: {count})",
        expected="the same length for all of them, at least one",
    )


def _column(name: str, value: Any, count: int, seed: int) -> Any:
    many, unit = split_unit(value)
    if isinstance(many, Distribution):
        return Column(drawn(name, many, count, seed), unit)
    if not is_many(many):
        return value
    values = np.asarray(many)
    if values.ndim != 1 or values.dtype.kind not in "fiuU":
        raise DeclarationError(
            f"{name}: an array of shape {values.shape} and type {values.dtype}",
            expected="one number per member, or one text with a unit",
        )
    return Column(values, unit)

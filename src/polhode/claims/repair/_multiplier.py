"""By what a place in a formula would have to be multiplied for the claim to hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import compress

import numpy as np

from polhode.claims.latex._tree import Node
from polhode.claims.states._numeric import Array

_CLOSE = 1e-8
_STEPS = 25
_LARGEST = 60
_SETTLED = 1e-14
_QUOTIENTS = (Fraction(n, d) for n in range(1, 5) for d in range(1, 5) if n != d)
_TRIED = (Fraction(-1), Fraction(0), *dict.fromkeys(_QUOTIENTS))
_PROBES = (1.0, 1.25, *map(float, _TRIED))


@dataclass(frozen=True, eq=False)
class Response:
    """How what must vanish changes with a factor put at a place.

    Attributes:
        changing: those rows that may change, (rows, trials, states), by the factor in every trial
            at every state.
        rows: which of all they are.
        before: all rows as they are: (rows, states).
    """

    changing: Callable[[Array], Array]
    rows: tuple[int, ...]
    before: Array

    def __call__(self, factors: Array) -> Array:
        """The changing rows, with arithmetic that may fail at a state."""
        with np.errstate(all="ignore"):
            return self.changing(factors)

    @cached_property
    def probed(self) -> Array:
        """The changing rows for some factors that are the same at all states, all at once."""
        return self(np.outer(_PROBES, np.ones(self.states)))

    def among(self, kept: Sequence[int]) -> Response | None:
        """The same with some of all rows alone; None where none of those changes."""
        places = [k for k, row in enumerate(self.rows) if row in kept]
        if len(kept) == len(self.before):
            return self
        if not places:
            return None
        rows = tuple(kept.index(self.rows[k]) for k in places)
        return _Part(lambda at: self.changing(at)[places], rows, self.before[kept], self, places)

    @cached_property
    def moved(self) -> tuple[int, ...]:
        """Which of all rows do change."""
        away = np.abs(self.probed - self.probed[:, :1])
        still = np.asarray((away <= _CLOSE * (1 + np.abs(self.probed))).all(axis=(1, 2)))
        return tuple(row for row, stays in zip(self.rows, still, strict=True) if not stays)

    @property
    def here(self) -> Array:
        """The changing rows for a factor one: (rows, states)."""
        return np.asarray(self.probed[:, 0])

    @property
    def states(self) -> int:
        """At how many states it is known."""
        return int(self.before.shape[1])

    @property
    def is_faithful(self) -> bool:
        """Whether a factor one changes nothing."""
        known = self.before[list(self.rows)]
        if self.here.shape != known.shape:
            return False
        return bool((np.abs(self.here - known) <= _CLOSE * (1 + np.abs(known))).all())

    @cached_property
    def change(self) -> Array | None:
        """Change of the changing rows per unit of the factor, where that is the same for any."""
        one, two, three = (self.probed[:, _PROBES.index(x)] for x in (1.0, 2.0, 3.0))
        change = two - one
        straight = np.abs(three - two - change) <= _CLOSE * (np.abs(one) + np.abs(three))
        if not np.isfinite(change).all() or not straight.all() or not change.any():
            return None
        return np.asarray(change)

    def slope(self) -> Array | None:
        """The same of all rows."""
        if self.change is None:
            return None
        whole = np.zeros_like(self.before)
        whole[list(self.rows)] = self.change
        return whole

    @cached_property
    def multiplier(self) -> Array | None:
        """The factor at every state at which all vanishes, by secants from one; None without one.

        A residual that no factor changes must vanish already.
        """
        here, there = self.here, self.probed[:, _PROBES.index(1.25)]
        size = np.abs(here) + np.abs(there)
        row = int(np.argmax(np.abs(here - there).min(axis=1)))
        if not np.isfinite(here).all() or not np.abs(here - there)[row].all():
            return None
        change = self.change
        at = 1 - here[row] / change[row] if change is not None else _by_secants(self, row)
        here = self(at[None])[:, 0]
        scale = size.max(axis=1, keepdims=True) + np.abs(at)
        vanishes = np.isfinite(here).all() and (np.abs(here) <= _CLOSE * scale).all()
        return at if vanishes else None


@dataclass(frozen=True, eq=False)
class _Part(Response):
    """Some rows of a response.

    Attributes:
        whole: the response.
        places: which of its rows.
    """

    whole: Response
    places: list[int]

    @cached_property
    def probed(self) -> Array:
        """The same rows of what is known of the whole."""
        return np.asarray(self.whole.probed[self.places])


def _by_secants(response: Response, row: int) -> Array:
    """Where one row vanishes, as nearly as that can be found."""
    here, there = (response.probed[row, _PROBES.index(x)] for x in (1.0, 1.25))
    at, before = np.full(response.states, 1.0), np.full(response.states, 1.25)
    for _ in range(_STEPS):
        with np.errstate(all="ignore"):
            step = here * (at - before) / (here - there)
        step = np.where(here == 0, 0.0, step)
        if not np.isfinite(step).all():
            break
        before, there = at, here
        at = at - step
        if (np.abs(step) < _SETTLED * (1 + np.abs(at))).all():
            break
        here = response(at[None])[row, 0]
    return at


def simple_numbers(response: Response) -> Iterator[Fraction]:
    """The simple factors at which all vanishes; what is not linear may have several."""
    size = np.abs(response.here).max(axis=1) + 1
    tried = response.probed[:, -len(_TRIED) :]
    vanishes = np.isfinite(tried) & (np.abs(tried) <= _CLOSE * size[:, None, None])
    yield from compress(_TRIED, vanishes.all(axis=(0, 2)))


@dataclass(frozen=True)
class Match:
    """A number times powers of known quantities that a factor equals at every state.

    Attributes:
        number: the number.
        powers: nodes and their powers.
    """

    number: Fraction
    powers: tuple[tuple[Node, int], ...] = ()

    @property
    def size(self) -> int:
        """How much it says: powers counted, and a number other than one."""
        number = self.number != 1
        return sum(abs(power) for _, power in self.powers) + number + (self.number.denominator > 1)


def simple_number(values: Array) -> Fraction | None:
    """The simple rational number that all values are, if they are."""
    first = float(values[0])
    if not np.ptp(values) <= _CLOSE * abs(first) + 1e-10:
        return None
    number = Fraction(first).limit_denominator(_LARGEST)
    close = abs(float(number) - first) <= _CLOSE * max(1.0, abs(first))
    return number if close and abs(number.numerator) <= _LARGEST else None

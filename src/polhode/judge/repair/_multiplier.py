"""The factor by which a place in a formula has to be multiplied for the claim to hold.

It is found as one number per sample point, then matched with numbers and products of known letters
that take the same values.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations_with_replacement, compress
from operator import attrgetter

import numpy as np

from polhode.judge.latex._tree import Node
from polhode.judge.states._numeric import Array

_CLOSE = 1e-8  # relative; half the digits of a double, the rest may be lost in long residuals
_NOTICED = 1e-6  # a residual above this does not vanish by another factor that leaves it alone
_STEPS = 25  # of the secant method
_LARGEST = 60  # numerator or denominator of a simple number
_GRID = 2.0 ** np.arange(-6, 6.5, 0.5)  # factors at which a change of sign is sought
_PARTS = 64  # into which the distance between two of them is divided, and how often
_DIVISIONS = 8
_CONVERGED = 1e-14  # relative step at which the secant method ends
_QUOTIENTS = (Fraction(n, d) for n in range(1, 5) for d in range(1, 5) if n != d)
_TRIED = (Fraction(-1), Fraction(0), *dict.fromkeys(_QUOTIENTS))
# Factors at which a residual is computed: 1 and 1.25 start the secant method, 1, 2 and 3 show
# whether it is linear, and the others are the numbers that authors most often get wrong.
_PROBES = (1.0, 1.25, *map(float, _TRIED))
_MOST_LETTERS = 40  # letters of which triples are formed: some 12 000 products
_MOST_TOGETHER = 3
_POWERS = (1, -1, 2, -2)
_NUMBER = 2  # letters that a number before others counts as: authors write ma² rather than 4I₁


@dataclass(frozen=True, eq=False)
class Response:
    """Residuals as a function of a factor put at a place.

    Attributes:
        changing: the residuals that may change, (rows, trials, states), from the factor in every
            trial at every state.
        rows: their numbers among all residuals.
        before: all residuals for a factor of one: (rows, states).
    """

    changing: Callable[[Array], Array]
    rows: tuple[int, ...]
    before: Array

    def __call__(self, factors: Array) -> Array:
        """The changing residuals; nan at states where arithmetic fails."""
        with np.errstate(all="ignore"):
            return self.changing(factors)

    @cached_property
    def probed(self) -> Array:
        """The changing residuals for the factors `_PROBES`, the same at all states."""
        return self(np.outer(_PROBES, np.ones(self.states)))

    def among(self, kept: Sequence[int]) -> Response | None:
        """The response of some residuals only; None if none of those changes."""
        places = [k for k, row in enumerate(self.rows) if row in kept]
        if len(kept) == len(self.before):
            return self
        if not places:
            return None
        rows = tuple(kept.index(self.rows[k]) for k in places)
        return _Part(lambda at: self.changing(at)[places], rows, self.before[kept], self, places)

    @cached_property
    def affected(self) -> tuple[int, ...]:
        """The numbers of the residuals that do change."""
        change = np.abs(self.probed - self.probed[:, :1])
        constant = np.asarray((change <= _CLOSE * (1 + np.abs(self.probed))).all(axis=(1, 2)))
        return tuple(row for row, stays in zip(self.rows, constant, strict=True) if not stays)

    @property
    def here(self) -> Array:
        """The changing residuals for a factor of one: (rows, states)."""
        return np.asarray(self.probed[:, 0])

    @property
    def states(self) -> int:
        """The number of states."""
        return int(self.before.shape[1])

    @property
    def is_faithful(self) -> bool:
        """Whether a factor of one gives the residuals back: a check on evaluation by numbers."""
        known = self.before[list(self.rows)]
        if self.here.shape != known.shape:
            return False
        return bool((np.abs(self.here - known) <= _CLOSE * (1 + np.abs(known))).all())

    @cached_property
    def change(self) -> Array | None:
        """Change of the changing residuals per unit of the factor; None if it is not linear."""
        one, two, three = (self.probed[:, _PROBES.index(x)] for x in (1.0, 2.0, 3.0))
        change = two - one
        straight = np.abs(three - two - change) <= _CLOSE * (np.abs(one) + np.abs(three))
        if not np.isfinite(change).all() or not straight.all() or not change.any():
            return None
        return np.asarray(change)

    def slope(self) -> Array | None:
        """Change of all residuals per unit of the factor; None if it is not linear."""
        if self.change is None:
            return None
        whole = np.zeros_like(self.before)
        whole[list(self.rows)] = self.change
        return whole

    @cached_property
    def multiplier(self) -> Array | None:
        """The factor, state by state, with which all residuals vanish; None without one.

        It is solved from the residual that depends on it most clearly, by its slope or by secants,
        and must then make the others vanish too.
        """
        here, there = self.here, self.probed[:, _PROBES.index(1.25)]
        size = np.abs(here) + np.abs(there)
        row = int(np.argmax(np.abs(here - there).min(axis=1)))
        if not np.isfinite(here).all() or not np.abs(here - there)[row].all():
            return None
        unmoved = ~np.isin(self.rows, self.affected)
        if np.abs(here[unmoved]).max(initial=0.0) > _NOTICED:
            return None
        for at in self._roots(row):
            left = self(at[None])[:, 0]
            scale = size.max(axis=1, keepdims=True) + np.abs(at)
            if np.isfinite(left).all() and (np.abs(left) <= _CLOSE * scale).all():
                return at
        return None

    def _roots(self, row: int) -> Iterator[Array]:
        """Factors with which one residual may vanish, state by state."""
        if self.change is not None:
            yield np.asarray(1 - self.here[row] / self.change[row])
            return
        yield _by_secants(self, row)
        found = _by_division(self, row)
        if found is not None:
            yield found


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
        """The same rows of the probes of the whole, which need not be computed again."""
        return np.asarray(self.whole.probed[self.places])


def _by_secants(response: Response, row: int) -> Array:
    """The factor with which one residual vanishes, state by state, by the secant method."""
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
        if (np.abs(step) < _CONVERGED * (1 + np.abs(at))).all():
            break
        here = response(at[None])[row, 0]
    return at


def _by_division(response: Response, row: int) -> Array | None:
    """The same, where one residual changes its sign nearest to a factor of one; None without it."""
    tried = response(np.outer(_GRID, np.ones(response.states)))[row]
    turns = (np.sign(tried[1:]) != np.sign(tried[:-1])) & np.isfinite(tried[1:] + tried[:-1])
    if not turns.any(axis=0).all():
        return None
    away = np.abs(np.arange(len(_GRID) - 1) - (len(_GRID) - 2) / 2)
    first = np.where(turns, away[:, None], np.inf).argmin(axis=0)
    low, high = _GRID[first], _GRID[first + 1]
    sign = np.sign(np.take_along_axis(tried, first[None], axis=0))
    for _ in range(_DIVISIONS):
        ends = np.linspace(low, high, _PARTS + 1)
        turned = np.sign(response(ends[1:-1])[row]) != sign
        first = np.vstack([turned, np.full_like(turned[:1], True)]).argmax(axis=0)[None]
        low, high = (np.take_along_axis(ends, place, axis=0)[0] for place in (first, first + 1))
    return np.asarray((low + high) / 2)


def simple_numbers(response: Response) -> Iterator[Fraction]:
    """The simple factors with which all residuals vanish; several where they are not linear."""
    size = np.abs(response.here).max(axis=1) + 1
    tried = response.probed[:, -len(_TRIED) :]
    vanishes = np.isfinite(tried) & (np.abs(tried) <= _CLOSE * size[:, None, None])
    yield from compress(_TRIED, vanishes.all(axis=(0, 2)))


@dataclass(frozen=True)
class Match:
    """A number times powers of known quantities, equal to a factor at every state.

    Attributes:
        number: the number.
        powers: nodes and their powers.
    """

    number: Fraction
    powers: tuple[tuple[Node, int], ...] = ()

    @property
    def size(self) -> int:
        """Its length: the powers, more for a number other than ±1, and one for a fraction."""
        letters = sum(abs(power) for _, power in self.powers)
        number = _NUMBER * (abs(self.number) != 1 and bool(self.powers)) + (self.number != 1)
        return letters + number + (self.number.denominator > 1)


def simple_number(values: Array) -> Fraction | None:
    """The simple rational number that all values equal; None without one."""
    first = float(values[0])
    if not np.ptp(values) <= _CLOSE * abs(first) + 1e-10:
        return None
    number = Fraction(first).limit_denominator(_LARGEST)
    close = abs(float(number) - first) <= _CLOSE * max(1.0, abs(first))
    return number if close and abs(number.numerator) <= _LARGEST else None


# -- products of letters that equal a quantity at every state --------------------------------------


@dataclass(frozen=True, eq=False)
class Products:
    """All products that can be formed of some letters, at sample points.

    Attributes:
        known: letters with their values: (states,).
        numerator_only: those that may stand above a fraction line only.
    """

    known: Sequence[tuple[Node, Array]]
    numerator_only: Collection[Node] = ()

    def equal_to(self, amount: Array) -> Iterator[Match]:
        """A number times products of letters, the shortest first.

        Up to two letters may stand above or below; more of them, up to six, above only.
        """
        yield from list(self.short(amount)) or sorted(self._long(amount), key=attrgetter("size"))

    def short(self, amount: Array) -> Iterator[Match]:
        """A number times at most two letters, the simplest first."""
        number = simple_number(amount)
        if number is not None:
            yield Match(number)
        if number is not None or not self.known:
            return
        found: list[Match] = []
        for (i, j), number in _simple(amount, self._powered):
            if self._may_stand(self.known[i][0], _POWERS[j]):
                found.append(Match(number, ((self.known[i][0], _POWERS[j]),)))
        for (i, j), number in _simple(amount, self._table):
            (first, p), (second, q) = self._signed[i], self._signed[j]
            allowed = self._may_stand(first, p) and self._may_stand(second, q)
            if allowed and i < j and first != second:
                found.append(Match(number, ((first, p), (second, q))))
        yield from sorted(found, key=attrgetter("size"))

    # -- one letter or two -----------------------------------------------------------------------

    @cached_property
    def _values(self) -> Array:
        return np.array([values for _, values in self.known])

    def _may_stand(self, node: Node, power: int) -> bool:
        return power > 0 or node not in self.numerator_only

    @cached_property
    def _powered(self) -> Array:
        """Powers of the letters."""
        return np.asarray(self._values[:, None] ** np.array(_POWERS, dtype=float)[None, :, None])

    @cached_property
    def _signed(self) -> list[tuple[Node, int]]:
        return [(node, power) for power in (1, -1) for node, _ in self.known]

    @cached_property
    def _table(self) -> Array:
        """Products of two of the letters or of their reciprocals."""
        table = np.concatenate([self._values, 1 / self._values])
        return np.asarray(table[:, None] * table[None])

    # -- more of them ----------------------------------------------------------------------------

    def _long(self, amount: Array) -> Iterator[Match]:
        """Products of up to six letters, by meeting in the middle.

        The quotient of the amount by three letters must be the product of three others. Logarithms
        turn products into sums; the constant factor drops out and is found at the end.
        """
        if len(amount) < _MOST_TOGETHER or not amount.all() or not self.known:
            return
        few = self._few
        for one, other in few.pairs(_without_number(np.log(np.abs(amount)))):
            letters = sorted(i for i in (*few.letters[one], *few.letters[other]) if i)
            number = simple_number(amount / np.prod(few.values[letters], axis=0))
            if number:
                counted = Counter(few.nodes[i] for i in letters)
                yield Match(number, tuple(counted.items()))

    @cached_property
    def _few(self) -> _FewLetters:
        different = list({v.tobytes(): (n, v) for n, v in reversed(self.known)}.values())[::-1]
        kept = different[:_MOST_LETTERS]
        # A row of ones stands first as the empty letter, so that shorter products are included.
        values = np.array([np.ones_like(kept[0][1]), *(v for _, v in kept)])
        return _FewLetters([kept[0][0], *(n for n, _ in kept)], values)


class _FewLetters:
    """Products of up to three letters, by logarithms of their values and a random projection.

    The projection of a sum of vectors of logarithms is the sum of their projections. So the partner
    of each product is found by bisection among sorted numbers, then compared in full.
    """

    def __init__(self, nodes: Sequence[Node], values: Array) -> None:
        self.nodes, self.values = nodes, values
        self.letters = _combinations(len(values))
        self._sums = _without_number(np.log(np.abs(values)))[self.letters].sum(axis=1)
        self._weights = np.random.default_rng(1).uniform(1, 2, self._sums.shape[1])
        self._keys = self._sums @ self._weights
        self._order = np.argsort(self._keys)
        self._sorted = self._keys[self._order]

    def pairs(self, total: Array) -> Iterator[tuple[int, int]]:
        """Pairs of products whose logarithms add up to a total, each pair once."""
        keys = total @ self._weights - self._keys
        first = np.searchsorted(self._sorted, keys - _CLOSE)
        last = np.searchsorted(self._sorted, keys + _CLOSE)
        for one in np.flatnonzero(last > first):
            for other in self._order[first[one] : last[one]]:
                left = total - self._sums[one] - self._sums[other]
                if one <= other and np.abs(left).max() < _CLOSE:
                    yield int(one), int(other)


@lru_cache(maxsize=_MOST_LETTERS + 1)
def _combinations(count: int) -> Array:
    """Numbers of letters taken together, in order and with repetition: (combinations, letters)."""
    return np.array(list(combinations_with_replacement(range(count), _MOST_TOGETHER)))


def _simple(amount: Array, table: Array) -> Iterator[tuple[tuple[int, int], Fraction]]:
    """Entries of a table, (.., .., states), by which an amount is a simple number at all states."""
    # Two states rule out nearly all entries before the rest are compared.
    first, last = (amount[state] / table[:, :, state] for state in (0, -1))
    likely = np.abs(last - first) <= _CLOSE * np.abs(first)
    for i, j in zip(*np.nonzero(likely), strict=True):
        left = amount / table[i, j]
        constant = np.ptp(left) <= _CLOSE * abs(left[0])
        if constant and (number := simple_number(left)):
            yield (int(i), int(j)), number


def _without_number(logs: Array) -> Array:
    """Logarithms relative to those at the first state, so that a constant factor drops out."""
    return np.asarray(logs[..., 1:] - logs[..., :1])

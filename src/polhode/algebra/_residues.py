"""Values of expressions at random points of a large prime field.

A rational function that is not identically zero vanishes at a random point of the field with p
elements with a probability of at most its degree over p (J. T. Schwartz, J. ACM 27 (1980) 701;
R. Zippel, EUROSAM 1979). So one exact evaluation decides whether an expression is zero, however
long it would be if it were multiplied out. The degree is bounded along with the evaluation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from hashlib import blake2b
from itertools import combinations
from typing import Any, NamedTuple, TypeAlias

from flint import fmpq, fmpz_mod_ctx

from polhode.base import NumericError

#: p = 3251247560570427907450 · 4 · (2 · 3 · 5 ··· 43) - 1, a prime of 127 bits. Modulo a prime of
#: this form all whole numbers without larger factors than 43 have roots, and of x and -x just one.
PRIME = 170141183460469231730876442507114893999
_FIELD = fmpz_mod_ctx(PRIME)

Element: TypeAlias = Any  # flint.fmpz_mod: python-flint ships no usable type information

_MOST_ROOTS = 5  # of unknown sign; every combination of their signs is tried
_TRIES = 64  # points that are drawn until all roots exist
_HOPELESS = 16  # points after which one root that none of them has is taken to exist nowhere
_MEMORY = 65536  # values that a point remembers


class NoResidueError(NumericError):
    """An expression has no value at a point of the field."""

    def __init__(self, what: str) -> None:
        super().__init__(what, expected="a point of a prime field at which it has a value")


class Residue(NamedTuple):
    """A value in the field.

    Attributes:
        value: modulo `PRIME`.
        degree: at most this is the degree, above and below the bar, of the rational function of the
            drawn quantities whose value this is.
        roots: the keys of the roots of unknown sign that it depends on.
    """

    value: Element
    degree: int = 0
    roots: frozenset[str] = frozenset()


class FieldPoint:
    """A random value for everything that an expression may contain.

    Args:
        seed: equal seeds give equal values in every process, so that verdicts are reproducible.
        negative: the keys of the roots that are given their other sign.
    """

    def __init__(self, seed: str, negative: frozenset[str] = frozenset()) -> None:
        self.seed = seed
        self._negative = negative
        self._known: dict[Any, Residue] = {}
        self._radicands: dict[int, tuple[str, int]] = {}
        self._same_as: dict[str, tuple[str, int]] = {}

    def of(self, generator: Any) -> Residue:
        """The value of a generator."""
        known = self._known
        if generator not in known:
            found = self._found(generator)
            if len(known) >= _MEMORY:
                known.clear()
            known[generator] = found
        return known[generator]

    def _found(self, generator: Any) -> Residue:
        found: Residue = generator.residue(self)
        return found

    def drawn(self, key: str) -> Element:
        """A random element."""
        digest = blake2b(f"{self.seed} {key}".encode(), digest_size=24).digest()
        return _FIELD(int.from_bytes(digest, "big"))

    def root(self, key: str, radicand: Residue, *, is_number: bool) -> Residue:
        """A square root; raises `NoResidueError` where there is none.

        Roots whose radicands agree at the point have one sign: they are the same, written in two
        ways, such as with a named part and without.
        """
        found = _FIELD(pow(int(radicand.value), (PRIME + 1) // 4, PRIME))
        if found * found != radicand.value:
            raise NoResidueError(f"the root {key}")
        if is_number:
            return Residue(found, radicand.degree, radicand.roots)
        if not self._negative:
            first = self._radicands.setdefault(int(radicand.value), (key, radicand.degree))
            self._same_as[key] = first
        same, degree = self._same_as.get(key, (key, radicand.degree))
        if same != key:  # the difference of the radicands vanishes too, but for its degree over p
            degree += radicand.degree
        return Residue(-found if same in self._negative else found, degree, radicand.roots | {same})

    def branches(self, roots: frozenset[str]) -> Iterator[FieldPoint]:
        """The same point with every other choice of signs of some roots.

        Raises `NoResidueError` for more roots than are tried.
        """
        if len(roots) > _MOST_ROOTS:
            raise NoResidueError(f"an expression with {len(roots)} different roots")
        for count in range(1, len(roots) + 1):
            yield from (self.with_signs(frozenset(c)) for c in combinations(sorted(roots), count))

    def with_signs(self, negative: frozenset[str]) -> FieldPoint:
        """The same point with these roots given their other sign."""
        if negative not in self._others:
            self._others[negative] = self._remade(negative)
            self._others[negative]._same_as = self._same_as
        return self._others[negative]

    def _remade(self, negative: frozenset[str]) -> FieldPoint:
        return FieldPoint(self.seed, negative)

    @cached_property
    def _others(self) -> dict[frozenset[str], FieldPoint]:
        return {}


def element(numerator: int, denominator: int = 1) -> Element:
    """A rational number; raises `NoResidueError` where the prime divides it.

    Then a number that is not zero would be taken for zero.
    """
    above, below = _FIELD(numerator), _FIELD(denominator)
    if (above == 0 and numerator) or below == 0:
        raise NoResidueError(f"the number {numerator}/{denominator}")
    return above if denominator == 1 else above / below


def evaluated(polynomial: Any, values: Sequence[Element]) -> Element:
    """The value of a polynomial with rational coefficients.

    It is computed in whole numbers first: that is one call, where terms modulo the prime would each
    take several.

    Raises `NoResidueError` where the prime divides one of the coefficients.
    """
    for coefficient in polynomial.coeffs():
        if coefficient.p % PRIME == 0 or coefficient.q % PRIME == 0:
            raise NoResidueError(f"the number {coefficient}")
    exact = polynomial(*(fmpq(int(value)) for value in values))
    return _FIELD(int(exact.p)) / _FIELD(int(exact.q))


class Vanishing(NamedTuple):
    """Whether an expression vanishes.

    Attributes:
        is_zero: False is certain.
        error_bound: if `is_zero`, at least the probability that it nevertheless does not vanish.
    """

    is_zero: bool
    error_bound: float = 0.0


def vanishing(
    value: Callable[[FieldPoint], Residue], point: Callable[[int], FieldPoint]
) -> Vanishing:
    """Whether an expression vanishes identically, whatever the signs of its roots.

    With k roots the product of its 2^k conjugates is a rational function. It is evaluated at a
    point at which all radicands are squares, as they are at about one in 2^k: the bound is degree ·
    4^k / p.

    Args:
        value: of the expression at a point.
        point: the points, by number.

    Raises:
        NoResidueError: for an expression that has no value at any of the points tried. A root whose
            radicand is minus a square exists at none; another one is missing at 16 in a row with
            a probability of 2⁻¹⁶.
    """
    missing: set[str] = set()
    for number in range(_TRIES):
        if number >= _HOPELESS and len(missing) == 1:
            break
        chosen = point(number)
        try:
            found = value(chosen)
        except (NoResidueError, ZeroDivisionError) as error:
            missing.add(str(error))
            continue
        if found.value != 0:
            return Vanishing(False)
        if any(value(branch).value != 0 for branch in chosen.branches(found.roots)):
            return Vanishing(False)
        bound = found.degree * 4 ** len(found.roots) / PRIME
        if bound < 1:
            return Vanishing(True, bound)
        break
    raise NoResidueError("an expression of too high a degree, or with roots that no point has")

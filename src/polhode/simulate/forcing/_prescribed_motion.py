"""Prescribed motions as integrated: expressions of time, with constants between knots."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import inf
from typing import Any

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, time
from polhode.base import DeclarationError, look_up
from polhode.simulate._names import Name, by_name, published
from polhode.simulate.forcing._approximation import Approximation, approximated
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.integrate._stepping import Array


@dataclass(frozen=True)
class PrescribedMotion:
    """All prescribed functions of a system.

    Attributes:
        expressions: each as an expression of time, of parameters, and of coefficients that change
            at the knots.
        pieces: those that are polynomials between knots.
    """

    expressions: Mapping[Symbol, Expr]
    pieces: Mapping[Symbol, Pieces]

    def constants(self, now: float) -> Mapping[Symbol, float]:
        """The coefficients just after an instant: the same object until they change."""
        return self._held(bisect_right(self._times, now))

    @cached_property
    def _held(self) -> Callable[[int], Mapping[Symbol, float]]:
        # Few: the integrator goes from one stretch to the next and hardly ever back.
        return lru_cache(maxsize=4)(self._on_stretch)

    def _on_stretch(self, stretch: int) -> Mapping[Symbol, float]:
        """The coefficients between two changes; 0 is before the first."""
        now = self._times[stretch - 1] if stretch else -inf
        found: dict[Symbol, float] = {}
        for symbol, pieces in self.pieces.items():
            begin, coefficients = pieces.polynomial(pieces.piece(now))
            places = _coefficients(symbol, pieces)
            found[_begin(symbol)] = begin
            found |= dict.fromkeys(places, 0.0)
            found |= dict(zip(places, (float(c) for c in coefficients), strict=False))
        return found

    @cached_property
    def jerks(self) -> frozenset[float]:
        """Instants at which a velocity jumps, s."""
        return frozenset(jump.time for p in self.pieces.values() for jump in p.jumps)

    @cached_property
    def resolution(self) -> dict[str, float]:
        """Resolution of the functions that were given as Python functions, by name, s."""
        return {symbol.published: p.resolution for symbol, p in self._approximations.items()}

    def confirm(self, steps: Array) -> None:
        """Evaluate Python functions again, within the steps of a motion.

        Raises:
            NumericError: where one differs from the value that the motion was computed with.
        """
        for symbol, pieces in self._approximations.items():
            pieces.confirm(symbol.published, steps)

    @property
    def _approximations(self) -> dict[Symbol, Approximation]:
        return {s: p for s, p in self.pieces.items() if isinstance(p, Approximation)}

    def until(self, now: float, end: float) -> float:
        """The time until which the coefficients hold, at most the end, s."""
        place = bisect_right(self._times, now)
        return min(end, self._times[place]) if place < len(self._times) else end

    @cached_property
    def breaks(self) -> frozenset[float]:
        """Instants at which coefficients change, s."""
        return frozenset(t for p in self.pieces.values() for t in p.breaks)

    @cached_property
    def _times(self) -> list[float]:
        return sorted(self.breaks)

    def stretches(self, end: float) -> Iterator[tuple[float, float]]:
        """Intervals between changes of coefficients, from 0 to the end."""
        breaks = [t for t in self._times if 0 < t < end]
        yield from zip([0.0, *breaks], [*breaks, end], strict=True)


def prescribed_motion(
    functions: tuple[Symbol, ...], forcing: Mapping[Name, Any], duration: float
) -> PrescribedMotion:
    """Prescribed functions from an expression, samples or a callable for each.

    Raises:
        DeclarationError: for a function that is missing, unknown, or depends on the motion.
        NumericError: for a callable that is not smooth.
    """
    known = by_name(functions)
    given = {
        look_up(published(name), known, "prescribed function of this system"): motion
        for name, motion in forcing.items()
    }
    missing = [symbol.published for symbol in functions if symbol not in given]
    if missing:
        raise DeclarationError(
            f"no motion for {', '.join(missing)}",
            expected="an expression of time for every prescribed function",
            advice=f"add forcing={{'{missing[0]}': ...}} with an expression of polhode.time",
        )
    pieces = dict[Symbol, Pieces]()
    for symbol, motion in given.items():
        if isinstance(motion, Pieces):
            pieces[symbol] = motion
        elif callable(motion) and not isinstance(motion, Expr):
            pieces[symbol] = approximated(motion, 0.0, duration)
    plain = {s: _expression(s, motion) for s, motion in given.items() if s not in pieces}
    counted = {_since(s): time - Expr.generator(_begin(s)) for s in pieces}
    polynomials = dict[Symbol, Expr]()
    for symbol, p in pieces.items():
        # In powers of the time since the knot: these stay accurate for late knots, where a
        # polynomial in t itself would be the difference of large terms.
        since = Expr.generator(_since(symbol))
        powers = enumerate(_coefficients(symbol, p))
        polynomials[symbol] = sum((Expr.generator(c) * since**k for k, c in powers), ZERO)
    return PrescribedMotion({**plain, **polynomials, **counted}, pieces)


def _expression(symbol: Symbol, motion: Any) -> Expr:
    expression = Expr.of(motion)
    others = [
        s for s in expression.symbols() if s.kind not in (SymbolKind.TIME, SymbolKind.PARAMETER)
    ]
    if others:
        raise DeclarationError(
            f"the prescribed {symbol.published}(t) depends on {others[0].published}",
            expected="an expression of time and parameters",
            advice="a force that depends on the motion is a load of the system",
        )
    return expression


def _begin(symbol: Symbol) -> Symbol:
    return Symbol(f"{symbol.name} from", SymbolKind.PARAMETER)


def _since(symbol: Symbol) -> Symbol:
    """Time since the knot, as a symbol: powers of t multiplied out would cancel digits."""
    return Symbol(f"{symbol.name} since", SymbolKind.FUNCTION)


def _coefficients(symbol: Symbol, pieces: Pieces) -> list[Symbol]:
    count = max(2, pieces.coefficients.shape[1])
    return [Symbol(f"{symbol.name} coefficient {k}", SymbolKind.PARAMETER) for k in range(count)]

"""Taylor's method, compiled by heyoka."""

from __future__ import annotations

import sqlite3
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from copy import copy
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache as once
from functools import cached_property, lru_cache, partial
from itertools import count
from math import inf
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from polhode.algebra import Arithmetic, Program, SymbolKind
from polhode.base import StoreError, cache
from polhode.simulate.integrate._arrays import Array, powers_of
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._number_types import LongDoubles, NumberType, number
from polhode.simulate.integrate._series import (
    InitialValueProblem,
    SeriesCallback,
    TaylorSolution,
    limbs_of,
)
from polhode.simulate.integrate._stepping import (
    Leg,
    StepCallback,
    Stepper,
    broken,
    fewest_steps,
    longest_step,
)
from polhode.simulate.integrate._taylor import TaylorLeg, scales_of

# -- a solution as Taylor series, step by step -------------------------------------------------

_MISSED = 2  # units in the last place by which the sum of the steps may differ from the end


class TaylorSteps:
    """Collects the steps of one integration.

    Args:
        begin: of the first of them, s.
    """

    def __init__(self, begin: float) -> None:
        self._times = [(begin, 0.0)]
        self._lengths = list[float]()
        self._series = list[Array]()

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self._series)

    def add(self, end: tuple[float, float], length: float, series: Array) -> None:
        """Add a step.

        Args:
            end: its end as the sum of two doubles, s.
            length: s.
            series: Taylor coefficients about its beginning, shape (states, order + 1).
        """
        self._times.append(end)
        self._lengths.append(length)
        self._series.append(series.copy())

    def leg(self, goal: float, *, broken: bool) -> TaylorLeg:
        """All of them together.

        Args:
            goal: where they were to end, s. If they miss it by rounding only, they end there: an
                event at that instant would be missed otherwise.
        """
        times, rests = np.array(self._times).T
        if abs(times[-1] - goal) <= _MISSED * np.spacing(abs(goal)):
            times[-1], rests[-1] = goal, 0.0
        lengths = np.array(self._lengths)
        shares = np.array(self._series)
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            powers = powers_of(lengths, shares.shape[2] - 1).T
            np.multiply(
                shares[:, :, 1:], powers[:, None], out=shares[:, :, 1:], where=shares[:, :, 1:] != 0
            )
        return TaylorLeg(times, rests, lengths, shares, broken)


# Operations: longer programs are compiled in heyoka's compact mode. Unrolled, 400 operations take
# eight times as long to compile and 1700 twenty times, for steps that are 10 to 20 % faster.
_LONG = 300

# heyoka chooses a step by the last two coefficients alone. Where a motion starts from rest in a
# symmetric position, its series may have but every fourth power, and both vanish.
_LAST = 8
_LARGE = 2.0**6  # multiples of their size that are scaled anew: others would lose digits
_TOO_LONG = 2.0  # times the length over which the series has converged


def converged_length(series: Array) -> float:
    """The length of a step over which Taylor series have converged, from their last coefficients.

    The radius of convergence is estimated from each, (size/|c_k|)^(1/k); the optimal step is that
    over e² (Jorba and Zou, Experimental Mathematics 14, 2005).

    Args:
        series: coefficients, shape (states, order + 1).
    """
    largest = np.max(np.abs(series), axis=0)
    orders = np.arange(max(1, len(largest) - _LAST), len(largest))
    with np.errstate(all="ignore"):
        radii = (max(1.0, float(largest[0])) / largest[orders]) ** (1.0 / orders)
    return float(np.min(radii) / np.exp(2.0))


def first_step(series: Array, length: float) -> tuple[float, Array]:
    """What the series of a first step tell.

    Args:
        series: coefficients, shape (states, order + 1).
        length: of the step that heyoka chose, s.

    Returns:
        the longest step that can be relied on, s, infinite if that is the chosen one; and the sizes
        of the states within it.
    """
    converged = converged_length(series)
    is_too_long = length > _TOO_LONG * converged
    reached = converged if is_too_long else length
    with np.errstate(all="ignore"):
        terms = np.abs(series) * reached ** np.arange(series.shape[1])
    sizes = np.max(np.where(series == 0, 0.0, terms), axis=1, initial=0.0)
    return (converged if is_too_long else inf), sizes


_FINE = 2.0**-48  # s: a unit of time in which derivatives of high order are not too large


@dataclass(frozen=True)
class _Units:
    """Units in which a motion is integrated: powers of two, so that nothing is rounded.

    Attributes:
        states: of each state.
        time: s.
    """

    states: Array
    time: float = 1.0

    def natural(self, leg: TaylorLeg) -> TaylorLeg:
        """A leg in these units, in SI units."""
        return TaylorLeg(
            leg.times * self.time,
            leg.rests * self.time,
            leg.lengths * self.time,
            leg.shares * self.states[:, None],
            leg.broken,
        )


_importing = Lock()
_compiling = Lock()


class Taylor:
    """Adaptive Taylor series of high order, accurate to rounding.

    The flow is compiled without optimisation: compilation takes a tenth of the time, and a run of
    usual length takes hardly longer.
    """

    name = "heyoka"

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """Compile the core, once for all values of its parameters."""
        least = float(np.finfo(float).eps) if tolerance is None else tolerance
        stepper = _TaylorStepper(flow, least)
        stepper.integrator  # noqa: B018
        return stepper


@lru_cache(maxsize=64)
def _compiled(program: Program, size: int, tolerance: float, *, scaled: bool) -> Any:
    """An integrator that serves as a template: copies are integrated, since they hold a state.

    The limit bounds the memory of a long session with many systems; one system has fewer modes.
    """
    compiled = partial(
        library().taylor_adaptive,
        rates_of(program, size, float, scaled=scaled),
        [0.0] * size,
        tol=tolerance,
        opt_level=0,
        compact_mode=is_long(program),
    )
    try:
        return compiled()
    except RuntimeError:  # the cache of compiled code cannot be used: a disk error, or a busy one
        library().llvm_state.set_diskcache_enabled(False)
        return compiled()


def is_long(program: Program) -> bool:
    """Whether its unrolled code would need too much of the stack."""
    return program.operations > _LONG


def rates_of(
    program: Program, size: int, number: Callable[[Fraction], Any], *, scaled: bool = False
) -> list[Any]:
    """Pairs of state and rate as heyoka expressions, with symbolic parameters.

    Args:
        program: of the rates of its first arguments.
        size: how many states there are.
        number: what a constant is in the numbers that are integrated.
        scaled: whether the states are multiples of as many parameters, and the time is one of a
            further parameter; these come before all others.
    """
    heyoka = library()
    multiples = [heyoka.make_vars(f"x{i}") for i in range(size)]
    constants = (heyoka.par[i] for i in count())
    scales = [next(constants) for _ in multiples] if scaled else []
    states = [s * x for s, x in zip(scales, multiples, strict=True)] if scaled else multiples
    unit = next(constants) if scaled else None
    time = unit * heyoka.time if scaled else heyoka.time
    others = {SymbolKind.PARAMETER: lambda: next(constants), SymbolKind.TIME: lambda: time}
    given = [others.get(s.kind, lambda: 0.0)() for s in program.arguments[size:]]
    arithmetic = Arithmetic.of(heyoka, lambda value: heyoka.expression(number(value)))
    found = program.function(arithmetic)(*states, *given)
    rates = [heyoka.expression(rate) for rate in found]
    if scaled:
        rates = [unit * rate / scale for rate, scale in zip(rates, scales, strict=True)]
    return list(zip(multiples, rates, strict=True))


@dataclass(frozen=True)
class _TaylorStepper:
    flow: Flow
    tolerance: float
    scaled: bool = False

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        found = self._attempt(parameters, begin, state, end, watch)
        if found is None or found.broken:
            # Close to the end of a slip, or where everything is fast, the coefficients of high
            # order are beyond the largest double. In a finer unit of time they are not.
            now = begin if found is None else float(found.times[-1])
            there = state if found is None else found.at(found.times[-1:])[:, 0]
            units = _Units(np.ones(len(state)), _FINE)
            further = self._in_units(units, parameters, now, there, end, watch)
            if further is not None:
                found = further if found is None else found.then(further)
        if found is None:
            raise broken(begin)
        return found

    def _attempt(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> TaylorLeg | None:
        """A leg, as far as it goes; None if that is not even one step."""
        taylor = self.integrator
        taylor.time = begin
        taylor.state[:] = state
        taylor.pars[:] = parameters[: len(taylor.pars)]
        steps = TaylorSteps(begin)
        first: float = inf
        scales: Array | None = None
        symbols, is_driven = self.flow.core.symbols, self.flow.degree > 0

        def record(taylor: Any) -> bool:
            nonlocal first, scales
            if not steps.count and first == inf:
                first, sizes = first_step(taylor.tc, taylor.last_h)
                if not self.scaled:
                    scales = scales_of(symbols, state, sizes, is_driven=is_driven)
                if first < inf or scales is not None:
                    return False
            steps.add(taylor.dtime, taylor.last_h, taylor.tc)
            return watch(taylor.time, taylor.state.tolist())

        # A series that ends (a polynomial) would otherwise allow an infinite step.
        longest = longest_step(begin, end, fewest_steps(self.flow))
        outcome, *_ = taylor.propagate_until(
            end, max_delta_t=longest, write_tc=True, callback=record
        )
        if scales is not None:
            return self._in_units(_Units(scales), parameters, begin, state, end, watch)
        if not steps.count and outcome.name == "cb_stop":
            taylor.time = begin
            taylor.state[:] = state
            for until in (begin + first, end):
                if outcome.name == "cb_stop" and steps.count:
                    break
                outcome, *_ = taylor.propagate_until(
                    until, max_delta_t=longest, write_tc=True, callback=record
                )
        if not steps.count:
            return None
        return steps.leg(end, broken=outcome.name not in ("time_limit", "cb_stop"))

    @cached_property
    def integrator(self) -> Any:
        """One of its own: an integrator holds the state of its motion."""
        core = self.flow.core
        with _compiling:
            blank = _compiled(core.program, len(core.symbols), self.tolerance, scaled=self.scaled)
            return copy(blank)

    @cached_property
    def _with_units(self) -> _TaylorStepper:
        return replace(self, scaled=True)

    def _in_units(
        self,
        units: _Units,
        parameters: Array,
        begin: float,
        state: Array,
        end: float,
        watch: StepCallback,
    ) -> TaylorLeg | None:
        """A leg in other units; in those of small states, until the states are large."""

        def seen(time: float, state: list[float]) -> bool:
            own = [scale * x for scale, x in zip(scales, state, strict=True)]
            return watch(time * unit, own) and all(abs(state[i]) < _LARGE for i in small)

        unit, scales = units.time, units.states.tolist()
        small = np.flatnonzero(units.states < 1.0).tolist()
        constants = np.concatenate([scales, [unit], parameters])
        found = self._with_units._attempt(
            constants, begin / unit, state / units.states, end / unit, seen
        )
        return None if found is None else units.natural(found)


@once
def library() -> Any:
    """The heyoka module, with its cache of compiled code in a folder of polhode's."""
    with _importing, _without_sympy():
        import heyoka
    heyoka.set_logger_level_critical()  # it logs to standard output
    try:
        kept = cache.folder("heyoka")
        _drop_damaged(kept / "cache.db")
        heyoka.llvm_state.set_diskcache_path(kept)
        heyoka.llvm_state.set_diskcache_limit(cache.LIMIT)
    except (StoreError, RuntimeError):
        heyoka.llvm_state.set_diskcache_enabled(False)
    return heyoka


def _drop_damaged(database: Path) -> None:
    """Remove a file that is no database, so that heyoka creates it again."""
    if not database.exists():
        return
    try:
        with closing(sqlite3.connect(database)) as opened:
            opened.execute("PRAGMA schema_version")
    except sqlite3.OperationalError:  # another process holds it
        return
    except sqlite3.DatabaseError:
        for part in database.parent.glob(f"{database.name}*"):
            part.unlink(missing_ok=True)


@contextmanager
def _without_sympy() -> Iterator[None]:
    """heyoka imports SymPy if it can, which takes two thirds of its start-up and is not needed."""
    if "sympy" in sys.modules:
        yield
        return
    sys.modules["sympy"] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        del sys.modules["sympy"]


# -- in long doubles, quadruple and any precision -----------------------------------------------

_SPARE_DIGITS = 8  # of decimal texts through which numbers pass to heyoka, beyond their own digits
_QUADRUPLE_BITS = 113


class TaylorSeries:
    """Adaptive Taylor series in long double, quadruple and higher precision."""

    name = "heyoka"

    def integrate(self, problem: InitialValueProblem, watch: SeriesCallback) -> TaylorSolution:
        """The motion up to its end, until `watch` returns false, or as far as it goes."""
        numbers = problem.numbers
        taylor = copy(_compiled_in(problem.program, len(problem.start), numbers))
        read = _HeyokaNumbers(numbers)
        taylor.time = read(problem.begin)
        taylor.state[:] = [read(value) for value in problem.start]
        taylor.pars[:] = [read(value) for value in problem.constants[: len(taylor.pars)]]
        outputs = list[Any]()
        first: Any = None

        def seen(taylor: Any) -> bool:
            nonlocal first
            if not outputs and first is None:
                share, _ = first_step(_in_doubles(taylor.tc, taylor.last_h), 1.0)
                if share < inf:
                    first = read(Fraction(share)) * taylor.last_h
                    return False
            return watch(float(taylor.time), float(taylor.last_h), taylor.state)

        def go(until: Any) -> bool:
            """Whether it got there."""
            outcome, *_, output, _ = taylor.propagate_until(
                until, c_output=True, write_tc=True, callback=seen
            )
            if output is None:  # no step was possible, and the time is no number any more
                raise broken(float(outputs[-1].times[-1] if outputs else problem.begin))
            outputs.append(output)
            return bool(outcome.name == "time_limit")

        end = read(problem.end)
        if not go(end) and first is not None:
            outputs.clear()
            taylor.time = read(problem.begin)
            taylor.state[:] = [read(value) for value in problem.start]
            if go(taylor.time + first):
                go(end)
        ends = np.concatenate([outputs[0].times[:1], *(output.times[1:] for output in outputs)])
        times = numbers.joined(list(limbs_of(ends, numbers.limbs)))
        # Rescaled to powers of the share of a step: at an order of hundreds, coefficients in powers
        # of the time itself would leave the range of doubles, as which they are stored.
        # shape (steps, states, order + 1)
        coefficients = np.concatenate([np.array(output.tcs) for output in outputs])
        lengths = (ends[1:] - ends[:-1])[:, None]
        power = lengths
        for k in range(1, coefficients.shape[2]):
            coefficients[:, :, k] = coefficients[:, :, k] * power
            power = power * lengths
        limbs = limbs_of(coefficients, numbers.limbs).transpose(0, 1, 3, 2)
        return TaylorSolution(numbers, times, limbs)


def _in_doubles(series: Any, length: Any) -> Array:
    """The first coefficients and the last ones, between which zeros are left.

    They are those of the powers of the share of a step of some length: coefficients of the powers
    of the time itself may be beyond the largest double.
    """
    found, power = np.zeros(series.shape), length
    found[:, 0] = [float(value) for value in series[:, 0]]
    for k in range(1, series.shape[1]):
        if k >= series.shape[1] - _LAST:
            found[:, k] = [float(value * power) for value in series[:, k]]
        power = power * length
    return found


@lru_cache(maxsize=32)
def _compiled_in(program: Program, size: int, numbers: NumberType) -> Any:
    """An integrator that is only ever copied."""
    read = _HeyokaNumbers(numbers)
    return library().taylor_adaptive(
        rates_of(program, size, read),
        [read(0)] * size,
        opt_level=0,
        compact_mode=True,  # unrolled, the code would be too long at such orders
        **read.kind,
    )


class _HeyokaNumbers:
    """Converts numbers of one precision to heyoka's types."""

    def __init__(self, numbers: NumberType) -> None:
        heyoka = library()
        self._numbers = numbers
        self._make: Callable[[str], Any]
        self.kind: dict[str, Any]
        if isinstance(numbers, LongDoubles):
            self._make, self.kind = np.longdouble, {"fp_type": np.longdouble}
        elif numbers.bits == _QUADRUPLE_BITS and hasattr(heyoka, "real128"):
            self._make, self.kind = heyoka.real128, {"fp_type": heyoka.real128}
        else:
            self._make = lambda text: heyoka.real(text, numbers.bits)
            self.kind = {"fp_type": heyoka.real, "prec": numbers.bits}

    def __call__(self, value: Fraction | Any) -> Any:
        exact = self._numbers.exact
        digits = int(exact.dps) + _SPARE_DIGITS
        return self._make(exact.nstr(number(exact, value), digits, strip_zeros=False))

"""Integrates a flow over a span of time: the core step by step, then the quadratures over it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import ceil, inf, log
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Symbol
from polhode.base import Progress, bisected
from polhode.simulate.integrate._arrays import Array, ascending, occurring, probed
from polhode.simulate.integrate._flow import Flow, Stage
from polhode.simulate.integrate._number_types import DOUBLES, NumberType
from polhode.simulate.integrate._quadrature import integral
from polhode.simulate.integrate._stepping import Leg, Stepper, fewest_steps
from polhode.simulate.integrate._stop_criteria import StepWatch, Stop, StopCriteria

# -- motions that begin in equilibrium, to within the last digit of their start ----------------

# Step of the difference quotients, relative to a state: only the size of slopes counts.
_APART = 1e-6


@dataclass(frozen=True)
class Constant:
    """A solution that does not change.

    Attributes:
        times: where it begins and ends, s.
        state: all along.
    """

    times: Array
    state: Array
    broken: bool = False

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        return np.repeat(self.state[:, None], len(times), axis=1)


def is_steady(flow: Flow, parameters: Array, state: Array) -> bool:
    """Whether the rates of the core are zero to within the rounding of its state.

    90° has no exact double: a disk that stands upright has rates that come from the last digit of
    that angle alone, and in an unstable equilibrium they would grow without limit. Rates that are
    exactly zero need no such care.
    """
    core = flow.core
    size = len(state)
    if flow.degree > 0:
        return False
    apart = _APART * np.where(state == 0, 1.0, np.abs(state))  # at zero no slope is needed
    columns = np.repeat(state[:, None], size + 1, axis=1)
    columns[:, 1:] += np.diag(apart)
    others = [0.0] * (len(core.program.arguments) - size - len(parameters) - 1)
    with np.errstate(all="ignore"):
        found = core.rates(*columns, *others, *parameters, 0.0)
    rates = np.array([np.broadcast_to(np.asarray(rate, dtype=float), size + 1) for rate in found])
    # What one unit in the last place of every state can do to the rates; zero is exact.
    slopes = np.abs(rates[:, 1:] - rates[:, :1]) / apart
    rounding = slopes @ np.where(state == 0, 0.0, np.spacing(np.abs(state)))
    now = np.abs(rates[:, 0])
    return bool(np.any(now > 0) and np.all(now <= rounding))


_FEW = 10_000  # times for which states are kept: larger sets are rarely read twice
_TURNS = 4  # periods after which an angle is reduced by whole turns: its sine keeps all its digits

States: TypeAlias = Callable[[Array], Array]


@dataclass(frozen=True)
class SegmentSolution:
    """All states at every instant of a span of time.

    Attributes:
        symbols: the states, in the order of the rows of `at`.
        turned: of large angles: the symbol of the angle less whole turns.
        steps: where the steps of the integrator begin and end, s.
        stop: why it ends where it does.
        vanished: which of the watched vectors vanishes at its end.
        numbers: the type of the states.
    """

    symbols: tuple[Symbol, ...]
    turned: Mapping[Symbol, Symbol]
    steps: Array
    stop: Stop
    vanished: int | None
    _at: States = field(repr=False)
    numbers: NumberType = DOUBLES
    _rounded_at: States | None = field(default=None, repr=False)
    _rest_at: Callable[[float], Array] | None = field(default=None, repr=False)

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        return self._at(times)

    def rest(self, time: float) -> Array:
        """All states of the flow at an instant, less the parts that are known functions of time.

        The next piece continues from these, so that the known parts are never summed up and their
        rounding does not accumulate.
        """
        if self._rest_at is None:
            return self._at(np.array([time]))[:, 0]
        return self._rest_at(time)

    def rounded(self) -> SegmentSolution:
        """This solution in doubles."""
        if self._rounded_at is None:
            return self
        steps = DOUBLES.array(self.steps)
        return replace(self, steps=steps, _at=self._rounded_at, numbers=DOUBLES, _rounded_at=None)


def integrate(
    flow: Flow,
    stepper: Stepper,
    parameters: Array,
    start: Array,
    span: tuple[float, float],
    progress: Progress,
    criteria: StopCriteria | None = None,
    finest: float = inf,
) -> SegmentSolution:
    """Integrate a flow over a span of time, or as far as it goes.

    Args:
        start: of all states, in the order of the flow, less the parts that are known.
        criteria: what may stop it early.
        finest: length down to which a single long step is graded, s.

    Raises:
        NumericError: where the motion cannot even begin.
    """
    size = len(flow.core.symbols)
    criteria = criteria or StopCriteria()
    path = _legs(flow, stepper, parameters, start[:size], span, progress, criteria)
    steps = ascending([leg.times for leg in path.legs])
    vanished = None
    # The stop criteria see the ends of steps only: within the last one the end of slip is located.
    if path.stop is Stop.VANISHED:
        end, vanished = _vanishing(path, criteria, (float(steps[-2]), float(steps[-1])))
        steps = np.append(steps[:-1], end)
    if fewest_steps(flow) > 1:
        looks = np.linspace(steps[0], steps[-1], fewest_steps(flow) + 1)
        steps = ascending([steps, looks])
    steps = _graded(steps, finest)
    at: States = _CachedStates(path.at)
    rests: list[States] = [path.core_at]
    known = size
    for stage in flow.stages:
        own = start[known : known + len(stage.symbols)]
        rest = _summed(stage, flow, at, own, parameters, steps)
        at = _CachedStates(_with_stage(stage, flow, at, rest, parameters))
        rests.append(rest)
        known += len(stage.symbols)

    def rest_at(time: float) -> Array:
        return np.concatenate([rest(np.array([time]))[:, 0] for rest in rests])

    return SegmentSolution(
        flow.symbols, flow.turned, steps, path.stop, vanished, at, _rest_at=rest_at
    )


def _graded(steps: Array, finest: float) -> Array:
    """The ends of steps, with further ones near the beginning if there is a single long step.

    A polynomial, such as a fall through empty space, is integrated in one step however long it is.
    Its rounding there is that of the largest values, and would be felt where the motion begins.
    """
    length = steps[-1] - steps[0]
    if len(steps) > 2 or not length > finest:
        return steps
    return ascending(
        [steps, steps[0] + length / 4.0 ** np.arange(1, ceil(log(length / finest, 4)))]
    )


def _vanishing(
    path: _Path, criteria: StopCriteria, step: tuple[float, float]
) -> tuple[float, int | None]:
    """When the first slip ends within the last step, and which; if none, the end of the step.

    In a motion without curvature a step is as long as it can be, and several may end within it.
    """
    ends = [_end_of(path, criteria.passing, list(rows), step) for rows in criteria.vectors]
    return min(((end, k) for k, end in enumerate(ends) if end is not None), default=(step[1], None))


def _end_of(
    path: _Path, passing: float, rows: list[int], step: tuple[float, float]
) -> float | None:
    """When a vector vanishes within a step, if it does."""

    def vector(time: float) -> Array:
        return path.at(np.array([time]))[rows, 0]

    start = vector(step[0])

    def along(time: float) -> float:
        return float(start @ vector(time))

    # A slip that reverses: its component along the old direction changes sign, and there it is
    # short enough to have vanished, or it has only been turned by more than 90°.
    if along(step[1]) <= 0:
        time = bisected(along, *step)
        return time if np.hypot(*vector(time)) <= passing else None
    return step[1] if np.hypot(*vector(step[1])) <= passing else None


@dataclass(frozen=True)
class _Path:
    """Consecutive legs, each with the whole turns by which its angles were reduced.

    Its rows are the states of the core, then the periodic ones once more, less whole turns.
    """

    legs: list[Leg]
    begins: Array
    turned: Array
    periodic: NDArray[np.bool_]
    stop: Stop

    def at(self, times: Array) -> Array:
        which = self._legs_at(times)
        states = self._states(which, times)
        return np.vstack([states + self.turned[which].T, states[self.periodic]])

    def core_at(self, times: Array) -> Array:
        """The states of the core alone."""
        which = self._legs_at(times)
        return self._states(which, times) + self.turned[which].T

    def _legs_at(self, times: Array) -> NDArray[np.intp]:
        return np.searchsorted(self.begins[1:], times, "right")

    def _states(self, which: NDArray[np.intp], times: Array) -> Array:
        """The states of the core, less the whole turns that each leg began with."""
        if len(self.legs) == 1:
            return self.legs[0].at(times)
        states = np.empty((len(self.periodic), len(times)))
        for i in occurring(which):
            here = which == i
            states[:, here] = self.legs[i].at(times[here])
        return states


def _legs(
    flow: Flow,
    stepper: Stepper,
    parameters: Array,
    state: Array,
    span: tuple[float, float],
    progress: Progress,
    criteria: StopCriteria,
) -> _Path:
    """Integrates leg by leg; each begins with angles reduced by whole turns, to keep their digits.

    An angle of 10⁶ rad has six digits fewer after the point than one of 1 rad, and its sine with
    it. Only angles that enter the equations through sines and cosines alone have a period.
    """
    now, end = span
    periods = np.array([period or np.inf for period in flow.periods])
    steps = StepWatch(criteria, state.tolist(), span, progress)
    watch = _AngleMonitor(steps, _TURNS * periods)
    legs, begins, turned = list[Leg](), list[float](), list[Array]()
    offset = np.zeros(len(state))
    steady = is_steady(flow, parameters, state)
    while now < end and watch.stop is None:
        if steady:
            leg: Leg = Constant(np.array([now, end]), state)
        else:
            leg = stepper.leg(parameters, now, state, end, watch)
        legs.append(leg)
        begins.append(now)
        turned.append(offset)
        now = float(leg.times[-1])
        state = leg.at(leg.times[-1:])[:, 0]
        whole = np.round(state / periods) * np.where(np.isfinite(periods), periods, 0.0)
        state, offset = state - whole, offset + whole
        if leg.broken and watch.stop is None:
            watch.stop = watch.broken()
    stop = watch.stop or Stop.TIME
    return _Path(legs, np.array(begins), np.array(turned), np.isfinite(periods), stop)


class _AngleMonitor:
    """Stops a leg when an angle has grown large, and the integration when its criteria say so."""

    def __init__(self, steps: StepWatch, limits: Array) -> None:
        self.stop: Stop | None = None
        self._steps = steps
        self._limits = [(i, limit) for i, limit in enumerate(limits.tolist()) if limit < inf]
        self._time = -inf

    def __call__(self, time: float, state: list[float]) -> bool:
        step, self._time = time - self._time, time
        self.stop = self._steps.after(time, step, state)
        return self.stop is None and all(abs(state[i]) < limit for i, limit in self._limits)

    def broken(self) -> Stop:
        """Why the integration stops where the integrator can take no further step."""
        return self._steps.broken()


def _summed(
    stage: Stage, flow: Flow, inner: States, start: Array, parameters: Array, steps: Array
) -> States:
    """The quadratures of a stage, less the parts that are known."""

    def rates(times: Array) -> Array:
        return flow.values(stage.rates, inner(times), parameters, times)

    # The uncertainty of the rates: how much they change with the last digits of the states.
    states = inner(steps)
    with np.errstate(all="ignore"):
        both = states, probed(states)
        here, there = (flow.values(stage.rates, s, parameters, steps) for s in both)
        noise = np.max(np.abs(there - here), axis=1, initial=0.0)
        found = integral(rates, steps, np.where(np.isfinite(noise), noise, 0.0), start)
    return lambda times: start[:, None] + found.at(times)


class _CachedStates:
    """Keeps the states at the last set of times: later stages and guards read the same times."""

    def __init__(self, at: States) -> None:
        self._at = at
        self._times = self._states = np.empty(0)

    def __call__(self, times: Array) -> Array:
        if len(times) > _FEW:
            return self._at(times)
        if not np.array_equal(times, self._times):
            self._times, self._states = times.copy(), self._at(times)
            self._states.flags.writeable = False
        return self._states


def _with_stage(stage: Stage, flow: Flow, inner: States, rest: States, parameters: Array) -> States:
    """The states known so far, and below them those of one more stage."""
    known = stage.known_values
    if known is None:
        return lambda times: np.vstack([inner(times), rest(times)])
    nothing = np.empty((0,))
    return lambda times: np.vstack(
        [inner(times), rest(times) + flow.values(known, nothing, parameters, times)]
    )

"""Taylor's method by polhode's own kernel, which every host runs to the same bits."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._stepping import (
    Leg,
    StepCallback,
    Stepper,
    broken,
    fewest_steps,
    longest_step,
)
from polhode.simulate.integrate._taylor import TaylorLeg, scales_of
from polhode.simulate.kernel._host import Kernel, Steps
from polhode.simulate.kernel._layout import Layout, order_of
from polhode.simulate.kernel._steps import Status
from polhode.simulate.kernel._tape import tape_of

_MOST = 64  # steps of a call: what bounds the time until an interrupt is seen
_LARGE = 2.0**6  # multiples of the unit of a state, beyond which units are chosen anew


class KernelTaylor:
    """Adaptive Taylor series of high order, accurate to rounding."""

    name = "kernel"

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """The tape of the core; the kernel itself is the same for all."""
        least = float(np.finfo(float).eps) if tolerance is None else tolerance
        tape = tape_of(flow.core.program, len(flow.core.symbols))
        return _KernelStepper(flow, Layout(tape, order_of(least), _MOST))


@dataclass(frozen=True)
class _KernelStepper:
    flow: Flow
    layout: Layout

    @cached_property
    def kernel(self) -> Kernel:
        """One of its own: a kernel holds the state of its motion."""
        return Kernel(self.layout)

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        # A series that ends (a polynomial) would otherwise allow an infinite step.
        longest = longest_step(begin, end, fewest_steps(self.flow))
        self.kernel.start(parameters, begin, state)
        first = self._first_step(begin, end, longest)
        sizes = np.max(np.abs(first.shares[0]), axis=1)
        symbols, is_driven = self.flow.core.symbols, self.flow.degree > 0
        scales = scales_of(symbols, state, sizes, is_driven=is_driven)
        if scales is not None:
            self.kernel.start(parameters, begin, state, 1.0 / scales)
            first = self._first_step(begin, end, longest)
            watch = _until_large(watch, scales)
        return self._followed(first, end, longest, watch)

    def _first_step(self, begin: float, end: float, longest: float) -> Steps:
        found = self.kernel.advance(end, longest, 1)
        if not len(found.lengths):
            raise broken(begin)
        return found

    def _followed(self, steps: Steps, end: float, longest: float, watch: StepCallback) -> Leg:
        """The leg that begins with a step, until it is stopped, ends or is broken."""
        calls = [up_to_where_stopped(steps, watch)]
        most = 1
        while calls[-1].status is Status.GOING:
            most = min(2 * most, _MOST)
            calls.append(up_to_where_stopped(self.kernel.advance(end, longest, most), watch))
        last = calls[-1]
        ends = np.concatenate([*(call.begins for call in calls), [last.end]])
        return TaylorLeg(
            ends[:, 0],
            ends[:, 1],
            np.concatenate([call.lengths for call in calls]),
            np.concatenate([call.shares for call in calls]),
            last.status is Status.BROKEN,
        )


def up_to_where_stopped(steps: Steps, watch: StepCallback) -> Steps:
    """The steps of a call up to the one after which the callback stops them."""
    if not len(steps.lengths):  # broken at once, where the call before it ended
        return steps
    times = [*steps.begins[1:, 0].tolist(), steps.end[0]]
    states = [*steps.shares[1:, :, 0].tolist(), steps.state.tolist()]
    for taken, (time, state) in enumerate(zip(times, states, strict=True), 1):
        if not watch(time, state):
            return steps.stopped(taken)
    return steps


def _until_large(watch: StepCallback, scales: Array) -> StepCallback:
    """A callback that also ends a leg where states are large in their units."""
    limits = [(i, _LARGE * scale) for i, scale in enumerate(scales.tolist()) if scale < 1.0]

    def seen(time: float, state: list[float]) -> bool:
        return watch(time, state) and all(abs(state[i]) < limit for i, limit in limits)

    return seen

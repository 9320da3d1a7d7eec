"""Taylor's method, compiled by heyoka."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache as once
from threading import Lock
from typing import Any

import numpy as np

from polhode.algebra import Arithmetic
from polhode.base import StoreError, cache
from polhode.simulate._flow import Flow
from polhode.simulate._integrators import LOOKS, Array, Leg, Stepper, Watch, broken

_importing = Lock()


class Taylor:
    """Adaptive Taylor series of high order, accurate to rounding.

    The flow is compiled without optimisation: that takes a tenth of the time and costs a run of
    usual length next to nothing.
    """

    name = "heyoka"
    dense = True

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """Compile the core; all parameters stay open."""
        heyoka = library()
        states = [heyoka.make_vars(f"x{i}") for i in range(len(flow.core.symbols))]
        later = [0.0] * (len(flow.states) - len(states))
        constants = [heyoka.par[i] for i in range(len(flow.parameters))]
        function = flow.core.program.function(
            Arithmetic.of(heyoka, lambda number: heyoka.expression(float(number)))
        )
        rates = function(*states, *later, *constants, heyoka.time)
        return _TaylorStepper(
            heyoka.taylor_adaptive(
                [(x, heyoka.expression(rate)) for x, rate in zip(states, rates, strict=True)],
                [0.0] * len(states),
                tol=np.finfo(float).eps if tolerance is None else tolerance,
                opt_level=0,
            ),
            LOOKS if flow.is_driven else 1,
        )


@dataclass(frozen=True)
class _TaylorStepper:
    integrator: Any
    least_steps: int

    def leg(self, parameters: Array, begin: float, state: Array, end: float, watch: Watch) -> Leg:
        taylor = self.integrator
        taylor.time = begin
        taylor.state[:] = state
        taylor.pars[:] = parameters[: len(taylor.pars)]
        longest = (end - begin) / self.least_steps  # infinite where all series end
        outcome, *_, output, _ = taylor.propagate_until(
            end,
            max_delta_t=longest,
            c_output=True,
            callback=lambda t: watch(t.time, t.state),
        )
        if output is None:
            raise broken(taylor.time)
        return _TaylorLeg(output, outcome.name not in ("time_limit", "cb_stop"))


@dataclass(frozen=True)
class _TaylorLeg:
    output: Any
    broken: bool

    @property
    def times(self) -> Array:
        return np.asarray(self.output.times)

    def at(self, times: Array) -> Array:
        return np.array(self.output(times)).T


@once
def library() -> Any:
    """The heyoka module, its cache of compiled code set to a folder of polhode's."""
    with _importing, _without_sympy():
        import heyoka
    try:
        heyoka.llvm_state.set_diskcache_path(cache.folder("heyoka"))
    except StoreError:
        heyoka.llvm_state.set_diskcache_enabled(False)
    return heyoka


@contextmanager
def _without_sympy() -> Iterator[None]:
    """heyoka imports SymPy wherever it is installed: two thirds of its start, and not needed."""
    if "sympy" in sys.modules:
        yield
        return
    sys.modules["sympy"] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        del sys.modules["sympy"]

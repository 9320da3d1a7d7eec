"""Taylor's method, compiled by heyoka."""

from __future__ import annotations

import sqlite3
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from functools import cache as once
from functools import lru_cache
from itertools import count
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from polhode.algebra import Arithmetic, Program, SymbolKind
from polhode.base import StoreError, cache
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._stepping import (
    Array,
    Leg,
    StepCallback,
    Stepper,
    broken,
    longest_step,
    looks_along,
)
from polhode.simulate.integrate._taylor import TaylorSteps

_LONG = 3000  # operations

_importing = Lock()
_compiling = Lock()


class Taylor:
    """Adaptive Taylor series of high order, accurate to rounding.

    The flow is compiled without optimisation: that takes a tenth of the time and costs a run of
    usual length next to nothing.
    """

    name = "heyoka"
    dense = True

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """Compile the core; all parameters stay open."""
        least = np.finfo(float).eps if tolerance is None else tolerance
        with _compiling:
            blank = _compiled(flow.core.program, len(flow.core.symbols), float(least))
            integrator = copy(blank)
        return _TaylorStepper(integrator, looks_along(flow))


@lru_cache(maxsize=64)
def _compiled(program: Program, size: int, tolerance: float) -> Any:
    """An integrator that is only ever copied: each holds the motion it is at."""
    return library().taylor_adaptive(
        rates_of(program, size, float),
        [0.0] * size,
        tol=tolerance,
        opt_level=0,
        compact_mode=is_long(program),
    )


def is_long(program: Program) -> bool:
    """Whether its code, written out, would not find room on the stack."""
    return program.operations > _LONG


def rates_of(program: Program, size: int, number: Callable[[Fraction], Any]) -> list[Any]:
    """Pairs of state and rate, in heyoka's expressions; all parameters stay open.

    Args:
        program: of the rates of its first arguments.
        size: how many states there are.
        number: what a constant is in the numbers that are integrated.
    """
    heyoka = library()
    states = [heyoka.make_vars(f"x{i}") for i in range(size)]
    constants = (heyoka.par[i] for i in count())
    others = {SymbolKind.PARAMETER: lambda: next(constants), SymbolKind.TIME: lambda: heyoka.time}
    given = [others.get(s.kind, lambda: 0.0)() for s in program.arguments[size:]]
    arithmetic = Arithmetic.of(heyoka, lambda value: heyoka.expression(number(value)))
    rates = program.function(arithmetic)(*states, *given)
    return [(x, heyoka.expression(rate)) for x, rate in zip(states, rates, strict=True)]


@dataclass(frozen=True)
class _TaylorStepper:
    integrator: Any
    least_steps: int

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        taylor = self.integrator
        taylor.time = begin
        taylor.state[:] = state
        taylor.pars[:] = parameters[: len(taylor.pars)]
        steps = TaylorSteps(begin)

        def looked(taylor: Any) -> bool:
            steps.add(taylor.dtime, taylor.last_h, taylor.tc)
            return watch(taylor.time, taylor.state.tolist())

        outcome, *_ = taylor.propagate_until(
            end,
            max_delta_t=longest_step(begin, end, self.least_steps),  # else infinite, as series end
            write_tc=True,
            callback=looked,
        )
        if not steps.count:
            raise broken(begin)
        return steps.leg(end, broken=outcome.name not in ("time_limit", "cb_stop"))


@once
def library() -> Any:
    """The heyoka module, its cache of compiled code set to a folder of polhode's."""
    with _importing, _without_sympy():
        import heyoka
    heyoka.set_logger_level_critical()  # its words would come on standard output
    try:
        kept = cache.folder("heyoka")
        _drop_damaged(kept / "cache.db")
        heyoka.llvm_state.set_diskcache_path(kept)
        heyoka.llvm_state.set_diskcache_limit(cache.LIMIT)
    except StoreError:
        heyoka.llvm_state.set_diskcache_enabled(False)
    return heyoka


def _drop_damaged(database: Path) -> None:
    """Take away what is no data base, so that it is made anew."""
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
    """heyoka imports SymPy wherever it is installed: two thirds of its start, and not needed."""
    if "sympy" in sys.modules:
        yield
        return
    sys.modules["sympy"] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        del sys.modules["sympy"]

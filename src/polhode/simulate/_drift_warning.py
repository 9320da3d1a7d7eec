"""Whether a computed motion can be believed: what must balance does, as far as rounding lets it.

One step of an integrator leaves the energy off by a few roundings (or by its tolerance, where that
is larger), which add up over the steps at worst in proportion to their number. Near a singular
position, such as a disk about to lie flat, terms that nearly cancel lose further digits. What is
beyond both is no rounding: a force that jumps unseen, or one that has no potential and whose work
was not counted.
"""

from __future__ import annotations

import warnings
from math import isfinite
from typing import TYPE_CHECKING

from polhode.base import DriftWarning, NumericError
from polhode.simulate._drift import imbalance_of

if TYPE_CHECKING:
    from polhode.simulate._trajectory import Trajectory

_LOST = 1e7  # roundings that terms which nearly cancel may cost
_PER_STEP = 100.0  # roundings that a step may cost
_WRONG = 1e-3  # of the energy or the lengths: a motion that is off by more is another one
_TIGHTEST = {"scipy": 1e-13}  # relative tolerance of an integrator at its best, if not rounding


def doubt_about(run: Trajectory, tolerance: float | None) -> str:
    """What speaks against a motion; empty where nothing does.

    Args:
        tolerance: of its steps, where one was asked for.

    Raises:
        NumericError: for one that is certainly wrong.
    """
    numbers = run.segments[0].numbers
    rounding = 2.0 ** (1 - numbers.bits)
    step = max(rounding, tolerance or 0.0, _tightest(run, rounding))
    steps = sum(len(segment.steps) for segment in run.segments)
    allowed = _LOST * rounding + _PER_STEP * step * steps
    for what, size in imbalance_of(run.segments).items():
        if not isfinite(size) or size <= allowed:
            continue
        told = f"{what} is off by {size:.1e} of its scale, where rounding explains {allowed:.0e}"
        if size > max(_WRONG, allowed):
            raise NumericError(
                f"a motion that is wrong: {told}",
                expected="a motion that keeps its balance",
                advice="a load that jumps, or whose power is not that of its force, does this; "
                "if there is none, please report it",
            )
        return told
    return ""


def _tightest(run: Trajectory, rounding: float) -> float:
    return max(rounding, _TIGHTEST.get(run.integrator, 0.0)) if rounding > 1e-17 else rounding


def refuse_doubt(run: Trajectory) -> None:
    """Refuse a motion against which anything speaks.

    Raises:
        NumericError: with what does.
    """
    if run.doubt:
        raise NumericError(
            f"a motion that cannot be relied on: {run.doubt}",
            expected="one that keeps its balance to rounding",
        )


def warn_of(run: Trajectory) -> None:
    """Say aloud what speaks against a motion."""
    if run.doubt:
        warnings.warn(f"this motion cannot be relied on: {run.doubt}", DriftWarning, stacklevel=3)

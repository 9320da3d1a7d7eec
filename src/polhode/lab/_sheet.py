"""The path of a sheet that was dragged by hand, made smooth."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from polhode.lab._requests import Row
from polhode.simulate import Pieces, sampled

_STEP = 0.12  # s between the samples that are kept: a hand does not move faster
_TREMOR = 0.02  # of the width of the path: what the hand did not mean
_REST = 3  # samples at the end, for the sheet to come to rest


def sheet_path(rows: Sequence[Row]) -> tuple[Pieces, Pieces]:
    """Place of the sheet along x and y, m: at rest at first and at the end.

    Args:
        rows: times (s) and places (m) of the hand.
    """
    t, x, y = np.array(rows).T
    times = np.linspace(0.0, t[-1] - t[0], max(2, round((t[-1] - t[0]) / _STEP)) + 1)
    step = times[1]
    later = times[-1] + step * np.arange(1, _REST + 1)
    knots = np.concatenate([times, later])
    width = float(np.hypot(np.ptp(x), np.ptp(y)))
    curves = []
    for places in (x, y):
        through = np.interp(times, t - t[0], places - places[0])
        held = np.concatenate([through, np.full(_REST, through[-1])])
        curves.append(_stopped(sampled(knots, held, noise=_TREMOR * width)))
    return curves[0], curves[1]


def _stopped(path: Pieces) -> Pieces:
    """Through the same places at its knots, and at rest at both ends: smoothing leaves a speed."""
    from scipy.interpolate import CubicSpline

    spline = CubicSpline(path.knots, path.value(path.knots), bc_type="clamped")
    return Pieces(path.knots, np.ascontiguousarray(spline.c[::-1].T))

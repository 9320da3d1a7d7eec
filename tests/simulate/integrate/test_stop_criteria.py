"""How many steps of a motion are kept: as many as memory has room for."""

from __future__ import annotations

import pytest

from polhode.base import NumericError
from polhode.simulate.integrate import _stop_criteria
from polhode.simulate.integrate._stop_criteria import StepCount


def counted(steps: int, size: float) -> None:
    """Count steps of so many states."""
    count = StepCount()
    for step in range(steps):
        count.count((0.0, 1.0), 1e-3 * (step + 1), size, no_slip_ends=False)


@pytest.mark.parametrize(("size", "most"), [(1, 1200), (4, 300), (12, 100)])
def test_the_more_a_step_keeps_the_fewer_are_kept(monkeypatch, size, most):
    monkeypatch.setattr(_stop_criteria, "MOST_KEPT", 1200)
    counted(most, size)
    with pytest.raises(NumericError, match=f"^{most} steps are not enough to go beyond t = "):
        counted(most + 1, size)


def test_what_stretches_keep_is_added_up(monkeypatch):
    monkeypatch.setattr(_stop_criteria, "MOST_KEPT", 10)
    count = StepCount()
    for begin in (0.0, 1.0):
        count.count((begin, 9.0), begin + 0.5, 4.0, no_slip_ends=True)
    with pytest.raises(NumericError, match="2 steps are not enough"):
        count.count((2.0, 9.0), 2.5, 4.0, no_slip_ends=True)

"""A bound on how long a command may compute."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from typing import Any

from polhode.base import NumericError

_AGAIN = 5.0  # s, where the first call to stop was taken for the failure of one attempt


@contextmanager
def within(seconds: float, *, advice: str) -> Iterator[None]:
    """Give up what takes more processor time than this, where the system has a timer for it.

    Raises:
        NumericError: once the time is over.
    """
    if not hasattr(signal, "setitimer") or current_thread() is not main_thread():
        yield
        return

    def stop(*_: Any) -> None:
        raise NumericError(
            f"more than {seconds:g} s of computing",
            expected="something that can be decided sooner",
            advice=advice,
        )

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, _AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)

"""Ctrl-C ends a computation where it is, and what is done is kept; a second one ends it all."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from polhode.base import Progress, StopRequested


class Terminated(KeyboardInterrupt):
    """An end that was asked for by SIGTERM."""

    code = 128 + signal.SIGTERM


@contextmanager
def ended_in_order() -> Iterator[None]:
    """Within it SIGTERM ends a command as Ctrl-C does: what it began is ended, and what is kept is
    told.
    """

    def end(number: int, frame: FrameType | None) -> None:
        raise Terminated

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class Interruptible:
    """Progress that has enough after an interrupt."""

    def __init__(self, shown: Progress) -> None:
        self._shown = shown
        self._before: Any = None
        self._asked = False

    def begin(self, task: str, total: int | None = None) -> None:
        """Show the task, and from now on keep what is done when interrupted."""
        self._shown.begin(task, total)
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, self._ask)

    def advance(self, steps: int = 1) -> None:
        """Tell of steps; raises `StopRequested` once interrupted."""
        self._shown.advance(steps)
        if self._asked:
            raise StopRequested

    def finish(self) -> None:
        """End the task; an interrupt is again what it was."""
        self._restore()
        self._shown.finish()

    def _ask(self, number: int, frame: FrameType | None) -> None:
        self._asked = True
        self._restore()

    def _restore(self) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            self._before = None

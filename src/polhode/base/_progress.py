"""Progress of a long computation, reported to a listener."""

import sys
import time
from typing import Protocol, TextIO


class StopRequested(Exception):  # noqa: N818  (not an error: the user asked for it)
    """Raised by a listener to end a task early and keep the results so far."""


class Progress(Protocol):
    """A listener to one task at a time."""

    def begin(self, task: str, total: int | None = None) -> None:
        """Start a task of `total` steps; None where the number is unknown."""

    def advance(self, steps: int = 1) -> None:
        """Report that so many more steps are done; may raise `StopRequested`."""

    def finish(self) -> None:
        """End the task."""


class SilentProgress:
    """A listener that shows nothing."""

    def begin(self, task: str, total: int | None = None) -> None:
        """Show nothing."""

    def advance(self, steps: int = 1) -> None:
        """Show nothing."""

    def finish(self) -> None:
        """Show nothing."""


class TerminalProgress:
    """One line of a terminal, rewritten as the task advances and cleared when it ends."""

    _INTERVAL = 0.1  # seconds between rewrites
    _WARM_UP = 2.0  # seconds before the remaining time is estimated

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._task = ""
        self._total: int | None = None
        self._done = 0
        self._due = 0.0
        self._began = 0.0
        self._before = 0

    def begin(self, task: str, total: int | None = None) -> None:
        """Show the task."""
        self._task, self._total, self._done = task, total, 0
        self._began, self._before = time.monotonic(), 0
        self._show()

    def advance(self, steps: int = 1) -> None:
        """Count the steps, and show the count when it is time."""
        if not self._done:
            self._before = steps  # the first call may count the steps of an earlier run
        self._done += steps
        if time.monotonic() >= self._due:
            self._show()

    def finish(self) -> None:
        """Clear the line."""
        self._write("")

    def _show(self) -> None:
        counted = f"{self._done}" if self._total is None else f"{self._done}/{self._total}"
        self._write(f"{self._task} {counted}{self._left()}")
        self._due = time.monotonic() + self._INTERVAL

    def _left(self) -> str:
        """The estimated remaining time, once there is an estimate."""
        passed, done = time.monotonic() - self._began, self._done - self._before
        if self._total is None or done <= 0 or passed < self._WARM_UP:
            return ""
        left = passed * max(self._total - self._done, 0) / done
        return f", {left / 60:.0f} min left" if left > 90 else f", {left:.0f} s left"

    def _write(self, line: str) -> None:
        self._stream.write(f"\r\x1b[K{line}")
        self._stream.flush()


def terminal_progress(stream: TextIO | None = None) -> Progress:
    """Progress on a terminal, by default standard error; silent where that is no terminal."""
    chosen = sys.stderr if stream is None else stream
    return TerminalProgress(chosen) if chosen.isatty() else SilentProgress()

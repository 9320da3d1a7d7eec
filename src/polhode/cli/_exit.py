"""Ctrl-C ends a computation where it is, and what is done is kept; a second one ends it all."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from polhode.base import PolhodeError, Progress, StopRequested, exit_code

# Ctrl-C ends a computation where it is, and what is done is kept; a second one ends it all.


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


# What is said when a command fails, and the exit code it leaves with.


def report(error: BaseException) -> int:
    """Tell in one line what went wrong, on standard error; returns the exit code.

    With POLHODE_DEBUG=1 the traceback comes first.
    """
    if os.environ.get("POLHODE_DEBUG") == "1":
        traceback.print_exception(error)
    if isinstance(error, BrokenPipeError):
        _stop_printing()
    else:
        print(f"polhode: {_told(error)}", file=sys.stderr)
    return error.code if isinstance(error, Terminated) else exit_code(error)


def _told(error: BaseException) -> str:
    match error:
        case PolhodeError():
            return " ".join(f"{error}{flag(error.option)}".split())
        case KeyboardInterrupt():
            how = "terminated" if isinstance(error, Terminated) else "interrupted"
            return "; ".join([how, *getattr(error, "__notes__", ())])
        case OSError(errno=errno.ENOSPC):
            return "the output cannot be written: no space left where it goes; make room there"
        case _:
            what = " ".join(f"{type(error).__name__}: {error}".split())
            return f"unexpected {what} (POLHODE_DEBUG=1 shows where; please report it)"


def flag(option: str) -> str:
    """How an option is given in a shell, behind the advice to give it; nothing for none."""
    return f" (--{option})" if option else ""


def _stop_printing() -> None:
    """Whoever read our output left; Python must not try to flush the rest when it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())

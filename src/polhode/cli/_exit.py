"""How a command ends: interrupted, terminated or failed, with a message and an exit code."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

from polhode.base import PolhodeError, Progress, StopRequested, exit_code
from polhode.cli._printing import printable
from polhode.cli._streams import give_up_output

# interrupts: the first Ctrl-C stops a computation and keeps its results, a second one kills it


class Terminated(KeyboardInterrupt):
    """Termination by SIGTERM."""

    code = 128 + signal.SIGTERM


@contextmanager
def terminating_like_interrupt() -> Iterator[None]:
    """Let SIGTERM end a command as Ctrl-C does: worker processes stop and results are kept."""

    def terminate(number: int, frame: FrameType | None) -> None:
        raise Terminated

    before = signal.signal(signal.SIGTERM, terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class Interruptible:
    """Progress that asks the computation to stop after an interrupt."""

    def __init__(self, shown: Progress) -> None:
        self._shown = shown
        self._before: Any = None
        self._interrupted = False

    def begin(self, task: str, total: int | None = None) -> None:
        """Show the task; from now on an interrupt stops it and keeps what is done."""
        self._shown.begin(task, total)
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGINT, self._interrupt)

    def advance(self, steps: int = 1) -> None:
        """Show steps; raises `StopRequested` once interrupted."""
        self._shown.advance(steps)
        if self._interrupted:
            raise StopRequested

    def finish(self) -> None:
        """End the task; an interrupt again has its usual effect."""
        self._restore()
        self._shown.finish()

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self._interrupted = True
        self._restore()

    def _restore(self) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            self._before = None


# -- failures --------------------------------------------------------------------------------------


def report(error: BaseException) -> int:
    """Print what went wrong in one line on standard error; returns the exit code.

    With POLHODE_DEBUG=1 the traceback comes first.
    """
    if os.environ.get("POLHODE_DEBUG") == "1":
        traceback.print_exception(error)
    if not isinstance(error, BrokenPipeError):  # the reader has closed it, as `head` does
        with suppress(OSError, ValueError):  # there may be nowhere to say it
            print(f"polhode: {_message(error)}", file=sys.stderr, flush=True)
    give_up_output()
    return error.code if isinstance(error, Terminated) else exit_code(error)


def _message(error: BaseException) -> str:
    match error:
        case PolhodeError():
            return printable(" ".join(f"{error}{flag(error.option)}".split()))
        case KeyboardInterrupt():
            how = "terminated" if isinstance(error, Terminated) else "interrupted"
            return "; ".join([how, *getattr(error, "__notes__", ())])
        case OSError(errno=errno.ENOSPC):
            return "the output cannot be written: no space left on the device; free some space"
        case OSError(errno=errno.EBADF):
            return "the output cannot be written: it is not open for writing; redirect it elsewhere"
        case _:
            what = " ".join(f"{type(error).__name__}: {error}".split())
            return f"unexpected {what} (POLHODE_DEBUG=1 shows where; please report it)"


def flag(option: str) -> str:
    """An option as written in a shell, to follow the advice to give it; empty for none."""
    return f" (--{option})" if option else ""

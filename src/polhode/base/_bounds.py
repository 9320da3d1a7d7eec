"""Limits that the operating system enforces on this process, even within compiled code."""

from __future__ import annotations

import os
import select
import signal
from contextlib import suppress
from pathlib import Path


def bound_time(seconds: float) -> None:
    """End the process after so many seconds of processor time; 0 removes the limit."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)


def bound_memory(most: int) -> None:
    """Limit the memory of the process to `most` bytes, where the system can."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def bound_growth(most: int) -> None:
    """Limit the process to `most` bytes beyond its present size, where the system reports it."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        pages = int(Path("/proc/self/statm").read_text().split()[0])
        bound_memory(pages * resource.getpagesize() + most)


def end_with(descriptor: int) -> None:
    """Let this process end, whatever it is doing, once the other end of a pipe is closed.

    A worker process then does not outlive its parent. Nothing may ever be sent through this pipe:
    the signal, SIGIO, tells of data too, and it may be late (Linux sends it after it has woken the
    reader). It has no effect on systems that send no signal about pipes.

    Args:
        descriptor: of a pipe or socket that only this process reads from.
    """
    try:
        import fcntl

        before = fcntl.fcntl(descriptor, fcntl.F_GETFL)
        fcntl.fcntl(descriptor, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(descriptor, fcntl.F_SETFL, before | os.O_ASYNC)
    except (AttributeError, ImportError, OSError):
        return
    other_end = select.poll()
    other_end.register(descriptor, 0)
    if other_end.poll(0):  # closed already: no signal will come
        os.kill(os.getpid(), signal.SIGIO)

"""Bounds that the operating system keeps on this process, even deep in compiled code."""

from __future__ import annotations

import os
import select
import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


def bound_time(seconds: float) -> None:
    """Have the process ended after some processor time; after none at all, do not."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)


def bound_memory(most: int) -> None:
    """Refuse the process more memory than some bytes, where the system has such a bound."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def bound_growth(most: int) -> None:
    """Refuse the process more than some bytes beyond what it has, where that can be told."""
    with suppress(ImportError, OSError, ValueError):
        import resource

        pages = int(Path("/proc/self/statm").read_text().split()[0])
        bound_memory(pages * resource.getpagesize() + most)


@contextmanager
def ended_with(descriptor: int) -> Iterator[None]:
    """Have this process ended, whatever it does, once nobody is at the other end of a pipe.

    So a process that computes for another does not outlive it. Nothing may come through the pipe
    meanwhile: that would end the process, too. Only where the system sends a signal about pipes.

    Args:
        descriptor: of a pipe or socket that this process reads from, and no other one does.
    """
    try:
        import fcntl

        before = fcntl.fcntl(descriptor, fcntl.F_GETFL)
        fcntl.fcntl(descriptor, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(descriptor, fcntl.F_SETFL, before | os.O_ASYNC)
    except (AttributeError, ImportError, OSError):
        yield
        return
    other_end = select.poll()
    other_end.register(descriptor, 0)
    if other_end.poll(0):  # closed already: no signal will come
        os.kill(os.getpid(), signal.SIGIO)
    try:
        yield
    finally:
        fcntl.fcntl(descriptor, fcntl.F_SETFL, before)

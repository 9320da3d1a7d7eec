"""Bounds that the operating system keeps on this process, even deep in compiled code."""

from __future__ import annotations

import signal
from contextlib import suppress
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

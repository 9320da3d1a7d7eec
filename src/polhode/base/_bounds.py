"""Bounds that the operating system keeps on this process, even deep in compiled code."""

from __future__ import annotations

import signal
from contextlib import suppress


def bound_time(seconds: float) -> None:
    """Have the process ended after some processor time; after none at all, do not."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)


def bound_memory(most: int) -> None:
    """Refuse the process more memory than some bytes, where the system has such a bound."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))

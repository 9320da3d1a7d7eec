"""The standard streams of a command, whatever a shell has made of them."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from typing import TextIO

from polhode.base import StoreError
from polhode.cli._ascii import register


class ClosedOutput:
    """Stands in for a standard output that is closed, as by ``>&-``: what is printed is lost."""

    encoding = "utf-8"

    def __init__(self) -> None:
        self.is_used = False

    def write(self, text: str) -> int:
        """Lose a text."""
        self.is_used = True
        return len(text)

    def flush(self) -> None:
        """Nothing is left to write."""

    def isatty(self) -> bool:
        """It is no terminal."""
        return False

    def fileno(self) -> int:
        """It has no descriptor; `OSError` as other streams without one."""
        raise OSError("standard output is closed")


def prepare_streams() -> None:
    """Let the standard streams take any text, and stand in for those that are closed."""
    for number in range(3):  # or the next file that is opened would become a standard stream
        try:
            os.fstat(number)
        except OSError:
            with suppress(OSError):
                # It takes the lowest number that is free. Worker processes have it too.
                os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)
    if sys.stdout is None:
        sys.stdout = ClosedOutput()
    if sys.stderr is None:  # print(file=None) would print to standard output
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115
    keep_output_apart()
    errors = register()
    for stream in (sys.stdout, sys.stderr):
        # Streams put in place of the terminal's may lack the method.
        with suppress(AttributeError):
            stream.reconfigure(errors=errors)  # type: ignore[union-attr]


def keep_output_apart() -> None:
    """Let what compiled libraries print, such as LAPACK, go to standard error.

    They write to descriptor 1 behind Python's back, in the midst of a JSON document.
    """
    out = sys.__stdout__
    if out is None or sys.stdout is not out:
        return  # another program has put its own stream there
    try:
        if out.fileno() != 1:
            return
        out.flush()
        own = os.dup(1)
        os.dup2(2, 1)
    except OSError:
        return
    # Line by line where it is a terminal, as it was.
    sys.stdout = open(own, "w", encoding=out.encoding, errors=out.errors)  # noqa: SIM115


def give_up_output() -> None:
    """Lose what cannot be written; Python would try once more when it exits, and print an error."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            with suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def flush_output() -> None:
    """Write what is printed.

    Raises:
        StoreError: where standard output is closed and something was printed.
    """
    out: TextIO | ClosedOutput = sys.stdout
    if isinstance(out, ClosedOutput) and out.is_used:
        raise StoreError(
            "standard output is closed, and what was printed is lost",
            expected="a terminal, a file or a pipe",
            advice="redirect it to /dev/null if it is not wanted",
        )
    out.flush()

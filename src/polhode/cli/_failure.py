"""What is said when a command fails, and the exit code it leaves with."""

from __future__ import annotations

import errno
import os
import sys
import traceback

from polhode.base import PolhodeError, exit_code
from polhode.cli._interrupt import Terminated


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

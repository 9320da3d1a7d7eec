"""A task done in a process of its own, which ends where it takes too long."""

from __future__ import annotations

import gc
import json
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import current_thread, main_thread
from typing import IO, Any, NoReturn

from polhode.base import NumericError, PolhodeError, bound_memory, bound_time

#: Exit code of a command, and what it prints.
Said = tuple[int, str]
#: Tells what is to be said if the task does not come to its end.
Tell = Callable[[Said], None]
Task = Callable[[Tell], Said]

_MEMORY = 4 << 30  # bytes
_PATIENCE = 6.0  # times the processor time, on a machine that has other work
_AGAIN = 5.0  # s, where the first call to stop was taken for the failure of one attempt
_CLOCKS = ("SIGPROF", "SIGALRM")


def within(seconds: float, task: Task, *, advice: str) -> Said:
    """What a task says, or told last, that may take so much processor time and no more.

    The system ends it even where it is deep in compiled code. Where a process cannot be parted in
    two the task is interrupted instead, between steps of Python.

    Raises:
        NumericError: once the time is over and nothing was told.
        PolhodeError: whatever the task raised.
    """
    if not _can_part():
        with _interrupted(seconds, advice):
            return task(lambda _: None)
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        os.close(reading)
        _work(task, seconds, writing)
    os.close(writing)
    try:
        with open(reading, encoding="utf-8") as lines:
            replies = [json.loads(line) for line in lines if line.endswith("\n")]
    finally:
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
    if not replies:
        raise _ended(status, seconds, advice)
    return _last_word(**replies[-1])


def _can_part() -> bool:
    """Whether a process can be parted in two; libraries of macOS do not stand it."""
    debugged = os.environ.get("POLHODE_DEBUG") == "1"  # then tracebacks are wanted
    return hasattr(os, "fork") and sys.platform != "darwin" and not debugged


def _last_word(
    said: Said | None = None, refused: tuple[str, str, str] | None = None, fault: str = ""
) -> Said:
    if refused is not None:
        given, expected, advice = refused
        raise PolhodeError(given, expected=expected, advice=advice)
    if said is None:
        raise RuntimeError(fault)
    code, text = said
    return code, text


def _ended(status: int, seconds: float, advice: str) -> NumericError:
    """Why a child ended without a word."""
    clocks = {getattr(signal, clock) for clock in _CLOCKS}
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) in clocks:
        return _too_long(seconds, advice)
    return NumericError(
        "the process that computed ended",
        expected="something that can be decided with less memory",
        advice=advice,
    )


# -- the child -----------------------------------------------------------------------------------


def _work(task: Task, seconds: float, writing: int) -> NoReturn:
    """Do the task, and leave without what a process does at its end."""
    try:
        gc.freeze()  # what was loaded is shared as long as nobody touches it
        _bound(seconds)
        with open(writing, "w", encoding="utf-8") as replies:
            _do(task, replies)
    finally:
        os._exit(0)


def _bound(seconds: float) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who waits for us ends us
    for clock in _CLOCKS:
        signal.signal(getattr(signal, clock), signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, _PATIENCE * seconds)
    bound_time(seconds)
    bound_memory(_MEMORY)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what libraries print as they break down


def _do(task: Task, replies: IO[str]) -> None:
    def send(**reply: Any) -> None:
        print(json.dumps(reply), file=replies, flush=True)

    try:
        send(said=task(lambda said: send(said=said)))
    except PolhodeError as error:
        send(refused=(error.given, error.expected, error.advice))
    except Exception as error:
        send(fault=f"{type(error).__name__}: {error}")


# -- without one ---------------------------------------------------------------------------------


@contextmanager
def _interrupted(seconds: float, advice: str) -> Iterator[None]:
    """Give up what takes more processor time than this, where the system has a timer for it."""
    if not hasattr(signal, "setitimer") or current_thread() is not main_thread():
        yield
        return

    def stop(*_: Any) -> None:
        raise _too_long(seconds, advice)

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, _AGAIN)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


def _too_long(seconds: float, advice: str) -> NumericError:
    return NumericError(
        f"more than {seconds:g} s of computing",
        expected="something that can be decided sooner",
        advice=advice,
    )

"""A task that may take so much processor time and no more, in a process that can be ended."""

from __future__ import annotations

import gc
import os
import signal
import sys
import warnings
from collections.abc import Callable, Collection, Iterator
from contextlib import closing, contextmanager, suppress
from threading import current_thread, main_thread
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar

from polhode.base._bounds import bound_growth, bound_time, ended_with
from polhode.base._errors import NumericError, PolhodeError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

Question = TypeVar("Question")
Said = TypeVar("Said")
#: Tells of something before a task is done.
Tell = Callable[[Said], object]

_MEMORY = 4 << 30  # bytes, beyond what this process holds
_PATIENCE = 6.0  # times the processor time, on a machine that has other work
_AGAIN = 5.0  # s, where the first call to stop was taken for the failure of one attempt
_CLOCKS = ("SIGPROF", "SIGALRM")


def within(
    seconds: float,
    task: Callable[[Tell[Said]], Said],
    *,
    advice: str,
    heard: Tell[Said] = lambda said: None,
) -> Said:
    """What a task says that may take so much processor time and no more.

    The system ends it even where it is deep in compiled code. Where a process cannot be parted in
    two the task is interrupted instead, between steps of Python.

    Args:
        seconds: of processor time.
        task: it may tell of something before it is done.
        advice: what to do about a task that takes longer.
        heard: called with all that the task tells.

    Raises:
        NumericError: once the time is over.
        Exception: whatever the task raised.
    """
    if not can_part():
        with _interrupted(seconds, advice):
            return task(heard)
    with closing(ForkedWorker[None, Said](lambda _, tell: task(tell))) as sitting:
        return sitting.ask(None, seconds, advice, heard)


def can_part() -> bool:
    """Whether a process can be parted in two; libraries of macOS do not stand it."""
    debugged = os.environ.get("POLHODE_DEBUG") == "1"  # then tracebacks are wanted
    return hasattr(os, "fork") and sys.platform != "darwin" and not debugged


class ForkedWorker(Generic[Question, Said]):
    """A copy of this process that answers questions, one after another, each in its time.

    Args:
        answer: what it does with a question; it may tell of something before it is done.
    """

    def __init__(self, answer: Callable[[Question, Tell[Said]], Said]) -> None:
        from multiprocessing.connection import Pipe  # what few need, and takes long to load

        theirs, self._questions = Pipe(duplex=False)
        self._replies, mine = Pipe(duplex=False)
        self._status: int | None = None
        self._child = _parted()
        if not self._child:
            self._questions.close()
            self._replies.close()
            _work(answer, theirs, mine)
        theirs.close()
        mine.close()

    def ask(self, question: Question, seconds: float, advice: str, heard: Tell[Said]) -> Said:
        """The answer; where there is none in time, it is closed.

        Raises:
            NumericError: once the time is over.
            Exception: whatever was raised instead of an answer.
        """
        try:
            self._questions.send((question, seconds))
            while True:
                said, error, is_last = self._replies.recv()
                if is_last:
                    break
                heard(said)
        except (EOFError, OSError):
            self.close()
            raise self._why(seconds, advice) from None
        except BaseException:
            self.close()
            raise
        if error is not None:
            raise error
        return said  # type: ignore[no-any-return]

    @property
    def is_open(self) -> bool:
        """Whether it may be asked more; somebody else may have ended it."""
        return self._status is None and not self._replies.poll()

    def close(self) -> None:
        """End it, whatever it does."""
        if self._status is not None:
            return
        self._status = 0
        with suppress(ProcessLookupError):
            os.kill(self._child, signal.SIGKILL)
        with suppress(ChildProcessError):  # somebody else was told of its end
            _, self._status = os.waitpid(self._child, 0)
        self._questions.close()
        self._replies.close()

    def _why(self, seconds: float, advice: str) -> NumericError:
        """Why it ended without a word."""
        clocks = {getattr(signal, clock) for clock in _CLOCKS}
        status = self._status or 0
        if os.WIFSIGNALED(status) and os.WTERMSIG(status) in clocks:
            return _too_long(seconds, advice)
        return _too_much(advice)


def _parted() -> int:
    """Part this process in two; 0 in the new one."""
    with warnings.catch_warnings():  # threads are no matter: the new one needs none of their locks
        warnings.simplefilter("ignore", DeprecationWarning)
        return os.fork()


# -- the child -----------------------------------------------------------------------------------


def _work(
    answer: Callable[[Question, Tell[Said]], Said], questions: Connection, replies: Connection
) -> NoReturn:
    """Answer until no more is asked, and leave without what a process does at its end."""
    try:
        gc.freeze()  # what was loaded is shared as long as nobody touches it
        _settle()
        _let_go({questions.fileno(), replies.fileno()})
        while True:
            question, seconds = questions.recv()
            with ended_with(questions.fileno()):
                _bound(seconds)
                reply = _reply(answer, question, replies)
            replies.send(reply)
            _bound(0.0)
    finally:
        os._exit(0)


def _settle() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who waits for us ends us
    for ending in (*_CLOCKS, "SIGIO"):
        signal.signal(getattr(signal, ending), signal.SIG_DFL)
    bound_growth(_MEMORY)


def _let_go(kept: Collection[int]) -> None:
    """Hold nothing open that the other process has: somebody may wait for its last end to close."""
    nothing = os.open(os.devnull, os.O_RDWR)
    for name in os.listdir("/dev/fd"):
        if int(name) not in kept:
            os.dup2(nothing, int(name))


def _bound(seconds: float) -> None:
    signal.setitimer(signal.ITIMER_REAL, _PATIENCE * seconds)
    bound_time(seconds)


def _reply(
    answer: Callable[[Question, Tell[Said]], Said], question: Question, replies: Connection
) -> tuple[Said | None, Exception | None, bool]:
    """What is said, what was raised instead, and that it is the last word."""
    try:
        said = answer(question, lambda said: replies.send((said, None, False)))
    except PolhodeError as error:
        return None, error, True
    except MemoryError:
        return None, _too_much(""), True
    except Exception as error:
        return None, RuntimeError(f"{type(error).__name__}: {error}"), True
    return said, None, True


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


def _too_much(advice: str) -> NumericError:
    return NumericError(
        "too much memory perhaps, for the process that computed ended",
        expected="something that can be decided with less memory",
        advice=advice,
    )

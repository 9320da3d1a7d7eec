"""How a worker process starts, and its loop: answer questions until the pipe is closed.

The docstring of `_workers` explains which way of starting is safe, and when.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, TypeVar

from polhode.base._bounds import bound_growth, bound_memory, bound_time, ended_with
from polhode.base._errors import PolhodeError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

Question = TypeVar("Question")
Reply = TypeVar("Reply")
#: Reports something before a task is done.
Tell: TypeAlias = Callable[[Reply], object]
#: Run in a worker to prepare it: returns the function that answers questions.
Setup: TypeAlias = Callable[[], Callable[[Question, Tell[Reply]], Reply]]


class StartMethod(Enum):
    """How a worker process begins."""

    COPY = auto()
    """A fork of this process, with everything it has in memory."""
    FRESH = auto()
    """A new interpreter, which imports the caller's script only if its setup needs it."""
    SERVER = auto()
    """A fork of a server process that has imported the modules given to `preload`."""


class Message(Enum):
    """Kinds of messages from a worker."""

    READY = auto()
    TOLD = auto()
    ANSWER = auto()
    ERROR = auto()


class Process(Protocol):
    """A process, however it was started."""

    @property
    def pid(self) -> int:
        """Its number."""
        ...

    def kill(self) -> None:
        """End it, whatever it is doing."""
        ...

    def exit_code(self) -> int:
        """Wait for its end; minus the number of the signal that ended it, if one did."""
        ...


def begin_process(
    start: StartMethod,
    setup: Setup[Any, Any],
    questions: Connection,
    replies: Connection,
    memory: int | None,
    environment: Mapping[str, str],
) -> Process:
    """Begin a process that serves at the far ends of two pipes."""
    with _interrupts_withheld(start):
        if start is StartMethod.COPY:
            return _copied(setup, questions, replies, memory)
        if start is StartMethod.FRESH and sys.platform != "win32":
            return _Fresh(questions, replies, memory, environment)
        return _InContext(_context(start), setup, questions, replies, memory)


@contextmanager
def _interrupts_withheld(start: StartMethod) -> Iterator[None]:
    """Keep Ctrl-C, which a terminal sends to all processes, from processes started in this block.

    A process inherits the blocked signals of the thread that starts it.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    if start is StartMethod.SERVER:
        from multiprocessing import resource_tracker

        resource_tracker.ensure_running()  # started later, it would unblock the signal
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


# -- a copy ----------------------------------------------------------------------------------------


class _Copy:
    """A fork of this process."""

    def __init__(self, pid: int) -> None:
        self.pid = pid

    def kill(self) -> None:
        with suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)

    def exit_code(self) -> int:
        with suppress(ChildProcessError):  # other code of this process has waited for it
            return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        return 0


def _copied(
    setup: Setup[Any, Any], questions: Connection, replies: Connection, memory: int | None
) -> _Copy:
    with warnings.catch_warnings():  # that of forking with threads: see `_workers`
        warnings.simplefilter("ignore", DeprecationWarning)
        pid = os.fork()
    if pid:
        return _Copy(pid)
    try:
        gc.freeze()  # memory stays shared as long as the collector does not touch it
        # The copy must keep no other pipe open: a reader waits until the last writer closes it.
        nothing = os.open(os.devnull, os.O_RDWR)
        for name in os.listdir("/dev/fd"):
            if int(name) not in (questions.fileno(), replies.fileno()):
                os.dup2(nothing, int(name))
        if memory is not None:
            bound_growth(memory)
        _serve(setup, questions, replies)
    finally:
        os._exit(0)  # atexit handlers and open buffers belong to the original


# -- a new interpreter -----------------------------------------------------------------------------


class _Fresh:
    """A new interpreter, which waits for `send_setup`."""

    def __init__(
        self,
        questions: Connection,
        replies: Connection,
        memory: int | None,
        environment: Mapping[str, str],
    ) -> None:
        from subprocess import DEVNULL, Popen

        pipes = (questions.fileno(), replies.fileno())
        folders = [folder for folder in sys.path if isinstance(folder, str)]
        program = (
            f"import sys; sys.path[:] = {folders!r}; "
            f"from polhode.base._processes import begin_fresh; begin_fresh{(*pipes, memory)}"
        )
        self._process = Popen(
            [sys.executable, *(f"-W{option}" for option in sys.warnoptions), "-c", program],
            stdin=DEVNULL,
            env={**os.environ, **environment},
            pass_fds=pipes,
        )
        self.pid = self._process.pid

    def kill(self) -> None:
        self._process.kill()

    def exit_code(self) -> int:
        return self._process.wait()


def send_setup(process: Process, setup: Setup[Any, Any], questions: Connection) -> None:
    """Send its setup to a process that was started without it.

    The caller's script is imported there, as multiprocessing does, only if the setup refers to it.
    Otherwise the script needs no `if __name__ == "__main__"`, and may come from standard input.
    """
    if not isinstance(process, _Fresh):
        return
    from multiprocessing.reduction import ForkingPickler
    from multiprocessing.spawn import get_preparation_data

    pickled = bytes(ForkingPickler.dumps(setup))
    known = get_preparation_data("worker") if b"__main__" in pickled else {}
    questions.send({key: known[key] for key in known if key.startswith("init_main")})
    questions.send_bytes(pickled)


def begin_fresh(questions: int, replies: int, memory: int | None) -> None:
    """Serve in a new interpreter.

    Args:
        questions: descriptor that the setup and the questions come from.
        replies: descriptor for the replies.
        memory: bytes that the process may hold; None for no limit.
    """
    from multiprocessing.connection import Connection
    from multiprocessing.spawn import prepare

    if memory is not None:
        bound_memory(memory)
    incoming = Connection(questions, writable=False)
    with suppress(EOFError, BrokenPipeError):
        prepare(incoming.recv())
        _serve(incoming.recv(), incoming, Connection(replies, readable=False))


# -- a process of multiprocessing ------------------------------------------------------------------


class _InContext:
    """A process of the multiprocessing module."""

    def __init__(
        self,
        context: Any,
        setup: Setup[Any, Any],
        questions: Connection,
        replies: Connection,
        memory: int | None,
    ) -> None:
        self._process = context.Process(
            target=_begin_in_context, args=(setup, questions, replies, memory), daemon=True
        )
        self._process.start()
        self.pid = int(self._process.pid)

    def kill(self) -> None:
        self._process.kill()

    def exit_code(self) -> int:
        self._process.join()
        return int(self._process.exitcode)


def _begin_in_context(
    setup: Setup[Any, Any], questions: Connection, replies: Connection, memory: int | None
) -> None:
    if memory is not None:
        bound_memory(memory)
    _serve(setup, questions, replies)


def _context(start: StartMethod) -> Any:
    from multiprocessing import get_all_start_methods, get_context

    has_server = "forkserver" in get_all_start_methods()
    return get_context("forkserver" if start is StartMethod.SERVER and has_server else "spawn")


def preload(modules: list[str]) -> None:
    """Let the server process of `StartMethod.SERVER`, if there is one, import these modules."""
    _context(StartMethod.SERVER).set_forkserver_preload(modules)


def shared_flag() -> Any:
    """A number, `value`, shared by this process with a `StartMethod.SERVER` worker in its setup."""
    return _context(StartMethod.SERVER).RawValue("i", 0)


# -- in the worker ---------------------------------------------------------------------------------


def _serve(setup: Setup[Any, Any], questions: Connection, replies: Connection) -> None:
    """Prepare the worker, then answer questions until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process ends its workers
    for name in ("SIGPROF", "SIGIO"):  # a copy inherits the handlers of its parent
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)

    def tell(report: Any) -> None:
        replies.send((Message.TOLD, report))

    with suppress(BrokenPipeError, EOFError):
        with ended_with(questions.fileno()):
            answer, error = _outcome(setup)
        replies.send((Message.READY, None) if error is None else (Message.ERROR, error))
        while error is None:
            question, seconds = questions.recv()
            with ended_with(questions.fileno()):
                bound_time(seconds)
                reply, failure = _outcome(answer, question, tell)
            replies.send((Message.ANSWER, reply) if failure is None else (Message.ERROR, failure))
            bound_time(0.0)


def _outcome(task: Callable[..., Any], *given: Any) -> tuple[Any, Exception | None]:
    """The result of a task, or the exception it raised in a form that can be sent."""
    try:
        return task(*given), None
    except PolhodeError as error:
        return None, error
    except MemoryError:
        os._exit(1)  # the process is not usable any more; the parent notices its end
    except Exception as error:
        return None, RuntimeError(f"{type(error).__name__}: {error}")

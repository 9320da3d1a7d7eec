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
from dataclasses import dataclass
from enum import Enum, auto
from threading import RLock
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias, TypeVar

from polhode.base._bounds import bound_growth, bound_memory, bound_time, end_with
from polhode.base._errors import PolhodeError

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

_SAFE_PATH = "PYTHONSAFEPATH"  # an environment variable of Python's
_STARTING = RLock()  # held while it is set for the processes that one thread starts

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


@dataclass(frozen=True)
class Pipes:
    """A worker's ends of the pipes between it and its parent.

    Attributes:
        questions: what it is asked.
        replies: its messages.
        parent: nothing is sent here: the worker ends when the other end is closed.
    """

    questions: Connection
    replies: Connection
    parent: Connection

    @property
    def descriptors(self) -> tuple[int, int, int]:
        """Their numbers, in the order of the attributes."""
        return self.questions.fileno(), self.replies.fileno(), self.parent.fileno()

    def close(self) -> None:
        """Close them in this process."""
        for pipe in (self.questions, self.replies, self.parent):
            pipe.close()


class Process(Protocol):
    """A process, however it was started."""

    @property
    def pid(self) -> int:
        """Its number."""

    def kill(self) -> None:
        """End it, whatever it is doing."""

    def exit_code(self) -> int:
        """Wait for its end; minus the number of the signal that ended it, if one did."""


def begin_process(
    start: StartMethod,
    setup: Setup[Any, Any],
    pipes: Pipes,
    memory: int | None,
    environment: Mapping[str, str],
) -> Process:
    """Begin a process that serves at these ends of its pipes."""
    with _current_folder_withheld(), _interrupts_withheld(start):
        if start is StartMethod.COPY:
            return _copied(setup, pipes, memory)
        if start is StartMethod.FRESH and sys.platform != "win32":
            return _Fresh(pipes, memory, environment)
        return _InContext(_context(start), setup, pipes, memory)


@contextmanager
def _current_folder_withheld() -> Iterator[None]:
    """Keep interpreters started in this block from importing what lies in the current folder.

    multiprocessing starts its server, and the process that frees what is left behind, as
    ``python -c "from multiprocessing..."``: a file of that name in a folder of submissions
    would be run. Modules of the caller are found all the same, as a worker is sent its `sys.path`.
    """
    with _STARTING:
        before = os.environ.get(_SAFE_PATH)
        os.environ[_SAFE_PATH] = "1"
        try:
            yield
        finally:
            if before is None:
                del os.environ[_SAFE_PATH]
            else:
                os.environ[_SAFE_PATH] = before


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


def _copied(setup: Setup[Any, Any], pipes: Pipes, memory: int | None) -> _Copy:
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
            if int(name) not in pipes.descriptors:
                os.dup2(nothing, int(name))
        if memory is not None:
            bound_growth(memory)
        _serve(setup, pipes)
    finally:
        os._exit(0)  # atexit handlers and open buffers belong to the original


# -- a new interpreter -----------------------------------------------------------------------------


class _Fresh:
    """A new interpreter, which waits for `send_setup`."""

    def __init__(self, pipes: Pipes, memory: int | None, environment: Mapping[str, str]) -> None:
        from subprocess import DEVNULL, Popen

        folders = [folder for folder in sys.path if isinstance(folder, str)]
        given = (*pipes.descriptors, memory)
        program = (
            f"import sys; sys.path[:] = {folders!r}; "
            f"from polhode.base._processes import begin_fresh; begin_fresh{given}"
        )
        self._process = Popen(
            [sys.executable, *(f"-W{option}" for option in sys.warnoptions), "-c", program],
            stdin=DEVNULL,
            env={**os.environ, **environment},
            pass_fds=pipes.descriptors,
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


def begin_fresh(questions: int, replies: int, parent: int, memory: int | None) -> None:
    """Serve in a new interpreter.

    Args:
        questions: descriptor that the setup and the questions come from.
        replies: descriptor for the replies.
        parent: descriptor of the pipe with which the process ends.
        memory: bytes that the process may hold; None for no limit.
    """
    from multiprocessing.connection import Connection
    from multiprocessing.spawn import prepare

    if memory is not None:
        bound_memory(memory)
    incoming = Connection(questions, writable=False)
    outgoing = Connection(replies, readable=False)
    pipes = Pipes(incoming, outgoing, Connection(parent, writable=False))
    with suppress(EOFError, BrokenPipeError):
        prepare(incoming.recv())
        _serve(incoming.recv(), pipes)


# -- a process of multiprocessing ------------------------------------------------------------------


class _InContext:
    """A process of the multiprocessing module."""

    def __init__(
        self, context: Any, setup: Setup[Any, Any], pipes: Pipes, memory: int | None
    ) -> None:
        self._process = context.Process(
            target=_begin_in_context, args=(setup, pipes, memory), daemon=True
        )
        self._process.start()
        self.pid = int(self._process.pid)

    def kill(self) -> None:
        self._process.kill()

    def exit_code(self) -> int:
        self._process.join()
        return int(self._process.exitcode)


def _begin_in_context(setup: Setup[Any, Any], pipes: Pipes, memory: int | None) -> None:
    if memory is not None:
        bound_memory(memory)
    _serve(setup, pipes)


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


def print_nothing() -> None:
    """Let this process print nothing, nor compiled libraries in it, which print past Python."""
    nothing = os.open(os.devnull, os.O_WRONLY)
    for number in (1, 2):  # standard output and errors, which may have been closed
        os.dup2(nothing, number)


# -- in the worker ---------------------------------------------------------------------------------


def _serve(setup: Setup[Any, Any], pipes: Pipes) -> None:
    """Prepare the worker, then answer questions until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process ends its workers
    for name in ("SIGPROF", "SIGIO"):  # a copy inherits the handlers of its parent
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    end_with(pipes.parent.fileno())

    def tell(report: Any) -> None:
        pipes.replies.send((Message.TOLD, report))

    with suppress(BrokenPipeError, EOFError):
        answer, error = _outcome(setup)
        pipes.replies.send((Message.READY, None) if error is None else (Message.ERROR, error))
        while error is None:
            question, seconds = pipes.questions.recv()
            bound_time(seconds)
            reply, failure = _outcome(answer, question, tell)
            message = (Message.ANSWER, reply) if failure is None else (Message.ERROR, failure)
            pipes.replies.send(message)
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

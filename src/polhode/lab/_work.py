"""What a worker process does: one task at a time, until one is called off or nobody asks."""

from __future__ import annotations

import json
import signal
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Protocol

from polhode.base import PolhodeError, ended_with

if TYPE_CHECKING:
    from polhode.lab._task_handler import TaskHandler

DONE, REFUSED, CALLED_OFF = b"D", b"R", b"C"  # first byte of a reply


class Flag(Protocol):
    """A number that two processes see."""

    value: int


class CalledOffError(Exception):
    """The task is no longer wanted."""


class Listener:
    """Progress of a simulation, which stops where it is no longer wanted."""

    def __init__(self, unwanted: Flag) -> None:
        self._unwanted = unwanted

    def begin(self, task: str, total: int | None = None) -> None:
        """Stop before it begins, if need be."""
        self.advance()

    def advance(self, steps: int = 1) -> None:
        """Stop, if need be.

        Raises:
            CalledOffError: where the task is no longer wanted.
        """
        if self._unwanted.value:
            raise CalledOffError

    def finish(self) -> None:
        """Nothing is left to stop."""


def work(connection: Connection, unwanted: Flag, own: tuple[str, str, str] | None) -> None:
    """Answer requests until the other end closes.

    Args:
        connection: brings a task and its JSON, separated by a line break; takes the replies.
        unwanted: set to 1 from outside to call off the task at hand.
        own: name, title and declaration of a system of the user's own.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server's: it ends its workers
    from polhode.lab._offer import Own
    from polhode.lab._task_handler import TaskHandler  # heavy, and of no use to the server

    bench = TaskHandler(Own(*own) if own else None, Listener(unwanted))
    while True:
        try:
            task, _, body = connection.recv_bytes().partition(b"\n")
        except (EOFError, OSError):
            return
        with ended_with(connection.fileno()):
            reply = _reply(bench, task.decode("ascii"), body)
        connection.send_bytes(reply)


def _reply(bench: TaskHandler, task: str, body: bytes) -> bytes:
    try:
        return DONE + bench.do(task, body)
    except CalledOffError:
        return CALLED_OFF
    except PolhodeError as error:
        return REFUSED + _told(error.given, error.expected, error.advice)
    except Exception as error:  # a fault of the program's is told, and the worker goes on
        fault = f"unexpected {type(error).__name__}: {error}"[:500]
        return REFUSED + _told(fault, "", "please report it")


def _told(given: str, expected: str, advice: str) -> bytes:
    return json.dumps({"given": given, "expected": expected, "advice": advice}).encode()

"""What workers do in the tests of worker processes; also a program that is killed at it."""

import os
import signal
import sys
import time
from collections import deque
from contextlib import closing
from functools import partial
from itertools import count
from pathlib import Path

from polhode.base import DeclarationError, Worker, answers


def compute_for_ever():
    deque(count(), maxlen=0)  # never comes back to Python, and heeds no signal handler


def doing(scratch="."):
    """Answers questions: the name of what is to be done, or that and a value."""
    mark = Path(scratch) / "died"

    def die_once():
        if not mark.exists():
            mark.touch()
            end(signal.SIGKILL)
        return "alive"

    acts = {
        "pid": os.getpid,
        "fail": lambda: [][0],
        "die": partial(end, signal.SIGKILL),
        "die once": die_once,
        "stop": partial(end, signal.SIGSTOP),
        "too much": lambda: len(bytearray(64 << 30)),
        "compute for ever": compute_for_ever,
        "refuse": refusing,
    }

    def answer(question, tell):
        match question:
            case "double", number:
                return 2 * number
            case "report", number:
                tell(number)
                return number + 1
            case "report and die":
                tell("so far")
                return end(signal.SIGKILL)
            case "begin", begun:
                Path(begun).write_text(str(os.getpid()))
                return compute_for_ever()
            case name:
                return acts[name]()

    return answer


def end(number):
    os.kill(os.getpid(), number)


def not_starting():
    os._exit(3)


def refusing():
    raise DeclarationError("this", expected="that")


def from_list(tasks):
    """Gives one task after the other, to whatever worker."""
    left = iter(tasks)
    return lambda last: next(left, None)


def all_of(tasks, workers=2, scratch=".", **limits):
    """The outcomes of some tasks."""
    begin = partial(Worker, partial(doing, scratch))
    with closing(answers(begin, workers, from_list(tasks), **limits)) as outcomes:
        return list(outcomes)


if __name__ == "__main__":
    idle = Worker(doing)
    idle.ask("pid")
    Path(sys.argv[1], "idle").write_text(str(idle.pid))
    all_of([("begin", str(Path(sys.argv[1], name))) for name in ("one", "other")])
    time.sleep(1000)

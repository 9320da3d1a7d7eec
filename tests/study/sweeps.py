"""A sweep over starts of a disk, to be run, stopped and gone on with; also as a program."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np

from polhode.study import EndMode, Fate, Final, sweep
from study.examples import FLAT, NUMBERS, disk

OUTPUTS = {"theta": Final("theta"), "fate": Fate(), "mode": EndMode()}
AXES = {"theta": ([0.0, 50.0, 60.0, 70.0, 85.0], "deg"), "omega_3": np.linspace(5, 40, 6)}


def fates(out: Path, **options: Any) -> Any:
    """The fate of disks; the start at 0 degrees is none."""
    given = {"chunk": 4, "near_flat": FLAT, "until": ("lifts off",)} | options
    return sweep(disk(), AXES, NUMBERS, {"phi_dot": 1.0}, 0.2, out=out, outputs=OUTPUTS, **given)


class _Stopper:
    """Kills the process once so many members are done."""

    def __init__(self, limit: int, stop: Any) -> None:
        self._left, self._stop = limit, stop

    def begin(self, task: str, total: int | None = None) -> None: ...

    def advance(self, steps: int = 1) -> None:
        self._left -= steps
        if self._left < 0:
            self._stop()

    def finish(self) -> None: ...


def killed_after(members: int) -> _Stopper:
    """As by a power cut."""
    return _Stopper(members, lambda: os.kill(os.getpid(), signal.SIGKILL))


def interrupted_after(members: int) -> _Stopper:
    """As by Ctrl-C."""

    def interrupt() -> None:
        raise KeyboardInterrupt

    return _Stopper(members, interrupt)


if __name__ == "__main__":
    fates(Path(sys.argv[1]), progress=killed_after(int(sys.argv[2])))

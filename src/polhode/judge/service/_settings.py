"""What a teacher fixes when marks are served."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.judge.output._hints import Hints


@dataclass(frozen=True)
class ServiceSettings:
    """Limits of the service, and how much it tells.

    Attributes:
        hints: how much is shown of lines that are not simply true.
        seconds: that one answer may take.
        workers: processes, each of which marks one answer at a time.
        waiting: answers that may wait for a worker; more are turned away.
        longest_wait: s that one may wait before it is turned away; its time begins after that.
        body: bytes of a request.
        arriving: s within which a request has to arrive.
        characters: of an answer.
        correcting: s of processor time in which a correction of a wrong line is sought.
        key: that requests have to show; empty for none.
    """

    hints: Hints = Hints.WHERE
    seconds: float = 20.0
    workers: int = 2
    waiting: int = 32
    longest_wait: float = 60.0
    body: int = 200_000
    arriving: float = 10.0
    characters: int = 20_000
    correcting: float = 2.0
    key: str = ""

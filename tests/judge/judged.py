"""Verdicts without the search for a correction, which changes no answer and may take long."""

from collections.abc import Callable
from typing import Any

import polhode as ph
from polhode.derive import Equations
from polhode.judge import Verdict

Tell = Callable[[Verdict], object]


class _FoundError(Exception):
    """A failure has been found; a correction would be sought next."""


def before_correction(judge: Callable[[Tell], Verdict]) -> Verdict:
    """The verdict of what tells of failures before a correction is sought."""
    failures: list[Verdict] = []

    def stop(verdict: Verdict) -> None:
        failures.append(verdict)
        raise _FoundError

    try:
        return judge(stop)
    except _FoundError:
        return failures[0]


def uncorrected(latex: str, equations: Equations, **options: Any) -> Verdict:
    """As `ph.check` finds it in this process, without a correction."""
    return before_correction(
        lambda stop: ph.check(latex, equations, seconds=None, tell=stop, **options)
    )

"""A worker process that derives a system once and reviews one document after another."""

from __future__ import annotations

import gc
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from polhode.base import PolhodeError, Tell, print_nothing
from polhode.derive import derive
from polhode.judge._review import review_files
from polhode.judge._reviewed import Review, ReviewedLine
from polhode.judge.output._messages import message
from polhode.model import System

# Workers share the cores.
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
MEMORY = 4 << 30
"""Bytes that a worker may hold."""

_COLLECT_AFTER = 50_000  # objects, since nearly all expressions are freed by reference counts


@dataclass(frozen=True)
class ReviewTask:
    """Files to be reviewed.

    Attributes:
        name: by which the answer is told from others.
        paths: of the files.
    """

    name: str
    paths: tuple[Path, ...]


@dataclass(frozen=True)
class ReviewRecord:
    """What came of a task, as plain data.

    Attributes:
        lines: as `ReviewedLine.to_json` gives them, with `part`, `final` and `message` besides.
        seconds: the wall time that it took.
        problem: why the document was not reviewed, or not to its end; empty if it was.
        notes: what holds for the whole document, such as a file that was not found.
    """

    lines: tuple[dict[str, Any], ...] = ()
    seconds: float = 0.0
    problem: str = ""
    notes: tuple[str, ...] = ()

    @property
    def has_errors(self) -> bool:
        """Whether a line is wrong by itself."""
        return any(line["mark"] == "error" for line in self.lines)


def review_worker(system: System) -> Callable[[ReviewTask, Tell[ReviewRecord]], ReviewRecord]:
    """The function that answers in a worker; it reports each line as soon as it is judged."""
    prepare_process()
    equations = derive(system)

    def answer(task: ReviewTask, tell: Tell[ReviewRecord]) -> ReviewRecord:
        def judged(line: ReviewedLine) -> None:
            tell(ReviewRecord((_plain(line),)))

        try:
            return record_of(review_files(task.paths, equations, tell=judged))
        except PolhodeError as error:
            return ReviewRecord(problem=str(error))
        except MemoryError:
            return ReviewRecord(problem="it needs more memory than a document is allowed")
        except Exception as error:  # report a bug of the program, and go on with other documents
            return ReviewRecord(problem=f"unexpected {type(error).__name__}: {error}"[:500])

    return answer


def prepare_process() -> None:
    """Let a worker collect garbage seldom, and print nothing."""
    gc.set_threshold(_COLLECT_AFTER)
    print_nothing()


def record_of(review: Review) -> ReviewRecord:
    """A review as plain data."""
    lines = tuple({**_plain(line), "message": message(line, review)} for line in review.lines)
    problem = "" if lines else "; ".join(review.notes) or "no relation was found in it"
    return ReviewRecord(lines, review.seconds, problem, review.notes if lines else ())


def _plain(line: ReviewedLine) -> dict[str, Any]:
    return {**line.to_json(), "part": line.part, "final": line.is_final}

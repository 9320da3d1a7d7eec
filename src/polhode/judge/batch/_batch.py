"""A folder of submissions reviewed by several processes; a run that was stopped can go on."""

from __future__ import annotations

import json
from collections.abc import Generator, Sequence
from contextlib import closing, suppress
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from typing import Any, TextIO

from polhode.base import (
    DeclarationError,
    Outcome,
    Progress,
    SilentProgress,
    StopRequested,
    StoreError,
    Worker,
    WorkerEndedError,
    answers,
    digest,
    installed_version,
)
from polhode.judge._review_worker import (
    MEMORY,
    ONE_THREAD,
    ReviewRecord,
    ReviewTask,
    review_worker,
)
from polhode.judge.batch._submissions import Submission
from polhode.model import System, write_declaration

SECONDS = 300.0  # s of processor time for one submission
_READY_WITHIN = 300.0  # s in which a worker has to derive the system


@dataclass(frozen=True)
class Batch:
    """The reviews of many submissions.

    Attributes:
        system: its name.
        records: what came of each submission, by its name, in the order given.
        left: the names of those not reached before an interruption.
        kept: how many were reviewed in an earlier run.
    """

    system: str
    records: dict[str, ReviewRecord]
    left: tuple[str, ...] = ()
    kept: int = 0


def review_batch(
    submissions: Sequence[Submission],
    system: System,
    log: Path,
    *,
    workers: int = 2,
    seconds: float = SECONDS,
    progress: Progress | None = None,
) -> Batch:
    """Review every submission against one system, in worker processes that derive it once each.

    One that cannot be read, or takes too long, is reported with the reason; the others go on. Each
    review is added to a log as soon as it is there. After an interruption, or with more
    submissions, those of which the log has a review of the same text are not reviewed again.

    Args:
        submissions: what was handed in.
        system: that they are about.
        log: a file of JSON lines; it is created where it does not exist.
        workers: number of processes.
        seconds: of processor time for one submission.
        progress: advanced by one with every submission.

    Raises:
        DeclarationError: for fewer workers than one, and a system that cannot be derived.
        StoreError: where the log cannot be read or written.
    """
    if workers < 1:
        raise DeclarationError(f"{workers} workers", expected="one or more")
    shown = progress or SilentProgress()
    model = digest(f"{installed_version('polhode')}\0{write_declaration(system)}")
    keys = {s.name: digest(f"{model}\0{s.name}\0{s.digest}") for s in submissions}
    known = _read_log(log)
    records = {name: known[key] for name, key in keys.items() if key in known}
    tasks = [ReviewTask(s.name, s.paths) for s in submissions if s.name not in records]
    kept = len(records)
    shown.begin("reviewing", len(submissions))
    if kept:
        shown.advance(kept)
    try:
        with _appending(log) as stream, closing(_reviewed(tasks, system, workers, seconds)) as run:
            for outcome in run:
                name = outcome.task.name
                records[name] = _record(outcome, seconds)
                _append(stream, keys[name], name, records[name])
                shown.advance()
    except (KeyboardInterrupt, StopRequested):
        pass  # those not reached are named
    finally:
        shown.finish()
    ordered = {s.name: records[s.name] for s in submissions if s.name in records}
    left = tuple(s.name for s in submissions if s.name not in records)
    return Batch(system.name, ordered, left, kept)


def _reviewed(
    tasks: Sequence[ReviewTask], system: System, workers: int, seconds: float
) -> Generator[Outcome[ReviewTask, ReviewRecord]]:
    """The outcomes of the tasks, in the order in which they are finished."""
    begin = partial(
        Worker[ReviewTask, ReviewRecord],
        partial(review_worker, system),
        memory=MEMORY,
        environment=ONE_THREAD,
        ready_within=_READY_WITHIN,
    )
    waiting = iter(tasks)
    try:
        yield from answers(begin, workers, lambda last: next(waiting, None), seconds=seconds)
    except WorkerEndedError:
        raise DeclarationError(
            "a worker process that does not start",
            expected=f"{system.name} to be derived in {_READY_WITHIN:g} s and {MEMORY >> 30} GiB",
            advice="derive it by itself, to see what is wrong",
        ) from None


def _record(outcome: Outcome[ReviewTask, ReviewRecord], seconds: float) -> ReviewRecord:
    """What a worker answered; where it was ended, the lines that it had judged, and why."""
    if outcome.reply is not None:
        return outcome.reply
    lines = tuple(line for told in outcome.told for line in told.lines)
    why = "the worker process ended before it was done, perhaps for lack of memory"
    if outcome.lost is not None and outcome.lost.out_of_time:
        why = f"it took more than {seconds:g} s of processor time"
    return ReviewRecord(lines, seconds, why)


# -- the log ---------------------------------------------------------------------------------------


def _read_log(path: Path) -> dict[str, ReviewRecord]:
    """The records of a log by their keys; a line that a kill cut off is passed over."""
    found: dict[str, ReviewRecord] = {}
    if path.exists() and not path.is_file():
        raise StoreError(f"{path} is no file", expected="the log of a review, or no file yet")
    try:
        text = path.read_text("utf-8") if path.exists() else ""
    except (OSError, UnicodeDecodeError) as error:
        raise StoreError(
            f"{path} cannot be read ({error})", expected="the log of a review"
        ) from error
    for row in text.split("\n"):
        with suppress(ValueError, TypeError, KeyError):
            entry = json.loads(row)
            record = entry["record"]
            lines, notes = tuple(record["lines"]), tuple(record["notes"])
            found[entry["key"]] = ReviewRecord(lines, record["seconds"], record["problem"], notes)
    return found


def _appending(path: Path) -> TextIO:
    try:
        stream = path.open("a", encoding="utf-8", errors="surrogateescape")
        if path.stat().st_size:
            stream.write("\n")  # ends a line that was cut off
        return stream
    except OSError as error:
        raise StoreError(
            f"{path} cannot be written ({error.strerror})",
            expected="a file in a folder that exists and can be written",
        ) from error


def _append(stream: TextIO, key: str, name: str, record: ReviewRecord) -> None:
    entry: dict[str, Any] = {"key": key, "name": name, "record": asdict(record)}
    stream.write(json.dumps(entry) + "\n")
    stream.flush()

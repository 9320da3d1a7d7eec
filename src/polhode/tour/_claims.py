"""The problem set's claims judged, in a process of their own beside the work on the systems."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial

import polhode as ph
from polhode.base import NumericError, Tell, Worker, WorkerEndedError
from polhode.catalogue import CATALOGUE, document_of
from polhode.claims import Judged, Note, audit
from polhode.derive import Equations
from polhode.view import Judgement


@dataclass(frozen=True)
class Told:
    """A claim and its verdict, as text.

    Attributes:
        id: in the document of claims, such as "12".
        system: name in the catalogue.
        stated: LaTeX as the text prints it, or words.
        is_formula: whether it is LaTeX.
        answer: holds, approximate, definition, fails or unread.
        reason: in words.
        correction: LaTeX of the least change that makes it hold; empty for none.
        judgement: the same for a page in three dimensions.
        notes: how it was read, beyond what the text prints.
        part: heading of the part of the text that it stands in.
        convention: of axes, angles and letters in that part, in words.
    """

    id: str
    system: str
    stated: str
    is_formula: bool
    answer: str
    reason: str
    correction: str
    judgement: Judgement
    notes: tuple[Note, ...] = ()
    part: str = ""
    convention: str = ""

    @property
    def place(self) -> tuple[str, str]:
        """The part of the text that it stands in, and the convention there."""
        return self.part, self.convention

    @property
    def problem(self) -> str:
        """The problem it belongs to."""
        return self.system.partition("/")[0]


@contextmanager
def judging(only: Iterable[str]) -> Iterator[Callable[[], tuple[Told, ...]]]:
    """The verdicts on claims with some ids, or on all of them, from a process that judges them
    within this block. To call for them waits until all are there.

    Raises:
        NumericError: where that process ends before.
    """
    with closing(Worker[None, tuple[Told, ...]](partial(_judging, tuple(only)))) as worker:

        def verdicts() -> tuple[Told, ...]:
            try:
                return worker.ask(None)
            except WorkerEndedError:
                raise NumericError(
                    "a worker process that ended while it judged the claims",
                    expected="enough memory for it",
                    advice="judge fewer of them with only",
                ) from None

        yield verdicts


def _judging(only: tuple[str, ...]) -> Callable[[None, Tell[tuple[Told, ...]]], tuple[Told, ...]]:
    """In the worker, which judges as soon as it begins, and is asked later."""
    verdicts = judged(only)
    return lambda question, tell: verdicts


def judged(only: tuple[str, ...]) -> tuple[Told, ...]:
    """Judge the claims of the problem set with these ids, or all of them; part by part."""
    report = audit(document_of(None), _equations, only=only)
    return tuple(_told(judged, part.title) for part, found in report.by_part() for judged in found)


def _equations(system: str) -> Equations:
    return ph.derive(CATALOGUE[system].build())


def _told(judged: Judged, part: str) -> Told:
    claim, verdict = judged.claim, judged.verdict
    return Told(
        id=claim.id,
        system=judged.system,
        stated=claim.printed,
        is_formula=bool(claim.latex),
        answer=verdict.answer.value,
        reason=verdict.reason,
        correction=verdict.correction.latex if verdict.correction is not None else "",
        judgement=Judgement.on(judged),
        notes=(*claim.notes, *(Note("note", note) for note in verdict.notes)),
        part=part,
        convention=judged.convention,
    )

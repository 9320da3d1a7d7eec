"""All claims of a document judged, each against the system of its part."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, partial, reduce
from time import perf_counter

from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._check import judged_claim
from polhode.judge._notation import Notation
from polhode.judge._readings import Chosen
from polhode.judge._typed import with_start
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.document._document import Claim, Document, Part
from polhode.judge.document._part_readings import (
    PartReading,
    choices_by_part,
    part_readings,
    proposed,
    under_part_reading,
)
from polhode.judge.document._report import Judged, Report
from polhode.judge.latex import Statement, read_latex
from polhode.judge.latex._tree import Node

Resolver = Callable[[str], Equations]


@dataclass(frozen=True)
class ClaimChecker:
    """Judges the claims of a document; the notation of each part is built once.

    Attributes:
        resolver: gives the equations of a system by its name.
    """

    resolver: Resolver
    _notations: dict[tuple[str, frozenset[tuple[Node, str]]], Notation] = field(
        default_factory=dict
    )

    def verdict(
        self,
        part: Part,
        claim: Claim,
        chosen: Chosen,
        tell: Callable[[Verdict], object] = lambda verdict: None,
    ) -> Verdict:
        """The verdict on one claim; unread where it, or its part, cannot be read or bound.

        Letters with several meanings are read as chosen, if they are among those; `tell` is called
        with a failure before a correction is sought.
        """
        try:
            return judged_claim(
                claim.formula,
                lambda more: self._notation(part, claim, {**chosen, **more}),
                claim.context,
                claim.when,
                partial(_accompanying, part, claim),
                tell=tell,
            )
        except PolhodeError as error:
            return Verdict.unread(claim.context, error)

    def _notation(self, part: Part, claim: Claim, chosen: Chosen) -> Notation:
        start = (f"{name} = {value}" for name, value in claim.start.items())
        # Start values are added to a copy: claims of one part share bindings and definitions, but
        # each may start its own motion.
        key = part.id, frozenset(chosen.items())
        if key not in self._notations:
            self._notations[key] = Notation.of_part(self.resolver(part.system), part, chosen)
        return reduce(with_start, start, self._notations[key].of_claim(claim))


def _accompanying(part: Part, claim: Claim) -> Iterator[Statement]:
    """Formulas that a document states with the claim."""
    definitions = (d.latex for d in (*part.definitions, *claim.definitions))
    for text in (*definitions, *part.positive, *part.given, *claim.given, *claim.small):
        yield read_latex(text)


def report_on(document: Document, resolver: Resolver, *, only: Iterable[str] = ()) -> Report:
    """Judge every claim of a document, or those with some ids, in this process.

    Args:
        document: the claims of a text, and the meaning of its symbols.
        resolver: gives the equations of a system by its name.
        only: ids of the claims to judge; all of them if empty.

    Raises:
        ParseError: for an id that the document does not have.
    """
    began = perf_counter()
    checker = ClaimChecker(cache(resolver))

    def judge(lines: Sequence[Line]) -> dict[str, Verdict]:
        return {
            line.claim.id: checker.verdict(document.part_of(line.claim), line.claim, line.chosen)
            for line in lines
        }

    claims = selected_claims(document, only)
    verdicts, readings = in_part_readings(document, claims, judge)
    return reported(document, claims, verdicts, readings, perf_counter() - began)


def selected_claims(document: Document, only: Iterable[str]) -> tuple[Claim, ...]:
    """The claims with some ids, in the document's order; all of them where there are no ids.

    Raises:
        ParseError: for an id that the document does not have.
    """
    ids = {document.claim(id).id for id in only}
    return tuple(c for c in document.claims if not ids or c.id in ids)


@dataclass(frozen=True)
class Line:
    """A claim to be judged.

    Attributes:
        claim: of the document.
        chosen: the readings that its part keeps, of letters with several.
    """

    claim: Claim
    chosen: Chosen = field(default_factory=dict)


def in_part_readings(
    document: Document,
    claims: Sequence[Claim],
    judge: Callable[[Sequence[Line]], Mapping[str, Verdict]],
) -> tuple[dict[str, Verdict], tuple[PartReading, ...]]:
    """Verdicts by claim id, each part read in one way, and the readings proposed for that.

    Args:
        document: that the claims are of.
        claims: to be judged.
        judge: gives verdicts by claim id; it may leave out claims after an interruption.
    """
    verdicts = dict(judge([Line(claim) for claim in claims]))
    if len(verdicts) < len(claims):
        return verdicts, ()  # without all lines, which reading most of them call for is unknown
    # Which reading most lines call for does not depend on which of them are selected.
    unclear = {c.part for c in claims if len(verdicts[c.id].by_reading) > 1}
    others = [c for c in document.claims if c.part in unclear and c.id not in verdicts]
    every = {**verdicts, **judge([Line(claim) for claim in others])} if others else verdicts
    readings = [
        reading
        for part in document.parts
        if part.id in unclear
        for reading in part_readings(
            part.id, (every[c.id] for c in document.claims if c.part == part.id and c.id in every)
        )
    ]
    choices = choices_by_part(readings)
    again: list[Line] = []
    for claim in (c for c in claims if c.part in choices):
        choice = choices[claim.part]
        verdict = under_part_reading(verdicts[claim.id], choice)
        if verdict is None:
            again.append(Line(claim, {node: read.meaning for node, read in choice.items()}))
        else:
            verdicts[claim.id] = verdict
    for id, verdict in judge(again).items() if again else ():
        verdicts[id] = proposed(verdict, choices[document.claim(id).part])
    return verdicts, tuple(readings)


def reported(
    document: Document,
    claims: Sequence[Claim],
    verdicts: Mapping[str, Verdict],
    readings: tuple[PartReading, ...],
    seconds: float,
) -> Report:
    """The report on verdicts given by claim id; claims without a verdict count as not reached."""
    left = tuple(claim.id for claim in claims if claim.id not in verdicts)
    report = Report(document, (), left, seconds, readings)
    conventions = {part.id: report.conventions(part) for part in document.parts}
    answers = ((claim.id, verdicts.get(claim.id)) for claim in claims)
    failed = [id for id, verdict in answers if verdict and verdict.answer is Answer.FAILS]
    consequences = {id: document.consequences(id) for id in failed}
    judged = tuple(
        Judged(
            claim,
            part.system,
            verdicts[claim.id],
            tuple(id for id in failed if claim.id in consequences[id]),
            " ".join(conventions[part.id]),
        )
        for claim, part in ((claim, document.part_of(claim)) for claim in claims)
        if claim.id in verdicts
    )
    return replace(report, judged=judged)

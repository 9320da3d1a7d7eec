"""All claims of a document judged, each against the system its part treats."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache, reduce

from polhode.base import PolhodeError
from polhode.claims._check import judged_claim
from polhode.claims._document import Claim, Document
from polhode.claims._notation import Notation
from polhode.claims._typed import with_start
from polhode.claims._verdict import Answer, Verdict
from polhode.derive import Equations

Resolver = Callable[[str], Equations]


@dataclass(frozen=True)
class Judged:
    """One claim with its verdict.

    Attributes:
        claim: of the document.
        system: name of the system it is about.
        verdict: the judgement.
        fed_by: failed claims that it follows from, directly or through others.
    """

    claim: Claim
    system: str
    verdict: Verdict
    fed_by: tuple[str, ...] = ()


@dataclass(frozen=True)
class Report:
    """The verdicts on all claims of a document, in its order."""

    document: Document
    judged: tuple[Judged, ...]

    @property
    def counts(self) -> dict[str, int]:
        """How many claims got each answer."""
        found = Counter(judged.verdict.answer for judged in self.judged)
        return {answer.value: found[answer] for answer in Answer}

    def __str__(self) -> str:
        rows = [f"{j.claim.id:>8}  {j.system:<24}  {j.verdict}" for j in self.judged]
        total = ", ".join(f"{count} {name}" for name, count in self.counts.items() if count)
        return "\n".join([*rows, total])


def audit(document: Document, resolver: Resolver, *, only: Iterable[str] = ()) -> Report:
    """Judge every claim of a document, or those with some ids.

    Args:
        document: what a text states, and how its symbols are meant.
        resolver: gives the equations of a system by its name.
        only: ids of the claims to judge; all of them if empty.

    Raises `ParseError` for an id that the document does not have.
    """
    wanted = [document.claim(id) for id in only] or list(document.claims)
    found = tuple(_verdicts(document, cache(resolver), wanted))
    failed = [j.claim.id for j in found if j.verdict.answer is Answer.FAILS]
    reached = {id: document.consequences(id) for id in failed}
    return Report(
        document,
        tuple(
            replace(j, fed_by=tuple(id for id in failed if j.claim.id in reached[id]))
            for j in found
        ),
    )


def _verdicts(document: Document, resolver: Resolver, claims: Iterable[Claim]) -> Iterator[Judged]:
    notations: dict[str, Notation] = {}
    for claim in claims:
        part = document.part_of(claim)
        try:
            if part.id not in notations:
                notations[part.id] = Notation.of_part(resolver(part.system), part)
            notation = notations[part.id].of_claim(claim)
            start = (f"{name} = {value}" for name, value in claim.start.items())
            notation = reduce(with_start, start, notation)
            verdict = judged_claim(claim.formula, notation, claim.context, claim.when)
        except PolhodeError as error:
            verdict = Verdict(Answer.UNREAD, claim.context, reason=str(error))
        yield Judged(claim, part.system, verdict)

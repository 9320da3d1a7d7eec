"""What the problem set claims about a system, judged, for its page."""

from __future__ import annotations

from polhode.base import DeclarationError
from polhode.catalogue import Entry, audit, document_of
from polhode.view import Judgement


def judgements_on(entry: Entry) -> tuple[Judgement, ...]:
    """The verdicts on every claim about a system, in the order of the text.

    Raises:
        DeclarationError: where there are none.
    """
    claims = claims_about(entry)
    return tuple(Judgement.on(judged) for judged in audit(only=claims).judged)


def claims_about(entry: Entry) -> tuple[str, ...]:
    """Ids of the problem set's claims about a system.

    Raises:
        DeclarationError: where there are none.
    """
    document = document_of(None)
    found = tuple(c.id for c in document.claims if document.part_of(c).system == entry.name)
    if not found:
        raise DeclarationError(
            f"--verdicts for {entry.name}, about which the problem set says nothing",
            expected="a system that its claims are about, such as rolling-disk",
            advice="judge your own with ph.check and give them to ph.page as judgements",
        )
    return found

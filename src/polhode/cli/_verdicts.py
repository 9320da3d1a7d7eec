"""What the problem set claims about a system, judged, for its page."""

from __future__ import annotations

from collections.abc import Collection

from polhode.base import DeclarationError
from polhode.catalogue import CatalogueEntry, audit, document_of
from polhode.view import Judgement


def claims_about(entry: CatalogueEntry) -> tuple[str, ...]:
    """Ids of the problem set's claims about a system.

    Raises:
        DeclarationError: where there are none.
    """
    found = tuple(claim.id for claim in document_of(None).about(entry.name))
    if not found:
        raise DeclarationError(
            f"--verdicts for {entry.name}, about which the problem set says nothing",
            expected="a system that its claims are about, such as rolling-disk",
            advice="judge your own with ph.check and give them to ph.page as judgements",
        )
    return found


def judgements_on(claims: Collection[str]) -> tuple[Judgement, ...]:
    """The verdicts on claims of the problem set with these ids, part by part."""
    parted = audit(only=claims).by_part() if claims else ()
    return tuple(Judgement.on(judged) for _, found in parted for judged in found)

"""A judged claim of a document, as the page of a motion shows it."""

from dataclasses import replace

from polhode.judge._verdict import Answer
from polhode.judge.document._report import Judged
from polhode.view import Judgement, NoteShown, typeset


def judgement_on(judged: Judged) -> Judgement:
    """From the verdict of `polhode.audit` on a claim of a document."""
    claim, verdict = judged.claim, judged.verdict
    judgement = Judgement.of(claim.latex, verdict)
    notes = (
        NoteShown(note.label, note.text, typeset(note.text) if note.is_formula else "")
        for note in claim.notes
    )
    return replace(
        judgement,
        claim=f"({claim.id}) {claim.printed}",
        reason="" if verdict.answer is Answer.HOLDS else verdict.reason,
        notes=(*notes, *judgement.notes),
        convention=judged.convention,
    )

"""Remarks on a text: what it prints, what is right, and how one sees it.

They come from an audit of the text's claims. A claim that fails is shown with a state that refutes
it, with the same numbers computed independently of the derivation, and with its correction, which
is judged again in its own part of the text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.claims import Answer, Document, Judged, Report, Verdict, audit
from polhode.derive import Equations
from polhode.solution._lines import Line, listed

#: Characters of a printed formula that can stand within words.
_INLINE = 170
#: Quantities of a state that are named.
_NAMED = 7
_DIGITS = 3
#: Smaller numbers are zero but for rounding.
_NOISE = 1e-12
#: Longest name of a symbol; a longer reading is a noun.
_SYMBOL = 4
_DOTS = {"dot": 1, "ddot": 2, "dddot": 3}

_LABELS = re.compile(r"\\tag\{[^{}]*\}|\\text\{\s*\(\d+\)\s*\}|\(\d+\)\s*$")
_SPACES = re.compile(r"(\\q?quad|\\,|~|\\n|\s)+$")


@dataclass(frozen=True)
class Remark:
    """What is to be said about one claim of a text, as plain text.

    Attributes:
        id: of the claim.
        name: number or place in brackets, such as "(24)" or "(after (42))".
        answer: holds, approximate, definition, ambiguous, fails or unread.
        printed: LaTeX of the formula, without its number; empty for a statement in words.
        words: the statement in words.
        damage: why the formula was read otherwise than the transcript has it, if it was.
        read_as: LaTeX of the formula as it was read.
        reason: of the verdict.
        evidence: sentences that show a failure.
        change: what the correction changes, in words.
        correction: LaTeX that holds in its place; empty for none.
        context: of the claim.
        fed_by: ids of failed claims from which it follows.
        letters: LaTeX of its letters, each with what it stands for.
    """

    id: str
    name: str
    answer: str
    printed: str = ""
    words: str = ""
    damage: str = ""
    read_as: str = ""
    reason: str = ""
    evidence: str = ""
    change: str = ""
    correction: str = ""
    context: str = ""
    fed_by: tuple[str, ...] = ()
    letters: tuple[tuple[str, str], ...] = ()

    @property
    def holds(self) -> bool:
        """Whether the claim is true, exactly or to its order."""
        return self.answer in ("holds", "approximate")


def remarks_on(
    document: Document, report: Report, resolver: Callable[[str], Equations]
) -> dict[str, Remark]:
    """A remark on every judged claim, by its id; corrections are judged once more."""
    corrected = {
        j.claim.id: j.verdict.correction.latex
        for j in report.judged
        if j.answer is Answer.FAILS and j.verdict.correction is not None
    }
    again = dict[str, bool]()
    if corrected:
        claims = tuple(
            replace(c, latex=corrected[c.id], read_as="", words="", means="")
            if c.id in corrected
            else c
            for c in document.claims
        )
        second = audit(replace(document, claims=claims), resolver, only=corrected)
        again = {j.claim.id: j.verdict.holds for j in second.judged}
    return {j.claim.id: _remark(j, again.get(j.claim.id, False)) for j in report.judged}


def _remark(judged: Judged, is_confirmed: bool) -> Remark:
    claim, verdict = judged.claim, judged.verdict
    correction = verdict.correction if is_confirmed else None
    return Remark(
        id=claim.id,
        name=f"({claim.id if claim.id.isdigit() else claim.where.partition(';')[0]})",
        answer=verdict.answer.value,
        printed=unnumbered(claim.latex),
        words=claim.words,
        damage=claim.reason,
        read_as=unnumbered(claim.read_as) if claim.latex else "",
        reason=verdict.reason,
        evidence=" ".join(_evidence(verdict)) if verdict.answer is Answer.FAILS else "",
        change=correction.what if correction else "",
        correction=unnumbered(correction.latex) if correction else "",
        context=claim.context,
        fed_by=judged.fed_by,
        letters=tuple((r.letter, r.meaning) for r in verdict.shown_readings),
    )


def unnumbered(latex: str) -> str:
    """A printed formula without its number, dollars, and the punctuation at its end."""
    text = " ".join(latex.replace("$$", " ").split())
    while True:
        shorter = _SPACES.sub("", _LABELS.sub("", text.strip()).strip()).rstrip(".,; ")
        if shorter == text:
            return text
        text = shorter


def _evidence(verdict: Verdict) -> Iterator[str]:
    """Sentences with the difference of the sides, a state, and the second computation."""
    example, second = verdict.counterexample, verdict.confirmation
    if example is None:
        return
    difference = example.residual.expression.latex()
    where = example.residual.component
    along = f" along ${_letter(where)}$" if where else ""
    if example.residual.expression and len(difference) <= _INLINE:
        yield f"Left minus right{along} is ${difference}$."
    if second is None:
        return
    shown = [(name, value) for name, value in second.values.items() if abs(value) > _NOISE]
    state = listed(f"${_letter(name)} = {_number(value)}$" for name, value in shown[:_NAMED] or ())
    more = ", and more" if len(shown) > _NAMED else ""
    at = f"For instance, with {state}{more} in SI units" if shown else "At a state of the motion"
    left, right = _number(second.left), _number(second.right)
    yield f"{at} the left side is ${left}$ and the right side ${right}$."
    if second.agrees:
        yield "Accelerations and forces were computed for this without the derivation."


def _letter(name: str) -> str:
    """LaTeX of a published name, such as theta_ddot."""
    if name.startswith("d") and (rest := Expr.generator(Symbol(name[1:])).latex()).startswith("\\"):
        return f"d{rest}"
    base, _, ending = name.rpartition("_")
    order = _DOTS.get(ending, 0)
    if not order:
        return name if name.isdigit() else Expr.generator(Symbol(name)).latex()
    return Expr.generator(Symbol(base, SymbolKind.COORDINATE, order)).latex()


def _number(value: float) -> str:
    text = f"{value:.{_DIGITS}g}"
    if "e" not in text:
        return text
    mantissa, power = text.split("e")
    return rf"{mantissa} \cdot 10^{{{int(power)}}}"


# -- in a solution ---------------------------------------------------------------------------------


def remark_lines(remarks: Iterable[Remark]) -> Iterator[Line]:
    """Agreement with the claims that hold, then a remark on each of the others."""
    every = tuple(remarks)
    agreeing = [r for r in every if r.holds and not r.damage]
    numbered = [r.name for r in agreeing if r.printed]
    said = [f"“{r.words}”" for r in agreeing if r.words]
    if numbered:
        verb = "agrees" if len(numbered) == 1 else "agree"
        yield Line(f"In the text {listed(numbered)} {verb} with this{_also(said)}.")
    elif said:
        yield Line(f"The text says so too: {listed(said)}.")
    for remark in every:
        if remark.holds and remark.damage:
            yield Line(
                f"The transcript is damaged at {remark.name}: {remark.damage}. Read as "
                f"${remark.read_as}$, it agrees with this."
            )
        elif remark.answer == "fails":
            yield from _failing(remark)


def _also(said: list[str]) -> str:
    if not said:
        return ""
    return f", and so {'does' if len(said) == 1 else 'do'} its words {listed(said)}"


def _failing(remark: Remark) -> Iterator[Line]:
    said = f"“{remark.words}”" if remark.words else ""
    if remark.printed and len(remark.printed) <= _INLINE:
        said = f"${remark.printed}$"
    subject = f"Remark. The text has {said} {remark.name}" if said else f"Remark. {remark.name}"
    wrong = "which does not hold" if said else "does not hold as printed"
    comma = ", " if said else " "
    damage = f" The transcript is damaged besides: {remark.damage}." if remark.damage else ""
    change = f" ({remark.change})" if remark.change else ""
    meant = [f"${letter}$ is {_meaning(meaning)}" for letter, meaning in remark.letters]
    said_of = f" There {listed(meant)}." if meant else ""
    words = f"{subject}{comma}{wrong}{change}.{damage}{said_of} {remark.evidence}".strip()
    if not remark.correction:
        yield Line(words)
        return
    yield Line(
        f"{words} It should read",
        remark.correction,
        context=remark.context,
        verdict=Verdict(Answer.HOLDS, remark.context),
    )


def _meaning(words: str) -> str:
    """A reading as a noun with its article; a formula as it stands."""
    spelled = re.sub(r"\b(about|of) cm\b", r"\1 the centre of mass", words)
    is_noun = re.fullmatch(r"[A-Za-z][A-Za-z0-9 ]*", spelled)
    return f"the {spelled}" if is_noun and len(spelled) > _SYMBOL else spelled


def further_remarks(remarks: Mapping[str, Remark], said: Iterable[str]) -> Iterator[Line]:
    """Remarks on the claims that fail and were not spoken of yet."""
    already = set(said)
    yield from remark_lines(
        r for r in remarks.values() if r.answer == "fails" and r.id not in already
    )

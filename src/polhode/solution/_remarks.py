"""Remarks on a text: what it prints, what is right, and how one sees it.

They come from an audit of the text's claims. A claim that fails is shown with a state that refutes
it, with the same numbers computed independently of the derivation, and with its correction, which
is judged again in its own part of the text.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import ParseError
from polhode.derive import Equations
from polhode.judge import (
    Answer,
    Claim,
    Document,
    Judged,
    Part,
    Report,
    Verdict,
    read_latex,
    report_on,
)
from polhode.judge.latex import Name, walk
from polhode.solution._lines import SolutionLine, breaks, listed

#: Characters of a printed formula that can stand within words.
_INLINE = 170
_DIGITS = 3
#: Quotations in one sentence.
_QUOTED = 4
_ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh")
#: Smaller numbers are zero but for rounding.
_NOISE = 1e-12
#: What only formulas contain.
_FORMULA = re.compile(r"[-+*/(]")
_SUBSCRIPT = re.compile(r"_(\d)")
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
#: A letter with another one below it, as quoted.
_LETTER = re.compile(r"([A-Za-zωτ])_([A-Za-z])(?![A-Za-z])")
_ANGLES = re.compile(r"\b(phi|theta|psi|chi)\b")
_DOTS = {"dot": 1, "ddot": 2, "dddot": 3}

_LABELS = re.compile(
    r"\\tag\{[^{}]*\}|\\text\{\s*\(\d+\)\s*\}|(?:(?<=[\s,.;])|(?<=quad))\(\d+\)\s*$"
)
#: The thing that a quantity belongs to, without an article.
_OF_THING = re.compile(r"\b(about|of|in) (?!curvature)(\w+)$")
#: Meanings of letters that every reader takes for granted.
_USUAL = {
    *("angular velocity", "axis z of lab", "gravity", "kinetic energy", "lagrangian", "momentum"),
    *("torque about cm", "velocity", "velocity of cm"),
}
#: The subscript of a value at the start.
_INITIAL = re.compile(r"_(?:0|\{0\})$")
_MOMENT = re.compile(r"^moment of inertia (\d)$")
_CITED = re.compile(r"\((\d+)\)")
_PLACED = re.compile(r"before|after")
#: A line break that the transcript spells out, as distinct from commands such as \\nu.
_NEWLINES = re.compile(r"\\n(?![A-Za-z])")
_SPACES = re.compile(r"(\\q?quad|\\,|~|\\n|\s)+$")


@dataclass(frozen=True)
class Remark:
    """What is to be said about one claim of a text, as plain text.

    Attributes:
        id: of the claim.
        name: number or place, such as "equation 24" or "the formula after equation 42".
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
        stated: definitions of its letters that the text gives, as LaTeX, each with its place.
        given: relations to which the claim is restricted, as LaTeX.
        is_confirmed: whether its numbers were found in a second way too.
        surviving: ids of claims that are derived from it and hold nevertheless.
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
    stated: tuple[tuple[str, str], ...] = ()
    given: tuple[str, ...] = ()
    is_confirmed: bool = False
    surviving: tuple[str, ...] = ()

    @property
    def as_named(self) -> str:
        """The name to follow what it says."""
        return f"as {self.name}" if self.printed else f"({self.name})"

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
        second = report_on(replace(document, claims=claims), resolver, only=corrected)
        again = {j.claim.id: j.verdict.holds for j in second.judged}
    surviving = {c.failed: c.surviving for c in report.consequences}
    parts = {part.id: part for part in document.parts}
    return {
        j.claim.id: _remark(
            j,
            parts[j.claim.part],
            again.get(j.claim.id, False),
            surviving.get(j.claim.id, ()),
        )
        for j in report.judged
    }


def _remark(judged: Judged, part: Part, is_right: bool, surviving: tuple[str, ...]) -> Remark:
    claim, verdict = judged.claim, judged.verdict
    correction = verdict.correction if is_right else None
    second = verdict.confirmation
    return Remark(
        id=claim.id,
        name=_name(claim.id, claim.where.partition(";")[0], bool(claim.words)),
        answer=verdict.answer.value,
        printed=unnumbered(claim.latex),
        words=_LETTER.sub(_as_formula, _SUBSCRIPT.sub(_lowered, claim.words)),
        damage=claim.reason,
        read_as=unnumbered(claim.read_as if claim.latex else claim.formula),
        reason=verdict.reason,
        evidence=" ".join(_evidence(verdict, claim.latex))
        if verdict.answer is Answer.FAILS
        else "",
        change=correction.what if correction else "",
        correction=unnumbered(correction.latex) if correction else "",
        context=claim.context,
        fed_by=judged.fed_by,
        letters=tuple(
            (r.letter, r.meaning)
            for r in verdict.shown_readings
            if r.meaning not in _USUAL and not _is_differential(r.letter, claim.latex)
        ),
        stated=tuple(_stated(claim, part, correction.latex if correction else "")),
        given=tuple(_given(claim, part)),
        is_confirmed=second is not None and second.agrees,
        surviving=tuple(_counted([f"equation {id}" for id in surviving if id.isdigit()])),
    )


def _stated(claim: Claim, part: Part, correction: str) -> Iterator[tuple[str, str]]:
    """The definitions of the text that a claim and its correction are read with."""
    used = {node for text in (claim.formula, correction) if text for node in _pieces(text)}
    for definition in (*part.definitions, *claim.definitions):
        defined = next(iter(read_latex(definition.latex).relations)).sides[0]
        if defined in used:
            yield unnumbered(definition.latex), definition.where


def _given(claim: Claim, part: Part) -> Iterator[str]:
    """What restricts a claim: its own relations, and those of its part between its letters."""
    used = set(_pieces(claim.formula))
    for relation in part.given:
        letters = {piece for piece in _pieces(relation) if isinstance(piece, Name)}
        if letters <= used:
            yield relation
    yield from claim.given


def _pieces(latex: str) -> Iterator[Any]:
    try:
        statement = read_latex(latex)
    except ParseError:
        return
    yield from walk(statement)


def _lowered(found: re.Match[str]) -> str:
    return found[1].translate(_LOWERED)


def _as_formula(found: re.Match[str]) -> str:
    letter = {"ω": r"\omega", "τ": r"\tau"}.get(found[1], found[1])
    return f"${letter}_{found[2]}$"


def _is_differential(letter: str, latex: str) -> bool:
    """Whether a letter occurs only behind a d: of dF it is not said what F is."""
    plain = letter.replace("{", "").replace("}", "").replace(" ", "")
    text = latex.replace("{", "").replace("}", "").replace(" ", "")
    return 0 < text.count(plain) == text.count(f"d{plain}")


def _name(id: str, where: str, is_in_words: bool) -> str:
    """How the text's formula is called; its numbers are not in brackets, as ours are."""
    if id.isdigit():
        return f"equation {id}"
    if is_in_words:
        return _CITED.sub(r"equation \1", where)
    cited = _CITED.sub(r"equation \1", where)
    return f"the formula {cited if _PLACED.match(where) else f'in the {cited}'}"


def unnumbered(latex: str) -> str:
    """A printed formula without its number, dollars, and the punctuation at its end."""
    text = " ".join(_NEWLINES.sub(" ", latex.replace("$$", " ")).split())
    while True:
        shorter = _SPACES.sub("", _LABELS.sub("", text.strip()).strip()).rstrip(".,; ")
        if shorter == text:
            return text
        text = shorter


def _sides(verdict: Verdict, latex: str) -> tuple[str, str]:
    """How the two sides are called that differ: in a chain a = b = c by their places."""
    text = unnumbered(latex)
    signs = [place for place in breaks(text) if text[place + 1] == "="]
    example = verdict.counterexample
    if example is None or len(signs) < 2 or "quad" in text or r"\\" in text:
        return "left side", "right side"
    member = example.residual.member
    if member + 2 > len(_ORDINALS):
        return "left side", "right side"
    return f"{_ORDINALS[member]} expression", _ORDINALS[member + 1]


def _evidence(verdict: Verdict, latex: str) -> Iterator[str]:
    """Sentences with the difference of the sides, a state, and the second computation."""
    example, second = verdict.counterexample, verdict.confirmation
    if example is None:
        return
    one, other = _sides(verdict, latex)
    if verdict.at_odds:
        units = " and ".join(verdict.at_odds[0].units).replace("^2", "²").replace("^3", "³")
        yield f"One sees it by the dimensions: it has terms in {units} side by side."
    difference = example.residual.expression.latex()
    where = example.residual.component
    along = f" along ${_letter(where)}$" if where else ""
    if second is not None and verdict.context == "steady" and len(second.values) == 1:
        ((name, value),) = second.values.items()
        zero = f"${_letter(name)} = {difference}$, for instance ${_number(value)}$,"
        yield f"On the motion that it describes {zero} instead of zero."
        return
    if example.residual.expression and len(difference) <= _INLINE:
        yield f"The {one} minus the {other}{along} is ${difference}$."
    if second is None:
        return
    shown = [(name, value) for name, value in second.values.items() if abs(value) > _NOISE]
    at = "At a state of the motion"
    if shown:
        state = listed(f"${_letter(name)} = {_number(value)}$" for name, value in shown)
        at = f"For instance, with {state} in SI units"
    left, right = _number(second.left), _number(second.right)
    yield f"{at} the {one} is ${left}$ and the {other} ${right}$."


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


def remark_lines(remarks: Iterable[Remark]) -> Iterator[SolutionLine]:
    """Agreement with the claims that hold, then a remark on each of the others."""
    every = tuple(remarks)
    agreeing = [r for r in every if r.holds and not r.damage]
    numbered = [r.name for r in agreeing if r.printed and r.id.isdigit()]
    others = [r.name for r in agreeing if r.printed and not r.id.isdigit()]
    said = [f"“{r.words}”" for r in agreeing if r.words]
    if len(said) > _QUOTED:
        said = [*said[: _QUOTED - 1], f"{len(said) - _QUOTED + 1} others, all of which hold"]
    formulas = [*_counted(numbered), *dict.fromkeys(others)]
    if formulas:
        verb = "agrees" if len(numbered) + len(others) == 1 else "agree"
        also = f", and so do its words {listed(said)}" if said else ""
        yield SolutionLine(f"In the text {listed(formulas)} {verb} with this{also}.")
    elif said:
        yield SolutionLine(f"The text says so too: {listed(said)}.")
    for remark in every:
        if remark.holds and remark.damage and remark.printed:
            yield SolutionLine(
                f"The transcript is damaged at {remark.name}: {remark.damage}. It agrees with this "
                "if it is read as",
                remark.read_as,
                context=remark.context,
                verdict=Verdict(Answer(remark.answer), remark.context),
            )
    failing = [r for r in every if r.answer == "fails"]
    known, told = dict[str, Remark](), set[tuple[str, str]]()
    for remark in failing:
        first = [known[id] for id in remark.fed_by if id in known]
        roots = [one for one in first if not set(one.fed_by) & set(known)]
        letters = tuple(pair for pair in remark.letters if pair not in told)
        stated = tuple(pair for pair in remark.stated if pair not in told)
        yield from _failing(replace(remark, letters=letters, stated=stated), roots)
        known[remark.id] = remark
        told |= {*remark.letters, *remark.stated}
    if any(r.is_confirmed and not set(r.fed_by) & set(known) for r in failing):
        yield SolutionLine(
            "The numbers of these remarks were found in a second way too, with accelerations and "
            "forces that do not come from the derivation."
        )


def _counted(names: list[str]) -> list[str]:
    """Names of equations as one: equations 1, 2 and 5."""
    numbers = [name.rpartition(" ")[2] for name in names]
    plain = len(names) > 1 and all(number.isdigit() for number in numbers)
    return [f"equations {listed(numbers)}"] if plain else names


def _failing(remark: Remark, causes: list[Remark]) -> Iterator[SolutionLine]:
    said = f"the words “{remark.words}”" if remark.words else ""
    if remark.printed and len(remark.printed) <= _INLINE:
        said = f"${remark.printed}$"
    change = f" ({remark.change})" if remark.change else ""
    if said:
        start = f"Remark. The text has {said} {remark.as_named}, which does not hold{change}."
    else:
        start = f"Remark. In the text {remark.name} does not hold as printed{change}."
    words = f"{start} {' '.join(_details(remark, causes))}".strip()
    if not remark.correction:
        yield SolutionLine(words)
        return
    yield SolutionLine(
        f"{words} It should read",
        remark.correction,
        context=remark.context,
        verdict=Verdict(Answer.HOLDS, remark.context),
    )
    if remark.surviving:
        later = listed(remark.surviving)
        yield SolutionLine(f"What the text derives from it in {later} holds all the same.")


def _details(remark: Remark, causes: list[Remark]) -> Iterator[str]:
    if remark.damage and remark.printed:
        yield f"The transcript is damaged besides: {remark.damage}."
    if remark.words and remark.read_as:
        yield f"As a formula this is ${remark.read_as}$."
    if causes:
        carried = ", and carries its mistake on" if _is_carried(remark, causes) else ""
        names = _counted([cause.name for cause in causes])
        yield f"The text derives it from {listed(names)}{carried}."
    yield from _meanings(remark.letters)
    yield from _definitions(remark)
    if causes:
        return
    if remark.evidence:
        yield remark.evidence
    elif remark.words:
        yield f"{remark.reason[:1].upper()}{remark.reason[1:]}."


def _meanings(letters: Iterable[tuple[str, str]]) -> Iterator[str]:
    """What letters of the text are in ours, and what the others are."""
    known, said = dict(letters), list[str]()
    for letter, meaning in known.items():
        later = _INITIAL.sub("", letter)
        is_start = later != letter and known.get(later) == meaning
        said.append(f"${letter}$ {f'is ${later}$ at the start' if is_start else _meaning(meaning)}")
    if said:
        yield f"Here {listed(said)}."


def _definitions(remark: Remark) -> Iterator[str]:
    """What a claim is read with: letters of the text, which the solution may use otherwise."""
    by_place: dict[str, list[str]] = {}
    for latex, where in remark.stated:
        by_place.setdefault(_CITED.sub(r"equation \1", where), []).append(f"${latex}$")
    said = [f"{listed(texts)} ({where})" for where, texts in by_place.items()]
    if said:
        yield f"It is read with {'; '.join(said)}."
    if remark.given:
        yield f"It is judged for {listed(f'${latex}$' for latex in remark.given)}."


def _is_carried(remark: Remark, causes: list[Remark]) -> bool:
    """Whether the correction changes what that of its only cause does."""
    return len(causes) == 1 and bool(remark.change) and remark.change in causes[0].change


def _meaning(words: str) -> str:
    """A reading as a predicate: a noun with its article, or a formula in our letters."""
    formula, along, axes = words.partition(" along ")
    if _FORMULA.search(formula) or (not along and _is_letter(words)):
        if formula.startswith("(") and "," in formula:
            return f"has the components ${_typeset(formula)}$"
        return f"is our ${_typeset(formula)}${along}{axes}"
    spelled = _OF_THING.sub(_with_article, _MOMENT.sub(r"moment of inertia about \1", words))
    return f"is the {_ANGLES.sub(lambda name: f'${_letter(name[0])}$', spelled)}"


def _with_article(found: re.Match[str]) -> str:
    """A thing that is named at the end of a meaning: its kind is added where only axes have it."""
    of, name = found.groups()
    if name.isdigit():
        return f"about axis ${name}$"
    if of == "in":
        return f"in the frame of the {name}"
    name = "centre of mass" if name == "cm" else name
    is_frame = found.string.startswith("angular velocity") and name.islower() and name != "axes"
    return f"{of} the {name}{' axes' if is_frame else ''}"


def _is_letter(word: str) -> bool:
    """Whether a word is the name of a symbol; others are printed upright."""
    return " " not in word and not _letter(word).startswith(r"\mathrm")


def _typeset(formula: str) -> str:
    """A formula of published names as LaTeX."""
    return re.sub(r"[A-Za-z]\w*", lambda name: _letter(name[0]), formula)


def further_remarks(remarks: Mapping[str, Remark], said: Iterable[str]) -> Iterator[SolutionLine]:
    """Remarks on the claims that fail and were not spoken of yet."""
    already = set(said)
    yield from remark_lines(
        r for r in remarks.values() if r.answer == "fails" and r.id not in already
    )

"""A review as one page: the text typeset, with a mark beside every relation and its evidence."""

from __future__ import annotations

import re
from collections import defaultdict, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib.resources import files
from pathlib import Path, PurePath

from polhode.base import ParseError, write_whole
from polhode.derive import Equations
from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge.output._evidence_html import (
    SCROLLS,
    correction_html,
    example_html,
    formula_html,
    readings_html,
    residuals_html,
)
from polhode.judge.output._hints import Hints, with_hints
from polhode.judge.output._messages import SIGNS, TITLES, place_of, sentence
from polhode.judge.output._refuting import refuting_scenes
from polhode.judge.source import Macro, ShownFormula, SourceWords, read_pieces
from polhode.judge.text._words import TextBlock, blocks, formula_at, with_formulas, without_marks
from polhode.view import (
    Markup,
    document,
    html_of,
    joined,
    scene_button,
    scene_frame,
    styled,
    tag,
)

_TOLD = {
    Hints.WHERE: "This page says which lines are wrong, and withholds why.",
    Hints.KIND: "This page says which lines are wrong and what kind of slip was made, and "
    "withholds the corrections.",
    Hints.CORRECTION: "",
}
Typesettable = Callable[[str], str]
"""Makes LaTeX of a text ready to be typeset."""

_WIDE = 40  # characters of a formula
_ALIGNMENT = re.compile(r"(?<!\\)&")
_BETWEEN = re.compile(r"&\s*(=|<|>|\\[a-z]+)\s*&")  # a sign, as eqnarray has it
_ENVIRONMENT = re.compile(r"\\begin\{(\w+)\}.*?\\end\{\1\}", re.DOTALL)
_UNSEEN = re.compile(r"\\(?:nonumber|notag|qedhere)(?![A-Za-z])|(?<=\\\\)\[-?[0-9.]+[a-z]+\]")
_ENDING = re.compile(r"(?:\s|\\\\|\\[,;: ]|[.,;])+\Z")


def review_page(
    review: Review,
    path: str | Path,
    equations: Equations | None = None,
    hints: Hints = Hints.CORRECTION,
) -> None:
    """Write a review as a self-contained page, which fetches nothing when it is opened.

    Args:
        review: of a document; its `texts` give the words between the formulas.
        path: of the file to write.
        equations: of the system, to play the states that refute lines; None to show no motion.
        hints: how much is shown of lines that are not simply true. What is withheld is nowhere in
            the page.

    Raises:
        StoreError: where it cannot be written.
    """
    write_whole(Path(path), review_html(review, equations, hints).encode("utf-8"))


def review_html(
    review: Review, equations: Equations | None = None, hints: Hints = Hints.CORRECTION
) -> str:
    """The text of the page that `review_page` writes; arguments as there."""
    shown = with_hints(review, hints)
    scenes = refuting_scenes(shown, equations) if equations is not None else {}
    frame = scene_frame({str(number): scene for number, scene in scenes.items()})
    parts = PageParts(shown, frozenset(scenes))
    names = ", ".join(PurePath(name).name for name in review.files if name) or "A text"
    title = without_marks(f"{names}, reviewed")
    header = tag("header", tag("h1", title), *_summary(shown), *_notice(hints), class_="summary")
    main = tag("main", *(_text(name, parts) for name in file_names(shown)))
    return document(
        title, page_style(), header, main, *frame.body, head=frame.head, class_="review"
    )


@html_of.register
def notebook_html(review: Review) -> Markup:
    """The review within a notebook, which has no room for motions."""
    texts = (_text(name, PageParts(review)) for name in file_names(review))
    inner = tag("div", *_summary(review), *texts, class_="review")
    return joined([tag("style", Markup(page_style())), inner])


def page_style() -> str:
    """The style of pages about reviews, with the fonts of formulas."""
    return styled((files("polhode.judge") / "review.css").read_text("utf-8"), ".review")


def file_names(review: Review) -> list[str]:
    """All files that have lines or a text, those included behind those that were given."""
    return list(dict.fromkeys([*review.files, *(line.file for line in review.lines)]))


def _notice(hints: Hints) -> Iterator[Markup]:
    if _TOLD[hints]:
        yield tag("p", _TOLD[hints], class_="note")


# -- the summary -----------------------------------------------------------------------------------


def _summary(review: Review) -> Iterator[Markup]:
    yield tag("p", "Judged against the model of ", tag("strong", review.system), ".", class_="note")
    yield counts_html(review)
    errors = [link(review, line) for line in review.errors]
    if errors:
        title = "Errors" if len(errors) > 1 else "Error"
        yield tag("p", f"{title}: ", joined(errors, ", "), ".")
    yield from final_html(review)
    for note in review.notes:
        yield tag("p", without_marks(note), class_="note")


def counts_html(review: Review) -> Markup:
    """How many lines got each mark."""
    counts = [tag("li", badge(mark), f" {n}") for mark, n in review.summary.items() if n]
    if not counts:
        return tag("p", "No relation was found.")
    return tag("ul", *counts, class_="counts", aria_label="How many lines got each mark")


def final_html(review: Review) -> Iterator[Markup]:
    """The mark of every final answer."""
    for final in review.finals:
        yield tag("p", "Final answer, ", link(review, final), ": ", badge(final.mark))


def badge(mark: Mark) -> Markup:
    """A mark as its sign and its words."""
    sign = tag("span", SIGNS[mark], aria_hidden="true", class_="sign")
    return tag("span", sign, f" {TITLES[mark]}", class_=f"verdict {mark.value}")


def link(review: Review, line: ReviewedLine) -> Markup:
    """A link to the place of a line in the page."""
    return tag("a", _place(review, line), href=f"#r{review.lines.index(line)}")


def _place(review: Review, line: ReviewedLine) -> str:
    """The number of a line, with its file where there are several."""
    where = f" of {PurePath(line.file).name}" if len(file_names(review)) > 1 else ""
    return f"line {line.line}{where}"


# -- the text --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class PageParts:
    """A review, and which of its lines have a motion to be played."""

    review: Review
    played: frozenset[int] = frozenset()
    _numbers: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._numbers.update({id(line): i for i, line in enumerate(self.review.lines)})

    def number(self, line: ReviewedLine) -> int:
        """The index of a line."""
        return self._numbers[id(line)]

    @cached_property
    def macros(self) -> dict[str, Macro]:
        """Those that its files define, where there are several: one may include another."""
        found: dict[str, Macro] = {}
        names = self.review.texts if len(self.review.texts) > 1 else ()
        for name in names:
            deque(_pieces(name, self, found), maxlen=0)
        return found

    @cached_property
    def by_file(self) -> Mapping[str, list[ReviewedLine]]:
        """The lines of each file, in order."""
        found: dict[str, list[ReviewedLine]] = defaultdict(list)
        for line in self.review.lines:
            found[line.file].append(line)
        return found


Placed = tuple[ShownFormula, list[ReviewedLine]]
"""A formula of a text, and the lines of a review that stand in it."""


def pieces_of(name: str, parts: PageParts) -> Iterator[str | Placed]:
    """The words and the formulas of a file, in order; none of a damaged notebook."""
    lines = parts.by_file.get(name, [])
    for piece in _pieces(name, parts, {**parts.macros}):
        if isinstance(piece, ShownFormula):
            inside = [x for x in lines if piece.begin <= (x.line, x.column) < piece.end]
            yield piece, inside
        else:
            yield without_marks(piece.text)


def _pieces(
    name: str, parts: PageParts, macros: dict[str, Macro]
) -> Iterator[SourceWords | ShownFormula]:
    text = parts.review.texts.get(name, "")
    with suppress(ParseError):
        yield from read_pieces(text, format_of(name), macros) if text else ()


def typesettables(review: Review) -> list[Typesettable]:
    """For each line, what makes LaTeX of it ready to be typeset, in the macros of its text."""
    parts = PageParts(review)
    known: dict[int, Typesettable] = {}
    for name in file_names(review):
        for piece in pieces_of(name, parts):
            if not isinstance(piece, str):
                formula, inside = piece
                known |= {id(line): typesettable(formula) for line in inside}
    return [known.get(id(line), without_marks) for line in review.lines]


def format_of(name: str) -> str:
    """The ending of a file's name; that of LaTeX for a text without a name."""
    return PurePath(name).suffix.lower() or ".tex"


def _text(name: str, parts: PageParts) -> Markup:
    """A file: its words and formulas, and behind them the relations whose place is not known."""
    formulas: list[Placed] = []
    words: list[str] = []
    for piece in pieces_of(name, parts):
        if isinstance(piece, str):
            words.append(piece)
        else:
            words.append(formula_at(len(formulas), is_display=piece[0].is_display))
            formulas.append(piece)
    shown = [_block(block, formulas, parts) for block in blocks("".join(words), format_of(name))]
    html = joined(shown)
    lines = parts.by_file.get(name, [])
    left = [line for line in lines if f'id="r{parts.number(line)}"' not in html]
    rest = [relation_html(line, without_marks, parts) for line in left]
    heading = tag("h2", PurePath(name).name) if len(file_names(parts.review)) > 1 else Markup()
    return tag("section", heading, *_listed(shown), *rest)


def _listed(shown: Iterable[Markup]) -> Iterator[Markup]:
    """Blocks, with successive items in one list."""
    items: list[Markup] = []
    for block in shown:
        if block.startswith("<li"):
            items.append(block)
            continue
        if items:
            yield tag("ul", *items)
            items = []
        yield block
    if items:
        yield tag("ul", *items)


def _block(block: TextBlock, formulas: Sequence[Placed], parts: PageParts) -> Markup:
    if block.kind == "formula":
        return _display(*formulas[block.number], parts)
    inside: list[tuple[ShownFormula, ReviewedLine]] = []

    def formula(number: int) -> Markup:
        piece, lines = formulas[number]
        inside.extend((piece, line) for line in lines)
        chips = (_chip(line, parts) for line in lines)
        shown = formula_html(typesettable(piece)(piece.latex))
        if len(piece.latex) > _WIDE:  # wider than a phone, and no browser breaks it
            shown = tag("span", shown, class_="wide", **SCROLLS)
        return joined([shown, *chips])

    words = with_formulas(block.html, formula)
    evidence = _evidence_of_paragraph(inside, parts)
    if block.kind == "li":
        return tag("li", words, evidence)
    return joined([tag(block.kind, words), evidence])


def _display(piece: ShownFormula, lines: Sequence[ReviewedLine], parts: PageParts) -> Markup:
    """A formula on lines of its own: a row for each of its relations."""
    if not lines:
        return tag("div", formula_html(typesettable(piece)(piece.latex)), class_="bare", **SCROLLS)
    return joined(relation_html(line, typesettable(piece), parts) for line in lines)


def typesettable(piece: ShownFormula) -> Typesettable:
    """Parts of a formula without macros and the point behind them, in the rows of the author."""

    def bare(latex: str) -> str:
        text = _ENDING.sub("", _UNSEEN.sub("", piece.expanded(latex)))
        outside = _ENVIRONMENT.sub("", text)
        if r"\\" in outside or ("&" in outside and outside != text):
            text = r"\begin{split}" + _BETWEEN.sub(r"&\1", text) + r"\end{split}"
        elif outside == text:
            text = _ALIGNMENT.sub("", text)
        return without_marks(text.replace("{aligned}", "{split}"))

    return bare


def _chip(line: ReviewedLine, parts: PageParts) -> Markup:
    """The mark of a relation within a line of words, which leads to what is said of it."""
    sign = tag("span", SIGNS[line.mark], aria_hidden="true", class_="sign")
    words = tag("span", f" ({TITLES[line.mark]})", class_="unseen")
    href = f"#r{parts.number(line)}"
    return tag("a", sign, words, class_=f"chip {line.mark.value}", href=href)


def _evidence_of_paragraph(
    inside: Sequence[tuple[ShownFormula, ReviewedLine]], parts: PageParts
) -> Markup:
    """What is said of the relations in a paragraph; those that hold are folded away."""
    rows = [(line, relation_html(line, typesettable(piece), parts)) for piece, line in inside]
    holding = [row for line, row in rows if line.mark is Mark.TRUE]
    others = [row for line, row in rows if line.mark is not Mark.TRUE]
    if holding:
        count = f"{len(holding)} relation{'s' * (len(holding) > 1)} in this paragraph"
        verb = "hold" if len(holding) > 1 else "holds"
        others.append(tag("details", tag("summary", f"{count} {verb}"), *holding))
    return joined(others)


# -- one relation ----------------------------------------------------------------------------------


def relation_html(line: ReviewedLine, bare: Typesettable, parts: PageParts) -> Markup:
    """A relation, its mark, and what is said of it."""
    number = parts.number(line)
    shown = formula_html(bare(line.latex))
    final = tag("span", "final answer", class_="final") if line.is_final else Markup()
    margin = tag(
        "p", badge(line.mark), final, tag("small", _place(parts.review, line)), class_="margin"
    )
    return tag(
        "div",
        tag("div", shown, class_="formula", **SCROLLS),
        margin,
        _said(line, bare, parts),
        id=f"r{number}",
        role="group",
        aria_label=f"Line {line.line}: {TITLES[line.mark]}",
        class_=f"relation {line.mark.value}",
    )


def _said(line: ReviewedLine, bare: Typesettable, parts: PageParts) -> Markup:
    """The mark in a sentence, the correction, and the evidence, folded away."""
    reason = Markup()
    if line.mark is not Mark.TRUE:
        reason = tag("p", *_reason(line, parts.review), class_="reason")
    fix = Markup()
    correction = line.verdict and line.verdict.correction
    if correction and line.mark is not Mark.TRUE:
        corrected = replace(correction, latex=bare(correction.latex))
        fix = correction_html("written", bare(line.latex), corrected)
    evidence = joined(_evidence(line, bare, parts))
    if evidence:
        evidence = tag("details", tag("summary", "Evidence"), tag("div", evidence, **SCROLLS))
    return joined([reason, fix, evidence])


def _reason(line: ReviewedLine, review: Review) -> Iterator[str]:
    """The mark in a sentence, in which the line that it refers to is a link."""
    words = without_marks(sentence(line, review))
    before, place, after = words.partition(place_of(line, review))
    yield before
    if place:
        yield tag("a", place, href=f"#r{line.of}")
    yield after


def _evidence(line: ReviewedLine, bare: Typesettable, parts: PageParts) -> Iterator[Markup]:
    verdict = line.verdict
    if line.context:
        yield tag("p", "Judged as: ", tag("strong", line.context), ".")
    if verdict is None:
        return
    if letters := readings_html(verdict.shown_readings):
        yield tag("p", "Letters read: ", letters, ".")
    if line.mark is Mark.TRUE and verdict.reason:
        yield tag("p", verdict.reason)
    for remark in verdict.details:
        yield tag("p", f"{remark[:1].upper()}{remark[1:]}.")
    for other in verdict.alternatives:
        yield tag("p", f"Or, {other.what}: ", formula_html(bare(other.latex)))
    if line.tried:
        yield tag("p", "It fails too with ", "; with ".join(map(without_marks, line.tried)), ".")
    if line.mark not in (Mark.NOT_JUDGED, Mark.DOUBT):
        yield from residuals_html(verdict)
        yield from example_html(verdict)
    number = parts.number(line)
    if number in parts.played:
        title = f"The motion from a state that refutes line {line.line}, in three dimensions"
        yield scene_button(str(number), "Show the motion from this state", title)

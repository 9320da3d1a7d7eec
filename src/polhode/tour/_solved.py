"""A worked solution on a page of the tour, with the motions that show its answers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from html import escape
from math import degrees

from polhode.algebra import Expr, Symbol
from polhode.solution import MOTION, Solution, Step
from polhode.tour._motions import ShownMotion, unit_of
from polhode.view import Markup, inline, joined, table, tag, typeset_in_pieces, words_with_formulas

_NUMBER = re.compile(r"\((\d+)\)")
#: Smaller values are zero but for rounding.
_NOISE = 1e-12
#: What an id, or a reference to one, follows in a drawing.
_IDS = re.compile(r"""(\bid="|url\(#|href="\#|aria-labelledby=")""")
_OPENINGS = ("Asked: ", "Convention: ", "Remark. ")


def solved(
    solution: Solution, anchor: str, level: int, motions: Mapping[str, Markup]
) -> Iterator[Markup]:
    """Figure and sections of a solution.

    Args:
        solution: to be shown.
        anchor: of its section on the page, with which the names of its equations begin.
        level: of its headings.
        motions: what shows the answer to a question, by the title of the question.
    """
    if solution.figure:
        caption = tag("figcaption", solution.figure.caption)
        drawing = _with_own_ids(solution.figure.svg(), anchor)
        yield tag("figure", drawing, caption, class_="system")
    titles = {question.heading: question.title for question in solution.questions}
    for heading, steps in solution.sections.items():
        kind = "question" if heading in titles else "part"
        yield tag(f"h{level}", heading, class_=kind)
        yield from _paragraphs(steps, anchor)
        if heading == MOTION and solution.motion:
            svg = solution.motion[solution.motion.index("<svg") :]
            yield tag("figure", _with_own_ids(svg, f"{anchor}-motion"), class_="system")
        yield motions.get(titles.get(heading, ""), Markup())


def _with_own_ids(svg: str, anchor: str) -> Markup:
    """A drawing whose ids differ from those of the other drawings on the page."""
    return Markup(_IDS.sub(lambda found: f"{found[1]}{anchor}-", svg))


def _paragraphs(steps: tuple[Step, ...], anchor: str) -> Iterator[Markup]:
    for step in steps:
        if step.words:
            yield _paragraph(step, anchor)
        if step.latex:
            yield _equation(step, anchor)


def _paragraph(step: Step, anchor: str) -> Markup:
    """Words with their formulas; what is asked, conventions and remarks are marked as such."""
    opening = next((o for o in _OPENINGS if step.words.startswith(o)), "")
    rest = step.words.removeprefix(opening)
    text = words_with_formulas(rest, _linking(step, anchor))
    if not opening:
        return tag("p", text)
    label = opening.strip()
    kind = label.rstrip(":.").lower()
    return tag("p", tag("span", label, class_="label"), " ", text, class_=kind)


def _linking(step: Step, anchor: str) -> Callable[[str], str]:
    """Text with the numbers of the formulas it refers to as links."""

    def link(found: re.Match[str]) -> str:
        if int(found[1]) not in step.references:
            return found[0]
        return f'<a class="reference" href="#{anchor}-{found[1]}">({found[1]})</a>'

    return lambda text: _NUMBER.sub(link, escape(text, quote=False))


def _equation(step: Step, anchor: str) -> Markup:
    name = f"{anchor}-{step.number}"
    shown = joined(typeset_in_pieces(step.latex))
    return tag(
        "div",
        tag("div", shown, class_="formula", role="math", tabindex="0"),
        tag("a", f"({step.number})", class_="number", href=f"#{name}"),
        class_="numbered",
        id=name,
    )


# -- motions ---------------------------------------------------------------------------------------


def motion_shown(shown: ShownMotion, page: str, image: Markup) -> Markup:
    """A motion with its caption, the page in three dimensions, its history and its extremes.

    Args:
        shown: the motion, simulated.
        page: address of the page in three dimensions.
        image: picture of its history.
    """
    title = shown.motion.title
    return tag(
        "div",
        tag("p", tag("strong", f"{title[0].upper()}{title[1:]}."), f" {shown.motion.caption}"),
        tag("p", words_with_formulas(shown.happened)) if shown.happened else Markup(),
        player(page, title),
        image,
        _extremes(shown),
        class_="motion",
    )


def player(page: str, title: str) -> Markup:
    """A page in three dimensions, in a frame."""
    frame = tag(
        "iframe", src=page, title=f"{title}, played", sandbox="allow-scripts", loading="lazy"
    )
    whole = tag("p", tag("a", "The page by itself", href=page))
    return tag("div", frame, whole, class_="player")


def _extremes(shown: ShownMotion) -> Markup:
    if not shown.extremes:
        return Markup()
    run = shown.run
    header = ("quantity", "least", "at", "greatest", "at")
    rows = []
    for extreme in shown.extremes:
        name = extreme.quantity
        # reactions have formulas of their own, for which their letters stand here
        reaction = Expr.generator(Symbol(name)) if name in run.reactions else None
        unit = unit_of(run, name)
        scale = degrees(1.0) if unit == "rad" else 1.0
        after = "°" if unit == "rad" else f" {unit}"
        rows.append(
            (
                inline(reaction or run.quantities[name]),
                f"{_shown(extreme.least * scale)}{after}",
                f"{extreme.least_at:.3g} s",
                f"{_shown(extreme.greatest * scale)}{after}",
                f"{extreme.greatest_at:.3g} s",
            )
        )
    return tag("div", table(header, rows, class_="numbers"), class_="wide")


def _shown(value: float) -> str:
    return "0" if abs(value) < _NOISE else f"{value:.4g}".replace("-", "−")


def folded(title: str, *content: Markup) -> Markup:
    """What is not needed at first sight."""
    return tag("details", tag("summary", title), joined(content), class_="folded")

"""A worked solution as a page, and as HTML for a notebook."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from importlib.resources import files

from polhode.base import installed_version
from polhode.solution._solution import MOTION, Solution, Step
from polhode.solution._words import paragraphs, with_displays
from polhode.view import (
    Markup,
    document,
    html_of,
    joined,
    math_fonts,
    styled,
    tag,
    typeset_in_pieces,
    words_with_formulas,
)

_REFERENCE = re.compile(r"\((\d+)\)")
_WORDS = {"holds": "judged: holds", "approximate": "judged: holds to the order stated"}


def page_of_solution(solution: Solution) -> str:
    """One self-contained page without scripts or external resources."""
    version = installed_version("polhode") or "(not installed)"
    closing = tag(
        "footer",
        f"Written by polhode {version}. {solution.counted} were judged against the declared "
        "system when this page was made.",
    )
    title = f"{solution.title}: a worked solution"
    return document(title, _style(), tag("main", *_body(solution)), closing)


@html_of.register
def _(thing: Solution) -> str:
    # Nested, so that the rules do not reach the rest of the notebook.
    nested = f"{math_fonts()}\n.polhode-solution {{\n{_own_style()} }}"
    return tag("div", tag("style", Markup(nested)), *_body(thing), class_="polhode-solution")


def _style() -> str:
    return styled(_own_style())


def _own_style() -> str:
    return files("polhode.solution").joinpath("style.css").read_text("utf-8")


def _body(solution: Solution) -> Iterator[Markup]:
    yield tag("h1", solution.title)
    yield tag("p", "A worked solution", class_="subtitle")
    if solution.figure:
        caption = tag("figcaption", solution.figure.caption)
        yield tag("figure", Markup(solution.figure.svg()), caption)
    for section, steps in solution.sections.items():
        shown = _motion(solution) if section == MOTION else ()
        yield tag("section", tag("h2", section), *_section(steps), *shown)


def _motion(solution: Solution) -> Iterator[Markup]:
    if solution.motion:
        yield tag("figure", Markup(solution.motion[solution.motion.index("<svg") :]))


def _section(steps: tuple[Step, ...]) -> Iterator[Markup]:
    for words, step in paragraphs(steps):
        if words:
            yield tag("p", paragraph_html(words))
        if step is not None:
            yield _equation(step)


def paragraph_html(words: str) -> Markup:
    """Words with their formulas typeset and numbers of equations linked."""

    def text(piece: str) -> str:
        link = r'<a class="reference" href="#eq\1">(\1)</a>'
        return _REFERENCE.sub(link, escape(piece, quote=False))

    return Markup(with_displays(words, lambda part: words_with_formulas(part, text), _displayed))


def _displayed(latex: str, mark: str) -> str:
    """A long formula within words, on lines of its own."""
    pieces = [*typeset_in_pieces(latex), Markup(mark)]
    return tag("span", joined(pieces), class_="formula", role="math", tabindex="0")


def _equation(step: Step) -> Markup:
    formula = joined(typeset_in_pieces(step.latex))
    judged = _WORDS.get(step.verdict.answer.value, "") if step.verdict else ""
    number = tag("a", f"({step.number})", class_="number", href=f"#eq{step.number}", title=judged)
    return tag(
        "div",
        tag("div", formula, class_="formula", role="math", tabindex="0"),
        number,
        class_="equation",
        id=f"eq{step.number}",
    )

"""The evidence for a verdict as HTML: corrections, residuals, a state that refutes a claim."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.claims import Correction, Verdict
from polhode.view._html import Markup, tag
from polhode.view._mathml import typeset, typeset_change

SCROLLS = {"tabindex": "0"}
"""Attributes of what is scrolled by the arrow keys where it is too wide."""

_SHOWN = 1200  # characters of a residual


def formula_html(latex: str) -> Markup:
    """LaTeX typeset, or as source text if it cannot be."""
    return (typeset(latex) or tag("code", latex)) if latex else Markup()


def correction_html(source: str, before: str, correction: Correction | None) -> Markup:
    """A formula above the corrected one, with what differs marked; nothing without a correction.

    Args:
        source: what the formula is called, such as "printed".
        before: the formula as LaTeX.
        correction: of it.
    """
    if correction is None:
        return Markup()
    if not correction.latex:  # withheld: only the kind of slip is shown
        return tag("div", tag("p", correction.what), class_="correction")
    was, now = typeset_change(before, correction.latex)
    shown = now or formula_html(correction.latex)
    return tag(
        "div",
        tag("p", correction.what),
        tag("div", tag("span", source), was or formula_html(before), class_="was", **SCROLLS),
        tag("div", tag("span", "holds"), shown, class_="is", **SCROLLS),
        class_="correction",
    )


def residuals_html(verdict: Verdict) -> Iterator[Markup]:
    """Left side minus right side of every component that does not vanish."""
    if verdict.residuals:
        yield tag("p", "Left side minus right side, exactly:")
        items = []
        for residual in verdict.residuals:
            where = f", component {residual.component}" if residual.component else ""
            short = len(str(residual.expression)) < _SHOWN
            shown = formula_html(residual.expression.latex()) if short else "too long to show"
            items.append(tag("li", f"member {residual.member + 1}{where}: ", shown))
        yield tag("ul", *items)


def example_html(verdict: Verdict) -> Iterator[Markup]:
    """A state that refutes the claim, and the independent check of it."""
    if (example := verdict.counterexample) is not None:
        left, right = (tag("b", side) for side in example.sides)
        yield tag("p", f"At {example.state} (SI): left ", left, ", right ", right, ".")
    if (second := verdict.confirmation) is not None:
        verb = "confirms" if second.agrees else "contradicts"
        yield tag(
            "p",
            "A separate numerical balance of forces and moments on every body gives "
            f"{second.left:.9g} and {second.right:.9g}, which {verb} this.",
        )

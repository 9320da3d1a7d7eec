"""The evidence for a verdict as HTML: corrections, residuals, a state that refutes a claim."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import starmap

from polhode.judge._verdict import Correction, Read, Verdict
from polhode.judge.latex import write_latex
from polhode.judge.latex._names import name_of
from polhode.view import Markup, joined, tag, typeset, typeset_change, words_with_published

SCROLLS = {"tabindex": "0"}
"""Attributes of what is scrolled by the arrow keys where it is too wide."""

_ANGLE = re.compile(r"2\*atan\((?P<tangent>[^()]+)\)")
_FRACTION = re.compile(r"(-?)([0-9]+)(?:/([0-9]+))?")
_SHOWN = 1200  # characters of a residual


def formula_html(latex: str) -> Markup:
    """LaTeX typeset, or as source text if it cannot be."""
    return (typeset(latex) or tag("code", latex)) if latex else Markup()


def readings_html(readings: Iterable[Read]) -> Markup:
    """The meanings that letters were given, the letters typeset; empty for none."""
    shown = (
        joined([typeset(r.letter) or r.plain, " ", words_with_published(r.words)]) for r in readings
    )
    return joined(shown, "; ")


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
        are_several = len({residual.member for residual in verdict.residuals}) > 1
        items = []
        for residual in verdict.residuals:
            member = [f"member {residual.member + 1}"] if are_several or residual.member else []
            component = [f"component {residual.component}"] if residual.component else []
            where = ", ".join([*member, *component])
            short = len(str(residual.expression)) < _SHOWN
            shown = formula_html(residual.expression.latex()) if short else "too long to show"
            items.append(tag("li", where and f"{where}: ", shown))
        yield tag("ul", *items)


def _value_html(name: str, value: str) -> Markup:
    """A quantity of a state with its value, typeset, or as text where it is no simple number."""
    latex = _value_latex(value)
    return formula_html(f"{write_latex(name_of(name))} = {latex}" if latex else f"{name} = {value}")


def _value_latex(value: str) -> str:
    """A fraction, or an angle 2 atan(q), as LaTeX; empty for anything else."""
    angle = _ANGLE.fullmatch(value)
    number = _FRACTION.fullmatch(angle["tangent"] if angle else value)
    if number is None:
        return ""
    sign, upper, lower = number.groups(default="")
    shown = rf"{sign}\tfrac{{{upper}}}{{{lower}}}" if lower else f"{sign}{upper}"
    if angle:
        bracketed = rf"\left({shown}\right)" if sign else shown
        return rf"2\arctan\,{bracketed}"
    return shown


def example_html(verdict: Verdict) -> Iterator[Markup]:
    """A state that refutes the claim, and the independent check of it."""
    if (example := verdict.counterexample) is not None:
        left, right = (tag("b", side) for side in example.sides)
        state = joined(starmap(_value_html, example.values.items()), ", ")
        yield tag("p", "At ", state, " (SI): left ", left, ", right ", right, ".")
    if (second := verdict.confirmation) is not None:
        verb = "confirms" if second.agrees else "contradicts"
        yield tag(
            "p",
            "A separate numerical balance of forces and moments on every body gives "
            f"{second.left:.9g} and {second.right:.9g}, which {verb} this.",
        )

"""Lines of a worked solution before they are numbered and judged, and formulas of vectors."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from math import gcd, lcm

from polhode.algebra import ONE, Expr, Symbol, Vector, sqrt, with_fewer_terms
from polhode.algebra import latex as latex_of
from polhode.derive import Equations
from polhode.judge import Verdict
from polhode.model import Frame

_ON_ONE_LINE = 280  # characters


@dataclass(frozen=True)
class SolutionLine:
    """A paragraph and the formula displayed below it.

    Attributes:
        words: the paragraph, with `$…$` around letters, and `[[key]]` for the number of a line.
        latex: the formula; empty for words alone.
        key: by which other lines refer to it.
        context: of the claim that the formula makes.
        let, given, small, positive: what is stated with the claim, as for `check`.
        bindings: meanings of letters, as LaTeX → quantity in words, as in documents of claims.
        of: the equations that it is judged against, if not those of the system.
        verdict: on the formula, where it was judged already, such as in the text's own notation.
        values: quantities that the line finds, each with its LaTeX, for typical numbers.
        stated: claims that the words make, each a line without words; they are judged too.
        sides: both sides of an equation for accelerations.
    """

    words: str
    latex: str = ""
    key: str = ""
    context: str = "motion"
    let: tuple[str, ...] = ()
    given: tuple[str, ...] = ()
    small: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()
    bindings: Mapping[str, str] = field(default_factory=dict)
    of: Equations | None = None
    verdict: Verdict | None = None
    values: tuple[tuple[str, Expr], ...] = ()
    stated: tuple[SolutionLine, ...] = ()
    sides: tuple[Expr, Expr] | None = None


def size(lines: Iterable[SolutionLine]) -> int:
    """Characters displayed, by which the shortest route is found."""
    return sum(len(line.latex) for line in lines)


# -- vectors ---------------------------------------------------------------------------------------


def letter_of(label: str) -> str:
    """LaTeX of the label of an axis."""
    return label if label.isdigit() else latex_of(Expr.generator(Symbol(label)))


def unit(label: str) -> str:
    """LaTeX of the unit vector with a label: 3̂, ẑ, ρ̂."""
    letter = letter_of(label)
    bold = r"\boldsymbol" if letter.startswith("\\") else r"\mathbf "
    return rf"\hat{{{bold}{letter}}}"


def vector_latex(vector: Vector, frame: Frame) -> str:
    """A vector by components along a frame, with the factor common to them in front."""
    components = map(with_fewer_terms, vector.express(frame).components)
    parts = dict(zip(frame.labels, components, strict=True))
    present = {label: value for label, value in parts.items() if value}
    if not present:
        return "0"
    if len(present) == 1:
        ((label, value),) = present.items()
        return _term(value, label)
    first, *others = (_with_factor(present, one) for one in _factors(tuple(present.values())))
    # a line may break between terms, but on a page not within the brackets behind a factor
    return min((first, *(text for text in others if len(text) <= _ON_ONE_LINE)), key=len)


def _factors(values: Sequence[Expr]) -> Iterator[Expr]:
    """What may stand in front: the common factor, also with the only denominator of several."""
    yield common_factor(values)
    divisors = {value.denominator for value in values if value.denominator.rational is None}
    if len(divisors) == 1:
        (divisor,) = divisors
        yield common_factor([value * divisor for value in values]) / divisor


def _with_factor(present: Mapping[str, Expr], shared: Expr) -> str:
    """A vector with a factor of its components in front."""
    parts = [(value / shared).latex() for value in present.values()]
    if shared != ONE and (
        shared.latex().startswith("-") or all(part.startswith("-") for part in parts)
    ):
        shared = -shared
    inside = joined([_term(value / shared, label) for label, value in present.items()])
    return inside if shared == ONE else rf"{shared.latex()}\left({inside}\right)"


def joined(terms: Sequence[str]) -> str:
    """Terms with + between them; a sign at the start of a term replaces it."""
    text = terms[0]
    for term in terms[1:]:
        text += f" - {term[1:].lstrip()}" if term.startswith("-") else f" + {term}"
    return text


def bracketed(text: str) -> str:
    """A formula in brackets if it is a sum or begins with a sign."""
    return rf"\left({text}\right)" if is_sum(text) or text.startswith("-") else text


def _term(value: Expr, label: str) -> str:
    if value == ONE:
        return unit(label)
    if value == -ONE:
        return f"-{unit(label)}"
    text = value.latex()
    if not is_sum(text):
        return rf"{text}\,{unit(label)}"
    opposite = (-value).latex()
    if text.startswith("-") and not opposite.startswith("-"):
        return rf"-\left({opposite}\right)\,{unit(label)}"
    return rf"\left({text}\right)\,{unit(label)}"


def is_sum(text: str) -> bool:
    """Whether LaTeX has a sign between terms outside all brackets."""
    return any(text[place + 1] in "+-" for place in breaks(text))


def breaks(text: str) -> list[int]:
    """Where a line of LaTeX may end: before signs and = outside all brackets."""
    found, depth = list[int](), 0
    for token in re.finditer(r"\\left|\\right|[{}]| [+=-] ", text):
        if token[0] in ("{", r"\left"):
            depth += 1
        elif token[0] in ("}", r"\right"):
            depth -= 1
        elif not depth:
            found.append(token.start())
    return found


def common_factor(values: Sequence[Expr]) -> Expr:
    """The number, letters and functions that all terms of some polynomials share."""
    if any(value.denominator.rational is None for value in values):
        return ONE
    terms = [term for value in values for term in value.terms()]
    divisors = [value.denominator.rational or Fraction(1) for value in values]
    numbers = [
        number / divisor
        for value, divisor in zip(values, divisors, strict=True)
        for _, number in value.terms()
    ]
    above = gcd(*(abs(number.numerator) for number in numbers))
    below = lcm(*(number.denominator for number in numbers))
    shared = Expr.constant(Fraction(above, below))
    for generator in terms[0][0]:
        power = min(powers.get(generator, 0) for powers, _ in terms)
        shared = shared * Expr.generator(generator) ** power
    return shared


def fraction(value: Expr) -> str:
    """LaTeX of an expression, as one fraction where that avoids fractions within fractions."""
    numerators = [number for _, number in value.numerator.terms()] or [Fraction(1)]
    scale = lcm(*(number.denominator for number in numerators))
    above, below = value.numerator * scale, value.denominator * scale
    texts = [value.latex(), _unsigned((-value).latex())]
    if below != ONE:
        texts += [rf"\frac{{{above.latex()}}}{{{below.latex()}}}"]
        texts += [rf"-\frac{{{(-above).latex()}}}{{{below.latex()}}}"]
    return min(texts, key=_awkwardness)


def negative_multiple(value: Expr, letter: Expr) -> str:
    """LaTeX of -(value) times a letter, with a sum in brackets."""
    text = fraction(value)
    if is_sum(text):
        return f"-{bracketed(text)} {letter.latex()}"
    return _unsigned(fraction(value * letter))


def root_latex(square: Expr) -> str:
    """LaTeX of the square root, with one sign of the root where that is possible."""
    return min((sqrt(square).latex(), rf"\sqrt{{{fraction(square)}}}"), key=_awkwardness)


def _unsigned(text: str) -> str:
    """A formula with the opposite sign, in brackets if it is a sum."""
    return text[1:].lstrip() if text.startswith("-") and not is_sum(text) else f"-{bracketed(text)}"


def _awkwardness(text: str) -> tuple[int, int, int]:
    """Fractions within fractions, roots, and signs and letters of a formula."""
    letters = len(text.replace(r"\left", "").replace(r"\right", "").replace(" ", ""))
    return _nested(text), text.count(r"\sqrt"), letters + 8 * text.count("-")


def _nested(text: str) -> int:
    """How many fractions stand within others."""
    found = 0
    for start in re.finditer(r"\\frac", text):
        depth = arguments = 0
        for token in re.finditer(r"\\frac|[{}]", text[start.end() :]):
            depth += {"{": 1, "}": -1}.get(token[0], 0)
            arguments += token[0] == "}" and not depth
            if arguments == 2:
                break
            found += token[0] == r"\frac"
    return found


# -- words -----------------------------------------------------------------------------------------


def listed(words: Iterable[str]) -> str:
    """a, b and c."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


def inline(expression: Expr | Symbol) -> str:
    """An expression within words."""
    value = Expr.generator(expression) if isinstance(expression, Symbol) else expression
    return f"${value.latex()}$"

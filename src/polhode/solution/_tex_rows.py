"""Long formulas in rows, for LaTeX: broken before signs, also within brackets."""

from __future__ import annotations

import re
from itertools import pairwise

from polhode.solution._lines import breaks

#: Letters that fit on a line of 160 mm in 11 points, beside the number of the formula.
WIDE = 70.0

_TOKEN = re.compile(r"\\left\\?.|\\right\\?.|\\[A-Za-z]+ ?|\\.|[{}^_]| [+=-] | |.", re.DOTALL)
_SPACES = {" + ": 3.0, " - ": 3.0, " = ": 3.0, " ": 0.0}
_SIGNS = {"+", "-", "="}
_OPENING = {
    "(",
    "[",
    "{",
    "=",
    "+",
    "-",
    ",",
    "^",
    "_",
    r"\left(",
    r"\left[",
    r"\left.",
    r"\approx",
}
_SMALL = 0.7  # an index or a power beside a letter
_FRACTION = re.compile(r"^((?:[^{}]*? = )?)\\frac\{")


def rows_of(latex: str) -> list[str]:
    """The rows of a formula, one for a short one; brackets are closed and opened at their ends."""
    if width(latex) <= WIDE:
        return [latex]
    return _broken(_unfolded(latex))


def is_long_in_a_sentence(latex: str) -> bool:
    """Whether a formula would fill most of a line of text, or a third of it without a break."""
    places = [0, *breaks(latex), len(latex)]
    unbroken = max(width(latex[start:end]) for start, end in pairwise(places))
    return width(latex) > 2 * WIDE / 3 or unbroken > WIDE / 3


def width(latex: str) -> float:
    """About how many letters wide a formula is."""
    total, at = 0.0, 0
    tokens = _TOKEN.findall(latex)
    while at < len(tokens):
        token = tokens[at]
        at += 1
        if token.strip() == r"\frac":
            above, at = _group(tokens, at)
            below, at = _group(tokens, at)
            total += max(width(above), width(below)) + 0.5
        elif token in "^_":
            inside, at = _group(tokens, at)
            total += _SMALL * width(inside)
        elif token in "{}":
            continue
        else:
            total += _glyph(token)
    return total


def _glyph(token: str) -> float:
    if token in _SPACES:
        return _SPACES[token]
    if token.startswith((r"\left", r"\right")):
        return 0.9
    name = token.strip()
    if name in (r"\sin", r"\cos", r"\tan"):
        return 3.2
    if name in (r"\dot", r"\ddot", r"\hat", r"\mathbf", r"\boldsymbol", r"\rm", r"\mathrm", r"\,"):
        return 0.2
    return 2.4 if name in _SIGNS else 1.0


def _group(tokens: list[str], at: int) -> tuple[str, int]:
    """What stands in braces from a place on, or the one token there, and the place behind it."""
    if at >= len(tokens) or tokens[at] != "{":
        return (tokens[at] if at < len(tokens) else ""), at + 1
    depth, start = 0, at + 1
    while at < len(tokens):
        depth += {"{": 1, "}": -1}.get(tokens[at], 0)
        at += 1
        if not depth:
            break
    return "".join(tokens[start : at - 1]), at


def _unfolded(latex: str) -> str:
    """A formula whose right-hand side is one long fraction, with the divisor in front."""
    found = _FRACTION.match(latex)
    if not found:
        return latex
    tokens = _TOKEN.findall(latex[found.end() - 1 :])
    above, at = _group(tokens, 0)
    below, at = _group(tokens, at)
    rest = "".join(tokens[at:])
    if width(above) <= WIDE - 10:
        return latex
    return rf"{found[1]}\frac{{1}}{{{below}}} \left({above}\right){rest}"


def _broken(latex: str) -> list[str]:
    """Rows, each broken at the outermost sign in its second half."""
    rows, rest = list[str](), latex
    while width(rest) > WIDE:
        place = _place(rest)
        if place is None:
            break
        at, depth = place
        rows.append(rest[:at] + r"\right." * depth)
        rest = r"\left." * depth + rest[at:]
    return [*rows, rest]


def _place(latex: str) -> tuple[int, int] | None:
    """Where a row ends: before a sign outside all braces, and in how many brackets."""
    best: tuple[float, int, int] | None = None
    at, braces, brackets, before = 0, 0, 0, "("
    for token in _TOKEN.findall(latex):
        braces += {"{": 1, "}": -1}.get(token, 0)
        brackets += token.startswith(r"\left") - token.startswith(r"\right")
        if token.strip() in _SIGNS and not braces and before not in _OPENING:
            wide = width(latex[:at])
            if wide > WIDE:
                break
            if wide > WIDE / 3:
                merit = wide - 30.0 * brackets + (20.0 if token.strip() == "=" else 0.0)
                if best is None or merit > best[0]:
                    best = (merit, at, brackets)
        before = token.strip() or before
        at += len(token)
    return None if best is None else best[1:]

"""Letters of formulas, and those that a solution introduces because the system has none."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from polhode.algebra import Expr, Length, Symbol, variables
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.judge.latex import GREEK

_SUBSCRIPT = r"(?:_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[a-z]+|\w))?"
# What has letters that are no quantities: unit vectors, vectors, words, functions, dots and the
# sign of a differential, which no parameter may share.
_NO_LETTERS = re.compile(
    r"\\hat\{(?:[^{}]|\{[^{}]*\})*\}"
    rf"|\\(?:mathbf|boldsymbol|mathcal|mathsf)\s*\{{?\\?[A-Za-z]+\}}?{_SUBSCRIPT}"
    r"|\\(?:operatorname|mathrm|text)\s*\{[^{}]*\}|\\d?dot(?=\{)|(?<![A-Za-z\\])d(?=[}\\a-z])"
)
_GREEK = "|".join(sorted(GREEK - {"pi", "Pi"}))
_LETTER = re.compile(
    rf"(?:\\(?:{_GREEK})(?![a-z])|(?<![\\a-zA-Z])[A-Za-z](?![a-zA-Z]))'?"
    rf"\}}?{_SUBSCRIPT}"
)


def letters_in(latex: str) -> frozenset[str]:
    """The letters of quantities in a formula, with their subscripts and without dots."""
    found = (match[0] for match in _LETTER.finditer(_NO_LETTERS.sub(" ", latex)))
    # the brace behind a letter with a dot closes what the dot stands over
    return frozenset(re.sub(r"^([^_{]*)\}", r"\1", letter) for letter in found)


def lengths_among(formulas: Iterable[str], equations: Equations) -> Iterator[Length]:
    """The lengths whose letters occur in formulas."""
    used = frozenset[str]().union(*map(letters_in, formulas))
    for part in equations.lengths.values():
        if Expr.generator(Symbol(part.letter.name)).latex() in used:
            yield part


def free_letter(equations: Equations, *candidates: str) -> Symbol:
    """The first of some published names that the system does not use.

    Raises `NumericError` where it uses them all.
    """
    known = {s.published for s in (*equations.parameters, *equations.coordinates)}
    known |= {s.published for s in equations.speeds} | set(equations.components)
    # also what the motion does not depend on, such as a moment of inertia that drops out
    bodies = equations.system.bodies
    known |= {
        s.published
        for s in variables([e for b in bodies for e in (b.mass, *sum(b.inertia.rows, ()))])
    }
    for name in candidates:
        if name not in known:
            return Symbol(name)
    raise NumericError(
        f"a system that uses all the letters {', '.join(candidates)}",
        expected=f"one of them free in {equations.system.name}",
        advice="rename a parameter",
    )


def letter_latex(symbol: Symbol) -> str:
    """LaTeX of a letter."""
    return Expr.generator(symbol).latex()


def definition(name: str, value: str) -> str:
    """A definition for a claim; the braces say that it is LaTeX."""
    return f"{{{name}}} = {value}"

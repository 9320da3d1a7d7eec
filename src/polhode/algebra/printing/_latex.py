"""Expressions as LaTeX, as a mechanics text prints them, and as MathML."""

from __future__ import annotations

from polhode.algebra._expression import Expr
from polhode.algebra._ring import Symbol
from polhode.algebra.printing._layout import layout
from polhode.algebra.printing._names import GREEK, Spelling
from polhode.algebra.printing._nodes import (
    PrintCall,
    PrintFraction,
    PrintName,
    PrintNode,
    PrintNumber,
    PrintPower,
    PrintProduct,
    PrintSum,
)

_ACCENTS = ("", "dot", "ddot", "dddot")


def latex(expression: Expr) -> str:
    r"""LaTeX of an expression: `5 a \ddot{\theta} + 4 g \cos\theta`."""
    return layout(expression).drawn(_Latex())


def latex_of_symbol(symbol: Symbol) -> str:
    r"""LaTeX of a symbol: `\dot{\omega}_3` for omega_3_dot, `F'_{\rho}` for Fprime_rho."""
    spelling = Spelling.of(symbol)
    subscript = ",".join(s if s.isdigit() else _letter(s) for s in spelling.subscripts)
    below = f"_{subscript}" if len(subscript) == 1 else f"_{{{subscript}}}"
    letter = _letter(spelling.stem)
    if spelling.dots >= len(_ACCENTS):
        letter = rf"{letter}^{{({spelling.dots})}}"
    elif spelling.dots:
        letter = rf"\{_ACCENTS[spelling.dots]}{{{letter}}}"
    return letter + "'" * spelling.primes + (below if subscript else "")


def mathml(formula: str) -> str:
    """Presentation MathML of a LaTeX formula."""
    from latex2mathml.converter import convert

    return str(convert(formula))


def _letter(name: str) -> str:
    if name in GREEK:
        return rf"\{name}"
    return name if len(name) == 1 else rf"\mathrm{{{name}}}"


class _Latex:
    """The style of `latex`."""

    def number(self, value: int) -> str:
        return str(value)

    def name(self, symbol: Symbol) -> str:
        return latex_of_symbol(symbol)

    def call(self, function: str, argument: PrintNode) -> str:
        return self._called(function, "", argument)

    def power(self, base: PrintNode, exponent: int) -> str:
        raised = f"^{exponent}" if exponent < 10 else f"^{{{exponent}}}"
        match base:
            case PrintCall(function="abs", argument=argument):
                return self._called("abs", "", argument) + raised
            case PrintCall(function=function, argument=argument):
                return self._called(function, raised, argument)
            case PrintSum() | PrintProduct() | PrintFraction() | PrintPower():
                return self._bracketed(base) + raised
        written = base.drawn(self)
        return f"{{{written}}}{raised}" if "'" in written or "^" in written else written + raised

    def product(self, factors: tuple[PrintNode, ...]) -> str:
        sign = "-" if factors[0] == PrintNumber(-1) else ""
        rest = factors[1:] if sign else factors
        parts = (self._bracketed(f) if isinstance(f, PrintSum) else f.drawn(self) for f in rest)
        return sign + " ".join(parts)

    def sum(self, terms: tuple[PrintNode, ...]) -> str:
        written = terms[0].drawn(self)
        for term in terms[1:]:
            size = term.negated() if term.is_negative else term
            written += f" {'-' if term.is_negative else '+'} {size.drawn(self)}"
        return written

    def fraction(self, above: PrintNode, below: PrintNode) -> str:
        return rf"\frac{{{above.drawn(self)}}}{{{below.drawn(self)}}}"

    def radical(self, radicand: PrintNode) -> str:
        return rf"\sqrt{{{radicand.drawn(self)}}}"

    def letter(self, letter: PrintNode, meaning: PrintNode) -> str:
        return letter.drawn(self)

    def _called(self, function: str, raised: str, argument: PrintNode) -> str:
        inside = argument.drawn(self)
        if function == "abs":
            return rf"\left|{inside}\right|"
        if isinstance(argument, PrintName):
            gap = "" if inside.startswith("\\") else " "
            return rf"\{function}{raised}{gap}{inside}"
        return rf"\{function}{raised}\left({inside}\right)"

    def _bracketed(self, node: PrintNode) -> str:
        return rf"\left({node.drawn(self)}\right)"

"""Expressions on one line: plain ASCII that a parser reads back, and pretty Unicode."""

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


def text(expression: Expr) -> str:
    """Plain ASCII with published names: `5*a*theta_ddot + 4*g*cos(theta)`."""
    return layout(expression).drawn(_Text())


def pretty(expression: Expr) -> str:
    """One line of Unicode: 5 a θ̈ + 4 g cosθ."""
    return layout(expression).drawn(_Pretty())


class _Text:
    """The style of `text`."""

    minus = "-"
    times = "*"

    def number(self, value: int) -> str:
        return str(value)

    def name(self, symbol: Symbol) -> str:
        return symbol.published

    def call(self, function: str, argument: PrintNode) -> str:
        return f"{function}({argument.drawn(self)})"

    def power(self, base: PrintNode, exponent: int) -> str:
        return f"{self._in_power(base)}**{exponent}"

    def product(self, factors: tuple[PrintNode, ...]) -> str:
        sign = self.minus if factors[0] == PrintNumber(-1) else ""
        rest = factors[1:] if sign else factors
        return sign + self.times.join(self._bracketed(f, PrintSum) for f in rest)

    def sum(self, terms: tuple[PrintNode, ...]) -> str:
        written = terms[0].drawn(self)
        for term in terms[1:]:
            size = term.negated() if term.is_negative else term
            written += f" {self.minus if term.is_negative else '+'} {size.drawn(self)}"
        return written

    def fraction(self, above: PrintNode, below: PrintNode) -> str:
        over = self._bracketed(above, PrintSum)
        return f"{over}/{self._bracketed(below, PrintSum, PrintProduct, PrintFraction)}"

    def radical(self, radicand: PrintNode) -> str:
        return f"sqrt({radicand.drawn(self)})"

    def letter(self, letter: PrintNode, meaning: PrintNode) -> str:
        return letter.drawn(self)

    def _in_power(self, base: PrintNode) -> str:
        return self._bracketed(base, PrintSum, PrintProduct, PrintFraction, PrintPower)

    def _bracketed(self, node: PrintNode, *looser: type[PrintNode]) -> str:
        written = node.drawn(self)
        return f"({written})" if isinstance(node, looser) else written


_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
_SUBSCRIPTS = str.maketrans("0123456789aehijklmnoprstuvxβγρφχ", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓᵦᵧᵨᵩᵪ")
_DOTS = ("", "\u0307", "\u0308", "\u20db")


class _Pretty(_Text):
    """The style of `pretty`."""

    minus = "−"
    times = " "

    def number(self, value: int) -> str:
        return f"{value}".replace("-", self.minus)

    def name(self, symbol: Symbol) -> str:
        spelling = Spelling.of(symbol)
        stem = GREEK.get(spelling.stem, spelling.stem)
        dots = _DOTS[spelling.dots : spelling.dots + 1] or (f"⁽{_raised(spelling.dots)}⁾",)
        subscripts = "".join(map(_lowered, spelling.subscripts))
        return stem[0] + dots[0] + stem[1:] + "′" * spelling.primes + subscripts

    def call(self, function: str, argument: PrintNode) -> str:
        inside = argument.drawn(self)
        if function == "abs":
            return f"|{inside}|"
        return function + self._argument(argument, inside)

    def power(self, base: PrintNode, exponent: int) -> str:
        match base:
            case PrintCall(function="abs"):
                return self.call("abs", base.argument) + _raised(exponent)
            case PrintCall(function=function, argument=argument):
                inside = argument.drawn(self)
                return function + _raised(exponent) + self._argument(argument, inside)
        return self._in_power(base) + _raised(exponent)

    def radical(self, radicand: PrintNode) -> str:
        inside = radicand.drawn(self)
        return f"√{inside}" if isinstance(radicand, PrintName | PrintNumber) else f"√({inside})"

    def _argument(self, argument: PrintNode, inside: str) -> str:
        if not isinstance(argument, PrintName):
            return f"({inside})"
        return f" {inside}" if inside[0].isascii() else inside


def _raised(number: int) -> str:
    return str(number).translate(_SUPERSCRIPTS)


def _lowered(subscript: str) -> str:
    glyphs = GREEK.get(subscript, subscript)
    lowered = glyphs.translate(_SUBSCRIPTS)
    return f"_{glyphs}" if any(a == b for a, b in zip(glyphs, lowered, strict=True)) else lowered

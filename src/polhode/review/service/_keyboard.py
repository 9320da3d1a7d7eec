r"""Answers as keyboards have them, ``3*g/(2*l)`` or ``sqrt(g/l)``, written as LaTeX.

Where multiplication is printed, a slash divides by the one factor behind it, as in programs; where
it is not, slashes are left for the reader of LaTeX, which knows that writers differ.
"""

from __future__ import annotations

import re

from polhode.claims import write_latex
from polhode.claims.building_blocks import FUNCTIONS, GREEK, name_of

_TOKEN = re.compile(
    r"\s*(?:(?P<number>[0-9]+(?:\.[0-9]+)?|\.[0-9]+)|(?P<name>[A-Za-z]+(?:_[A-Za-z0-9]+)*_?)"
    r"|(?P<power>\*\*|\^)|(?P<open>[(\[])|(?P<close>[)\]])|(?P<other>[^\s]))"
)
_AROUND = {"sqrt": (r"\sqrt{", "}"), "abs": ("|", "|"), "": (r"\left(", r"\right)")}
_BEGINS_FACTOR = ("number", "name", "open")
_ENDS_PRODUCT = frozenset("+-=<>,;≤≥≈")


def keyboard_latex(text: str) -> str:
    r"""A formula of a keyboard as LaTeX; one that has a backslash is LaTeX already.

    Names stand for themselves: ``theta_ddot`` for θ̈, ``omega_3`` for ω₃, ``mgl`` for a product.
    """
    return text if "\\" in text else _KeyboardFormula(text).latex()


class _KeyboardFormula:
    """Goes through one formula."""

    def __init__(self, text: str) -> None:
        self._tokens = list(_TOKEN.finditer(text.strip()))
        self._place = 0
        self._divides_by_one = "*" in text.replace("**", "")

    def latex(self) -> str:
        """The whole formula, with brackets that close nothing where they stand."""
        found = self._sum()
        while self._place < len(self._tokens):
            found += self._take()[0]
            found += self._sum()
        return found

    def _kind(self) -> str:
        at_end = self._place >= len(self._tokens)
        return "" if at_end else self._tokens[self._place].lastgroup or ""

    def _take(self) -> re.Match[str]:
        self._place += 1
        return self._tokens[self._place - 1]

    def _sum(self) -> str:
        """What stands up to the bracket that closes, or to the end."""
        found: list[str] = []
        begins = 0  # where the product begins
        while self._kind() not in ("", "close"):
            said = self._tokens[self._place][0].strip()
            if said == "/" and self._divides_by_one and len(found) > begins:
                self._take()
                found[begins:] = [rf"\frac{{{''.join(found[begins:])}}}{{{self._factor()}}}"]
            elif self._kind() in _BEGINS_FACTOR:
                found.append(self._factor())
            else:
                self._take()
                found.append(" " if said == "*" else said)
                begins = len(found) if said in _ENDS_PRODUCT else begins
        return "".join(found)

    def _factor(self) -> str:
        """A number, a letter, a bracket or a function, with its power."""
        if self._kind() not in _BEGINS_FACTOR:
            return ""
        token = self._take()
        said = token[0].strip()
        space = token[0].removesuffix(said)
        if token.lastgroup == "open":
            return f"{space}{self._bracket('')}{self._power()}"
        if said in _AROUND and self._kind() == "open":
            self._take()
            return f"{space}{self._bracket(said)}{self._power()}"
        if said in FUNCTIONS:  # sin(x)^2 is the square of the sine
            opens = self._kind() == "open" and self._take()
            argument = self._bracket("") if opens else " "
            return rf"{space}\{FUNCTIONS[said]}{self._power()}{argument}"
        return f"{space}{_named(said) if token.lastgroup == 'name' else said}{self._power()}"

    def _bracket(self, function: str) -> str:
        """What stands in a bracket that has been opened; one that is not closed stays so."""
        opening, closing = _AROUND[function]
        inner = self._sum()
        if self._kind() != "close":
            return f"{opening}{inner}"
        self._take()
        return f"{opening}{inner}{closing}"

    def _power(self) -> str:
        if self._kind() != "power":
            return ""
        self._take()
        minus = ""
        if self._kind() == "other" and self._tokens[self._place][0].strip() == "-":
            minus = self._take()[0]
        if self._kind() == "open":
            self._take()
            inner = self._sum()
            if self._kind() == "close":
                self._take()
                return f"^{{{minus}{inner}}}"
            return f"^{{{minus}({inner}}}"
        return f"^{{{minus}{self._factor()}}}"


def _named(name: str) -> str:
    """A name as LaTeX: a Greek letter, a letter with a label or dots, or a product of letters."""
    base = name.partition("_")[0]
    is_letter = base in GREEK or (len(base) == 1 and "_" in name)
    return f"{write_latex(name_of(name))} " if is_letter else name

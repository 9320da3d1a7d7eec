"""Expressions as people type them: ``2*m*a**2/5``, ``pi/2``, ``(1 - cos(2*t))/20``.

The text is only ever taken apart here. What would take long to work out is refused before it is
tried.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction

from polhode.algebra._bounded import FUNCTIONS, add, apply, multiply, raise_to
from polhode.algebra._expression import Expr
from polhode.algebra._functions import pi
from polhode.algebra._symbols import time
from polhode.base import NumericError, ParseError

LONGEST = 1000  # characters
SHOWN = 40  # of them, in messages
DEEPEST = 50  # nested brackets, signs and powers
HIGHEST_OF_TEN = 400  # in a number such as 1e-3

_CONSTANTS = {"pi": pi, "t": time}
_TOKEN = re.compile(
    r"""\s*(?:
        (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
      | (?P<name>[A-Za-z][A-Za-z0-9_]*)
      | (?P<mark>\*\*|[-+*/^()])
      | (?P<strange>\S)
    )""",
    re.VERBOSE,
)


def read_expression(text: str, names: Mapping[str, Expr]) -> Expr:
    """The exact expression that a text spells.

    It may hold decimal numbers (taken as the exact fraction they spell), ``+ - * / ** ^``, round
    brackets, ``sin cos tan sqrt abs exp sinh cosh tanh``, ``pi``, the time ``t`` and names.

    Args:
        text: what was typed.
        names: what each name stands for.

    Raises:
        ParseError: for anything else, pointing at the place, and for what is too large.
    """
    if len(text) > LONGEST:
        raise ParseError(
            f"an expression of {len(text)} characters", expected=f"at most {LONGEST} of them"
        )
    return _ExpressionParser(text.replace("−", "-").replace("π", "pi "), names).whole()


@dataclass(frozen=True)
class _Token:
    kind: str
    text: str
    place: int


class _ExpressionParser:
    """Recursive descent over the tokens of one text; each method reads one kind of phrase."""

    def __init__(self, text: str, names: Mapping[str, Expr]) -> None:
        self._text = text
        self._names = {**names, **_CONSTANTS}
        self._tokens = [*_tokens(text), _Token("end", "", len(text))]
        self._next = 0
        self._depth = 0

    def whole(self) -> Expr:
        """The text from beginning to end."""
        expression = self._sum()
        if self._token.kind != "end":
            raise self._unexpected("an operator")
        return expression

    def _sum(self) -> Expr:
        total = self._product()
        while self._token.text in ("+", "-"):
            sign = self._take()
            term = self._product()
            with self._worked_out(sign):
                total = add(total, term if sign.text == "+" else -term)
        return total

    def _product(self) -> Expr:
        total = self._signed()
        while self._token.text in ("*", "/"):
            sign = self._take()
            factor = self._signed()
            with self._worked_out(sign):
                total = multiply(total, factor if sign.text == "*" else factor.reciprocal())
        return total

    def _signed(self) -> Expr:
        if self._token.text not in ("+", "-"):
            return self._power()
        sign = self._take()
        with self._deeper(sign):
            operand = self._signed()
        return operand if sign.text == "+" else -operand

    def _power(self) -> Expr:
        base = self._atom()
        if self._token.text not in ("**", "^"):
            return base
        sign = self._take()
        with self._deeper(sign):
            exponent = self._signed()
        with self._worked_out(sign):
            return raise_to(base, exponent)

    def _atom(self) -> Expr:
        token = self._token
        if token.kind == "number":
            return self._number(self._take())
        if token.kind == "name":
            return self._named(self._take())
        if token.text == "(":
            return self._bracket()
        raise self._unexpected("a number, a name or a bracket")

    def _bracket(self) -> Expr:
        with self._deeper(self._take()):
            inside = self._sum()
        if self._token.text != ")":
            raise self._unexpected("a closing bracket")
        self._take()
        return inside

    def _number(self, token: _Token) -> Expr:
        power_of_ten = token.text.lower().partition("e")[2]
        if abs(int(power_of_ten or 0)) > HIGHEST_OF_TEN:
            raise self._refusal(
                token, "a number out of all bounds", f"powers of ten up to {HIGHEST_OF_TEN}"
            )
        return Expr.constant(Fraction(token.text))

    def _named(self, token: _Token) -> Expr:
        if token.text in self._names:
            return self._names[token.text]
        if token.text in FUNCTIONS and self._token.text == "(":
            argument = self._bracket()
            with self._worked_out(token):
                return apply(token.text, argument)
        if token.text in FUNCTIONS:
            raise self._unexpected(f"the argument of {token.text} in brackets")
        raise self._unknown(token)

    @property
    def _token(self) -> _Token:
        return self._tokens[self._next]

    def _take(self) -> _Token:
        token = self._token
        self._next += 1
        return token

    @contextmanager
    def _deeper(self, token: _Token) -> Iterator[None]:
        self._depth += 1
        if self._depth > DEEPEST:
            raise self._refusal(token, "nested too deeply", f"at most {DEEPEST} levels")
        yield
        self._depth -= 1

    @contextmanager
    def _worked_out(self, token: _Token) -> Iterator[None]:
        """Says where in the text an operation failed."""
        try:
            yield
        except NumericError as error:
            raise self._refusal(token, error.given, error.expected, error.advice) from error
        except ZeroDivisionError as error:
            raise self._refusal(token, "a division by zero", "") from error

    def _unexpected(self, expected: str) -> ParseError:
        token = self._token
        what = f"unexpected {token.text!r}" if token.text else "the text ends"
        return self._refusal(token, what, expected)

    def _unknown(self, token: _Token) -> ParseError:
        near = get_close_matches(token.text, [*self._names, *FUNCTIONS], n=3)
        return self._refusal(
            token,
            f"{token.text!r} is not known",
            f"a number or one of {', '.join([*self._names, *FUNCTIONS])}",
            f"did you mean {' or '.join(near)}?" if near else "",
        )

    def _refusal(self, token: _Token, what: str, expected: str, advice: str = "") -> ParseError:
        place = f"at character {token.place + 1} of {_shown(self._text, token.place)}"
        return ParseError(f"{place}: {what}", expected=expected, advice=advice)


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text.rstrip()):
        kind = match.lastgroup or "strange"
        yield _Token(kind, match[kind], match.start(kind))


def _shown(text: str, place: int) -> str:
    """The text, or of a long one what surrounds the place."""
    if len(text) <= SHOWN:
        return repr(text)
    start = max(0, min(place - SHOWN // 2, len(text) - SHOWN))
    return f"...{text[start : start + SHOWN]!r}..."

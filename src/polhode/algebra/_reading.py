"""Expressions as people type them: ``2*m*a**2/5``, ``pi/2``, ``(1 - cos(2*t))/20``.

The text is parsed here and never passed to Python's `eval` or SymPy's `sympify`. Operations that
could take long are refused before they are tried, by upper bounds on the size of the result.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from math import comb, prod

from polhode.algebra import _functions as functions
from polhode.algebra._expression import Expr
from polhode.algebra._functions import pi
from polhode.algebra._roots import absolute, sqrt
from polhode.algebra._symbols import time
from polhode.base import NumericError, ParseError, did_you_mean

# -- arithmetic with bounds on the size of results -------------------------------------------------

HIGHEST = 64  # power
MOST_TERMS = 2000  # of an expression multiplied out
MOST_BITS = 4096  # of a whole number raised to a power
MOST_BITS_OF_ROOT = 160  # of a whole number that is factorised to take a root

FUNCTIONS: dict[str, Callable[[Expr], Expr]] = {
    "sin": functions.sin,
    "cos": functions.cos,
    "tan": functions.tan,
    "sqrt": sqrt,
    "abs": absolute,
    "exp": functions.exp,
    "sinh": functions.sinh,
    "cosh": functions.cosh,
    "tanh": functions.tanh,
}
"""The functions that a text may use."""


def add(first: Expr, second: Expr) -> Expr:
    """The sum. This and the following operations raise `NumericError` if it may be too long."""
    _refuse_many(max(_size(first) * _below(second), _size(second) * _below(first)))
    return _small(first + second)


def multiply(first: Expr, second: Expr) -> Expr:
    """The product."""
    _refuse_many(_size(first) * _size(second))
    return _small(first * second)


def raise_to(base: Expr, exponent: Expr) -> Expr:
    """A whole or half-integer power."""
    power = exponent.rational
    if power is None or abs(power) > HIGHEST:
        raise NumericError(
            "a power that is not a number, or too high",
            expected=f"one from -{HIGHEST} to {HIGHEST}",
        )
    times = abs(power.numerator)
    # a sum of n terms to the power k has at most C(n + k - 1, k) terms
    _refuse_many(comb(_size(base) + times - 1, times))
    _refuse_long(_bits(base) * times, MOST_BITS)
    if power.denominator > 1:
        _refuse_hard_root(base)
    return _small(base**power)


def apply(name: str, argument: Expr) -> Expr:
    """A function of `FUNCTIONS`."""
    if name in ("sqrt", "abs"):
        _refuse_hard_root(argument)
    else:  # the addition theorems expand functions of sums and of multiples up to 8
        _refuse_many(prod(2 * min(abs(c.numerator), 8) for _, c in argument.terms()))
    return _small(FUNCTIONS[name](argument))


def _refuse_hard_root(radicand: Expr) -> None:
    _refuse_many(_size(radicand) ** 2)
    _refuse_long(_bits(radicand), MOST_BITS_OF_ROOT)


def _small(expression: Expr) -> Expr:
    _refuse_many(_size(expression))
    return expression


def _refuse_many(terms: int) -> None:
    if terms > MOST_TERMS:
        raise NumericError("a result that may be very long", expected=f"at most {MOST_TERMS} terms")


def _refuse_long(bits: int, most: int) -> None:
    if bits > most:
        raise NumericError(
            f"a number of {round(bits * 0.30103)} digits",
            expected=f"at most {round(most * 0.30103)} digits",
        )


def _size(expression: Expr) -> int:
    """Number of terms of the numerator or the denominator, whichever is more."""
    return max(sum(1 for _ in expression.terms()), _below(expression))


def _below(expression: Expr) -> int:
    return sum(1 for _ in expression.denominator.terms())


def _bits(expression: Expr) -> int:
    """Length of the longest coefficient, numerator and denominator together."""
    numbers = [c for part in (expression, expression.denominator) for _, c in part.terms()]
    return max((c.numerator.bit_length() + c.denominator.bit_length() for c in numbers), default=0)


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
        text: as typed.
        names: the meaning of each name.

    Raises:
        ParseError: for anything else, with its position, and for results that are too long.
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
            self._take()
            if abs(int(token.text.lower().partition("e")[2] or 0)) > HIGHEST_OF_TEN:
                limit = f"powers of ten up to {HIGHEST_OF_TEN}"
                raise self._refusal(token, "a number too large or too small", limit)
            return Expr.constant(Fraction(token.text))
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

    def _named(self, token: _Token) -> Expr:
        if token.text in self._names:
            return self._names[token.text]
        if token.text in FUNCTIONS and self._token.text == "(":
            argument = self._bracket()
            with self._worked_out(token):
                return apply(token.text, argument)
        if token.text in FUNCTIONS:
            raise self._unexpected(f"the argument of {token.text} in brackets")
        known = [*self._names, *FUNCTIONS]
        raise self._refusal(
            token,
            f"{token.text!r} is not known",
            f"a number or one of {', '.join(known)}",
            did_you_mean(token.text, known),
        )

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
        """Report a failed operation with its position in the text."""
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

    def _refusal(self, token: _Token, what: str, expected: str, advice: str = "") -> ParseError:
        place = f"at character {token.place + 1} of {_shown(self._text, token.place)}"
        return ParseError(f"{place}: {what}", expected=expected, advice=advice)


def _tokens(text: str) -> Iterator[_Token]:
    for match in _TOKEN.finditer(text.rstrip()):
        kind = match.lastgroup or "strange"
        yield _Token(kind, match[kind], match.start(kind))


def _shown(text: str, place: int) -> str:
    """The text, or the surroundings of the place in a long one."""
    if len(text) <= SHOWN:
        return repr(text)
    start = max(0, min(place - SHOWN // 2, len(text) - SHOWN))
    return f"...{text[start : start + SHOWN]!r}..."

"""The place of the reader among the tokens of one display, and its way into brackets."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from polhode.base import ParseError
from polhode.judge.latex._brackets import DEEPEST, Paired, shown
from polhode.judge.latex._tokens import Token, refusal
from polhode.judge.latex._tree import Span

_NAMED = {"close": "the end", "row": "a new line", "gap": "a gap", "tag": "an equation number"}


class Cursor:
    """A place among tokens, which methods of readers move forward.

    A method begins at the current token and stops at the first one that it does not take.
    """

    def __init__(self, source: str, paired: Paired) -> None:
        self._source = source
        self._tokens = paired.tokens
        self._partner = paired.partner
        self._place = 0
        self._depth = 0
        self._around = ""  # what opened the innermost bracket
        self._bars = 0  # that are open in it

    @property
    def _token(self) -> Token:
        return self._tokens[self._place]

    @property
    def _next(self) -> Token:
        """The token after this one."""
        return self._tokens[min(self._place + 1, len(self._tokens) - 1)]

    @property
    def _start(self) -> int:
        """Where this token begins in the source."""
        return self._token.span[0]

    def _since(self, start: int) -> Span:
        """From a place in the source up to the token before this one."""
        end = self._tokens[self._place - 1].span[1] if self._place else start
        return (start, max(start, end))

    def _take(self) -> Token:
        token = self._token
        self._place = min(self._place + 1, len(self._tokens) - 1)
        return token

    def _at(self, *marks: str) -> bool:
        return self._token.is_mark(*marks)

    def _took(self, mark: str) -> bool:
        """Take a mark if it is there."""
        found = self._at(mark)
        if found:
            self._take()
        return found

    @contextmanager
    def _deeper(self) -> Iterator[None]:
        """One level further down."""
        self._depth += 1
        if self._depth > DEEPEST:
            problem = f"quantities nested more than {DEEPEST} deep"
            raise self._refused(self._token.span, problem, "a formula with less nesting")
        yield
        self._depth -= 1

    @contextmanager
    def _within(self) -> Iterator[Token]:
        """Inside the bracket that opens here; gives the token that closes it."""
        closing = self._partner[self._place]
        outside = self._around, self._bars
        self._around, self._bars = self._take().text, 0
        with self._deeper():
            yield self._tokens[closing]
        if self._place != closing:
            raise self._unexpected(f"the end of the bracket, {shown(self._tokens[closing])}")
        self._take()
        self._around, self._bars = outside

    def _unexpected(self, expected: str) -> ParseError:
        token = self._token
        given = _NAMED.get(token.kind, self._source[slice(*token.span)])
        return self._refused(token.span, given, expected)

    def _refused(self, span: Span, problem: str, expected: str) -> ParseError:
        return refusal(self._source, span, problem, expected)

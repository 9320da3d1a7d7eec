"""Letters with their hats, dots, primes, labels and exponents."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from string import ascii_letters, ascii_uppercase

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._cursor import Cursor
from polhode.claims.latex._names import is_label, label_text, spells
from polhode.claims.latex._tokens import Token
from polhode.claims.latex._tree import (
    Component,
    Dots,
    Name,
    Node,
    Number,
    Power,
    Product,
    mapped,
)

_ROMAN = frozenset(ascii_letters)
_POINTS = frozenset(Name(letter) for letter in ascii_uppercase)


@dataclass
class Scripts:
    """What was printed around a quantity."""

    subscript: str = ""
    superscript: str = ""
    primes: int = 0
    degrees: bool = False
    exponent: Node | None = None


class LetterReader(Cursor):
    """Reads letters, and what stands above and below any quantity."""

    @abstractmethod
    def _argument(self) -> Node:
        """The argument of a macro, a ``^`` or a ``_``: a group or a single token."""

    def _letter(self) -> Node:
        """A letter, decorated or not, without what follows it."""
        token = self._take()
        if token.kind == "letter":
            return Name(token.text, span=token.span)
        with self._deeper():
            argument = self._argument()
        if token.kind == "decoration":
            return self._decorated(argument, token)
        span = self._since(token.span[0])
        if token.kind == "dots":
            return Dots(argument, int(token.text), span=span)
        if isinstance(argument, Name) and argument.letter in _ROMAN:
            return replace(argument, letter=f"{token.text} {argument.letter}", span=span)
        raise self._refused(span, "a script letter that is not a letter", "one Roman letter")

    def _decorated(self, node: Node, token: Token) -> Node:
        """A letter under a hat or an arrow, or a quantity in bold."""
        span = self._since(token.span[0])
        decoration = "vector" if token.text == "arrow" else token.text
        match node:
            case Number(text) if decoration in ("hat", "vector"):
                return Name(text, decoration=decoration, span=span)
            case Name(decoration=there) if (decoration, there) in lexicon.DECORATED:
                return replace(node, decoration=lexicon.DECORATED[decoration, there], span=span)
            case Dots(of):
                return replace(node, of=self._decorated(of, token), span=span)
            case Product(factors) if token.text == "arrow":
                return Name(self._points(factors, token), decoration="vector", span=span)
        if token.text != "vector":
            raise self._refused(span, f"a {token.text} over more than a letter", "one letter")

        def in_bold(part: Node) -> Node:  # letters are vectors, numbers stay numbers
            return part if isinstance(part, Number) else self._decorated(part, token)

        return mapped(node, in_bold)

    def _points(self, factors: Sequence[Node], token: Token) -> str:
        """Points under one arrow: from A to B."""
        letters = [
            factor.letter for factor in factors if isinstance(factor, Name) and factor in _POINTS
        ]
        if len(letters) != len(factors):
            raise self._refused(token.span, "an arrow over a product", "one letter, or two points")
        return "".join(letters)

    def _scripts(self) -> Scripts:
        """The labels, primes and exponent that follow."""
        found = Scripts()
        while self._at("_", "^", "'"):
            mark = self._take()
            if mark.text == "'":
                found.primes += 1
            elif mark.text == "_":
                self._refuse_second(found.subscript != "", mark)
                found.subscript = self._label()
            else:
                self._read_superscript(found, mark)
        return found

    def _read_superscript(self, found: Scripts, mark: Token) -> None:
        inside = self._inside()
        kinds = {token.kind for token in inside}
        if all(token.is_mark("'") for token in inside):
            found.primes += len(inside)
            self._pass(inside)
        elif all(token.is_mark("°") for token in inside):
            found.degrees = True
            self._pass(inside)
        elif kinds <= {"words", "label"} or is_label(inside):
            self._refuse_second(found.superscript != "", mark)
            found.superscript = self._label()
        else:
            self._refuse_second(found.exponent is not None, mark)
            with self._deeper():
                found.exponent = self._argument()

    def _refuse_second(self, is_second: bool, mark: Token) -> None:
        if is_second:
            raise self._refused(mark.span, f"a second {mark.text}", "one of them on each letter")

    def _labelled(self, node: Node, scripts: Scripts) -> Node:
        """A letter with its labels, which go below the dots that stand over it."""
        span = self._since(node.span[0])
        match node:
            case Dots(Name() as name):
                return replace(node, of=self._labelled(name, scripts), span=span)
            case Name():
                if (node.subscript and scripts.subscript) or (
                    node.superscript and scripts.superscript
                ):
                    raise self._refused(span, "a second label", "one on each letter")
                return replace(
                    node,
                    subscript=node.subscript or scripts.subscript,
                    primes=node.primes + scripts.primes,
                    superscript=node.superscript or scripts.superscript,
                    span=span,
                )
            case Number() if scripts.subscript:
                raise self._refused(span, "a number with an index", "a letter with an index")
        return self._indexed(node, replace(scripts, exponent=None, degrees=False))

    def _indexed(self, node: Node, scripts: Scripts) -> Node:
        """More than a letter, with the index of a component and an exponent."""
        span = self._since(node.span[0])
        if scripts.primes or scripts.superscript:
            raise self._refused(span, "a label on more than a letter", "one letter, or an exponent")
        indexed = Component(node, scripts.subscript, span=span) if scripts.subscript else node
        return self._raised(indexed, scripts)

    def _raised(self, node: Node, scripts: Scripts) -> Node:
        """With its exponent or degree sign."""
        span = self._since(node.span[0])
        if scripts.degrees:
            node = Product((node, Name("degree", span=span)), span=span)
        if scripts.exponent is not None:
            node = Power(node, scripts.exponent, span=span)
        return node

    def _label(self) -> str:
        """The text of a label, which is not mathematics."""
        if self._token.kind in ("decoration", "dots"):
            raise self._unexpected("a label in braces")
        inside = self._inside()
        for token in inside:
            if not spells(token):
                raise self._refused(
                    token.span, "a formula in a label", "letters, digits and commas"
                )
        self._pass(inside)
        return label_text(inside)

    def _inside(self) -> Sequence[Token]:
        """The tokens of a group, without its braces, or the single one there is."""
        if self._at("{"):
            inside = self._tokens[self._place + 1 : self._partner[self._place]]
        else:
            inside = self._tokens[self._place : self._place + 1]
        if not inside or inside[0].kind in ("close", "row", "gap"):
            raise self._unexpected("a label or an exponent")
        return inside

    def _pass(self, inside: Sequence[Token]) -> None:
        """Skip a group that `_inside` gave."""
        self._place += len(inside) + (2 if self._at("{") else 0)

"""Letters with their hats, dots, primes, labels and exponents."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from string import ascii_uppercase

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._brackets import Paired
from polhode.judge.latex._cursor import Cursor
from polhode.judge.latex._labels import label_text, spells
from polhode.judge.latex._names import (
    ROMAN,
    are_indices,
    has_indices_above,
    is_label_text,
    superscript_kind,
    superscript_latex,
)
from polhode.judge.latex._tokens import Token
from polhode.judge.latex._tree import (
    Component,
    ComponentList,
    Derivative,
    Dots,
    Integral,
    Name,
    Negative,
    Node,
    Number,
    PoissonBracket,
    Power,
    PrintedMatrix,
    Product,
    Span,
    Summation,
    Transposed,
    mapped,
)

_POINTS = frozenset(Name(letter) for letter in ascii_uppercase)
_ARTICLES = {"arrow": "an arrow"}

_LETTERS = re.compile("[A-Za-z]{2,}/?[A-Za-z]?|[mN]/[a-z]")
_UNIT = re.compile(r"(?:rad|rpm|kg|cm|mm|km|Nm|Hz|deg|rev)(?![A-Za-z])|[mN]/[ms]")
_BARE_FUNCTION = re.compile(r"(?:sin|cos|tan)(?=[A-Za-z])|sqrt|\Aa(?:rc?)?(?:sin|cos|tan)")
_POWER = re.compile(r"\^[-+]?[0-9]")
_BOLD_WORD = re.compile(r"\{\s*[A-Za-z][a-z]{2,}\s*\}?\Z")


@dataclass
class Scripts:
    """What was printed around a quantity."""

    subscript: str = ""
    superscript: str = ""
    primes: int = 0
    degrees: bool = False
    transposed: bool = False
    exponent: Node | None = None


class LetterReader(Cursor):
    """Reads letters, and what stands above and below any quantity."""

    def __init__(self, source: str, paired: Paired) -> None:
        super().__init__(source, paired)
        self._columns: set[Span] = set()  # where entries are stacked
        self._has_indices = has_indices_above(paired.tokens)

    @abstractmethod
    def _argument(self) -> Node:
        """The argument of a macro, a ``^`` or a ``_``: a group or a single token."""

    def _letter(self) -> Node:
        """A letter, decorated or not, without what follows it."""
        self._refuse_italic_word()
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
        if token.text == "bb" and isinstance(argument, Number):
            return Name(f"bb {argument.text}", span=span)
        if isinstance(argument, Name) and argument.letter in ROMAN:
            return replace(argument, letter=f"{token.text} {argument.letter}", span=span)
        raise self._refused(span, "a script letter that is not a letter", "one Roman letter")

    def _refuse_italic_word(self) -> None:
        """Refuse letters that spell a word, such as mass or asin, or a unit behind a number."""
        start = self._start
        run = _LETTERS.match(self._source, start)
        if run is None or len(self._token.text) > 1 or self._source[:start][-1:].isalpha():
            return
        before = self._tokens[self._place - 1] if self._place else self._token
        is_unit = before.kind == "number" and _UNIT.match(run[0])
        if is_unit or run[0].lower() in lexicon.ITALIC_WORDS or _BARE_FUNCTION.search(run[0]):
            problem = f"{run[0]}, which LaTeX prints letter by letter"
            raise self._refused((start, run.end()), problem, rf"\mathrm{{{run[0]}}}, or a macro")

    def _decorated(self, node: Node, token: Token) -> Node:
        """A letter under a hat or an arrow, or a quantity in bold."""
        span = self._since(token.span[0])
        decoration = "vector" if token.text == "arrow" else token.text
        match node:
            case Number(text) if decoration in ("hat", "vector"):
                return Name(text, decoration=decoration, span=span)
            case Name(letter, decoration="") if letter.isdigit() and decoration != "vector":
                pass  # a zero matrix
            case Name(decoration=there) if (decoration, there) in lexicon.DECORATED:
                return replace(node, decoration=lexicon.DECORATED[decoration, there], span=span)
            case Dots(of):
                return replace(node, of=self._decorated(of, token), span=span)
            case Product(factors) if token.text in ("arrow", "bar"):
                return Name(self._points(factors, token), decoration=decoration, span=span)
        if token.text != "vector":
            problem = f"{_ARTICLES.get(token.text, f'a {token.text}')} over more than a letter"
            raise self._refused(span, problem, "one letter")

        def in_bold(part: Node) -> Node:  # letters are vectors, numbers stay numbers
            return part if isinstance(part, Number) else self._decorated(part, token)

        if _BOLD_WORD.search(self._source, *span):
            raise self._refused(span, "a word in bold", "letters, or the function it stands for")
        if isinstance(node, Summation | Derivative | Integral):
            return replace(node, of=in_bold(node.of))  # index and variable stay as they are
        return mapped(node, in_bold)

    def _points(self, factors: Sequence[Node], token: Token) -> str:
        """Points under one arrow: from A to B."""
        letters = [
            factor.letter for factor in factors if isinstance(factor, Name) and factor in _POINTS
        ]
        if len(letters) != len(factors):
            problem = f"{_ARTICLES.get(token.text, f'a {token.text}')} over a product"
            raise self._refused(token.span, problem, "one letter, or two points")
        return "".join(letters)

    def _scripts(self, node: Node | None = None) -> Scripts:
        """The labels, primes and exponent that follow a quantity."""
        found = Scripts()
        while self._at("_", "^", "'"):
            mark = self._take()
            if mark.text == "'":
                found.primes += 1
            elif mark.text == "_":
                self._refuse_second(found.subscript != "", mark)
                found.subscript = self._label()
            else:
                self._read_superscript(found, mark, node)
        return found

    def _read_superscript(self, found: Scripts, mark: Token, node: Node | None) -> None:
        inside = self._inside()
        # e with a label is a letter like any other, and no base of exponentials.
        behind = self._tokens[self._place + len(inside) + 2 * self._at("{")]
        if isinstance(node, Name) and (found.subscript or behind.is_mark("_")):
            node = replace(node, subscript=found.subscript or "_")
        kind = superscript_kind(inside, node)
        if kind == "exponent" and self._has_indices and are_indices(inside):
            problem = "an index above a letter, which may be a power"
            raise self._refused(mark.span, problem, "the index below, or q for the coordinates")
        if kind == "transpose":
            self._refuse_second(found.transposed or found.exponent is not None, mark)
            found.primes += sum(token.is_mark("'") for token in inside)
            found.transposed = True
            if any(token.is_mark("-") for token in inside):
                found.exponent = Negative(Number("1"), span=inside[0].span)
            self._pass(inside)
        elif kind == "primes":
            found.primes += len(inside)
            self._pass(inside)
        elif kind == "degrees":
            found.degrees = True
            self._pass(inside)
        elif kind == "label":
            self._refuse_second(found.superscript != "", mark)
            found.superscript = self._label()
            if not superscript_latex(found.superscript, node):
                raise self._refused(mark.span, "a formula in a label", "letters and digits")
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
            case Dots(Name() as name) | Derivative(Name() as name, frame="circ"):
                return replace(node, of=self._labelled(name, scripts), span=span)
            case Name():
                if node.superscript and scripts.superscript:
                    raise self._refused(span, "a second label", "one on each letter")
                return replace(
                    node,
                    subscript=",".join(filter(None, (node.subscript, scripts.subscript))),
                    primes=node.primes + scripts.primes,
                    superscript=node.superscript or scripts.superscript,
                    span=span,
                )
            case Number("0" | "1" as text) if "×" in scripts.subscript and not scripts.superscript:
                return Name(text, scripts.subscript, span=span)  # zero and unit matrix
            case Number() if scripts.subscript:
                raise self._refused(span, "a number with an index", "a letter with an index")
        return self._indexed(node, replace(scripts, exponent=None, degrees=False, transposed=False))

    def _indexed(self, node: Node, scripts: Scripts) -> Node:
        """More than a letter, with the index of a component and an exponent."""
        span = self._since(node.span[0])
        if isinstance(node, Name) and scripts.primes:  # [I]', the letter of a matrix
            node = replace(node, primes=node.primes + scripts.primes, span=span)
            scripts = replace(scripts, primes=0)
        if scripts.primes or scripts.superscript:
            raise self._refused(span, "a label on more than a letter", "one letter, or an exponent")
        if scripts.subscript:
            seen = seen_from(node, scripts.subscript)
            node = seen or Component(node, scripts.subscript, span=span)
        return self._raised(node, scripts)

    def _raised(self, node: Node, scripts: Scripts) -> Node:
        """With its exponent, degree sign or T."""
        span = self._since(node.span[0])
        if scripts.transposed:
            node = self._transposed(node, span)
        if scripts.degrees:
            node = Product((node, Name("degree", span=span)), span=span)
        if scripts.exponent is not None:
            node = Power(node, scripts.exponent, span=span)
        return node

    def _transposed(self, node: Node, span: Span) -> Node:
        """With a T above, which makes a column of entries in a row, and a row of a column."""
        match node:
            case ComponentList((_,)):
                return node
            case PoissonBracket(left, right, is_square=True):
                return ComponentList((left, right), span=node.span)
            case ComponentList():
                is_column = node.span in self._columns
                return PrintedMatrix((node,), span=span) if is_column else node
            case PrintedMatrix((row,)):
                return row
        return Transposed(node, span=span)

    def _label(self) -> str:
        """The text of a label, which is not mathematics."""
        if self._token.kind in ("decoration", "dots"):
            raise self._unexpected("a label in braces")
        inside = self._inside()
        misplaced = next((token for token in inside if not spells(token)), None)
        text = "" if misplaced else label_text(inside)
        problem = ""
        if misplaced or _POWER.search(text) or not is_label_text(text):
            problem = "a formula in a label"
        elif not text.strip(",;:. "):
            problem = "an empty label"
        if problem:
            span = (misplaced or inside[0]).span
            raise self._refused(span, problem, "letters, digits and commas")
        self._pass(inside)
        return text

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


def seen_from(node: Node, label: str) -> Node | None:
    """A derivative with the label of the triad in which it is taken: (dL/dt)_rot."""
    is_frame = label.partition("_")[0] in lexicon.FRAMES
    if isinstance(node, Derivative) and not node.frame and is_frame:
        return replace(node, frame=label)
    return None

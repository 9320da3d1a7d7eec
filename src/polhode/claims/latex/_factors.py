"""Factors read: whatever can stand beside another quantity, brackets and functions included."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace

from polhode.claims.latex._calls import CallReader
from polhode.claims.latex._differentials import SIGNS, Operator, derivative, measured
from polhode.claims.latex._tokens import Token
from polhode.claims.latex._tree import (
    At,
    ComponentList,
    Differential,
    Dots,
    Evaluated,
    Integral,
    Magnitude,
    Name,
    Node,
    Number,
    Quotient,
    Root,
    walk,
)

_CONSTANTS = {"constant", "const", "a constant", "constant vector", "a constant vector"}
_OVER = ("decoration", "dots")
_OPENERS = ("(", "[", "\\{", "bar(", "null(")
_KINDS = {"letter", "number", "function", "decoration", "dots", "alphabet"} | {
    "fraction",
    "derivative",
    "root",
    "integral",
    "begin",
}


class FactorReader(CallReader):
    """Reads one factor with all that belongs to it."""

    @abstractmethod
    def _sum(self) -> Node:
        """A quantity."""

    @abstractmethod
    def _product(self) -> Node:
        """A quantity without + or − outside brackets."""

    @abstractmethod
    def _environment(self) -> Node:
        """Cases, or a column of components."""

    @abstractmethod
    def _cases(self) -> Node:
        """An environment whose rows are cases."""

    def _starts_factor(self) -> bool:
        token = self._token
        return (
            token.kind in _KINDS
            or token.is_mark("{", *_OPENERS)
            or (token.is_mark("|") and not self._bars and not self._next.is_mark("_"))
        )

    def _factor(self) -> Node:
        if self._at_differential():
            return self._differential()
        is_bracket = self._at("{", "|", *_OPENERS)
        atom = self._atom()
        if isinstance(atom, Operator):
            return self._with_operand(atom)
        if is_bracket:
            return self._evaluated(self._indexed(atom, self._scripts()))
        return self._evaluated(self._of_argument(self._scripted(atom)))

    def _differential(self) -> Node:
        """d, Δ, δ or ∂ with the letter it stands before."""
        start = self._start
        sign = SIGNS[self._take().text]
        with self._deeper():
            letter = self._letter()
        if not isinstance(letter.of if isinstance(letter, Dots) else letter, Name):
            raise self._refused(letter.span, f"a {sign} before more than a letter", "one letter")
        scripts = self._scripts()
        of = self._labelled(letter, replace(scripts, exponent=None))
        if scripts.exponent is None:
            of = self._of_argument(of)
        return self._raised(Differential(of, sign, span=self._since(start)), scripts)

    def _atom(self) -> Node:
        """A factor without what follows it."""
        token = self._token
        if self._starts_letter(token):
            return self._letter()
        reader = _READERS.get(token.text if token.kind == "mark" else token.kind)
        if reader:
            return reader(self)
        raise self._unexpected("a quantity")

    def _number(self) -> Node:
        token = self._take()
        return Number(token.text, span=token.span)

    def _word(self) -> Node:
        """A word that stands for a quantity: "constant", or capitals such as KE."""
        if not self._at_word():
            raise self._unexpected("a quantity")
        token = self._take()
        letter = "constant" if _plain_words(token) in _CONSTANTS else token.text
        return Name(letter, span=token.span)

    def _at_word(self) -> bool:
        text = _plain_words(self._token)
        return self._at_capitals() or (self._token.kind == "words" and text in _CONSTANTS)

    def _at_capitals(self) -> bool:
        token = self._token
        is_name = token.text.isupper() or self._next.is_mark("_")
        return token.kind == "words" and token.text.isalpha() and is_name

    def _argument(self) -> Node:
        if self._at("{"):
            return self._group()
        atom = self._atom()
        if isinstance(atom, Operator):
            raise self._refused(atom.span, "a derivative of nothing", "what it acts on")
        return atom

    def _group(self) -> Node:
        r"""What braces hold, with one ``\over`` in it or none."""
        start = self._start
        with self._within():
            above = self._sum()
            below = self._sum() if self._took("over") else None
        return above if below is None else self._over(above, below, start)

    def _fraction(self) -> Node:
        start = self._start
        self._take()
        with self._deeper():
            above = self._argument()
            below = self._argument()
        return self._over(above, below, start)

    def _derivative(self) -> Node:
        r"""What the package physics writes as ``\dv{x}{t}``, or ``\dv{t}`` before a bracket."""
        token = self._take()
        with self._deeper():
            of, by = None, self._argument()
            if self._at("{"):
                of, by = by, self._argument()
        operator = Operator(((by, 1),), token.text == "partial", span=self._since(token.span[0]))
        return operator if of is None else operator.applied(of, operator.span)

    def _over(self, above: Node, below: Node, start: int) -> Node:
        span = self._since(start)
        return derivative(above, below, span) or Quotient(above, below, span=span)

    def _with_operand(self, operator: Operator) -> Node:
        """A d/dt with what it acts on: a bracket, or else all that stands beside it."""
        start = operator.span[0]
        if not self._starts_factor():
            raise self._refused(operator.span, "a derivative of nothing", "what it acts on")
        with self._deeper():
            of = self._factor() if self._at(*_OPENERS) else self._product()
        return operator.applied(of, self._since(start))

    def _root(self) -> Node:
        token = self._take()
        kind = Number if token.text.isdigit() else Name
        index = kind(token.text, span=token.span) if token.text else None
        with self._deeper():
            of = self._argument()
        return Root(of, index, span=self._since(token.span[0]))

    def _bracket(self) -> Node:
        start = self._start
        opener = self._token
        with self._within() as closer:
            if opener.is_mark("\\{") and self._token.kind == "begin":
                return self._cases()
            entries = [self._sum()]
            while self._at(",", ";"):
                self._take()
                entries.append(self._sum())
        return self._bracketed(entries, opener, closer, start)

    def _bracketed(self, entries: list[Node], opener: Token, closer: Token, start: int) -> Node:
        span = self._since(start)
        if len(entries) > 1:
            return ComponentList(tuple(entries), span=span)
        if opener.is_mark("bar("):
            return Magnitude(entries[0], span=span)
        if closer.is_mark("bar)") and self._took("_"):
            return Evaluated(entries[0], self._label(), span=self._since(start))
        return entries[0]

    def _evaluated(self, node: Node) -> Node:
        """With the bar and label behind it, if there are: dL/dt|_P."""
        if self._at("|") and self._next.is_mark("_"):
            self._take()
            self._take()
            return Evaluated(node, self._label(), span=self._since(node.span[0]))
        return node

    def _magnitude(self) -> Node:
        start = self._take().span[0]
        self._bars += 1
        with self._deeper():
            of = self._sum()
        self._expect("|")
        self._bars -= 1
        return Magnitude(of, span=self._since(start))

    def _of_argument(self, node: Node) -> Node:
        """With the bracket behind it, if that holds a single letter or a nought: v(t), θ(0)."""
        base = node.of if isinstance(node, Dots) else node
        if not isinstance(base, Name) or base.decoration == "hat" or not self._at("("):
            return node
        inside = self._tokens[self._place + 1 : self._partner[self._place]]
        if [token.kind for token in inside] == ["words"]:
            return self._with_label(node, base)
        behind = self._tokens[self._partner[self._place] + 1]
        if behind.is_mark("_") or not _is_argument(inside):
            return node
        with self._within():
            argument = self._sum()
        applied = At(node, argument, span=self._since(node.span[0]))
        return self._raised(applied, self._scripts())

    def _with_label(self, node: Node, base: Name) -> Node:
        r"""With the label in brackets behind it: ``\omega_p(\text{slow})``."""
        with self._within():
            label = self._label()
        subscript = f"{base.subscript},{label}" if base.subscript else label
        span = self._since(node.span[0])
        name = replace(base, subscript=subscript, span=span)
        return replace(node, of=name, span=span) if isinstance(node, Dots) else name

    def _integral(self) -> Node:
        start = self._take().span[0]
        with self._deeper():
            limits = self._limits()
            of = self._product()
        span = self._since(start)
        found = measured(of, of.span)
        if found is None:
            raise self._refused(span, "an integral without its d", "the variable it runs over")
        if any(isinstance(piece, Differential) for piece in walk(found[0])):
            raise self._refused(span, "an integral with a second d", "one for each integral sign")
        return Integral(*found, limits.get("_"), limits.get("^"), span=span)

    def _limits(self) -> dict[str, Node]:
        limits: dict[str, Node] = {}
        while self._at("_", "^"):
            mark = self._take()
            self._once(mark.text not in limits, mark)
            limits[mark.text] = self._argument()
        return limits


def _is_argument(inside: Sequence[Token]) -> bool:
    """Whether a bracket holds nothing but a letter, with its dots and label, or a nought."""
    if [token.text for token in inside] == ["0"]:
        return True
    bar = next((i for i, token in enumerate(inside) if token.is_mark("_")), len(inside))
    letters = [t for t in inside[:bar] if t.kind not in _OVER and not t.is_mark("{", "}")]
    is_letter = [token.kind for token in letters] == ["letter"] and letters[0].text not in SIGNS
    return is_letter and _is_one_label(inside[bar + 1 :])


def _is_one_label(tokens: Sequence[Token]) -> bool:
    """Whether a label, if there is one, is all there is."""
    closing = [token.is_mark("}") for token in tokens]
    return len(tokens) < 2 or (tokens[0].is_mark("{") and closing.index(True) == len(tokens) - 1)


def _plain_words(token: Token) -> str:
    return token.text.rstrip(".,")


_READERS: dict[str, Callable[[FactorReader], Node]] = {
    "number": FactorReader._number,
    "words": FactorReader._word,
    "function": FactorReader._call,
    "fraction": FactorReader._fraction,
    "derivative": FactorReader._derivative,
    "root": FactorReader._root,
    "integral": FactorReader._integral,
    "begin": lambda reader: reader._environment(),
    "{": FactorReader._group,
    "|": FactorReader._magnitude,
} | dict.fromkeys(_OPENERS, FactorReader._bracket)

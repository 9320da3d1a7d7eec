r"""Displays of LaTeX read into trees, by recursive descent.

The grammar, a line for each method; ``{ }`` is repeated any number of times, ``[ ]`` is optional:

    statement   { relation | separator }
    separator   line break, punctuation, words, equation number, relations in brackets
    relation    side { sign side }
    side        sum { "or" sum }  |  words to the end of the line
    sum         term { (+ | - | ± | ∓) term }
    term        [ + | - | ± | ∓ ] chain
    chain       product { (× | · | *) [ - ] product }
    product     factors { / factors }
    factors     factor { factor }
    factor      differential  |  atom [ scripts ] [ argument ] [ bar with a label ]
    atom        letter | number | word | call | fraction | derivative | root | integral
                | environment | group | bracket | magnitude
    call        function [ power ] (bracket | angle)
    letter      a letter, or a decoration, dots or an alphabet around a group
    scripts     { _ label | ^ label | ^ group | ' }

Before, brackets are paired and line breaks that separate nothing are removed (`_brackets`). What
the notation leaves open is read as texts mean it: see `_over_slash`, `_angle`, `_of_argument` and
`_subtracts`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from string import ascii_letters, ascii_uppercase

from polhode.base import ParseError
from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._brackets import Paired, paired, shown
from polhode.claims.latex._derivatives import Operator, derivative, measured
from polhode.claims.latex._names import is_label, label_text, spells
from polhode.claims.latex._tokens import Token, refusal, tokens
from polhode.claims.latex._tree import (
    At,
    Call,
    Case,
    Cases,
    Component,
    ComponentList,
    Cross,
    Differential,
    Dot,
    Dots,
    Evaluated,
    Integral,
    Magnitude,
    Name,
    Negative,
    Node,
    Number,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Relation,
    Root,
    Span,
    Statement,
    Sum,
    Words,
    mapped,
    product,
    walk,
)

DEEPEST = 60  # levels of nesting; each takes some eight of the thousand calls Python allows
LONGEST_CHAIN = 40  # of slashes, or of products between vectors, one after another

_ADDING = ("+", "-", "±", "∓")
_MULTIPLYING = ("×", "·", "*")
_OPENERS = ("(", "[", "\\{", "bar(", "null(")
_LETTERS = {"letter", "decoration", "dots", "alphabet"}
_ANGLES = _LETTERS | {"fraction"}  # what an angle behind a number may begin with
_FACTORS = _LETTERS | {
    "number",
    "function",
    "fraction",
    "derivative",
    "root",
    "integral",
    "begin",
}
_NAMED = {"close": "the end", "row": "a new line", "gap": "a gap", "tag": "an equation number"}

_ROMAN = frozenset(ascii_letters)
_POINTS = frozenset(Name(letter) for letter in ascii_uppercase)

_OR = re.compile(r"(?:\(.*\) *)?or")
_WORDS_OF_CASE = re.compile(r"(?:\((.*)\) *)?(?:or)?")
_ASSUMED = re.compile(
    r"(?:only )?(?:if|for|where|when|whenever|at|assuming|provided|given|as long as)\b",
    re.IGNORECASE,
)
_JOINED = re.compile(r"and|also|,", re.IGNORECASE)
_WRAPPED = re.compile(r"\\(?:text|textrm|mbox|mathrm)\{([^{}]*)\}")
_EQUATION_NUMBER = re.compile(r"\([0-9]{1,4}\)")
_STOPS = (",", ";", ".")
_ENDS = {"row", "gap", "words", "arrow", "tag", "close"}


def read_latex(text: str) -> Statement:
    r"""The relations of a display, read from its LaTeX.

    Dollar signs, ``\[ \]``, alignment, spacing, type sizes and punctuation may be there. Of a
    formula in text style, ``a b/c d`` is a b over c d up to the next vector, and ``\sin 2\theta
    \cos\phi`` a product of two functions. Nothing is evaluated.

    Args:
        text: at most 20 000 characters of LaTeX.

    Returns:
        The relations in the order of printing; a row that begins with a sign continues the
        relation before.

    Raises:
        ParseError: for what cannot be read, showing the place.
    """
    return _Parser(text, paired(text, tokens(text))).statement()


@dataclass
class _Scripts:
    """What was printed around a quantity."""

    subscript: str = ""
    superscript: str = ""
    primes: int = 0
    degrees: bool = False
    exponent: Node | None = None


class _Parser:
    """Reads one display.

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
        self._asides = paired.around_relations
        self._relations: list[Relation] = []
        self._conditions: list[Relation] = []
        self._assumptions: list[Relation] = []
        self._notes: list[str] = []
        self._tags: list[str] = []

    # -- statements: relations, with words, gaps and numbers between them -----------------------

    def statement(self) -> Statement:
        """The whole display."""
        while self._token.kind != "close":
            if not self._took_separator():
                self._read_relation()
        stated = self._relations or self._conditions
        if not stated:
            raise self._unexpected("a formula")
        statement = Statement(
            tuple(stated),
            tuple(self._conditions) if self._relations else (),
            tuple(self._notes),
            tuple(self._tags),
            tuple(self._assumptions),
            span=(0, len(self._source)),
        )
        for piece in walk(statement):
            if isinstance(piece, Name) and piece.letter == "partial":
                raise self._refused(piece.span, "a ∂ that stands alone", "a partial derivative")
        return statement

    def _took_separator(self) -> bool:
        """Take a separator between relations, if one is next, and keep its words and numbers."""
        token = self._token
        if token.kind in ("row", "gap") or self._at(",", ";", ".", ":", "&"):
            self._take()
        elif token.kind == "words" and _EQUATION_NUMBER.fullmatch(token.text):
            self._tags.append(self._take().text.strip("()"))
        elif token.kind in ("words", "arrow") and not self._at_capitals():
            self._notes.append(self._take().text)
        elif token.kind == "tag":
            self._tags.append(self._take().text)
        elif self._at_equation_number():
            with self._within():
                self._tags.append(self._take().text)
        elif self._place in self._asides:
            with self._within():
                self._read_aside()
        elif self._at_bracketed_words():
            with self._within():
                self._notes.append(self._take().text)
        else:
            return False
        return True

    def _read_aside(self) -> None:
        """Relations in brackets: assumptions after a word such as "if", else conditions."""
        found = self._conditions
        while True:
            while self._token.kind == "words":
                words = self._take().text
                if _ASSUMED.match(words):
                    found = self._assumptions
                elif not _JOINED.fullmatch(words):
                    self._notes.append(words)
            found.append(self._relation())
            if not self._took(",") and self._token.kind != "words":
                return

    def _at_equation_number(self) -> bool:
        """Whether a number in brackets ends the display, as equation numbers do."""
        if not (self._at("(") and self._holds_one() and self._next.text.isdigit()):
            return False
        place = self._place + 3  # behind the bracket, the number and the closing bracket
        while self._tokens[place].kind == "row" or self._tokens[place].is_mark(".", ","):
            place += 1
        is_number = self._tokens[place].kind == "close" and self._next.text != "0"
        return is_number and self._is_set_off()

    def _is_set_off(self) -> bool:
        """Whether a break or a space separates this token from the one before."""
        if self._place == 0:
            return True
        before = self._tokens[self._place - 1]
        is_break = before.kind in ("gap", "row") or before.is_mark(",", ".", ";")
        return is_break or self._source[self._start - 1].isspace()

    def _at_bracketed_words(self) -> bool:
        return self._at("(") and self._next.kind == "words" and self._holds_one()

    def _holds_one(self) -> bool:
        """Whether the bracket that opens here holds a single token."""
        return self._partner[self._place] == self._place + 2

    def _read_relation(self) -> None:
        """A new relation, or the rest of the one before."""
        if self._token.kind != "sign":
            self._relations.append(self._relation())
            return
        if not self._relations:
            raise self._unexpected("the left side of the relation")
        before = self._relations.pop()
        sides, signs = list(before.sides), list(before.signs)
        self._relations.append(self._continued(sides, signs, before.span[0]))

    # -- relations ------------------------------------------------------------------------------

    def _relation(self) -> Relation:
        """Quantities with signs between them; a single quantity has none."""
        start = self._start
        return self._continued([self._side()], [], start)

    def _continued(self, sides: list[Node], signs: list[str], start: int) -> Relation:
        """A relation with all further signs and sides."""
        while self._token.kind == "sign":
            signs.append(self._take().text)
            sides.append(self._side())
        return Relation(tuple(sides), tuple(signs), span=self._since(start))

    def _side(self) -> Node:
        """A quantity, quantities with "or" between, or words to the end of the line."""
        self._skip_breaks()
        start = self._start
        if self._at_bracketed_words() or (self._token.kind == "words" and not self._at_word()):
            return self._words_to_end()
        side = self._sum()
        cases: list[Case] = []
        while self._at_or():
            cases.append(Case(side, words=self._words_of_case(), span=side.span))
            side = self._sum()
        if not cases:
            return side
        cases.append(Case(side, words=self._words_of_case(), span=side.span))
        return Cases(tuple(cases), span=self._since(start))

    def _at_or(self) -> bool:
        """Whether the next "or" separates two values of one relation rather than two relations.

        It separates relations if a relation sign follows before the end of the line.
        """
        place = self._past_breaks(self._place)
        token = self._tokens[place]
        if token.kind != "words" or not _OR.fullmatch(token.text):
            return False
        place = self._past_breaks(place + 1)
        while not self._tokens[place].is_mark(*_STOPS) and self._tokens[place].kind not in _ENDS:
            if self._tokens[place].kind == "sign":
                return False
            place = self._partner.get(place, place) + 1
        return True

    def _words_of_case(self) -> str:
        """The words in brackets that distinguish one value, without the "or" behind them."""
        place = self._past_breaks(self._place)
        token = self._tokens[place]
        match = _WORDS_OF_CASE.fullmatch(token.text) if token.kind == "words" else None
        if not match:
            return ""
        self._place = place
        self._take()
        return (match[1] or "").strip()

    def _words_to_end(self) -> Words:
        """Words for a quantity, with the formulas among them, to the end of the line."""
        start = self._start
        while self._token.kind not in ("row", "tag", "close"):
            self._take()
        span = self._since(start)
        words = _WRAPPED.sub(r" \1 ", self._source[slice(*span)])
        return Words(" ".join(words.split()).rstrip(" .,"), span=span)

    # -- sums, chains and products --------------------------------------------------------------

    def _sum(self) -> Node:
        self._skip_breaks()
        start = self._start
        terms = [self._term()]
        while self._continues(_ADDING):
            terms.append(self._term())
        return terms[0] if len(terms) == 1 else Sum(tuple(terms), span=self._since(start))

    def _term(self) -> Node:
        """A chain with the sign before it; a plus sign is dropped."""
        start = self._start
        if not self._at(*_ADDING):
            return self._chain()
        sign = self._take().text
        self._skip_breaks()
        with self._deeper():
            of = self._behind_sign(self._term)
        span = self._since(start)
        if sign == "+":
            return of
        return Negative(of, span=span) if sign == "-" else PlusMinus(of, sign, span=span)

    def _behind_sign(self, read: Callable[[], Node]) -> Node:
        """The quantity behind a sign; a further sign counts as a level of nesting."""
        if not self._at(*_ADDING):
            return read()
        with self._deeper():
            return read()

    def _chain(self) -> Node:
        r"""Products with ``\times`` or ``\cdot`` between them, from left to right."""
        start = self._start
        left = self._product()
        for _ in range(LONGEST_CHAIN):
            if not self._continues(_MULTIPLYING):
                return left
            kind = Cross if self._take().text == "×" else Dot
            self._skip_breaks()
            left = kind(left, self._multiplied(), span=self._since(start))
        raise self._unexpected(f"at most {LONGEST_CHAIN} products in a row")

    def _multiplied(self) -> Node:
        r"""What stands behind a ``\times``: a product, even with a minus sign."""
        start = self._start
        if not self._took("-"):
            return self._product()
        with self._deeper():
            of = self._behind_sign(self._multiplied)
        return Negative(of, span=self._since(start))

    def _product(self) -> Node:
        start = self._start
        factors = self._factors([self._factor()])
        for _ in range(LONGEST_CHAIN):
            if not self._took("/"):
                return product(factors, self._since(start))
            above = product(factors, self._since(start))
            factors = self._factors([self._over_slash(above, start)])
        raise self._unexpected(f"at most {LONGEST_CHAIN} slashes in a row")

    def _factors(self, first: list[Node], ends: Callable[[], bool] = lambda: False) -> list[Node]:
        """The first factors and all that stand beside them."""
        factors = first
        while self._starts_factor() and not ends():
            if isinstance(factors[-1], Number) and self._token.kind == "number":
                raise self._refused(self._token.span, "two numbers side by side", "one number")
            factors.append(self._factor())
        return factors

    def _over_slash(self, above: Node, start: int) -> Node:
        """All factors before a slash over all behind it, up to a vector.

        Texts print g/3a for g over 3a, and v/r ẑ for (v/r) ẑ: nothing is divided by a vector.
        """
        below_start = self._start
        if self._at_differential():
            factors = [self._factor()]
            while self._at_differential():
                factors.append(self._factor())
            return self._over(above, product(factors, self._since(below_start)), start)
        factors = self._factors([self._factor()], self._starts_vector)
        below = product(factors, self._since(below_start))
        return Quotient(above, below, span=self._since(start))

    def _starts_vector(self) -> bool:
        return self._token.kind == "decoration" and self._token.text in ("hat", "vector")

    def _over(self, above: Node, below: Node, start: int) -> Node:
        """A derivative where the fraction prints one, else a quotient."""
        span = self._since(start)
        return derivative(above, below, span) or Quotient(above, below, span=span)

    # -- breaks between the lines of a display --------------------------------------------------

    def _skip_breaks(self) -> None:
        """Skip a new line before a quantity, where lines are not entries."""
        while self._around == "" and (self._token.kind in ("row", "gap") or self._at("&")):
            self._take()

    def _past_breaks(self, place: int) -> int:
        while self._tokens[place].kind in ("row", "gap") or self._tokens[place].is_mark("&"):
            place += 1
        return place

    def _continues(self, operators: tuple[str, ...]) -> bool:
        """Whether an operator continues this quantity, perhaps on the next line; go there."""
        place = self._past_breaks(self._place) if self._around == "" else self._place
        if not self._tokens[place].is_mark(*operators):
            return False
        if self._tokens[place].is_mark("-") and not self._subtracts(place):
            return False
        self._place = place
        return True

    def _subtracts(self, place: int) -> bool:
        """Whether a minus sign subtracts, rather than begins a new statement on the next line.

        It subtracts if a column mark stands before it, or if its line has no relation sign.
        """
        is_new_line = any(token.kind == "row" for token in self._tokens[self._place : place])
        if not is_new_line or self._tokens[place - 1].is_mark("&"):
            return True
        while self._tokens[place].kind not in ("row", "close"):
            if self._tokens[place].kind == "sign":
                return False
            place = self._partner.get(place, place) + 1
        return True

    # -- factors --------------------------------------------------------------------------------

    def _starts_factor(self) -> bool:
        token = self._token
        if token.kind in _FACTORS or token.is_mark("{"):
            return True
        if token.is_mark("|"):
            return not self._bars and not self._next.is_mark("_")
        if not token.is_mark(*_OPENERS):
            return False
        is_aside = self._at_bracketed_words() or self._place in self._asides
        return self._around != "" or not (is_aside or self._at_equation_number())

    def _factor(self) -> Node:
        """An atom with its scripts, its argument and its bar."""
        if self._at_differential():
            return self._differential()
        is_bracket = self._at("{", "|", *_OPENERS)
        atom = self._atom()
        if isinstance(atom, Operator):
            return self._with_operand(atom)
        if is_bracket:
            return self._evaluated(self._indexed(atom, self._scripts()))
        scripts = self._scripts()
        scripted = self._raised(self._labelled(atom, scripts), scripts)
        return self._evaluated(self._of_argument(scripted))

    def _at_differential(self) -> bool:
        is_sign = self._token.kind == "letter" and self._token.text in lexicon.DIFFERENTIALS
        return is_sign and self._next.kind in _LETTERS

    def _differential(self) -> Node:
        """d, Δ, δ or ∂ with the letter behind it."""
        start = self._start
        sign = lexicon.DIFFERENTIALS[self._take().text]
        with self._deeper():
            letter = self._letter()
        if not isinstance(letter.of if isinstance(letter, Dots) else letter, Name):
            raise self._refused(letter.span, f"a {sign} before more than a letter", "one letter")
        scripts = self._scripts()
        of = self._labelled(letter, replace(scripts, exponent=None))
        if scripts.exponent is None:
            of = self._of_argument(of)
        return self._raised(Differential(of, sign, span=self._since(start)), scripts)

    def _with_operand(self, operator: Operator) -> Node:
        """A d/dt with its operand: a bracket, otherwise all factors behind it."""
        start = operator.span[0]
        if not self._starts_factor():
            raise self._without_operand(operator)
        with self._deeper():
            of = self._factor() if self._at(*_OPENERS) else self._product()
        return operator.applied(of, self._since(start))

    def _without_operand(self, operator: Operator) -> ParseError:
        problem = "a derivative with nothing to act on"
        return self._refused(operator.span, problem, "the quantity that is differentiated")

    def _of_argument(self, node: Node) -> Node:
        """A letter with its argument, if a bracket with a letter or a zero follows: v(t), θ(0)."""
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

    def _evaluated(self, node: Node) -> Node:
        """A quantity with the bar and label behind it, if there are any: dL/dt|_P."""
        if self._at("|") and self._next.is_mark("_"):
            self._take()
            self._take()
            return Evaluated(node, self._label(), span=self._since(node.span[0]))
        return node

    # -- atoms ----------------------------------------------------------------------------------

    def _atom(self) -> Node:
        """A factor without what follows it."""
        token = self._token
        if token.kind in _LETTERS:
            return self._letter()
        reader = _ATOMS.get(token.text if token.kind == "mark" else token.kind)
        if reader:
            return reader(self)
        raise self._unexpected("a quantity")

    def _argument(self) -> Node:
        """The argument of a macro, a ``^`` or a ``_``: a group or a single token."""
        if self._at("{"):
            return self._group()
        atom = self._atom()
        if isinstance(atom, Operator):
            raise self._without_operand(atom)
        return atom

    def _number(self) -> Node:
        token = self._take()
        return Number(token.text, span=token.span)

    def _word(self) -> Node:
        """A word that stands for a quantity: "constant", or capitals such as KE."""
        if not self._at_word():
            raise self._unexpected("a quantity")
        token = self._take()
        letter = "constant" if token.text.rstrip(".,") in lexicon.CONSTANTS else token.text
        return Name(letter, span=token.span)

    def _at_word(self) -> bool:
        is_constant = self._token.text.rstrip(".,") in lexicon.CONSTANTS
        return self._at_capitals() or (self._token.kind == "words" and is_constant)

    def _at_capitals(self) -> bool:
        token = self._token
        is_name = token.text.isupper() or self._next.is_mark("_")
        return token.kind == "words" and token.text.isalpha() and is_name

    def _group(self) -> Node:
        r"""What braces hold, with at most one ``\over`` in it."""
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

    def _root(self) -> Node:
        token = self._take()
        kind = Number if token.text.isdigit() else Name
        index = kind(token.text, span=token.span) if token.text else None
        with self._deeper():
            of = self._argument()
        return Root(of, index, span=self._since(token.span[0]))

    def _bracket(self) -> Node:
        """One quantity, the components of a vector, cases, or a magnitude."""
        start = self._start
        opener = self._token
        with self._within() as closer:
            if opener.is_mark("\\{") and self._token.kind == "begin":
                return self._cases()
            entries = [self._sum()]
            while self._at(",", ";"):
                self._take()
                entries.append(self._sum())
        span = self._since(start)
        if len(entries) > 1:
            return ComponentList(tuple(entries), span=span)
        if opener.is_mark("bar("):
            return Magnitude(entries[0], span=span)
        if closer.is_mark("bar)") and self._took("_"):
            return Evaluated(entries[0], self._label(), span=self._since(start))
        return entries[0]

    def _magnitude(self) -> Node:
        start = self._take().span[0]
        self._bars += 1
        with self._deeper():
            of = self._sum()
        if not self._took("|"):
            raise self._unexpected("|")
        self._bars -= 1
        return Magnitude(of, span=self._since(start))

    def _integral(self) -> Node:
        start = self._take().span[0]
        limits: dict[str, Node] = {}
        with self._deeper():
            while self._at("_", "^"):
                mark = self._take()
                self._refuse_second(mark.text in limits, mark)
                limits[mark.text] = self._argument()
            of = self._product()
        span = self._since(start)
        found = measured(of, of.span)
        if found is None:
            problem = "an integral without a differential"
            raise self._refused(span, problem, "the variable of integration, as in dx")
        if any(isinstance(piece, Differential) for piece in walk(found[0])):
            problem = "an integral with a second differential"
            raise self._refused(span, problem, "one for each integral sign")
        return Integral(*found, limits.get("_"), limits.get("^"), span=span)

    # -- cases and columns ----------------------------------------------------------------------

    def _environment(self) -> Node:
        if self._token.text in lexicon.CASES:
            return self._cases()
        if self._token.text not in lexicon.STACKS:
            raise self._unexpected("cases, a column or a display")
        start = self._start
        breaks = set()
        with self._within():
            entries = [self._sum()]
            while self._token.kind == "row" or self._at("&"):
                breaks.add(self._take().text)
                entries.append(self._sum())
        span = self._since(start)
        if len(breaks) > 1:
            raise self._refused(span, "a matrix", "one row or one column")
        return ComponentList(tuple(entries), span=span)

    def _cases(self) -> Node:
        start = self._start
        with self._within():
            cases = [self._case()]
            while self._token.kind == "row":
                self._take()
                if self._token.kind != "end":
                    cases.append(self._case())
        return Cases(tuple(cases), span=self._since(start))

    def _case(self) -> Case:
        start = self._start
        value = self._sum()
        conditions: list[Relation] = []
        words: list[str] = []
        while self._token.kind not in ("row", "end"):
            if self._token.kind == "words":
                words.append(self._take().text)
            elif self._at("&", ",", ";", "."):
                self._take()
            else:
                conditions.append(self._relation())
        return Case(value, tuple(conditions), " ".join(words), span=self._since(start))

    # -- functions, as texts print them: sin 2θ cos φ, cos Ωt, tanh⁻¹ x --------------------------

    def _call(self) -> Node:
        """A function with its argument: a bracket, or the angle that stands behind it."""
        start = self._start
        function = self._take().text
        exponent = self._exponent()
        if exponent == Negative(Number("1")) and function in lexicon.INVERSES:
            function, exponent = lexicon.INVERSES[function], None
        with self._deeper():
            argument = self._bracket() if self._at("(", "[", "\\{") else self._angle()
        call = Call(function, argument, span=self._since(start))
        exponent = exponent or self._exponent()
        return call if exponent is None else Power(call, exponent, span=self._since(start))

    def _exponent(self) -> Node | None:
        if not self._took("^"):
            return None
        with self._deeper():
            return self._argument()

    def _angle(self) -> Node:
        """The argument of a function without brackets: numbers and counts, then one more factor.

        So sin 2θ cos φ is a product. A time t behind a rate belongs to the angle: cos Ωt.
        """
        start = self._start
        if self._took("-"):
            with self._deeper():
                of = self._angle()
            return Negative(of, span=self._since(start))
        factors = [self._factor()]
        while _is_count(factors[-1]) and (self._token.kind in _ANGLES or self._at("(", "[")):
            factors.append(self._factor())
        if _is_rate(factors[-1]) and self._token.kind == "letter" and self._token.text == "t":
            factors.append(self._factor())
        return product(factors, self._since(start))

    # -- letters with their hats, dots, primes and labels ---------------------------------------

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

    def _scripts(self) -> _Scripts:
        """The labels, primes and exponent that follow."""
        found = _Scripts()
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

    def _read_superscript(self, found: _Scripts, mark: Token) -> None:
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

    def _labelled(self, node: Node, scripts: _Scripts) -> Node:
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

    def _indexed(self, node: Node, scripts: _Scripts) -> Node:
        """More than a letter, with the index of a component and an exponent."""
        span = self._since(node.span[0])
        if scripts.primes or scripts.superscript:
            raise self._refused(span, "a label on more than a letter", "one letter, or an exponent")
        indexed = Component(node, scripts.subscript, span=span) if scripts.subscript else node
        return self._raised(indexed, scripts)

    def _raised(self, node: Node, scripts: _Scripts) -> Node:
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

    # -- the place among the tokens -------------------------------------------------------------

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


_ATOMS: dict[str, Callable[[_Parser], Node]] = {
    "number": _Parser._number,
    "words": _Parser._word,
    "function": _Parser._call,
    "fraction": _Parser._fraction,
    "derivative": _Parser._derivative,
    "root": _Parser._root,
    "integral": _Parser._integral,
    "begin": _Parser._environment,
    "{": _Parser._group,
    "|": _Parser._magnitude,
    **dict.fromkeys(_OPENERS, _Parser._bracket),
}


def _is_count(node: Node) -> bool:
    """Whether a factor is a multiple that stands before an angle: 2θ, nθ, πt/T."""
    return isinstance(node, Number) or (isinstance(node, Name) and node.letter in lexicon.COUNTS)


def _is_rate(node: Node) -> bool:
    """Whether a time t behind this factor makes an angle with it."""
    if isinstance(node, Name):
        return node.letter in lexicon.RATES or (len(node.letter) == 1 and node.letter != "t")
    return isinstance(node, Dots)


def _is_argument(inside: Sequence[Token]) -> bool:
    """Whether a bracket holds only a letter, with its dots and label, or a zero."""
    if [token.text for token in inside] == ["0"]:
        return True
    bar = next((i for i, token in enumerate(inside) if token.is_mark("_")), len(inside))
    letters = [
        token
        for token in inside[:bar]
        if token.kind not in ("decoration", "dots") and not token.is_mark("{", "}")
    ]
    if [token.kind for token in letters] != ["letter"] or letters[0].text in lexicon.DIFFERENTIALS:
        return False
    label = inside[bar + 1 :]  # which has to be all there is behind the letter
    closing = [token.is_mark("}") for token in label]
    return len(label) < 2 or (label[0].is_mark("{") and closing.index(True) == len(label) - 1)

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
    factor      differential  |  order  |  [ prescript ] atom [ scripts ] [ arguments ] [ bar ]
    order       O bracket
    bar         | _ label
    atom        letter | number | word | call | fraction | derivative | root | integral
                | summation | matrix | cases | group | bracket | magnitude | brace | dots | unit
    integral    { integral sign [ limits ] } product
    summation   (Σ | ∏) _ { index { , index } [ = sum ] } [ ^ group ] chain
    matrix      environment of [ sum ] { (column mark | row) [ sum ] }
    brace       group with a brace under or over it [ label ]
    call        function [ power ] (bracket | angle)
    letter      a letter, or a decoration, dots or an alphabet around a group
    scripts     { _ label | ^ label | ^ group | ^ T | ' }

Statements and relations are read here, quantities by `_quantities`, `_factors`, `_integrals`
and `_columns`, letters by `_letters`. Before,
macros with arguments and labels in front of letters become plain tokens (`_rewriting`), brackets
are paired and line breaks that separate nothing are removed (`_brackets`). What the notation leaves
open is read as texts mean it: see `_over_slash`, `_angle`, `_applied` and `_subtracts`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise

from polhode.base import ParseError
from polhode.judge.latex._brackets import Paired, paired
from polhode.judge.latex._names import is_word
from polhode.judge.latex._quantities import QuantityReader
from polhode.judge.latex._rewriting import rewritten
from polhode.judge.latex._slashes import UnclearSlashError
from polhode.judge.latex._tokens import is_words, plain_words, tokens
from polhode.judge.latex._tree import (
    Case,
    Cases,
    ComponentList,
    Name,
    Node,
    Number,
    Omitted,
    PoissonBracket,
    Relation,
    Statement,
    Words,
    height,
    walk,
)

_MOST_WAYS = 16  # in which the slashes of a statement are read
HIGHEST = 20  # pieces within each other: three brackets for each when it is written, see DEEPEST

_OR = re.compile(r"(?:\(.*\) *)?or")
_WORDS_OF_CASE = re.compile(r"(?:\((.*)\) *)?(?:or)?")
_ASSUMED = re.compile(
    r"(?:only )?(?:if|for|where|when|whenever|at|assuming|provided|given|as long as)\b",
    re.IGNORECASE,
)
_IF = re.compile(
    r"\W*(?:if|for|at|when|whenever|provided|provided that|assuming|as long as)\W*", re.IGNORECASE
)
_CONDITIONS = {"=", "<", ">", "≤", "≥"}
_JOINED = re.compile(r"and|also|,", re.IGNORECASE)
_WRAPPED = re.compile(r"\\(?:text|textrm|mbox|mathrm)\{([^{}]*)\}")
_WORDS_BEFORE = re.compile(r"\\(?:text|textrm|mbox|mathrm)\s*\{[^{}]*\}\s*\Z")
_EQUATION_NUMBER = re.compile(r"\([0-9]{1,4}\)")
_CONSTANT = Name("constant")
_INDICES = "ijklmn"
_STOPS = (",", ";", ".")
_COMMA = re.compile(r"[\s{}]*,[\s~{}]*(?:\\[,;:! ])?[\s~{}]*")
_ENDS = {"row", "gap", "words", "arrow", "tag", "close"}


@lru_cache(maxsize=512)  # the definitions of a text are read again for each of its claims
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
    return _Parser(text, paired(text, rewritten(text, tokens(text)))).statement()


def slash_readings(latex: str) -> dict[str, Statement]:
    """A statement in each reading of its slashes; most have one, as printed.

    Of slashes between two numbers, as in 1/2 m v² + 1/2 I ω², all are read in one way.

    Raises:
        ParseError: for what cannot be read, or in more ways than are tried.
    """
    found: dict[str, Statement] = {}
    pending: list[tuple[str, int | None]] = [(latex, None)]  # with the way of numbers, if chosen
    while pending:
        source, chosen = pending.pop(0)
        try:
            found[source] = read_latex(source)
        except UnclearSlashError as unclear:
            of_numbers = unclear.is_of_numbers
            ways = [(way, i if of_numbers else chosen) for i, way in enumerate(unclear.ways)]
            if of_numbers and chosen is not None:
                ways = [ways[chosen]]
            pending = [*ways, *pending]
            if len(found) + len(pending) > _MOST_WAYS:
                problem = f"slashes that can be read in more than {_MOST_WAYS} ways"
                raise ParseError(problem, expected=r"\frac, or brackets") from None
    return found


class _Parser(QuantityReader):
    """Reads one display."""

    def __init__(self, source: str, paired: Paired) -> None:
        super().__init__(source, paired)
        self._asides = paired.around_relations
        self._relations: list[Relation] = []
        self._conditions: list[Relation] = []
        self._assumptions: list[Relation] = []
        self._tags: list[str] = []

    # -- statements: relations, with words, gaps and numbers between them -----------------------

    def statement(self) -> Statement:
        """The whole display."""
        while self._token.kind != "close":
            if not self._took_separator():
                self._read_relation()
        self._spread_lists()
        self._separate_conclusions()
        self._relations += self._braced
        self._refuse_loss()
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
        if height(statement) > HIGHEST:
            problem = f"quantities nested more than {HIGHEST} deep"
            raise self._refused(statement.span, problem, "a formula with less nesting")
        return statement

    def _refuse_loss(self) -> None:
        """Refuse a quantity that stands beside relations and in none of them: ``a : b = 1 : 2``."""
        for relation in self._relations if any(r.signs for r in self._relations) else ():
            of, behind = relation.sides[0], self._source[relation.span[1] :].lstrip()
            before = self._source[: relation.span[0]]
            # L, |L| = 1, or a word in capitals before a formula, or "for small θ: ..."
            is_aside = behind.startswith(",") or _WORDS_BEFORE.search(before)
            is_listed = isinstance(of, Name) and (is_aside or is_word(of))
            if not (relation.signs or is_listed or isinstance(of, Omitted)):
                expected = "a sign such as = before or behind it"
                raise self._refused(relation.span, "a quantity in no relation", expected)

    def _spread_lists(self) -> None:
        """Of x, y > 0 a relation each; in θ = 0, π nobody knows what belongs together."""
        for place in reversed(range(len(self._relations) - 1)):
            first, second = self._relations[place : place + 2]
            between = self._source[first.span[1] : second.span[0]]
            if bool(first.signs) == bool(second.signs) or not _COMMA.fullmatch(between):
                continue
            are_letters = isinstance(first.sides[0], Name) and isinstance(second.sides[0], Name)
            if first.signs or "=" in second.signs or not are_letters:
                problem = "several quantities with commas on a side of a relation"
                raise self._refused(second.span, problem, "a relation for each of them")
            sides, span = (first.sides[0], *second.sides[1:]), (first.span[0], second.span[1])
            self._relations[place] = Relation(sides, second.signs, span=span)

    def _took_separator(self) -> bool:
        """Take a separator between relations, if one is next, and keep its words and numbers."""
        token = self._token
        if token.kind in ("row", "gap") or self._at(",", ";", ".", ":", "&"):
            self._take()
        elif token.kind == "words" and _EQUATION_NUMBER.fullmatch(token.text):
            self._tags.append(self._take().text.strip("()"))
        elif token.kind == "arrow" and token.text == "∀":
            self._read_range()
        elif token.kind in ("words", "arrow") and not self._at_quantity_in_words():
            self._read_note()
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

    def _read_note(self) -> None:
        """Words beside the relations, which do not say what a quantity in them is."""
        token = self._take()
        is_text = self._source[token.span[0]] == "\\"  # and not between dollar signs
        is_open = token.text.count("(") > token.text.count(")")
        is_name = token.text.endswith(" of") and self._token.kind not in (*_ENDS, "words")
        if is_text and (is_open or is_name):
            problem = "words that go on with a quantity"
            raise self._refused(token.span, problem, "a quantity in letters, and words beside it")
        self._notes.append(token.text)
        if not _IF.fullmatch(token.text):
            return
        while self._token.kind == "gap":
            self._take()
        if self._token.kind not in _ENDS:
            found = self._relation()  # of "if A = B"
            is_condition = found.signs and set(found.signs) <= _CONDITIONS
            (self._assumptions if is_condition else self._relations).append(found)

    def _at_quantity_in_words(self) -> bool:
        """Whether a word that stands for a quantity begins a relation: ``const = ...``."""
        goes_on = self._next.kind == "sign" or self._next.is_mark(*"+-·×^/")
        is_side = self._at_word() and goes_on
        return is_side or self._at_capitals() or self._at_diagonal()

    def _read_range(self) -> None:
        """For which values a relation holds, as a note: ∀ i, ∀ t > 0."""
        start = self._take().span[0]
        self._relation()
        self._notes.append(self._source[slice(*self._since(start))])

    def _read_aside(self) -> None:
        """Relations in brackets: assumptions after a word such as "if", else conditions.

        One that begins with its sign, as in a (= 0), goes on with the relation before it.
        """
        if self._token.kind == "sign":
            self._read_relation()
            return
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

    def _at_aside(self) -> bool:
        """Whether words, relations or an equation number stand in the bracket that opens here."""
        is_aside = self._at_bracketed_words() or self._place in self._asides
        return is_aside or self._at_equation_number()

    def _at_equation_number(self) -> bool:
        """Whether a number in brackets ends the display, as equation numbers do."""
        if not (self._at("(") and self._holds_one() and self._next.kind == "number"):
            return False
        if "." in self._next.text and not self._is_behind_gap():  # (4.12), but not a factor (0.5)
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

    def _is_behind_gap(self) -> bool:
        return self._place > 0 and self._tokens[self._place - 1].kind in ("gap", "row")

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

    def _separate_conclusions(self) -> None:
        """Of a = b → c = d two relations, as with ⇒; in a = b → 0 the arrow is of a limit."""
        self._relations = [part for whole in self._relations for part in self._concluded(whole)]

    def _concluded(self, relation: Relation) -> Iterator[Relation]:
        ends = [i for i, sign in enumerate(relation.signs) if sign == "→"]
        bounds = [-1, *ends, len(relation.signs)]
        pieces = [
            (relation.sides[a + 1 : b + 1], relation.signs[a + 1 : b]) for a, b in pairwise(bounds)
        ]
        if not ends or not all(signs for _, signs in pieces):
            yield relation
            return
        self._notes += ["→"] * len(ends)
        for sides, signs in pieces:
            yield Relation(sides, signs, span=(sides[0].span[0], sides[-1].span[1]))

    # -- relations ------------------------------------------------------------------------------

    def _relation(self) -> Relation:
        """Quantities with signs between them; a single quantity has none."""
        around, self._begins = self._begins, self._place
        start = self._start
        found = self._continued([self._side()], [], start)
        self._begins = around
        return found

    def _continued(self, sides: list[Node], signs: list[str], start: int) -> Relation:
        """A relation with all further signs and sides."""
        while self._token.kind == "sign":
            signs.append(self._take().text)
            sides.append(self._listed(self._side(), sides[-1]))
        self._settle_square(sides)
        if sides[0] == _CONSTANT and set(signs) == {"="}:
            sides.sort(key=_CONSTANT.__eq__)  # what is constant is stated of the other sides
        return Relation(tuple(sides), tuple(signs), span=self._since(start))

    def _settle_square(self, sides: list[Node]) -> None:
        """Take v = [a, b] = [c, d] for lists; beside 0 alone it may be a list or a bracket."""
        square = [s for s in sides if isinstance(s, PoissonBracket) and s.is_square]
        others = [s for s in sides if s not in square]
        if len(sides) > 1 and all(isinstance(s, Name) and s.is_marked_vector for s in others):
            for place, side in enumerate(sides):
                if isinstance(side, PoissonBracket) and side.is_square:
                    sides[place] = ComponentList((side.left, side.right), span=side.span)
        elif square and all(s == Number("0") for s in others):
            problem = "two quantities in square brackets that equal 0"
            expected = "braces around a Poisson bracket, or round brackets around a list"
            raise self._refused(square[0].span, problem, expected)

    def _listed(self, first: Node, left: Node) -> Node:
        """The values of an index, ``i = 1, 2, 3`` or ``i = 1, \\ldots, n``; or the side alone."""
        if not (isinstance(left, Name) and isinstance(first, Number) and self._at_listed([])):
            return first
        entries: list[Node] = [first]
        while self._at_listed(entries):
            self._take()
            entries.append(self._atom())
        span = self._since(first.span[0])
        is_decimal = len(entries) == 2 and self._source[span[0] : span[1]].find(", ") < 0
        if is_decimal and left.letter not in _INDICES:
            problem = "a comma between two numbers, of a decimal or between two values"
            raise self._refused(span, problem, "a decimal point, or a space behind the comma")
        return ComponentList(tuple(entries), span=span)

    def _at_listed(self, before: Sequence[Node]) -> bool:
        """Whether a comma and one more value follow, and then no more of a formula."""
        if not self._at(","):
            return False
        is_last = bool(before) and isinstance(before[-1], Omitted)
        kinds = {"number", "omitted", "letter"} if is_last else {"number", "omitted"}
        behind = self._tokens[min(self._place + 2, len(self._tokens) - 1)]
        ends = behind.kind in _ENDS or behind.is_mark(*_STOPS, ")", "&")
        return self._next.kind in kinds and ends

    def _side(self) -> Node:
        """A quantity, quantities with "or" between, or words to the end of the line."""
        self._skip_breaks()
        start = self._start
        is_words = self._token.kind == "words" and not self._at_word()
        if self._at_bracketed_words() or (is_words and not self._next.is_mark("^")):
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
        words = plain_words(match[1] or "")
        return words if is_words(words) else f"({words})"

    def _words_to_end(self) -> Words:
        """Words for a quantity, with the formulas among them, to the end of the line."""
        start = self._start
        while self._token.kind not in ("row", "tag", "close"):
            self._take()
        span = self._since(start)
        words = _WRAPPED.sub(r" \1 ", self._source[slice(*span)])
        return Words(" ".join(words.split()).rstrip(" .,"), span=span)

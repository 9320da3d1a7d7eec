"""A line with the letters in it left open: what it says of E, T or I, whatever they are.

A wrong line gives a letter a value that it does not have. To see what would follow if it did, the
letters of all lines are symbols of their own here, beside those of the model, whose accelerations,
reactions and dependent speeds are as free.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import prod

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, Vector, roots_in
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge.consequences._equations_of_text import Solving
from polhode.judge.contexts._equations import ENERGIES
from polhode.judge.latex._names import spelled
from polhode.judge.latex._tree import Name, Node, Relation
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._meaning import Meaning, Side
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim
from polhode.judge.states._claim_domain import TrueMotion

_HAT = "hat"


@dataclass(frozen=True)
class OpenLine:
    """A line with its letters open.

    Attributes:
        claim: that it makes of them; None for a definition.
        context: in which it was judged.
        defined: what vanishes by the definitions of letters in it.
        is_chain: whether its members are the links of one chain a = b = c.
        drawn_on: of a wrong line, the differences that vanish for those who draw on it.
    """

    claim: BoundClaim | None
    context: str
    defined: tuple[Expr, ...] = ()
    is_chain: bool = False
    drawn_on: tuple[Expr, ...] = ()

    @cached_property
    def relations(self) -> tuple[Expr, ...]:
        """The differences of both sides of its equations, which it says vanish."""
        return (*self.defined, *(_equations(self.claim) if self.claim is not None else ()))

    def parted(self, wrong: Collection[int]) -> tuple[OpenLine, OpenLine]:
        """What is true of it, with its definitions, and the members that are wrong.

        From a chain a = b = c that is wrong behind b, a text goes on with a = c.
        """
        claim = self.claim
        if claim is None or len(claim.branches) > 1 or not wrong:
            return replace(self, claim=None), replace(self, defined=(), drawn_on=self.relations)
        true = [member for member in range(len(claim.members)) if member not in wrong]
        right = replace(self, claim=claim.only(true))
        failing = replace(self, claim=claim.only(wrong), defined=())
        if not self.is_chain:
            return right, replace(failing, drawn_on=failing.relations)
        first = self.defined[0] if len(self.defined) == 1 else ZERO
        behind: dict[str, Expr] = {}
        found = []
        for component in claim.components():
            label = component.label
            behind[label] = behind.get(label, first) + component.difference
            if component.member >= min(wrong) and behind[label]:
                found.append(behind[label])
        return right, replace(failing, drawn_on=tuple(found))

    @property
    def differences(self) -> tuple[Expr, ...]:
        """Those of its claim; empty where it claims more than equations.

        Of an equation with ±, the product of those of its branches.
        """
        claim = self.claim
        if claim is None or any(relation.sign not in EQUALITY for relation in claim.members):
            return ()
        branches = [claim.components(i) for i in range(len(claim.branches))]
        if len(branches) == 1:
            return tuple(c.difference for c in branches[0] if c.difference)
        if any(len(components) != 1 for components in branches):
            return ()
        return (prod((c.difference for (c,) in branches), start=ONE),)

    @property
    def squared(self) -> tuple[Expr, ...]:
        """The differences of the squares of both sides where these contain a root.

        Of which sign such a root is, the motion says, and not the equation that it comes from.
        """
        claim = self.claim
        if claim is None or len(claim.branches) > 1 or not roots_in(self.differences):
            return ()
        return tuple(c.left**2 - c.right**2 for c in claim.components() if c.difference)

    @property
    def is_energy(self) -> bool:
        """Whether it gives an energy, which may count from any level."""
        printed = [relation.printed for relation in self.claim.members] if self.claim else []
        lefts = [one.left for one in printed if one is not None]
        return any(isinstance(left, Name) and left.letter in ENERGIES for left in lefts)

    def states(self, equations: Equations) -> TrueMotion:
        """The true motions under the restrictions that give values to quantities.

        Other restrictions are equations of the text, which are imposed like its lines.
        """
        claim = self.claim or BoundClaim(((),), equations)
        return replace(claim, relations=()).states(TrueMotion)


class OpenLetters:
    """Symbols in place of the letters of a text, and the values that they have in truth.

    Attributes:
        values: of the symbols, in truth.
        groups: the symbols of each letter, three for a vector.
    """

    def __init__(self) -> None:
        self._fresh: dict[tuple[Node, Meaning], Meaning] = {}
        self.values: dict[Symbol, Expr] = {}
        self.groups: list[tuple[Symbol, ...]] = []
        self._rates: dict[Symbol, Expr] = {}

    def opened(self, judged: JudgedLine) -> OpenLine | None:
        """A line with its letters open; None where it has no meaning or states no equation."""
        notation, closed = judged.judgement.notation, judged.claim
        if notation is None or closed is None:
            return None
        statement = judged.line.statement
        letters: dict[Node, Meaning] = {}
        for name in judged.line.letters:
            meaning = notation.vocabulary.find(name)
            is_own = name in notation.vocabulary.stated
            if meaning is not None and _is_open(name, meaning, is_own):
                letters[name] = self._symbol(name, meaning)
        context = judged.verdict.context
        try:
            claim = notation.stating(letters).read_claim(statement, {})
            is_same = len(claim.components()) == len(closed.components()) and all(
                self.in_truth(one.difference) == other.difference
                for one, other in zip(claim.components(), closed.components(), strict=True)
            )
        except (PolhodeError, ArithmeticError):
            is_same = False
        claim = claim if is_same else closed
        defined = tuple(self._definitions(judged, letters))
        links = judged.line.statement.relations
        is_chain = len(links) == 1 and len(links[0].sides) > 2 and {*links[0].signs} <= {*EQUALITY}
        return OpenLine(claim, context, defined, is_chain)

    def _definitions(self, judged: JudgedLine, letters: Mapping[Node, Meaning]) -> Iterator[Expr]:
        """What a line says of the letters that it defines."""
        defined = judged.bound.defined if judged.bound is not None else {}
        for relation in judged.line.statement.relations:
            letter = relation.sides[0]
            if letter not in defined or len(relation.sides) < 2:
                continue
            value, symbol = defined[letter], self._symbol(letter, defined[letter])
            if isinstance(value, Expr) and isinstance(symbol, Expr):
                yield symbol - self._opened_value(relation, judged, letters, value)

    def _opened_value(
        self, relation: Relation, judged: JudgedLine, letters: Mapping[Node, Meaning], value: Expr
    ) -> Expr:
        notation = judged.judgement.notation
        assert notation is not None
        try:
            found = notation.stating(letters).value(relation.sides[1])
        except (PolhodeError, ArithmeticError):
            return value
        return found if isinstance(found, Expr) and self.in_truth(found) == value else value

    def value(self, symbol: Symbol) -> Expr | None:
        """What an open letter, or a rate of one, is in truth; None for any other symbol."""
        if symbol.order == 0:
            return self.values.get(symbol)
        if symbol.base() not in self.values:
            return None
        if symbol not in self._rates:
            value = self.values[symbol.base()]
            for _ in range(symbol.order):
                value = value.dt()
            self._rates[symbol] = value
        return self._rates[symbol]

    def in_truth(self, expression: Expr) -> Expr:
        """An expression with the letters that are open replaced by their values."""
        found = {s: value for s in expression.symbols() if (value := self.value(s)) is not None}
        return expression.subs(found) if found else expression

    def solved(self, relation: Expr, symbol: Symbol, slope: Expr) -> Expr | None:
        """The value of a letter by an equation linear in it, the others as they are in truth.

        None where its coefficient vanishes in truth.
        """
        rest = relation - slope * Expr.generator(symbol)
        divisor = self.in_truth(slope)
        return -self.in_truth(rest) / divisor if divisor else None

    def values_by(self, solving: Solving) -> dict[Symbol, Expr] | None:
        """The values that equations give in turn, other letters as they are in truth."""
        found: dict[Symbol, Expr] = {}
        for equation, unknown in solving:
            slope = self.in_truth(unknown.slope.subs(found))
            if unknown.power > 1 or not slope:
                return None
            rest = equation.relation - unknown.slope * Expr.generator(unknown.symbol)
            found[unknown.symbol] = -self.in_truth(rest.subs(found)) / slope
        return found

    def with_values(self, claim: BoundClaim, values: Mapping[Symbol, Expr]) -> BoundClaim:
        """A claim whose letters have values, or else those that they have in truth."""

        def put_in(side: Side) -> Side:
            return self.in_truth(side.subs(values)) if isinstance(side, Expr) else side

        members = (replace(m, left=put_in(m.left), right=put_in(m.right)) for m in claim.members)
        return replace(claim, branches=(tuple(members),))

    def _symbol(self, letter: Node, meaning: Meaning) -> Meaning:
        key = letter, meaning
        if key not in self._fresh:
            known = len(self.values)
            self._fresh[key] = self._made(letter, meaning)
            self.groups.append(tuple(self.values)[known:])
        return self._fresh[key]

    def _made(self, letter: Node, meaning: Meaning) -> Meaning:
        match meaning:
            case Expr():
                return self._scalar(spelled(letter), meaning, meaning.varies)
            case Vector(components, triad):
                varies = any(component.varies for component in components)
                made = (
                    self._scalar(f"{spelled(letter)} {i}", component, varies)
                    for i, component in enumerate(components, 1)
                )
                return Vector(tuple(made), triad)
        return meaning

    def _scalar(self, name: str, value: Expr, varies: bool) -> Expr:
        kind = SymbolKind.FUNCTION if varies else SymbolKind.PARAMETER
        symbol = Symbol(f"{name} of the text {len(self.values)}", kind)
        self.values[symbol] = value
        return Expr.generator(symbol)


def _is_open(name: Node, meaning: Meaning, is_own: bool) -> bool:
    """Whether a letter stands for more than a symbol of the model, a number or an axis.

    A letter that the text defines for itself may stand for a number: k of I = k m a².
    """
    if isinstance(name, Name) and name.decoration.endswith(_HAT):
        return False
    match meaning:
        case Expr():
            return meaning.symbol is None and (is_own or bool(meaning.symbols()))
        case Vector(components, _):
            # A constant vector that the text itself defines is never wrong.
            return any(c.varies if is_own else c.symbols() for c in components)
    return False


def _equations(claim: BoundClaim) -> Iterator[Expr]:
    if len(claim.branches) > 1:
        return
    for component in claim.components():
        if claim.members[component.member].sign in EQUALITY and component.difference:
            yield component.difference

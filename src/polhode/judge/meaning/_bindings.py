"""A statement bound to a model: its members as relations between exact quantities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction

from polhode.algebra import ZERO, Expr, Symbol, Vector, as_symbol, is_positive
from polhode.judge.latex import _tree as tree
from polhode.judge.latex._tree import Node, Relation, Statement, walk
from polhode.judge.meaning._differentials import are_rates
from polhode.judge.meaning._evaluate import FORWARD, Evaluator
from polhode.judge.meaning._expanded import expanded
from polhode.judge.meaning._initial_values import INITIAL, initial_value
from polhode.judge.meaning._meaning import (
    BindingError,
    Meaning,
    Side,
    Tensor,
    as_scalar,
    over,
    positive_root,
    rate,
    zero_like,
)
from polhode.judge.meaning._proposals import GREATEST, OWN
from polhode.judge.meaning._relations import BoundRelation, PrintedRelation, changing
from polhode.judge.meaning._vocabulary import Vocabulary

EQUAL = ("=", "≡")
#: Letters that a text writes on the right for "some constant".
_CONSTANTS = (tree.Name("c"), tree.Name("C"), tree.Name("const"))
_UNKNOWN = Expr.generator(Symbol("unknown"))  # in place of a letter that a chain defines
COMPARED = (*EQUAL, "≈", "≠", "<", ">", "≤", "≥", "≪", "≫", "∝")


@dataclass(frozen=True)
class Bound:
    """A statement with all its symbols given a meaning.

    Attributes:
        branches: the members; twice, for the upper and the lower sign, where it says ±.
        defined: letters that only this statement defines, with their meaning.
        conditions: its restrictions: relations in brackets after a word such as "if", and ranges
            of coordinates or speeds.
        values: values of coordinates and speeds in brackets, which may be conditions or claims.
        digits: for members with a decimal number on the right, half a unit of its last digit.
    """

    branches: tuple[tuple[BoundRelation, ...], ...]
    defined: Mapping[Node, Meaning]
    conditions: tuple[BoundRelation, ...]
    digits: Mapping[int, Expr]
    values: tuple[BoundRelation, ...] = ()

    @property
    def relations(self) -> tuple[BoundRelation, ...]:
        """The members, with the upper sign of ±."""
        return self.branches[0]

    @property
    def is_definition(self) -> bool:
        """Whether it only defines letters."""
        return bool(self.defined) and not self.relations


def bind(statement: Statement, vocabulary: Vocabulary) -> Bound:
    """Give every symbol of a statement its meaning.

    Raises:
        BindingError: for a symbol without a meaning, with names that resemble it, and for scalars
            and vectors that cannot be combined.
    """
    statement = expanded(statement, vocabulary)
    has_sign = any(isinstance(p, tree.PlusMinus) for p in walk(statement))
    signs = (True, False) if has_sign else (True,)
    per_time = are_rates(statement, vocabulary)
    binders = [_Binder(Evaluator(vocabulary, upper, per_time)) for upper in signs]
    branches = tuple(tuple(binder.members(statement.relations)) for binder in binders)
    first = binders[0]
    ranges: list[BoundRelation] = []
    values: list[BoundRelation] = []
    # A relation in brackets restricts the state if it bounds a coordinate or speed by a constant;
    # an equality of that form is ambiguous, and any other relation is one more member.
    for relation in statement.conditions:
        found = [tuple(binder.members([relation])) for binder in binders]
        of_state = [r for r in found[0] if _is_of_state(r, vocabulary)]
        if len(of_state) == len(found[0]) and all(r.sign not in EQUAL for r in of_state):
            ranges += of_state
        else:
            values += (r for r in of_state if r.sign in EQUAL)
            branches = tuple((*one, *more) for one, more in zip(branches, found, strict=True))
    # θ̇₀ = 0 beside another relation says how the motion that this speaks of starts.
    starts = [r for r in branches[0] if _is_of_start(r, vocabulary)]
    if starts and len(starts) < len(branches[0]) and not first.digits:
        branches = tuple(tuple(r for r in one if r not in starts) for one in branches)
        ranges += starts
    assumed = tuple(first.members(statement.assumptions))
    return Bound(branches, first.defined, (*assumed, *ranges), first.digits, tuple(values))


def _is_of_start(relation: BoundRelation, vocabulary: Vocabulary) -> bool:
    """Whether it gives a coordinate or its rate a constant value at the start of the motion."""
    left, right = relation.left, relation.right
    if relation.sign not in EQUAL or not isinstance(left, Expr) or not isinstance(right, Expr):
        return False
    coordinates = vocabulary.mechanics.declared.coordinates
    starts = {initial_value(s) for q in coordinates for s in (q, q.derivative())}
    others = right.symbols()
    return left.symbol in starts and not any(s in starts or s.kind.varies for s in others)


def _is_of_state(relation: BoundRelation, vocabulary: Vocabulary) -> bool:
    """Whether it compares a coordinate or speed with a constant, unlike any equation of motion."""
    equations = vocabulary.mechanics.equations
    state = {*equations.coordinates, *equations.speeds}
    left, right = relation.left, relation.right
    if not isinstance(left, Expr) or not isinstance(right, Expr) or relation.sign == "≈":
        return False
    return any(
        one.symbol in state and not other.varies for one, other in ((left, right), (right, left))
    )


def _sets_each_to_zero(relation: Relation) -> bool:
    """Whether it sets several letters to zero, as θ = θ̇ = 0 does.

    They need no dimension in common, since none is compared with another.
    """
    *letters, last = relation.sides
    are_letters = all(isinstance(x, tree.Name | tree.Dots | tree.At) for x in letters)
    return last == tree.Number("0") and are_letters and {*relation.signs} <= {*EQUAL}


class _Binder:
    """Binds the relations of one statement in order; later ones use what earlier ones define."""

    def __init__(self, evaluator: Evaluator) -> None:
        self._evaluator = evaluator
        self.defined: dict[Node, Meaning] = {}
        self.digits: dict[int, Expr] = {}
        self._count = 0

    def members(self, relations: Sequence[Relation]) -> Iterator[BoundRelation]:
        """All members of the given chains."""
        stated: list[Relation] = []
        for place, relation in enumerate(relations):
            if any(relation is each for each in stated):
                continue
            stated += self._stated_behind(relation, relations[place + 1 :])
            for number, chain in enumerate(_by_cases(relation)):
                for member in self._chain(chain):
                    left_out = tuple(map(self._order, relation.left_out))
                    yield replace(member, is_alternative=number > 0, left_out=left_out)

    def _stated_behind(self, relation: Relation, later: Sequence[Relation]) -> Iterator[Relation]:
        """Later relations that define a letter of this one, as after "where"; they are stated."""
        for other in later:
            if len(other.signs) != 1 or other.signs[0] not in EQUAL:
                continue
            side, value = other.sides
            letter = side.base if isinstance(side, tree.Power) else side
            if not isinstance(letter, tree.Name) or side in relation.sides:
                continue
            try:
                new = self._defined_by(side, value) if letter in walk(relation) else {}
            except BindingError:
                continue
            if new:
                self._state(new)
                yield other

    def _order(self, node: Node) -> Expr:
        return as_scalar(self._evaluator.value(node), "an order")

    def _chain(self, relation: Relation) -> Iterator[BoundRelation]:
        relation = self._behind_new_letters(relation)
        sides = relation.sides
        if relation.signs and relation.signs[0] in EQUAL and (new := self._defined_by(*sides[:2])):
            self._state(new)
            relation = replace(relation, sides=sides[1:], signs=relation.signs[1:])
        following = relation.sides[1:]
        if _sets_each_to_zero(relation):
            following = relation.sides[-1:] * len(following)
        chain = zip(relation.sides, relation.signs, following, strict=False)
        for place, (left, sign, right) in enumerate(chain):
            if len(relation.signs) > 1 and sign in EQUAL and self._defines(left, right):
                continue
            tensors = self._tensors(left, right)
            if tensors is not None:
                yield from self._by_columns(*tensors, sign, (left.span[0], right.span[1]))
            elif sign != "↔":
                yield self._member(PrintedRelation(self._evaluator, left, right, place == 0), sign)

    def _behind_new_letters(self, relation: Relation) -> Relation:
        """What a chain says behind two or more new letters that begin it: I₁ = I₂ = m a²/4."""
        sides, count = relation.sides, 0
        while count < len(relation.signs) and relation.signs[count] in EQUAL:
            if not (isinstance(sides[count], tree.Name) and self._is_new(sides[count])):
                break
            count += 1
        if count < 2:
            return relation
        value = self._evaluator.value(sides[count])
        self._state(dict.fromkeys(sides[:count], value))
        return replace(relation, sides=sides[count:], signs=relation.signs[count:])

    def _tensors(self, left: Node, right: Node) -> tuple[Tensor, Tensor] | None:
        """Both sides, if they are tensors."""
        if not any(isinstance(p, tree.PrintedMatrix) for p in (left, right)):
            return None
        one, other = self._evaluator.value(left), self._evaluator.value(right)
        both = isinstance(one, Tensor) and isinstance(other, Tensor)
        return (one, other) if both else None  # type: ignore[return-value]

    def _by_columns(
        self, one: Tensor, other: Tensor, sign: str, span: tree.Span
    ) -> Iterator[BoundRelation]:
        """An equation of tensors as what they make of three unit vectors."""
        for column in range(3):
            axis = Vector(tuple(Expr.of(int(i == column)) for i in range(3)), one.triad)
            self._count += 1
            yield BoundRelation(one.of(axis), sign, other.of(axis), span)

    def _defines(self, left: Node, right: Node) -> bool:
        """Take a link of a chain such as ... = I₁ a as the definition of its one new letter.

        The new letter has to be a factor of the whole side.
        """
        new = {p for p in walk(right) if isinstance(p, tree.Name) and not self._is_known(p)}
        if len(new) != 1:
            return False
        (letter,) = new
        unit = replace(
            self._evaluator, vocabulary=self._evaluator.vocabulary.stating({letter: _UNKNOWN})
        )
        try:
            side = as_scalar(unit.value(right), "a side")
            factor = side.diff(as_symbol(_UNKNOWN))
            if not factor or factor * _UNKNOWN != side or as_symbol(_UNKNOWN) in factor.symbols():
                return False
            self._state({letter: over(self._evaluator.value(left), factor)})
        except BindingError:
            return False
        return True

    def _is_known(self, name: Node) -> bool:
        try:
            self._evaluator.value(name)
        except BindingError:
            return False
        return True

    def _state(self, definition: Mapping[Node, Meaning]) -> None:
        """Let later relations use what one defines."""
        self.defined |= definition
        vocabulary = self._evaluator.vocabulary.stating(definition)
        self._evaluator = replace(self._evaluator, vocabulary=vocabulary)

    def _defined_by(self, left: Node, right: Node) -> dict[Node, Meaning]:
        """The new letter that is set equal to a value, itself or by its square.

        The square of a letter that the field uses for a quantity is taken for that of the quantity.
        """
        if self._is_new(left):
            return {left: self._evaluator.value(right)}
        vocabulary = self._evaluator.vocabulary
        match left:
            case tree.Power(base, tree.Number("2")) if (
                not vocabulary.has(left)  # a square that is defined as such is judged
                and self._is_new(base)
                and vocabulary.chosen.get(base) != OWN
            ):
                square = self._evaluator.value(right)
                if isinstance(square, Expr):
                    return {base: positive_root(square, vocabulary.positive)}
        return {}

    def _is_new(self, node: Node) -> bool:
        """Whether a node is a letter that has no meaning yet, neither itself nor by its parts."""
        self._refuse_primes(node)
        is_letter = isinstance(node, tree.Name | tree.Differential | tree.At)
        if not is_letter or self._evaluator.vocabulary.has(node):
            return False
        if isinstance(node, tree.Name):
            return not node.letter.isdigit()  # a bold 0 is the zero vector
        try:
            self._evaluator.value(node)
        except BindingError:
            return True
        return False

    def _refuse_primes(self, node: Node) -> None:
        """Refuse two primes on a known quantity: they mean a rate there, not a new letter."""
        vocabulary = self._evaluator.vocabulary
        if not isinstance(node, tree.Name) or node.primes < 2 or vocabulary.has(node):
            return
        if vocabulary.has(replace(node, primes=0)):
            raise BindingError(
                f"{node.primes} primes on {node.letter}",
                expected="dots for time derivatives",
                advice=r"write \ddot{...}, or define the letter",
                option="let",
            )

    def _member(self, printed: PrintedRelation, sign: str) -> BoundRelation:
        left, right = printed.left, printed.right
        if sign not in COMPARED:
            raise BindingError(
                f"the sign {sign}, which compares nothing",
                expected=f"one of {' '.join(COMPARED)}",
                advice="write = for a value, or ≈ with what is small for a limit",
            )
        span = left.span[0], right.span[1]
        if sign in EQUAL:
            left, right = self._up_to_a_constant(left, right)
            printed = replace(printed, left=left, right=right)
        self._refuse_bounds_inside(left, right)
        one, other = self._sides(left, right)
        # A printed 9.81 stands for any value within half a unit of its last digit.
        half = self._half_unit(right)
        if half is not None:
            self.digits[self._count] = half
        self._count += 1
        is_lasting = self._says_constant(left, right)
        if is_lasting:
            printed = changing(printed)
        if self._is_greatest(left, one) and sign in EQUAL:
            sign = "≤"  # the greatest speed is one that no speed exceeds
        return BoundRelation(one, sign, other, span, is_lasting=is_lasting, printed=printed)

    def _up_to_a_constant(self, left: Node, right: Node) -> tuple[Node, Node]:
        """V = f + const as V - f = const."""
        if not isinstance(right, tree.Sum):
            return left, right
        rest = [term for term in right.terms if not self._is_constant(_unsigned(term))]
        if len(rest) == len(right.terms):
            return left, right
        terms = (left, *(tree.Negative(term, span=term.span) for term in rest))
        return tree.Sum(terms, span=left.span), tree.Name("constant", span=right.span)

    def _refuse_bounds_inside(self, left: Node, right: Node) -> None:
        """Refuse T_max anywhere but alone on the left: of its value only a bound is known."""
        sense = self._evaluator.vocabulary.sense
        inside = (p for side in (left, right) for p in walk(side) if p is not left)
        for node in inside:
            if not isinstance(node, tree.Name) or node.subscript != GREATEST:
                continue
            found = sense(node)
            if found and any(r.phrase.startswith("greatest ") for r in found.readings):
                raise BindingError(
                    f"{node.letter}_{GREATEST} inside a formula",
                    expected="a greatest value alone on the left, or as the text defines it",
                    option="let",
                )

    def _is_greatest(self, node: Node, value: Side) -> bool:
        """Whether a letter such as v_max stands for what varies with time."""
        if not isinstance(node, tree.Name) or node.subscript != GREATEST:
            return False
        return isinstance(value, Expr) and value.varies

    def _sides(self, left: Node, right: Node) -> tuple[Side, Side]:
        if self._says_constant(left, right):
            change = rate(self._evaluator.value(left))
            return _side(change), _side(zero_like(change))
        for node, other in ((left, right), (right, left)):
            inverse = _inverse(node)
            if inverse is not None:
                # c artanh x = y is read as x = tanh(y/c), which needs no choice of a branch.
                value = self._evaluator.value
                factor = value(tree.replaced(node, inverse, tree.Number("1")))
                inside = as_scalar(over(value(other), factor), inverse.function)
                return _side(value(inverse.argument)), FORWARD[inverse.function](inside)
        one, two = self._evaluator.value(left), self._evaluator.value(right)
        return _side(one), _side(two)

    def _says_constant(self, left: Node, right: Node) -> bool:
        """Whether the right side says that the left one is constant.

        A text writes a word, a c that it does not define, or the value at the start: E = E₀.
        """
        if self._is_constant(right):
            return True
        while isinstance(left, tree.Dots) and isinstance(right, tree.Dots):
            if left.count != right.count:
                return False
            left, right = left.of, right.of
        if not isinstance(left, tree.Name) or not isinstance(right, tree.Name):
            return False
        stem = replace(right, subscript=right.subscript.removesuffix("0").rstrip(", "))
        if right == left or stem != replace(left, span=stem.span) or not self._is_known(left):
            return False
        sense = self._evaluator.vocabulary.sense(right)
        return sense is None or any(r.phrase.startswith(INITIAL) for r in sense.readings)

    def _is_constant(self, node: Node) -> bool:
        """Whether a word, or a c that the text does not define, stands for some constant."""
        return _says_constant(node) or (node in _CONSTANTS and not self._is_known(node))

    def _half_unit(self, node: Node) -> Expr | None:
        """Half a unit of the last digit of the only decimal number in a node, times its factor.

        The factor is the slope of the node, which is taken as linear in the number. A whole number
        of two digits or more is rounded too if it stands with a unit. Of several decimals that are
        put into a formula, 0.5 · 9.81 · 0.866, what the roundings of all make together.
        """
        pieces = list(walk(node))
        numbers = [p for p in pieces if isinstance(p, tree.Number) and "." in p.text]
        if not numbers and any(isinstance(p, tree.UnitSymbol) for p in pieces):
            numbers = [p for p in pieces if isinstance(p, tree.Number)]
            numbers = numbers if all(len(p.text) > 1 for p in numbers) else []
        if len(numbers) > 1 and not any(isinstance(p, tree.Name) for p in pieces):
            return self._rounding(node, numbers)
        if len(numbers) != 1:
            return None
        (number,) = numbers
        half = Fraction(1, 2 * 10 ** len(number.text.partition(".")[2]))

        def with_number(text: str) -> Expr:
            changed = tree.replaced(node, number, tree.Number(text))
            return as_scalar(self._evaluator.value(changed), "a number")

        return (with_number("1") - with_number("0")) * half

    def _rounding(self, node: Node, numbers: Sequence[tree.Number]) -> Expr | None:
        """By how much a value may differ from that of its decimals, each rounded as printed.

        A decimal of one significant digit, such as the 0.5 for a half, counts as exact beside those
        of more.
        """
        precise = [n for n in numbers if len(n.text.replace(".", "").lstrip("0")) > 1] or numbers
        value = as_scalar(self._evaluator.value(node), "a number")
        whole = ZERO
        for number in dict.fromkeys(precise):
            places = len(number.text.partition(".")[2])
            more = tree.Number(f"{Decimal(number.text) + Decimal(5).scaleb(-places - 1)}")
            changed = self._evaluator.value(tree.replaced(node, number, more))
            difference = as_scalar(changed, "a number") - value
            if difference.symbols():
                return None
            whole += difference if is_positive(difference) else -difference
        return whole


def _unsigned(node: Node) -> Node:
    return node.of if isinstance(node, tree.Negative | tree.PlusMinus) else node


def _by_cases(relation: Relation) -> Iterator[Relation]:
    """ω ≈ A (slow) or B (fast) as ω(slow) ≈ A and ω(fast) ≈ B."""
    *before, last = relation.sides
    if not isinstance(last, tree.Cases):
        yield relation
        return
    for case in last.cases:
        sides = tuple(_labelled(side, case.words) for side in before)
        yield replace(relation, sides=(*sides, case.value))


def _labelled(node: Node, words: str) -> Node:
    if not isinstance(node, tree.Name) or not words:
        return node
    return replace(node, subscript=",".join(filter(None, (node.subscript, words))))


def _says_constant(node: Node) -> bool:
    words = {tree.Name: "letter", tree.Words: "text"}.get(type(node), "")
    text = str(getattr(node, words, "")).strip(" .,") if words else ""
    return text in ("constant", "const", "constant vector")


def _inverse(node: Node) -> tree.Call | None:
    """The inverse function, such as arctan, that a side consists of, apart from factors."""
    match node:
        case tree.Call(function) if function in FORWARD:
            return node
        case tree.Product(factors):
            found = [f for f in factors if isinstance(f, tree.Call) and f.function in FORWARD]
            return found[0] if len(found) == 1 else None
        case tree.Negative(of):
            return _inverse(of)
    return None


def _side(meaning: Meaning) -> Side:
    if isinstance(meaning, Tensor):
        raise BindingError("a tensor on one side", expected="a scalar or a vector")
    return meaning


def restrictions(
    relations: Sequence[BoundRelation],
) -> tuple[dict[Expr, Expr], tuple[Expr, ...]]:
    """Equalities taken as given: symbols with values, and further expressions that vanish.

    Raises `BindingError` for an inequality.
    """
    values: dict[Expr, Expr] = {}
    vanishing: list[Expr] = []
    for relation in relations:
        if relation.sign not in EQUAL:
            raise BindingError(
                f"the condition with {relation.sign}", expected="an equality such as θ = π/2"
            )
        for left, right in _scalars(relation.left, relation.right):
            if left.symbol is not None and left.symbol not in right.symbols():
                values[left] = right
            elif left != right:
                vanishing.append(left - right)
    return values, tuple(vanishing)


def _zeros(sides: tuple[tuple[Expr, ...], tuple[Expr, ...]]) -> int:
    return max(sum(not component for component in side) for side in sides)


def _scalars(left: Side, right: Side) -> Iterator[tuple[Expr, Expr]]:
    match left, right:
        case Expr(), Expr():
            yield left, right
        case Vector(), Vector():
            # Along axes of which most are across one side, few relations contain its length.
            sides = [
                (left.express(t).components, right.express(t).components)
                for t in (left.triad, right.triad)
            ]
            yield from zip(*max(sides, key=_zeros), strict=True)
        case Vector(), Expr() if not right:
            yield from ((component, ZERO) for component in left.components)
        case _:
            raise BindingError(
                "a scalar set equal to a vector", expected="two scalars or two vectors"
            )

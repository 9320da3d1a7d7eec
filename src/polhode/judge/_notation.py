"""The notation of a text about a system: letters, definitions, restrictions, small quantities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, as_symbol
from polhode.base import Dimension, ParseError
from polhode.derive import Equations
from polhode.judge.document._document import Claim, Definition, Part
from polhode.judge.latex import read_latex
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import Node, Statement
from polhode.judge.meaning._bindings import EQUAL, Bound, bind, restrictions
from polhode.judge.meaning._derived_quantities import polar_sines
from polhode.judge.meaning._evaluate import Evaluator
from polhode.judge.meaning._initial_values import initial_value, start_of
from polhode.judge.meaning._meaning import BindingError, Meaning, Side, as_scalar, signed, sort
from polhode.judge.meaning._mechanics import is_acceleration
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.meaning._vocabulary import Vocabulary, constant
from polhode.judge.states._bound_claim import SENSE, BoundClaim, Small

#: The binding that names the frame of components in a bracket.
COLUMNS = "components"

_CLAIMS_KEPT = 200


@dataclass(frozen=True, eq=False)
class Notation:
    """What statements about one system mean.

    Attributes:
        vocabulary: letters of the text.
        given: restrictions, as bound relations.
        small: quantities taken as small.
        start: initial values of a motion, as bound relations.
        when: for statements about a motion, when they hold, as in `BoundClaim`.
    """

    vocabulary: Vocabulary
    given: tuple[BoundRelation, ...] = ()
    small: tuple[Small, ...] = field(default=())
    start: tuple[BoundRelation, ...] = ()
    when: str = ""

    @classmethod
    def of(cls, equations: Equations) -> Notation:
        """With only the names of the declaration."""
        return cls(Vocabulary.of(equations))

    @classmethod
    def of_part(
        cls, equations: Equations, part: Part, chosen: Mapping[Node, str] | None = None
    ) -> Notation:
        """The notation of one part of a document.

        Raises:
            ParseError: for LaTeX in the part that cannot be read.
            BindingError: for symbols there that stand for nothing.
        """
        return (
            cls.of(equations)
            .choosing(chosen or {})
            .binding(part.bindings)
            .with_constants(part.constants)
            .taking_positive(part.positive)
            .defining(part.definitions)
            .under(part.given)
        )

    def of_claim(self, claim: Claim) -> Notation:
        """The notation of one claim of that part, with its own bindings and restrictions."""
        return (
            self.binding(claim.bindings)
            .defining(claim.definitions)
            .under(claim.given)
            .with_small(claim.small)
        )

    # -- extended by what a text states ---------------------------------------------------------

    def choosing(self, chosen: Mapping[Node, str]) -> Notation:
        """With letters of several meanings read as quantities of the model."""
        return replace(self, vocabulary=self.vocabulary.choosing(chosen)) if chosen else self

    def with_lengths(self) -> Notation:
        """With the letters of distances and slip speeds that the derived equations print.

        A letter that means something else already keeps its meaning.
        """
        vocabulary = self.vocabulary
        letters = {letter: name_of(letter) for letter in vocabulary.mechanics.equations.lengths}
        new = {
            node: f"length {letter} of the equations"
            for letter, node in letters.items()
            if vocabulary.find(node) is None
        }
        return replace(self, vocabulary=vocabulary.binding(new)) if new else self

    def allowing(self, allowed: Mapping[Node, tuple[str, ...]]) -> Notation:
        """With only some of the meanings of letters that have several."""
        return replace(self, vocabulary=self.vocabulary.allowing(allowed))

    def binding(self, bindings: Mapping[str, str]) -> Notation:
        """With letters, as LaTeX, bound to quantities of the model."""
        if not bindings:
            return self
        mechanics = self.vocabulary.mechanics
        columns = bindings.get(COLUMNS, self.vocabulary.columns)
        mechanics.frame(columns)
        phrases = {letter(latex): phrase for latex, phrase in bindings.items() if latex != COLUMNS}
        vocabulary = replace(self.vocabulary.binding(phrases), columns=columns)
        return replace(self, vocabulary=vocabulary)

    def with_constants(self, letters: Iterable[str]) -> Notation:
        """With letters, as LaTeX, that stand for constants without a value."""
        found = [letter(latex) for latex in letters]
        return self.stating({node: constant(node) for node in found})

    def taking_positive(self, quantities: Iterable[str]) -> Notation:
        """With quantities, as LaTeX, whose sign is known."""
        return self.with_positive([self.scalar(latex) for latex in quantities])

    def with_positive(self, values: Iterable[Expr]) -> Notation:
        """With positive quantities, by which earlier definitions are simplified: |a| becomes a."""
        vocabulary = self.vocabulary
        positive = (*vocabulary.positive, *values)
        stated = {node: signed(meaning, positive) for node, meaning in vocabulary.stated.items()}
        return replace(self, vocabulary=replace(vocabulary, positive=positive, stated=stated))

    def defining(self, definitions: Iterable[Definition]) -> Notation:
        """With new letters, each by an equation that has it on the left.

        Raises `ParseError` for one that the declaration uses already.
        """
        notation = self
        for definition in definitions:
            notation = notation.stating(notation._defined(definition.latex))
        return notation

    def _defined(self, latex: str) -> dict[Node, Meaning]:
        statement = read_latex(latex)
        found: dict[Node, Meaning] = {}
        for relation in statement.relations:
            if len(relation.sides) != 2 or relation.signs[0] not in EQUAL:
                raise ParseError(
                    f"the definition {latex!r}", expected="an equation: new letter = its value"
                )
            new, value = relation.sides
            if new in self.vocabulary.declared:
                raise ParseError(
                    f"{spelled(new)}, which {self.vocabulary.system} has already",
                    expected="a definition of a new letter",
                    advice="restrict a known quantity to a value instead",
                    option="given",
                )
            found[new] = self.stating(found).value(value)
        return found

    def under(self, given: Iterable[str]) -> Notation:
        """Restricted by relations, as LaTeX."""
        bound = [
            relation for latex in given for relation in self.bound(read_latex(latex)).relations
        ]
        return replace(self, given=(*self.given, *bound)) if bound else self

    def with_small(self, small: Mapping[str, int | None]) -> Notation:
        """With small quantities, as LaTeX, and the order to which they are kept."""
        found = [Small(self.scalar(latex), order) for latex, order in small.items()]
        return replace(self, small=(*self.small, *found)) if found else self

    def at(self, when: str) -> Notation:
        """For statements that hold at some times of a motion only."""
        return self if when == self.when else replace(self, when=when)

    def stating(self, meanings: Mapping[Node, Meaning]) -> Notation:
        """With letters of the text, which may be known ones that it uses for something else."""
        return replace(self, vocabulary=self.vocabulary.stating(meanings)) if meanings else self

    def measuring(self, letters: Mapping[Node, Dimension | None]) -> Notation:
        """With the dimensions of letters whose value the text gives as a number."""
        if not letters:
            return self
        return replace(self, vocabulary=replace(self.vocabulary, measured=letters))

    # -- reading --------------------------------------------------------------------------------

    def bound(self, statement: Statement) -> Bound:
        """A statement with its symbols given a meaning."""
        return bind(statement, self.vocabulary)

    def read_claim(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes; `extra` are further letters by published name.

        Definitions are not among its members.
        """
        wider = self._with(extra)
        claims = wider._claims
        if statement not in claims:
            claim = wider.claimed(wider.bound(statement))
            if len(claims) == _CLAIMS_KEPT:
                del claims[next(iter(claims))]  # the oldest
            claims[statement] = claim
        return claims[statement]

    @cached_property
    def _claims(self) -> dict[Statement, BoundClaim]:
        """Claims read before: a search for a correction comes back to the same statements."""
        return {}

    def _with(self, extra: Mapping[str, Expr]) -> Notation:
        key = tuple(extra.items())
        if key not in self._wider:
            self._wider[key] = self.stating({name_of(name): value for name, value in key})
        return self._wider[key]

    @cached_property
    def _wider(self) -> dict[tuple[tuple[str, Expr], ...], Notation]:
        """Extended notations; each keeps the values of nodes that it has evaluated."""
        return {(): self}

    def claimed(self, bound: Bound) -> BoundClaim:
        """The claim that a bound statement makes under this notation's restrictions."""
        equalities = [r for r in bound.conditions if r.sign in EQUAL]
        values, vanishing = restrictions((*self.given, *equalities))
        mechanics = self.vocabulary.mechanics
        printed = list(_scalars(r for b in bound.branches for r in b))
        # The motion determines accelerations: a value of one restricts the states. An equation for
        # one is no restriction; if it is wrong, what follows from it alone is wrong too.
        accelerations = [
            s for s in values if is_acceleration(as_symbol(s)) and not values[s].varies
        ]
        vanishing += tuple(s - values.pop(s) for s in accelerations)
        given: dict[Symbol, Expr] = {as_symbol(s): value for s, value in values.items()}
        stated = list(_scalars((*self.given, *bound.conditions)))
        begun = {as_symbol(s): value for s, value in restrictions(self.start)[0].items()}
        at_start = {initial_value(s): value for s, value in begun.items()}
        start = start_of(mechanics, (*printed, *stated), {**at_start, **given})
        letters = {s for side in (*printed, *stated) for s in side.symbols()}
        given = {
            **{s: v for s, v in at_start.items() if s in letters and v != Expr.generator(s)},
            **given,
        }
        for relation in bound.values:
            if relation.left not in values and relation.right not in values:
                raise ParseError(
                    f"{relation.left} = {relation.right} in brackets, which may be a condition or "
                    "a claim",
                    expected="a word that decides, such as (if ...)",
                    advice="write \\text{if} inside the bracket, or state it as given",
                    option="given",
                )
        # A rate given at the start, though what is conserved determines it, restricts the motion.
        met = [start.solved[s] - value for s, value in given.items() if s in start.solved]
        given |= start.solved
        lasting = filter(None, map(_lasting, (*self.given, *equalities)))
        equations = mechanics.equations
        # A condition left > right makes left - right positive.
        differences = [
            (as_scalar(r.left, "a bound") - as_scalar(r.right, "a bound")) * SENSE[r.sign]
            for r in bound.conditions
            if r.sign in SENSE
        ]
        sized = {p for e in printed for g in e.generators if (p := getattr(g, "plain", None))}
        polar = (e for e in polar_sines(mechanics) if not sized.isdisjoint((e, -e)))
        return BoundClaim(
            bound.branches,
            equations,
            given,
            (*vanishing, *lasting, *start.relations, *met),
            self.small,
            tuple(dict.fromkeys((*self.vocabulary.positive, *differences, *polar))),
            bound.digits,
            begun,
            when=self.when,
            defined=tuple(bound.defined),
            initial=start,
        )

    def value(self, node: Node, extra: Mapping[str, Expr] = MappingProxyType({})) -> Side:
        """What one node stands for, a scalar or a vector; `extra` are further letters in it."""
        found = Evaluator(self._with(extra).vocabulary).value(node)
        if not isinstance(found, Side):
            raise BindingError(f"a {sort(found)}", expected="a scalar or a vector")
        return found

    def scalar(self, latex: str) -> Expr:
        """The scalar that a quantity in LaTeX stands for."""
        return as_scalar(self.value(letter(latex)), latex)

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters of the text, with their dots, that a correction may use."""
        return tuple(dict.fromkeys(self.vocabulary.letters()))

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters that may stand for vectors, and that a correction may use."""
        return tuple(self.vocabulary.vectors())


def _scalars(relations: Iterable[BoundRelation]) -> Iterator[Expr]:
    """The scalar sides of relations, and the components of those that are vectors."""
    for relation in relations:
        for side in (relation.left, relation.right):
            yield from side.components if isinstance(side, Vector) else (side,)


def letter(latex: str) -> Node:
    """The one quantity that a piece of LaTeX prints."""
    statement = read_latex(latex)
    (relation, *others) = statement.relations
    if others or relation.is_claim:
        raise ParseError(f"{latex!r}", expected="one letter or quantity, and no relation")
    return relation.sides[0]


def _lasting(relation: BoundRelation) -> Expr | None:
    """The acceleration that vanishes too where a coordinate is constant; None for other relations.

    So θ = const restricts the rate of precession of a top, which θ̇ = 0 at one instant does not.
    """
    if not relation.is_lasting or not isinstance(relation.left, Expr):
        return None
    rate = relation.left.symbol
    is_of_coordinate = rate and rate.order == 1 and rate.kind is SymbolKind.COORDINATE
    return relation.left.dt() if is_of_coordinate else None

"""What a text has stated up to a line, and the part of the text for which it stands."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, symbol
from polhode.base import Dimension, PolhodeError
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations
from polhode.judge._notation import Notation
from polhode.judge.latex._tree import Node
from polhode.judge.meaning._meaning import Meaning, Side
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.source import SourceRelation
from polhode.judge.states._bound_claim import Small
from polhode.judge.text._cues import Cues

#: Bars of absolute values, as LaTeX.
BARS = re.compile(r"\\(?:left|right)\s*\||\\[lr]vert(?![A-Za-z])|\\[lr]?[bB]igg?[lr]?\||\|")
#: Letters of several meanings, each with the one that is taken.
Chosen = Mapping[Node, str]


@dataclass(frozen=True)
class StatedCondition:
    """Restrictions that a sentence states for itself.

    Attributes:
        latex: the formula that states them.
        relations: the restrictions.
        is_meant_on: whether later sentences may go on to mean them, as after "a hollow sphere has
            I = ..." and unlike after "when θ = π/2".
        positive: differences of parameters that it takes as positive.
    """

    latex: str
    relations: tuple[BoundRelation, ...]
    is_meant_on: bool = False
    positive: tuple[Expr, ...] = ()

    @property
    def is_of_state(self) -> bool:
        """Whether it restricts the state, and not the parameters alone, as a choice of bodies."""
        return any(varies(relation.left) for relation in self.relations)


@dataclass(frozen=True)
class InForce:
    """What holds for a line by what the text has stated before it.

    Attributes:
        defined: letters that the text defines, with their meaning.
        measured: of these, those whose value is a number, with its dimension where it is known.
        given: restrictions.
        small: quantities that are small.
        start: initial values.
        conditions: restrictions of one sentence.
        is_steady: whether the motion is said to be steady.
        is_body_fixed: whether axes are said to be fixed in a body.
        unread: conditions that could not be read, as they are printed.
        integrated: restrictions by constants of integration that are taken as zero.
        counts_time: whether the text says from which instant time is counted.
        is_from_rest: whether the motion starts from rest.
        is_of_equilibrium: whether the text has spoken of equilibrium, which it may go on to mean.
        named: letters that words give another of their meanings: "the effective potential U".
        event: restrictions for the instant at which a contact ends, to which "then" may refer.
        positive: differences of parameters that the text takes as positive, as by I₁ < I₂ < I₃.
        is_at_start: whether the text has spoken of the start, of which it may go on to speak.
        is_along_momentum: whether the z axis is said to be along the angular momentum.
    """

    defined: Mapping[Node, Meaning] = field(default_factory=dict)
    measured: Mapping[Node, Dimension | None] = field(default_factory=dict)
    given: tuple[BoundRelation, ...] = ()
    small: tuple[Small, ...] = ()
    start: tuple[BoundRelation, ...] = ()
    conditions: tuple[StatedCondition, ...] = ()
    is_steady: bool = False
    unread: tuple[str, ...] = ()
    is_body_fixed: bool = False
    integrated: tuple[BoundRelation, ...] = ()
    counts_time: bool = False
    is_from_rest: bool = False
    is_of_equilibrium: bool = False
    named: Chosen = field(default_factory=dict)
    event: tuple[BoundRelation, ...] = ()
    positive: tuple[Expr, ...] = ()
    is_at_start: bool = False
    is_along_momentum: bool = False

    def notation(self, equations: Equations, chosen: Chosen) -> Notation:
        """The notation of a line, with letters of several meanings read as chosen."""
        known = {symbol.published for symbol in equations.parameters}
        entry = CATALOGUE.get(equations.system.name)
        usual = (symbol(p.name) for p in (entry.parameters if entry else ()) if p.name not in known)
        notation = Notation.of(equations).with_constants(each.latex() for each in usual)
        notation = notation.with_positive((*equations.assumed_positive, *self.positive))
        notation = notation.choosing({**self.named, **chosen}).stating(self.defined)
        notation = notation.measuring(self.measured)
        given = (*notation.given, *self.given, *self.integrated)
        return replace(notation, given=given, small=self.small, start=self.start)

    def to_order(self, order: int | None) -> InForce:
        """With small quantities kept to an order where none was stated for them."""
        if order is None:
            return self
        kept = (s if s.order is not None else replace(s, order=order) for s in self.small)
        return replace(self, small=tuple(kept))

    @property
    def departures(self) -> dict[Symbol, Expr]:
        """Coordinates that are not small, each with the deviation of it that may be: θ - π.

        The same coordinate counted in the other sense is none.
        """
        values = (v for v in self.defined.values() if isinstance(v, Expr))
        return {q: value for value in values for q in _departing(value)}

    def near_motion(self, letters: Collection[Node]) -> InForce:
        """For a line on small departures: at the value that they depart from, they all vanish."""
        small = {s.quantity for s in self.small}
        used = {value for n in letters if isinstance(value := self.defined.get(n), Expr)} & small
        departing = {s for value in used for s in value.symbols()}
        given = (
            r for r in self.given if not (isinstance(r.left, Expr) and r.left.symbol in departing)
        )
        return replace(self, given=tuple(given)) if departing else self

    def defining(self, letters: Mapping[Node, Meaning]) -> InForce:
        """With letters that the text has defined."""
        if not letters:
            return self
        measured = {n: of for n, of in self.measured.items() if n not in letters}
        return replace(self, defined={**self.defined, **letters}, measured=measured)

    def measuring(self, letters: Mapping[Node, Dimension | None]) -> InForce:
        """With letters whose value the text has given as a number."""
        return replace(self, measured={**self.measured, **letters}) if letters else self

    def under(self, relations: tuple[BoundRelation, ...]) -> InForce:
        """With further restrictions."""
        return replace(self, given=(*self.given, *relations))

    def when(self, condition: StatedCondition) -> InForce:
        """With restrictions for the sentence that states them."""
        return replace(self, conditions=(*self.conditions, condition))

    def when_unread(self, latex: str) -> InForce:
        """With a condition of one sentence that could not be read."""
        return replace(self, unread=(*self.unread, latex))

    def in_sentence(self, sentence: str) -> InForce:
        """With the conditions that a sentence states as restrictions, and only these."""
        said = [each for each in self.conditions if each.latex in sentence]
        return replace(
            self.under(tuple(r for each in said for r in each.relations)),
            unread=tuple(latex for latex in self.unread if latex in sentence),
            positive=(*self.positive, *(p for each in said for p in each.positive)),
        )

    def with_numbers(self, *, of_state: bool) -> InForce:
        """With numbers as well that sentences before have given parameters, or also the state.

        Of several for one quantity, the last one counts.
        """
        known = {relation.left for relation in self.given}
        values = {
            relation.left: relation
            for condition in self.conditions
            for relation in condition.relations
            if relation.left not in known
            and is_number(relation.right)
            and (of_state or not varies(relation.left))
        }
        return self.under(tuple(values.values())) if values else self

    def of_another_motion(self) -> InForce:
        """What still stands where a text goes on to another motion, under another bold head."""
        momentary = InForce()
        return replace(
            self,
            given=tuple(r for r in self.given if not varies(r.left)),
            small=momentary.small,
            start=momentary.start,
            conditions=tuple(c for c in self.conditions if not c.is_of_state),
            integrated=momentary.integrated,
            event=momentary.event,
            is_from_rest=False,
            is_at_start=False,
        )

    def starting(self, relations: tuple[BoundRelation, ...]) -> InForce:
        """With further initial values."""
        return replace(self, start=(*self.start, *relations))


@lru_cache(maxsize=512)  # each line asks it of every letter that the text has defined before
def _departing(value: Expr) -> tuple[Symbol, ...]:
    """The coordinates from whose values it is a departure, as θ - π is; none for θ and -θ.

    A combination of several coordinates, such as α + iβ or x₁ + x₂, departs from none.
    """
    if value.symbol is not None or (-value).symbol is not None:
        return ()
    symbols = value.symbols()
    coordinates = [s for s in symbols if s.kind is SymbolKind.COORDINATE and not s.order]
    if len(coordinates) > 1:
        return ()
    return tuple(q for q in coordinates if value.diff(q).rational in (1, -1))


def is_number(side: Side) -> bool:
    """Whether a side is a number other than zero."""
    return isinstance(side, Expr) and bool(side) and {s.name for s in side.symbols()} <= {"pi"}


def varies(side: Side) -> bool:
    """Whether a side may change with time, as every vector may."""
    return not isinstance(side, Expr) or side.varies


def with_small(
    stated: InForce, words: Sequence[tuple[str, int | None]], equations: Equations
) -> InForce:
    """With what words call small, as LaTeX with the order that is kept."""
    known = {small.quantity for small in stated.small}
    known |= {Expr.generator(q) for q in stated.departures}
    notation = stated.notation(equations, {})
    named = [(each, order) for latex, order in words for each in BARS.sub("", latex).split(",")]
    for latex, order in named:
        with suppress(PolhodeError, ArithmeticError):
            quantity = notation.scalar(latex)
            if quantity not in known and quantity.symbols():
                small = Small(quantity, order, quantity.numerator.symbol)
                stated = replace(stated, small=(*stated.small, small))
    return stated


def kept_by_words(
    stated: InForce, words: Sequence[str], equations: Equations
) -> tuple[StatedCondition, ...]:
    """The conditions that words state: "if θ is constant", of coordinates and given motions."""
    found = list[StatedCondition]()
    notation = stated.notation(equations, {})
    for latex in words:
        with suppress(PolhodeError, ArithmeticError):
            symbol = notation.scalar(latex).symbol
            if symbol is not None and symbol.kind in (SymbolKind.COORDINATE, SymbolKind.FUNCTION):
                rate = Expr.generator(symbol.derivative())
                relation = BoundRelation(rate, "=", ZERO, is_lasting=True)
                found.append(StatedCondition(rf"{latex} = \text{{const}}", (relation,), True))
    return tuple(found)


@dataclass(frozen=True)
class Section:
    """A part of a text: the headings above a line, and its label such as "Problem 2 (b)".

    Attributes:
        headings: outermost first.
        label: of the part; empty for none.
        within: label of the part that it belongs to, as (a) belongs to "Problem 2".
        head: bold words that open its paragraph: "Rolling straight."; empty for none.
    """

    headings: tuple[str, ...] = ()
    label: str = ""
    within: str = ""
    head: str = ""

    @property
    def whole(self) -> Section:
        """The part with the paragraphs under all of its bold heads."""
        return replace(self, head="")

    @property
    def name(self) -> str:
        """In words."""
        return self.label or (self.headings[-1] if self.headings else "")

    def holds_for(self, other: Section) -> bool:
        """Whether what is stated in this part stands in another one."""
        if other.headings[: len(self.headings)] != self.headings:
            return False
        mine, its = self.whole, other.whole
        return not self.label or mine == its or mine == replace(its, label=its.within, within="")

    def at(self, relation: SourceRelation, cues: Cues) -> Section:
        """The part of a relation that comes next."""
        if cues.label:
            is_letter = cues.label.startswith("(") and relation.headings == self.headings
            around = self.within if self.label.startswith("(") else self.label
            return Section(relation.headings, cues.label, around if is_letter else "", cues.head)
        same = self if relation.headings == self.headings else Section(relation.headings)
        return replace(same, head=cues.head) if cues.head else same


class Statements:
    """What a text has stated so far, by the part for which it stands.

    Attributes:
        called: what words have called letters so far, which later parts may go on to mean.
        constants: letters of constants of the motion, which another part may use for others.
        printed: relations that the text has stated, as LaTeX, and what is said of one that it
            states again.
    """

    def __init__(self) -> None:
        self.called: dict[Node, str] = {}
        self.constants: dict[Node, Meaning] = {}
        self.printed: dict[str, str] = {}
        self._by_section: dict[Section, InForce] = {}

    def at(self, section: Section) -> InForce:
        """What stands in a part, stated in it or in those around it."""
        found = InForce()
        for where, stated in self._by_section.items():
            if where.holds_for(section):
                if where.head not in ("", section.head):
                    stated = stated.of_another_motion()
                found = InForce(
                    defined={**found.defined, **stated.defined},
                    measured=found.defining(stated.defined).measuring(stated.measured).measured,
                    given=(*found.given, *stated.given),
                    small=(*found.small, *stated.small),
                    start=(*found.start, *stated.start),
                    conditions=(*found.conditions, *stated.conditions),
                    is_steady=found.is_steady or stated.is_steady,
                    unread=(*found.unread, *stated.unread),
                    is_body_fixed=found.is_body_fixed or stated.is_body_fixed,
                    integrated=(*found.integrated, *stated.integrated),
                    counts_time=found.counts_time or stated.counts_time,
                    is_from_rest=found.is_from_rest or stated.is_from_rest,
                    is_of_equilibrium=found.is_of_equilibrium or stated.is_of_equilibrium,
                    named={**found.named, **stated.named},
                    event=stated.event or found.event,
                    positive=(*found.positive, *stated.positive),
                    is_at_start=found.is_at_start or stated.is_at_start,
                    is_along_momentum=found.is_along_momentum or stated.is_along_momentum,
                )
        return found

    @property
    def letters(self) -> dict[Node, Meaning]:
        """The letters defined in any part so far; of several meanings, the last one counts."""
        return {n: m for stated in self._by_section.values() for n, m in stated.defined.items()}

    @property
    def measured(self) -> dict[Node, Dimension | None]:
        """Those whose value is a number, in any part so far."""
        return {n: of for stated in self._by_section.values() for n, of in stated.measured.items()}

    def own(self, section: Section) -> InForce:
        """What was stated in the part itself."""
        return self._by_section.get(section, InForce())

    def state(self, section: Section, stated: InForce) -> None:
        """Replace what was stated in a part."""
        self._by_section[section] = stated

"""What a line states for those after it: letters, restrictions, small quantities, a start."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace

from polhode.algebra import ZERO, Expr, is_positive
from polhode.base import Dimension
from polhode.derive import Equations
from polhode.judge._dimensions import dimension_of_number
from polhode.judge._verdict import Answer
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import Name, Node, Piece, UnitSymbol, walk
from polhode.judge.lines._judge_line import judged_line
from polhode.judge.lines._judged_line import JudgedLine, differs_by_a_constant, vanishes_at_rest
from polhode.judge.lines._own_letters import (
    constant_speed,
    defined_or_wrong,
    deviation,
    introduced,
    letter_by_equation,
    letter_for_speed,
    letter_of_its_own,
    named_by_equation,
    other_sense,
)
from polhode.judge.lines._restrictions import chosen_values, held, ordered, restricts
from polhode.judge.lines._starts import begins, started, starting, with_initial_values
from polhode.judge.lines._stated_small import (
    departing,
    neighbourhood,
    other_components,
    taken_as_small,
)
from polhode.judge.lines._weaker_meanings import speaks_of_start
from polhode.judge.meaning._bindings import Bound
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.meaning._mechanics import is_acceleration
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import EQUALITY, SENSE
from polhode.judge.text._cues import CASE, Role
from polhode.judge.text._in_force import InForce, StatedCondition, is_number, varies, with_small
from polhode.judge.text._state_words import StateKind
from polhode.judge.text._text_line import TIME_LETTER

_HENCE = Role.CONSEQUENCE
_OPENS_CONDITION = re.compile(
    r"\b(?:when|whenever|where|if|once|as soon as|provided(?: that)?)\s*,?\s*\Z", re.I
)
#: Words behind a relation that limit it: "(λ < 0) as long as".
_LIMITED = re.compile(
    r"[\s$)\]\\,]*(?:(?:so|as) long as|if|when(?:ever)?|while|until|provided|for)\b", re.I
)
#: Words that name the motions on the border between others, which a line then describes.
_ON_SEPARATRIX = re.compile(r"\b(?:on|along|for|of) (?:the|each|this) separatri", re.I)
_CONDITION = "a condition, met by some motions and not by others"
_OPEN_VALUE = "a value that depends on more than the text has given numbers for here"


def stated_by(judged: JudgedLine, own: InForce, equations: Equations) -> tuple[JudgedLine, InForce]:
    """The line, said to be stated rather than claimed where it is, and what its part states now."""
    before = own.defined
    said, own = _stated(judged, own, equations)
    new = {n for n, value in own.defined.items() if before.get(n) != value}
    own = own.measuring(_measured(judged, new))
    own = replace(own, event=judged.event or own.event)
    known = {**judged.line.in_force.defined, **own.defined}
    letters = [known[name] for name in judged.line.letters if name in known]
    departs = judged.line.cues.departs
    if not departs and judged.line.cues.is_linear:
        departures = judged.line.in_force.defining(own.defined).departures.values()
        letters = [value for value in letters if value in departures]
        departs = True
    if said.stated and letters and departs:
        return said, departing(judged, own, letters)
    stated = judged.line.in_force.defining(own.defined)
    small = with_small(stated, judged.line.cues.small, equations).small
    others = other_components(judged) if judged.line.cues.are_others_small else ()
    every = dict.fromkeys((*own.small, *small, *others))
    departed = {Expr.generator(q) for q in own.departures}
    return said, replace(own, small=tuple(s for s in every if s.quantity not in departed))


def _measured(judged: JudgedLine, letters: AbstractSet[Node]) -> dict[Node, Dimension | None]:
    """Of letters that a line defines, those whose value is a number, with its dimension if known.

    So is what the text calculates from other numbers: h = s sin α with s = 2.4 m.
    """
    notation = judged.judgement.notation
    found: dict[Node, Dimension | None] = {}
    if notation is None:
        return found
    for relation in judged.line.statement.relations:
        for letter in letters & set(relation.sides):
            others = [side for side in relation.sides if side != letter]
            pieces = [set(walk(side)) for side in others]
            if any(_is_of_numbers(side, judged.line.in_force.measured) for side in pieces):
                known = (dimension_of_number(notation, side) for side in others)
                found[letter] = next((of for of in known if of is not None), None)
    return found


def _is_of_numbers(pieces: AbstractSet[Piece], measured: Collection[Node]) -> bool:
    """Whether a side with these pieces is, or contains, a number with or without its unit."""
    names = {p for p in pieces if isinstance(p, Name)}
    return (
        not names
        or not names.isdisjoint(measured)
        or any(isinstance(p, UnitSymbol) for p in pieces)
    )


def _stated(judged: JudgedLine, own: InForce, equations: Equations) -> tuple[JudgedLine, InForce]:
    cues = judged.line.cues
    if cues.role is Role.EXCEPTION:
        return replace(judged, stated="an exception: the text speaks of all other cases"), own
    own = replace(
        own,
        is_steady=own.is_steady or cues.is_steady,
        is_of_equilibrium=own.is_of_equilibrium or cues.is_of_equilibrium,
        is_body_fixed=own.is_body_fixed or cues.is_body_fixed,
        counts_time=own.counts_time or cues.counts_time,
        is_at_start=own.is_at_start or speaks_of_start(judged.line),
    )
    if (small := taken_as_small(judged, own, equations)) is not None:
        return small
    return _stated_by_formula(judged, own, equations)


def _stated_by_formula(
    judged: JudgedLine, own: InForce, equations: Equations
) -> tuple[JudgedLine, InForce]:
    bound, answer = judged.bound, judged.verdict.answer
    if (begun := with_initial_values(judged, own, equations)) is not None:
        return replace(judged, stated="an initial value"), begun
    if answer is Answer.AMBIGUOUS and not judged.verdict.option:
        return judged, own  # a slash with two readings
    if new := _letters_of_undecided(judged, equations):
        return _defining(judged, new, equations), own.defining(new)
    if new := defined_or_wrong(judged, equations):
        return judged, own.defining(new)
    departs = bound is not None and deviation(judged, equations) is not None
    if bound is None or departs or ZERO in bound.defined.values():
        return _without_meaning(judged, own, equations)
    own = own.defining(_defined_for_sure(judged, bound))
    if answer is Answer.DEFINITION:
        names = ", ".join(spelled(letter) for letter in bound.defined)
        return replace(judged, stated=f"defines {names}"), own
    if answer is Answer.HOLDS and (again := _stated_again(judged)):
        return replace(judged, stated=again), own
    if _is_unequal(judged) and not judged.verdict.holds:
        role = judged.line.cues.role
        are_equal = answer is Answer.FAILS and role in (Role.CLAIM, _HENCE)
        return replace(judged, stated="" if are_equal else _CONDITION), own
    is_claimed = _is_claimed(judged, bound, equations)
    return (judged, own) if is_claimed else _not_claimed(judged, own, bound, equations)


def _is_claimed(judged: JudgedLine, bound: Bound, equations: Equations) -> bool:
    """Whether what was found of a line settles it, whatever the text means by it.

    A failing threshold is one that the sentence says to be the condition of stability, and what
    fails at an instant of a motion from a start is determined by that start. Beside an angle of 5°,
    of which only numbers are decided, a value is undecided, but stated.
    """
    match judged.verdict.answer:
        case Answer.FAILS:
            return judged.verdict.context in ("threshold", "launch")
        case Answer.UNREAD:
            return not restricts(bound.relations, equations, is_assumed=False)
    return True


def _defined_for_sure(judged: JudgedLine, bound: Bound) -> Mapping[Node, Meaning]:
    """The letters that a line defines; of a wrong one, not those that may mean something else."""
    ways = judged.verdict.by_reading
    if judged.verdict.answer is not Answer.FAILS or len(ways) < 2:
        return bound.defined
    open_letters = {letter for way in ways for letter in way.chosen}
    return {n: meaning for n, meaning in bound.defined.items() if n not in open_letters}


def _of_time(judged: JudgedLine) -> str:
    """What a line says of the time only: when an instant is, or from when it is counted."""
    relation, bound = judged.line.relation.relation, judged.bound
    values = [r.right for r in bound.relations] if bound is not None else []
    if relation is not None and relation.sides[0] == TIME_LETTER and not any(map(varies, values)):
        return "an instant of the motion"
    counts_time = judged.line.cues.counts_time or judged.line.in_force.counts_time
    if TIME_LETTER in judged.line.letters and counts_time:
        return "a choice: time is counted from an instant of its own"
    return ""


def _letters_of_undecided(judged: JudgedLine, equations: Equations) -> Mapping[Node, Meaning]:
    """The letters that a line which is ambiguous or unread introduces: Ω in ω₂ ≈ Ω."""
    match judged.verdict.answer:
        case Answer.AMBIGUOUS:
            if named := _speed_named(judged, equations):
                return named
            new = introduced(judged, equations)
            return {letter: new[letter] for letter in new if _may_define(letter, judged)}
        case Answer.UNREAD:
            new = letter_for_speed(judged, equations) or letter_of_its_own(judged, equations)
            new = new or named_by_equation(judged, equations)
            return new or (introduced(judged, equations) if judged.line.cues.introduces else {})
    return {}


def _may_define(letter: Node, judged: JudgedLine) -> bool:
    """Whether the readings of a line differ by the meaning of a letter, or one defines letters.

    Where they differ by another letter only, all of them say what this one is.
    """
    ways = judged.verdict.by_reading
    meanings = {read.meaning if (read := way.chosen.get(letter)) else "" for way in ways}
    return len(meanings) > 1 or any(way.verdict.answer is Answer.DEFINITION for way in ways)


def _speed_named(judged: JudgedLine, equations: Equations) -> Mapping[Node, Meaning]:
    """A letter that an ambiguous line either defines as a speed or is wrong about, as Ω = φ'."""
    answers = {way.verdict.answer for way in judged.verdict.by_reading}
    if answers != {Answer.DEFINITION, Answer.FAILS}:
        return {}
    return letter_for_speed(judged, equations)


def _not_claimed(
    judged: JudgedLine, own: InForce, bound: Bound, equations: Equations
) -> tuple[JudgedLine, InForce]:
    """A line that does not hold, but that the text may state rather than claim."""
    cues = judged.line.cues
    if of_time := _of_time(judged):
        return replace(judged, stated=of_time), own
    if (chosen := _own_letter(judged, own, equations)) is not None:
        return chosen
    is_plain = all(r.right == ZERO or is_number(r.right) for r in bound.relations)  # in SI units
    is_plain = is_plain and not judged.line.prints_a_unit
    has_wrong_unit = not is_plain and bool(judged.verdict.at_odds)
    is_assumed = cues.role is Role.ASSUMPTION
    values = chosen_values(judged, bound, equations)
    if values and not has_wrong_unit:
        return _restricted(judged, own, values)
    if judged.is_open_value and not has_wrong_unit:
        return replace(judged, stated=_OPEN_VALUE), own
    sides = (side for relation in bound.relations for side in (relation.left, relation.right))
    is_let = cues.introduces and not any(map(varies, sides))  # "Let RΩ² = 2g"
    is_let = is_let and not _is_met_nowhere(judged)
    is_chosen = is_assumed or is_let or _ON_SEPARATRIX.search(cues.words_before) is not None
    is_chosen = is_chosen or (cues.is_at_rest and vanishes_at_rest(judged, equations))
    if is_chosen and _stays_true(judged, bound, equations):
        said = "an assumption: it chooses among the motions by a conserved quantity"
        return replace(judged, stated=said, is_assumed=True), own.under(bound.relations)
    if _is_case(judged) and differs_by_a_constant(judged.line, equations):
        said = "a condition: it chooses among the motions by a conserved quantity"
        case = StatedCondition(judged.line.relation.latex, bound.relations)
        return replace(judged, stated=said), own.when(case)
    if cues.integrates and differs_by_a_constant(judged.line, equations):
        said = "an assumption: a constant of integration is zero"
        exact = (replace(relation, sign="=") for relation in bound.relations)
        own = replace(own, integrated=(*own.integrated, *exact))
        return replace(judged, stated=said), own
    if (compared := _compared(judged, own, bound)) is not None:
        return compared
    is_condition = _is_case(judged) or _OPENS_CONDITION.search(cues.words_before)
    if is_condition and not _is_met_nowhere(judged):
        return replace(judged, stated=_CONDITION), own.when_unread(judged.line.relation.latex)
    return judged, own


def _is_met_nowhere(judged: JudgedLine) -> bool:
    """Whether no body and no motion meets it, as I = ma²/2 of a ball, whose factor is 2/5."""
    components = judged.claim.components() if judged.claim is not None else []
    differences = [c.difference for c in components if not c.difference.varies]
    return any(is_positive(d) or is_positive(-d) for d in differences)


def _compared(judged: JudgedLine, own: InForce, bound: Bound) -> tuple[JudgedLine, InForce] | None:
    """An inequality that chooses among bodies or motions; None for any other line.

    An order of parameters stands for the lines after it, or for its sentence if it is a condition.
    """
    orders_bodies = not any(varies(s) for r in bound.relations for s in (r.left, r.right))
    role, relation = judged.line.cues.role, judged.line.relation
    is_hence = role is _HENCE and not _LIMITED.match(relation.after)
    if not any(r.sign in SENSE for r in bound.relations) or (is_hence and not orders_bodies):
        return None
    judged, positive = replace(judged, stated=_CONDITION), ordered(bound.relations)
    if not orders_bodies or role is _HENCE:
        return judged, own
    if role is not Role.CONDITION:
        return judged, replace(own, positive=(*own.positive, *positive))
    return judged, own.when(StatedCondition(relation.latex, (), positive=positive))


def _own_letter(
    judged: JudgedLine, own: InForce, equations: Equations
) -> tuple[JudgedLine, InForce] | None:
    """A line that gives a letter a meaning of its own, or another sense; None for any other."""
    new = letter_of_its_own(judged, equations) or letter_for_speed(judged, equations)
    if new:
        return _defining(judged, new, equations), own.defining(new)
    for sense in other_sense(judged, equations):
        again = _again(judged, sense, equations)
        if again.verdict.holds:
            letter = spelled(*sense)
            said = f"a choice of sign: it holds if {letter} is positive in the sense opposite to "
            said += "that of the model, and is taken so from here on"
            return replace(again, stated=said, is_assumed=True), own.defining(sense)
    return None


def _defining(
    judged: JudgedLine, letters: Mapping[Node, Meaning], equations: Equations
) -> JudgedLine:
    """A line that defines a letter; what a chain says after that is a claim."""
    if len(judged.line.statement.relations[0].sides) > 2:
        return _again(judged, letters, equations)
    return replace(judged, stated=f"defines {spelled(*letters)}")


def _again(judged: JudgedLine, letters: Mapping[Node, Meaning], equations: Equations) -> JudgedLine:
    """The line with letters as it defines them."""
    stated = judged.line.in_force.defining(letters)
    return judged_line(replace(judged.line, in_force=stated), equations, {})


def _stays_true(judged: JudgedLine, bound: Bound, equations: Equations) -> bool:
    """Whether an equation holds along the whole motion once it holds."""
    line, notation = judged.line, judged.judgement.notation
    chosen = notation.vocabulary.chosen if notation is not None else {}
    if differs_by_a_constant(line, equations, chosen):
        return True
    sides = (s for r in bound.relations for s in (r.left, r.right) if isinstance(s, Expr))
    if any(is_acceleration(symbol) for side in sides for symbol in side.symbols()):
        return False
    holding = replace(line, in_force=line.in_force.under(bound.relations))
    upper = line.latex.replace(r"\pm", "+").replace(r"\mp", "-")  # the sign that was bound
    return differs_by_a_constant(holding, equations, chosen, upper)


def _is_case(judged: JudgedLine) -> bool:
    """Whether the words right before it make it a case, as "at η = A" does within a sentence."""
    line = judged.line
    if line.cues.role is not Role.CONDITION or line.relation.is_display:
        return False
    return CASE.search(line.cues.words_before) is not None or _stands_still(judged)


def _stands_still(judged: JudgedLine) -> bool:
    """Whether it sets rates to zero, of any order, as "for circular motion r'' = 0" does."""
    members = judged.claim.members if judged.claim is not None else ()
    sides = [(m.left, m.right) for m in members]
    return bool(sides) and all(
        isinstance(left, Expr) and left.symbol is not None and left.symbol.order and right == ZERO
        for left, right in sides
    )


def _stated_again(judged: JudgedLine) -> str:
    """That a line says once more what the text has stated; empty for any other line."""
    stated, relation = judged.line.in_force, judged.line.relation.relation
    if relation is None or judged.line.cues.role is _HENCE:
        return ""
    if judged.line.cues.introduces and relation.sides[0] in stated.defined:
        return f"defines {spelled(relation.sides[0])} once more"
    # Of θ = const, θ̇ = 0 is a consequence.
    said = [r for r in (*stated.start, *stated.given) if not r.is_lasting]
    known = {d for r in said for d in _differences(r)}
    bound = judged.bound
    relations = bound.relations if bound is not None else ()
    is_known = bool(relations) and all(not known.isdisjoint(_differences(r)) for r in relations)
    return "it repeats what the text has stated" if is_known else ""


def _differences(relation: BoundRelation) -> tuple[Expr, ...]:
    """Left minus right of an equation, and the reverse; nothing for any other relation."""
    left, right = relation.left, relation.right
    if not (isinstance(left, Expr) and isinstance(right, Expr) and relation.sign in EQUALITY):
        return ()
    return left - right, right - left


def _is_unequal(judged: JudgedLine) -> bool:
    relation = judged.line.relation.relation
    return relation is not None and set(relation.signs) == {"≠"}


def _restricted(
    judged: JudgedLine, own: InForce, relations: tuple[BoundRelation, ...]
) -> tuple[JudgedLine, InForce]:
    """A line that chooses among the motions, unless it says that it is drawn from others."""
    cues, relation = judged.line.cues, judged.line.relation
    if cues.role is _HENCE and relation.is_display:
        return replace(judged, stated=_OPEN_VALUE if judged.is_open_value else ""), own
    if cues.is_launch:
        return replace(judged, stated="an initial value"), started(relations, own, cues)
    is_of_place = cues.state is not None and cues.state.kind in (
        StateKind.LOWEST,
        StateKind.HIGHEST,
    )
    is_case = cues.role is Role.ASSUMPTION or CASE.search(cues.words_before)
    if is_of_place and judged.line.in_force.start and not is_case:
        return judged, own  # the motion from the start has one rate there
    judged = replace(judged, stated="an assumption: it chooses among the motions, or the bodies")
    if centre := neighbourhood(cues, relations):
        return judged, replace(own, small=(*own.small, *centre))
    is_general = cues.role is Role.ASSUMPTION or (cues.role is Role.DEFINITION and cues.introduces)
    if cues.role is not Role.CONDITION and (driven := held(relations)):
        relations, is_general = (*relations, *driven), True
    # "Equilibria: θ = 0" says where they are, and not that the body stays there.
    is_chosen = cues.role in (Role.CLAIM, Role.DEFINITION) and not cues.is_of_equilibrium
    if is_general or (relation.is_display and is_chosen):
        return judged, own.under(relations)
    return judged, own.when(StatedCondition(relation.latex, relations, is_chosen))


def _without_meaning(
    judged: JudgedLine, own: InForce, equations: Equations
) -> tuple[JudgedLine, InForce]:
    """A line that could not be bound: it may define a deviation, as θ = π/2 + ε does."""
    new = deviation(judged, equations)
    if judged.bound is not None and new is None:
        # Zero for a letter, with which any linear equation would hold.
        return replace(judged, stated="the value of a letter that the model does not have"), own
    is_of_start = begins(judged.line.cues)
    if known := constant_speed(judged, equations):
        if is_of_start:
            return replace(judged, stated="an initial value"), starting(
                known, own, judged.line.cues
            )
        return replace(judged, stated=f"defines {spelled(*known)}"), own.defining(known)
    if new is not None:
        letter = next(iter(new))
        if is_of_start and new[letter].symbol in equations.coordinates:
            return replace(judged, stated="an initial value"), starting(new, own, judged.line.cues)
        return replace(judged, stated=f"defines {spelled(letter)}"), own.defining(new)
    role, is_display = judged.line.cues.role, judged.line.relation.is_display
    is_case = CASE.search(judged.line.cues.words_before) is not None
    is_claim = role is not Role.ASSUMPTION and not is_case
    if is_claim and (own_letter := letter_by_equation(judged, equations)):
        said = f"defines {spelled(*own_letter)}"
        return replace(judged, stated=said), own.defining(own_letter)
    is_condition = role is Role.ASSUMPTION or (
        role is Role.CONDITION and (is_case or not is_display)
    )
    if is_condition or _is_of_coordinate(judged, equations):
        return judged, own.when_unread(judged.line.relation.latex)
    return judged, own


def _is_of_coordinate(judged: JudgedLine, equations: Equations) -> bool:
    """Whether it is an inline value of a coordinate, such as θ = 90°, in a unit not read."""
    relation = judged.line.relation
    if relation.is_display or relation.relation is None:
        return False
    coordinates = {name_of(q.published) for q in equations.coordinates}
    return relation.relation.sides[0] in coordinates

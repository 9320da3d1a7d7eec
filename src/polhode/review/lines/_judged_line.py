"""One line judged: in the strongest context in which it holds, under what the text has stated."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import product
from math import prod

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, as_symbol
from polhode.base import LENGTH, PURE, TIME, NumericError, PolhodeError
from polhode.claims import Answer, Bound, BoundRelation, Notation, Verdict, read_latex, write_latex
from polhode.claims.building_blocks import (
    EQUALITY,
    FROM_BODY,
    BoundClaim,
    Derivative,
    Dots,
    Meaning,
    Name,
    Node,
    Number,
    OpenVerdict,
    SimpleCondition,
    Small,
    TrueMotion,
    follows_from_invariants,
    holds,
    judgement,
    name_of,
    on_constraints,
    restrictions,
    walk,
)
from polhode.derive import Equations
from polhode.model import Coulomb
from polhode.review.lines._near_steady import under_steady_momenta
from polhode.review.lines._taken_for_granted import conditions
from polhode.review.lines._weaker_meanings import (
    is_at_end_of_contact,
    says_that_it_vanishes,
    weaker_meanings,
)
from polhode.review.text._cues import Role
from polhode.review.text._in_force import Chosen, InForce, is_number, varies
from polhode.review.text._text_line import TIME_LETTER, TextLine, essential_coordinates

_RATE = PURE / TIME  # of turning
_EQUATING = (*EQUALITY, "≈")
#: Words right before a letter that stands for a period or a frequency of small oscillations.
_CALLED = re.compile(r"\b(period|frequency)(?: of (?:the )?small oscillations)?(?: is)?\W*\Z", re.I)
#: On the earth, m/s², as texts round it.
_GRAVITY = (Fraction("9.81"), Fraction("9.8"), Fraction(10))


@dataclass(frozen=True)
class JudgedLine:
    """A line with the judgement on it.

    Attributes:
        line: what was judged.
        judgement: in the context in which it holds, or else on every true motion.
        needs: a simple condition, not stated by the text, under which it holds.
        stated: what it is where it is stated rather than claimed: "defines k", "an assumption".
        is_assumed: whether it is an equation that lines after it may be drawn from.
        defines: letters to which it gives a meaning.
        is_open_value: whether it gives a number that depends on what the text has not stated.
        event: restrictions for the instant that it says a contact to end at.
    """

    line: TextLine
    judgement: OpenVerdict
    needs: str = ""
    stated: str = ""
    is_assumed: bool = False
    defines: Mapping[Node, Meaning] = field(default_factory=dict)
    is_open_value: bool = False
    event: tuple[BoundRelation, ...] = ()

    @property
    def verdict(self) -> Verdict:
        """Without a correction."""
        return self.judgement.verdict

    @cached_property
    def bound(self) -> Bound | None:
        """Its statement with a meaning for every letter, in the reading kept; None without one."""
        notation = self.judgement.notation
        try:
            return None if notation is None else notation.bound(self.line.statement)
        except (PolhodeError, ZeroDivisionError):
            return None

    @cached_property
    def claim(self) -> BoundClaim | None:
        """The claim that it makes, in the reading that was kept; None where it makes none."""
        notation, bound = self.judgement.notation, self.bound
        try:
            return None if notation is None or bound is None else notation.claimed(bound)
        except (PolhodeError, ZeroDivisionError):
            return None


def judged_line(line: TextLine, equations: Equations, chosen: Chosen) -> JudgedLine:
    """The judgement on a line, with letters of several meanings read as chosen."""
    found = _started(line, _seen_from_body(in_context(line, equations, chosen, "motion")))
    if found.verdict.answer is Answer.HOLDS:
        return _as_identity(JudgedLine(line, found))
    if said := _meant_by_words(line, found.verdict):
        return judged_line(line, equations, {**chosen, **said})
    if found.verdict.answer in (Answer.AMBIGUOUS, Answer.DEFINITION, Answer.APPROXIMATE):
        return _called_wrongly(line, found, equations) or JudgedLine(line, found)
    if is_equilibrium(line, found, equations):
        holds = Verdict(Answer.HOLDS, "steady", readings=found.verdict.readings)
        return JudgedLine(line, replace(found, verdict=holds, corrected=None))
    is_value = _gives_a_value(line, found)
    if (weaker := _in_weaker_meaning(line, equations, chosen, is_value)) is not None:
        return weaker
    if is_value:  # the state that a sentence before has given may be meant no more
        others = with_all_numbers(line, equations, chosen)
        right = next((other for other in others if other.verdict.holds), None)
        return right or JudgedLine(line, found, is_open_value=True)
    if (wrong := _fails_in_limit(line, found, equations, chosen)) is not None:
        return wrong
    why = _unread(line, found, equations)
    if found.verdict.answer is Answer.FAILS and why:
        return JudgedLine(
            line, OpenVerdict(replace(found.verdict, answer=Answer.UNREAD, reason=why))
        )
    return JudgedLine(line, found, _unstated(line, found, equations, chosen))


def with_all_numbers(line: TextLine, equations: Equations, chosen: Chosen) -> list[JudgedLine]:
    """A line judged with every number that the text has given, and with each usual value of g."""
    meant = replace(line, in_force=line.in_force.with_numbers(of_state=True))
    return [
        JudgedLine(each, in_context(each, equations, chosen, "number"))
        for each in (meant, *_with_gravity(meant, equations))
    ]


def _with_gravity(line: TextLine, equations: Equations) -> Iterator[TextLine]:
    """The line with each usual value of g, of a text that gives other numbers but not this one."""
    g = next((s for s in equations.parameters if s.published == "g"), None)
    given = {relation.left for relation in line.in_force.given}
    gives_it = name_of("g") in line.statement.relations[0].sides
    if g is None or gives_it or equations.dimensions.get(g) != LENGTH / TIME**2:
        return
    for value in _GRAVITY if Expr.generator(g) not in given else ():
        relation = BoundRelation(Expr.generator(g), "=", Expr.of(value))
        said = f"with g = {float(value):g}"
        yield replace(line, in_force=line.in_force.under((relation,)), read_as=said)


def _in_weaker_meaning(
    line: TextLine, equations: Equations, chosen: Chosen, is_value: bool
) -> JudgedLine | None:
    """The judgement in the first weaker context that decides it.

    One in which it holds from a start in some reading of its letters only comes after all others.
    """
    open_readings: JudgedLine | None = None
    for meant, context in weaker_meanings(line, equations):
        found = in_context(meant, equations, chosen, context)
        if said := _meant_by_words(meant, found.verdict) or _only_read(found.verdict):
            found = in_context(meant, equations, {**chosen, **said}, context)
        other = JudgedLine(meant, _started(meant, found))
        if other.verdict.holds and _speaks_of_rates(other, line, context, equations):
            continue
        if other.verdict.holds and says_something(other, context, equations):
            is_meant = context != "steady" or line.says_that_it_is_steady
            return other if is_meant else replace(other, needs="equilibrium")
        if context == "launch" and other.verdict.answer is Answer.AMBIGUOUS:
            open_readings = other
        if sign := _sign_needed(other.verdict):
            return replace(other, needs=sign)
        if other.verdict.answer is Answer.FAILS and (
            (context == "number" and is_value) or _is_at_an_event(meant, context)
        ):
            return other
    return open_readings or _to_leading_order(line, equations, chosen)


def for_positive_speeds(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A line that holds in a limit where the speeds in it are positive, as v = aω of a disk does.

    The root of which v is short has no series there while their sign is open.
    """
    line, is_claim = judged.line, not (judged.stated or judged.needs)
    speeds = [Expr.generator(s) for s in equations.speeds if name_of(s.published) in line.letters]
    if not (is_claim and speeds and judged.verdict.answer is Answer.FAILS):
        return judged
    for meant, context in weaker_meanings(line, equations):
        stated = replace(meant.in_force, positive=(*meant.in_force.positive, *speeds))
        if context == "limit":
            found = in_context(replace(meant, in_force=stated), equations, {}, context)
            if found.verdict.holds:
                said = " and ".join(f"{s.latex()} > 0" for s in speeds)
                return replace(judged, line=meant, judgement=found, needs=said)
    return judged


def _speaks_of_rates(
    judged: JudgedLine, line: TextLine, context: str, equations: Equations
) -> bool:
    """Whether a line that holds at rest, where any factor of a rate is right, speaks of motion.

    Members that print a rate have to hold on every motion, unless one side is a rate or zero.
    """
    at_rest, claim = _vanishing(judged.line, context, equations), judged.claim
    if context != "motion" or claim is None or judged.line.in_force == line.in_force:
        return False
    stated = {r.left for r in line.in_force.given}
    given = {s: v for s, v in claim.given.items() if v or Expr.generator(s) in stated}
    general = replace(claim, given=given)
    printed = {
        c.member
        for c in claim.components()
        if at_rest & c.difference.symbols()
        and not any(side.symbol in at_rest or not side for side in (c.left, c.right))
    }
    return bool(printed) and not holds(general.only(printed), context)


def _to_leading_order(line: TextLine, equations: Equations, chosen: Chosen) -> JudgedLine | None:
    """An equation that holds to leading order in what its own sentence calls small."""
    signs = line.relation.relation.signs if line.relation.relation is not None else ()
    if signs != ("=",) or not line.cues.small_here:
        return None
    for near in (line.in_force, *under_steady_momenta(line.in_force, equations)):
        meant = replace(line, in_force=near)
        found = in_context(meant, equations, chosen, "limit", _as_approximate(line))
        if found.verdict.holds:
            return JudgedLine(meant, found)
    return None


def _fails_in_limit(
    line: TextLine, found: OpenVerdict, equations: Equations, chosen: Chosen
) -> JudgedLine | None:
    """An approximation that fails to the order of what its own sentence calls small."""
    relation, cues = line.relation.relation, line.cues
    is_said = cues.is_linear or bool(cues.small_in_sentence)
    is_close = relation is not None and relation.signs == ("≈",)
    if not (is_said and is_close and found.verdict.answer is Answer.UNREAD):
        return None
    limits = (meant for meant, context in weaker_meanings(line, equations) if context == "limit")
    for meant in limits:
        other = in_context(meant, equations, chosen, "limit")
        if other.verdict.answer is Answer.FAILS:
            return JudgedLine(meant, other)
    return None


def _as_approximate(line: TextLine) -> str:
    return line.latex.replace("=", r"\approx ")


def _started(line: TextLine, found: OpenVerdict) -> OpenVerdict:
    """The judgement, where what it leaves open is a start from rest or the axis of the text."""
    if line.in_force.is_along_momentum and _is_open_for_axis(found.verdict):
        said = "it holds, as the z axis is along the angular momentum"
        return replace(found, verdict=replace(found.verdict, answer=Answer.HOLDS, reason=said))
    verdict, is_from_rest = found.verdict, line.in_force.is_from_rest or line.cues.is_at_rest
    still = {r.left for r in line.in_force.start if r.right == ZERO}
    is_said = is_from_rest or still.issuperset(map(Expr.generator, verdict.resting))
    if not (is_said and verdict.resting):
        return found
    rates = " and ".join(f"{rate.published} = 0" for rate in verdict.resting)
    said = f"holds if the motion starts with {rates}"
    return replace(found, verdict=replace(verdict, answer=Answer.HOLDS, reason=said))


def _seen_from_body(found: OpenVerdict) -> OpenVerdict:
    """The judgement, where a rate beside ω × **L** may be taken in space or seen from the body.

    It is seen from the body: so Euler's equations are written.
    """
    ways = [
        way.verdict
        for way in found.verdict.by_reading
        if any(read.meaning == FROM_BODY for read in way.chosen.values())
    ]
    is_open = found.verdict.answer is Answer.AMBIGUOUS and len(ways) == 1
    return replace(found, verdict=ways[0]) if is_open else found


def _is_open_for_axis(verdict: Verdict) -> bool:
    """Whether a line, in one reading, holds only with the z axis along the angular momentum."""
    ways = [way.verdict for way in verdict.by_reading] or [verdict]
    return verdict.answer is Answer.AMBIGUOUS and any(
        way.answer is Answer.AMBIGUOUS and way.option == "given" and not way.resting for way in ways
    )


def _meant_by_words(line: TextLine, verdict: Verdict) -> dict[Node, str]:
    """The meanings that words near an ambiguous line choose for letters: "about the end"."""
    found: dict[Node, str] = {}
    if verdict.answer is not Answer.AMBIGUOUS:
        return found
    read = [pair for way in verdict.by_reading for pair in way.chosen.items()]
    for letter in dict.fromkeys(node for node, _ in read):
        meanings = dict.fromkeys(reading.meaning for node, reading in read if node == letter)
        for pattern in line.cues.meant:
            said = [meaning for meaning in meanings if re.search(pattern, meaning)]
            if len(said) == 1 and len(meanings) > 1:
                found[letter] = said[0]
    return found


def _called_wrongly(line: TextLine, found: OpenVerdict, equations: Equations) -> JudgedLine | None:
    """A definition of what words call the period or frequency, where the system's own differs."""
    letter = line.statement.relations[0].sides[0]
    called = _CALLED.search(line.cues.words_before)
    if found.verdict.answer is not Answer.DEFINITION or called is None:
        return None
    chosen = {letter: f"{called[1].lower()} of small oscillations"}
    other = JudgedLine(line, in_context(line, equations, chosen, "motion"))
    return other if other.verdict.answer is Answer.FAILS else None


def _only_read(verdict: Verdict) -> dict[Node, str]:
    """The meanings of letters with which alone a line can be read."""
    ways = [way for way in verdict.by_reading if way.verdict.answer is not Answer.UNREAD]
    if verdict.answer is not Answer.AMBIGUOUS or len(ways) != 1:
        return {}
    return {letter: reading.meaning for letter, reading in ways[0].chosen.items()}


def is_equilibrium(line: TextLine, found: OpenVerdict, equations: Equations) -> bool:
    """Whether a line gives one of several equilibria: whatever obeys it at rest stays at rest.

    That every equilibrium is of this kind it does not say: "sin θ = 0 or cos θ = g/(ω²R)".
    """
    claim = JudgedLine(line, found).claim if line.cues.is_one_of_several else None
    if claim is None or any(member.sign != "=" for member in claim.members):
        return False
    speeds = vanishing_in_steady_motion(equations) & frozenset(equations.speeds)
    rest = tuple(BoundRelation(Expr.generator(s), "=", ZERO) for s in speeds)
    at_rest = replace(line, in_force=line.in_force.under((*claim.members, *rest)))
    accelerations = (Expr.generator(s).latex() for s in equations.acceleration_symbols)
    still = (in_context(at_rest, equations, {}, "motion", f"{a} = 0") for a in accelerations)
    return all(found.verdict.holds for found in still)


def _gives_a_value(line: TextLine, found: OpenVerdict) -> bool:
    """Whether a line that fails gives a number for what has a dimension, or varies.

    Beside an angle of 5°, whose sine is no root, it is undecided but for its number.
    """
    claim = JudgedLine(line, found).claim
    if claim is None or found.verdict.answer not in (Answer.FAILS, Answer.UNREAD):
        return False
    values = [c.left for c in claim.components() if is_number(c.right)]
    is_physical = line.prints_a_unit or bool(found.verdict.at_odds)
    return any(is_physical or v.varies for v in values)


def _is_at_an_event(line: TextLine, context: str) -> bool:
    """Whether a line is a claim about the instant at which a motion reaches a state, as θ = π/2."""
    is_claimed = line.cues.role in (Role.CLAIM, Role.CONSEQUENCE)
    reached = (varies(r.left) for r in line.in_force.given)
    return context == "launch" and is_claimed and any(reached)


def says_something(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds in a context says more than that nothing happens there.

    From (almost) rest in equilibrium, what is conserved keeps the value that it has there.
    """
    if context == "steady" and _is_equation_of_motion(judged, equations):
        return False
    if not _is_empty(judged, context, equations):
        return True
    claim = judged.claim
    return context == "launch" and (
        differs_by_a_constant(judged.line, equations)
        or (claim is not None and follows_from_invariants(claim))
    )


def _is_equation_of_motion(judged: JudgedLine, equations: Equations) -> bool:
    """Whether a line prints what vanishes in steady motion, and does not set it to zero.

    Of steady motion I d²θ/dt² = 2M would be true, as M is zero there, but it does not speak of it.
    """
    notation = judged.judgement.notation
    if notation is None:
        return False
    vanishing = vanishing_in_steady_motion(equations)
    for relation in judged.line.statement.relations:
        if Number("0") in relation.sides:
            continue
        for piece in walk(relation):
            with suppress(PolhodeError, ArithmeticError):
                value = notation.value(piece) if isinstance(piece, Dots | Derivative) else None
                if isinstance(value, Expr) and value.symbol in vanishing:
                    return True
    return False


def _is_empty(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether all terms of a line vanish in steady motion or at rest: it does not speak of it then.

    That single quantities vanish, such as dθ/dt, it may say.
    """
    vanishing = _vanishing(judged.line, context, equations)
    if vanishing and context == "launch":
        return True  # nothing moves
    claim = judged.claim
    if not vanishing or claim is None or any(r.sign not in _EQUATING for r in claim.members):
        return False
    given, _ = restrictions([r for r in judged.line.in_force.given if r.sign in EQUALITY])
    placed = {q.symbol: value for q, value in given.items() if q.symbol is not None}
    at_rest = {**placed, **dict.fromkeys(vanishing, ZERO)}
    sides = [side for c in claim.components() for side in (c.left, c.right) if side]
    if all(side.symbol is not None for side in sides):
        return context == "motion" and all(side.symbol in vanishing for side in sides)
    with suppress(PolhodeError, ArithmeticError):
        known = (on_constraints(side.subs(at_rest), equations) for side in sides)
        if not any(side.subs(at_rest) for side in known):
            return True
        # Where θ' = 0 also cos θ = cos θ₀ for a start from rest, whatever the factor of either is.
        return context == "motion" and not any(map(claim.states(TrueMotion).on, sides))
    return False


def _vanishing(line: TextLine, context: str, equations: Equations) -> frozenset[Symbol]:
    """The speeds and accelerations that vanish in a context by themselves."""
    if context == "steady":
        return vanishing_in_steady_motion(equations)
    if context not in ("motion", "launch"):
        return frozenset()
    start, _ = restrictions(line.in_force.start)
    values = {as_symbol(quantity): value for quantity, value in start.items()}
    if context == "motion":  # at rest
        values = dict.fromkeys(equations.speeds, ZERO)
    still = frozenset(speed for speed, value in values.items() if not value)
    if any(a.subs(values) for a in equations.accelerations.values()):
        return still if context == "motion" else frozenset()
    return still.union(equations.acceleration_symbols)


def vanishing_in_steady_motion(equations: Equations) -> frozenset[Symbol]:
    """The speeds and accelerations that vanish there: rates of coordinates that matter."""
    speeds = frozenset(q.derivative() for q in essential_coordinates(equations))
    return speeds.union(equations.acceleration_symbols)


def _unread(line: TextLine, found: OpenVerdict, equations: Equations) -> str:
    """What the sentence of a line says that was not read, on which the line may depend."""
    if is_at_end_of_contact(line):
        return "it is about the instant at which a contact ends, for which it was not decided"
    if line.in_force.unread:
        return "its sentence states a condition that was not read"
    if line.cues.drops_terms:
        return "its sentence says in words, which are not read, that it leaves terms out"
    if line.cues.is_fast:
        return (
            "its sentence speaks of fast spin; say in symbols what is large, as in "
            r"'for large $\omega_1$'"
        )
    if TIME_LETTER in line.letters and any(
        isinstance(c, Coulomb) for c in equations.system.contacts
    ):
        return "it is of the time for which a body slips in one direction, which was not decided"
    defined = line.in_force.defined
    if found.verdict.order == -1 and any(_is_own_constant(defined.get(n)) for n in line.letters):
        return "it departs from a motion whose constants of the text's own may have to fit together"
    if found.notation is not None:
        vocabulary = found.notation.vocabulary
        for latex in line.cues.named:
            with suppress(PolhodeError):
                name = read_latex(latex).relations[0].sides[0]
                is_known = name in vocabulary.declared or name in vocabulary.stated
                is_known = is_known or (line.is_steady and name in _kept(equations))
                is_vector = isinstance(name, Name) and name.decoration == "vector"
                is_given_here = is_vector and name == line.statement.relations[0].sides[0]
                if name in line.letters and not (is_known or is_given_here):
                    return f"{latex} is a letter of the text's own, which no equation defines"
    return ""


def _kept(equations: Equations) -> list[Node]:
    """The letters r₀ and θ₀ of what coordinates keep in steady motion."""
    return [name_of(f"{q.published}_0") for q in equations.coordinates]


def _is_own_constant(meaning: Meaning | None) -> bool:
    symbol = meaning.symbol if isinstance(meaning, Expr) else None
    return symbol is not None and symbol.kind is SymbolKind.PARAMETER


def in_context(
    line: TextLine, equations: Equations, chosen: Chosen, context: str, latex: str = ""
) -> OpenVerdict:
    """The judgement on a line, or on another form of it."""

    def notation(more: Chosen) -> Notation:
        return line.in_force.notation(equations, {**chosen, **more})

    try:
        return judgement(latex or line.latex, notation, context)
    except PolhodeError as error:
        return OpenVerdict(Verdict.unread(context, error))


def _as_identity(judged: JudgedLine) -> JudgedLine:
    """The line, said to be an identity where it holds for every state."""
    claim = judged.claim
    try:
        is_identity = claim is not None and holds(claim, "identity")
    except (PolhodeError, ArithmeticError):
        is_identity = False
    if not is_identity:
        return judged
    found = replace(judged.verdict, context="identity")
    return replace(judged, judgement=replace(judged.judgement, verdict=found))


def _unstated(line: TextLine, found: OpenVerdict, equations: Equations, chosen: Chosen) -> str:
    """A simple condition under which a line holds that the text has not stated."""
    if said := _sign_needed(found.verdict):
        return said
    if found.verdict.answer is not Answer.FAILS:
        return ""
    if said := _approximately(line, equations, chosen):
        return said
    # Of steady motion a text goes on to speak, at the angle that a sentence before has named.
    contexts = ("motion", "steady") if line.is_steady else ("motion",)
    near = line.cues.two_sentences
    taken = conditions(line.tacit, line.in_force, near, equations)
    for (said, relations), context in product(taken, contexts):
        if _sets_to_zero(relations, line):
            continue
        stated = replace(line, in_force=line.in_force.under(relations))
        other = JudgedLine(stated, in_context(stated, equations, chosen, context))
        sign = _in_latex(filter(_are_signs, other.verdict.holds_where[:1]))
        if (other.verdict.holds or sign) and not _is_void(other, context, equations):
            return " and ".join(filter(None, (said, sign)))
    if _holds_at_start(line, equations, chosen):
        return "the state at the start"
    is_integral = _relates_coordinates(JudgedLine(line, found))
    if is_integral and differs_by_a_constant(line, equations, chosen):
        return "a constant of integration that is zero"
    return ""


def _relates_coordinates(judged: JudgedLine) -> bool:
    """Whether a line is linear in several coordinates, and prints nothing else that varies."""
    components = judged.claim.components() if judged.claim is not None else []
    moving = {s for c in components for s in c.difference.symbols() if s.kind.varies}
    return len(moving) > 1 and all(
        s.kind is SymbolKind.COORDINATE and not s.order and not c.difference.diff(s).varies
        for c in components
        for s in moving
    )


def _holds_at_start(line: TextLine, equations: Equations, chosen: Chosen) -> bool:
    """Whether it holds at the start of the motion, of which sentences before have spoken."""
    stated = line.in_force
    if not (stated.is_at_start and stated.start):
        return False
    there = replace(line, in_force=stated.under(stated.start))
    found = JudgedLine(there, in_context(there, equations, chosen, "motion"))
    return found.verdict.holds and not _is_void(found, "motion", equations)


def _sets_to_zero(relations: tuple[BoundRelation, ...], line: TextLine) -> bool:
    """Whether a line prints a speed that a condition sets to zero, of which it speaks then."""
    speeds = [r.left.symbol for r in relations if isinstance(r.left, Expr) and r.right == ZERO]
    names = {name_of(s.published) for s in speeds if s is not None and s.kind is SymbolKind.SPEED}
    return not names.isdisjoint(line.letters)


def _sign_needed(verdict: Verdict) -> str:
    """The signs of the motion or of roots for which a line holds, of which a text may be silent."""
    if verdict.answer is Answer.UNREAD and verdict.option == "positive":
        return _in_latex(filter(_are_signs, verdict.holds_where))
    if verdict.answer is Answer.FAILS and _is_direction(verdict.holds_where):
        return _in_latex(verdict.holds_where[:1])
    return ""


def _is_void(judged: JudgedLine, context: str, equations: Equations) -> bool:
    """Whether a line that holds in a context under further restrictions says nothing there."""
    if judged.claim is None or (context == "steady" and _is_empty(judged, context, equations)):
        return True
    differences = [component.difference for component in judged.claim.components()]
    for relation in judged.line.in_force.given:
        if relation.is_lasting and isinstance(relation.left, Expr):
            # An equation for the acceleration is of motions on which the value does not last.
            acceleration = relation.left.dt()
            found = [d for d in differences if acceleration.symbols() <= d.symbols()]
            if found:
                return found != [acceleration]
    return _is_at_rest(judged.claim) or says_nothing(judged.claim)


def _is_at_rest(claim: BoundClaim) -> bool:
    """Whether all rates of a line are zero on its states, where any factor of them is right."""
    symbols = {s for c in claim.components() for side in (c.left, c.right) for s in side.symbols()}
    rates = [s for s in symbols if s.kind is SymbolKind.SPEED or s.order]
    states = claim.states(TrueMotion)
    with suppress(NumericError):
        return bool(rates) and all(states.vanishing(Expr.generator(r)).is_zero for r in rates)
    return False


def _are_signs(conditions: SimpleCondition) -> bool:
    """Whether conditions are signs, as that of a velocity of slipping, and no values."""
    return all(each.sign != "=" for each in conditions)


def _is_direction(where: Sequence[SimpleCondition]) -> bool:
    """Whether the first alternative is the sign of a single quantity, or of a sine or cosine.

    Parameters may have to be of some size besides: R - a > 0.
    """
    moving = [each for each in (where[0] if where else ()) if each.left.varies]
    if len(moving) != 1 or not _are_signs(where[0]):
        return False
    return moving[0].left in map(Expr.generator, moving[0].left.generators)


def _in_latex(where: Iterable[SimpleCondition]) -> str:
    return " or ".join(" and ".join(each.latex() for each in all_) for all_ in where)


def _approximately(line: TextLine, equations: Equations, chosen: Chosen) -> str:
    """What an equation of a text about small departures needs to be true to leading order.

    A speed may have to be small besides, since the steady motion has none of it, and a constant of
    integration may have to be zero.
    """
    order = 1 if says_that_it_vanishes(line) else None
    line = replace(line, in_force=line.in_force.to_order(order))
    relation, stated = line.relation.relation, line.in_force
    departures = () if stated.small else stated.departures.values()
    unsaid = {n: v for n in line.letters for v in departures if stated.defined.get(n) == v}
    stated = replace(stated, small=(*stated.small, *map(Small, dict.fromkeys(unsaid.values()))))
    if not stated.small or relation is None or not {*relation.signs} <= {"=", "≈"}:
        return ""
    line = replace(line, in_force=stated)
    small = [f"small {write_latex(letter)}" for letter in unsaid]
    exact = [] if "≈" in relation.signs else ["≈ in place of =, to leading order in what is small"]
    latex = _as_approximate(line)
    for said, more in (("", stated), *_of_departures(line, equations)):
        meant = replace(line, in_force=more)
        verdict = in_context(meant, equations, chosen, "limit", latex).verdict
        lacks_constant = verdict.answer is Answer.AMBIGUOUS and verdict.option == "given"
        if verdict.holds or lacks_constant:
            constant = ["a constant of integration that is zero"] if lacks_constant else []
            return " and ".join([*small, *filter(None, [said]), *constant, *exact])
    return ""


def _of_departures(line: TextLine, equations: Equations) -> Iterator[tuple[str, InForce]]:
    """What texts take for granted of the steady motion from which an angle departs.

    Momenta are those of the steady motion. A speed or a rate of turning among the parameters is
    small, or a spin that is conserved and that the line does not contain is zero.
    """
    stated = line.in_force
    yield from (("", near) for near in under_steady_momenta(stated, equations))
    known = {s.base() for small in stated.small for s in small.quantity.symbols()}
    if known.isdisjoint(equations.coordinates):
        return
    turning = (s for s in equations.parameters if equations.dimensions.get(s) == _RATE)
    for symbol in (*equations.speeds, *turning):
        if symbol.base() not in known:
            small = Small(Expr.generator(symbol), 1)
            yield f"small {small.quantity.latex()}", replace(stated, small=(*stated.small, small))
    letters = set(line.letters)
    for symbol in equations.speeds:
        is_spin = symbol.name.startswith("omega") and name_of(symbol.published) not in letters
        if is_spin and not equations.accelerations[symbol.derivative()]:
            spin = BoundRelation(Expr.generator(symbol), "=", ZERO)
            yield f"{Expr.generator(symbol).latex()} = 0", stated.under((spin,))


def differs_by_a_constant(
    line: TextLine, equations: Equations, chosen: Chosen | None = None, latex: str = ""
) -> bool:
    """Whether the sides of an equation differ by what is constant, as after an integration.

    Of the equation of a line, or of another form of it.
    """
    relation = line.relation.relation
    if relation is None or relation.signs not in (("=",), ("≈",)):
        return False
    left, right = re.split(r"=|\\approx|\\simeq|≈", latex or line.latex, maxsplit=1)
    sign, context = (r"\approx", "limit") if line.in_force.small else ("=", "motion")
    change = rf"\frac{{d}}{{dt}}\left({left} - \left({right}\right)\right) {sign} 0"
    return in_context(line, equations, chosen or {}, context, change).verdict.holds


def vanishes_at_rest(judged: JudgedLine, equations: Equations) -> bool:
    """Whether a line sets to zero what is zero at rest, as P = 0 does of a momentum."""
    still, claim = dict.fromkeys(equations.speeds, ZERO), judged.claim
    found = [] if claim is None else claim.components()
    with suppress(ArithmeticError):  # of a ratio of speeds
        return bool(found) and all(
            not c.right and not on_constraints(c.left, equations).subs(still) for c in found
        )
    return False


def says_nothing(claim: BoundClaim) -> bool:
    """Whether every term vanishes by itself on the states for which it should hold: 0 = 0.

    Where that cannot be decided, it is taken to say nothing.
    """
    states = claim.states(TrueMotion)
    sides = (side for c in claim.components() for side in (c.left, c.right))
    try:
        return all(states.vanishing(term).is_zero for side in sides for term in _terms(side))
    except NumericError:
        return True


def _terms(side: Expr) -> Iterator[Expr]:
    for powers, coefficient in side.numerator.terms():
        factors = (Expr.generator(generator) ** power for generator, power in powers.items())
        yield prod(factors, start=Expr.of(coefficient))

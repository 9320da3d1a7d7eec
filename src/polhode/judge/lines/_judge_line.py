"""One line judged: in the strongest context in which it holds, under what the text has stated."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from polhode.algebra import ZERO, Expr, SymbolKind
from polhode.base import LENGTH, TIME, PolhodeError
from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.contexts._contexts import holds
from polhode.judge.latex import read_latex
from polhode.judge.latex._names import name_of
from polhode.judge.latex._tree import Name, Node
from polhode.judge.lines._judged_line import (
    JudgedLine,
    holds_in,
    in_context,
    may_define,
    may_hold_in,
)
from polhode.judge.lines._near_steady import under_steady_momenta
from polhode.judge.lines._needs import as_approximate, sign_needed, unstated_condition
from polhode.judge.lines._vacuous import (
    says_something,
    speaks_of_rates,
    vanishing_in_steady_motion,
)
from polhode.judge.lines._weaker_meanings import is_at_end_of_contact, weaker_meanings
from polhode.judge.meaning._evaluate import FROM_BODY
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.meaning._vocabulary import Vocabulary
from polhode.judge.text._cues import Role
from polhode.judge.text._in_force import Chosen, is_number, varies
from polhode.judge.text._text_line import TIME_LETTER, TextLine
from polhode.model import DryFriction

#: Words right before a letter that stands for a period or a frequency of small oscillations.
_CALLED = re.compile(r"\b(period|frequency)(?: of (?:the )?small oscillations)?(?: is)?\W*\Z", re.I)
_MOMENTS = ("I", "J")  # letters of moments of inertia, whatever their label
_MOMENT_OF_INERTIA = "moment of inertia"
#: On the earth, m/s², as texts round it.
_GRAVITY = (Fraction("9.81"), Fraction("9.8"), Fraction(10))


def judged_line(line: TextLine, equations: Equations, chosen: Chosen) -> JudgedLine:
    """The judgement on a line, with letters of several meanings read as chosen."""
    found = _started(line, _seen_from_body(in_context(line, equations, chosen, "motion")))
    if found.verdict.answer is Answer.HOLDS:
        return _as_called(line, found, equations, chosen) or _as_identity(JudgedLine(line, found))
    if said := _meant_by_words(line, found.verdict):
        return judged_line(line, equations, {**chosen, **said})
    if found.verdict.answer in (Answer.AMBIGUOUS, Answer.DEFINITION, Answer.APPROXIMATE):
        return _as_called(line, found, equations, chosen) or JudgedLine(line, found)
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
    return JudgedLine(line, found, unstated_condition(line, found, equations, chosen))


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
        may_refute = (context == "number" and is_value) or _is_at_an_event(meant, context)
        if not (may_refute or may_hold_in(meant, equations, chosen, context)):
            continue
        found = in_context(meant, equations, chosen, context)
        if said := _meant_by_words(meant, found.verdict) or _only_read(found.verdict):
            found = in_context(meant, equations, {**chosen, **said}, context)
        other = JudgedLine(meant, _started(meant, found))
        if other.verdict.holds and speaks_of_rates(other, line, context, equations):
            continue
        if (called := _as_called(line, other.judgement, equations, chosen)) is not None:
            return called
        if other.verdict.holds and says_something(other, context, equations):
            is_meant = context != "steady" or line.says_that_it_is_steady
            return other if is_meant else replace(other, needs="equilibrium")
        if context == "launch" and other.verdict.answer is Answer.AMBIGUOUS:
            open_readings = other
        if sign := sign_needed(other.verdict, equations):
            return replace(other, needs=sign)
        if other.verdict.answer is Answer.FAILS and may_refute:
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


def _to_leading_order(line: TextLine, equations: Equations, chosen: Chosen) -> JudgedLine | None:
    """An equation that holds to leading order in what its own sentence calls small."""
    signs = line.relation.relation.signs if line.relation.relation is not None else ()
    if signs != ("=",) or not line.cues.small_here:
        return None
    for near in (line.in_force, *under_steady_momenta(line.in_force, equations)):
        meant, latex = replace(line, in_force=near), as_approximate(line)
        if may_hold_in(meant, equations, chosen, "limit", latex):
            found = in_context(meant, equations, chosen, "limit", latex)
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


def _as_called(
    line: TextLine, found: OpenVerdict, equations: Equations, chosen: Chosen
) -> JudgedLine | None:
    """A line that defines what words call the period, frequency or moment of inertia, as a claim.

    None where the system has none, or where it could not be compared.
    """
    letter = line.statement.relations[0].sides[0]
    if letter in chosen or not isinstance(letter, Name):
        return None
    # of a chain, ω = a = b, the rest may hold
    if not (may_define(found.verdict, letter) or found.verdict.answer is Answer.DEFINITION):
        return None
    called = _meanings_by_words(line, letter, line.in_force.notation(equations, {}).vocabulary)
    others = [judged_line(line, equations, {**chosen, letter: phrase}) for phrase in called]
    if right := next((other for other in others if other.verdict.holds or other.needs), None):
        return right
    return next((other for other in others if other.verdict.answer is Answer.FAILS), None)


def _meanings_by_words(line: TextLine, letter: Name, vocabulary: Vocabulary) -> list[str]:
    """What words call a letter: "the period is", "the moment of inertia about the hinge is"."""
    called = _CALLED.search(line.cues.words_before)
    if called is not None:
        kind = f"{called[1].lower()} of small oscillations"
        # one for each steady motion
        known = (p for r in vocabulary.readings_of(letter) for p in r.phrases)
        return [p for p in known if p.startswith(kind)] or [kind]
    if letter.letter not in _MOMENTS or not letter.subscript:
        return []
    if _MOMENT_OF_INERTIA not in line.cues.two_sentences.lower():
        return []
    known = (p for r in vocabulary.readings_of(Name(_MOMENTS[0])) for p in r.phrases)
    moments = [p for p in known if p.startswith(_MOMENT_OF_INERTIA)]
    said = [p for p in moments if any(re.search(pattern, p) for pattern in line.cues.meant)]
    return said if len(said) == 1 else []


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
    return all(holds_in(at_rest, equations, {}, "motion", f"{a} = 0") for a in accelerations)


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
        isinstance(c, DryFriction) for c in equations.system.contact_laws
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
                sense = vocabulary.sense(name)
                readings = sense.readings if sense is not None else ()
                # As words describe it: "from the centre to the contact".
                is_known = is_known or any(r.phrase.startswith("arm of ") for r in readings)
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

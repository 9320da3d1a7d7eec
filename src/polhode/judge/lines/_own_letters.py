"""Letters that a line defines although they may mean something in the model: ε, Ω, **r**."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import combinations, permutations, starmap

from polhode.algebra import ZERO, Expr, SymbolKind, Vector, as_symbol, sqrt
from polhode.base import TIME, ByIdentity, PolhodeError
from polhode.derive import Equations
from polhode.judge._notation import Notation
from polhode.judge._verdict import Answer
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import At, Derivative, Dots, Name, Node, Number, Power, walk
from polhode.judge.lines._judged_line import JudgedLine, in_context
from polhode.judge.lines._near_steady import steady_momenta, steady_value
from polhode.judge.meaning._derived_quantities import phase_space
from polhode.judge.meaning._meaning import Meaning, UnknownLetterError
from polhode.judge.meaning._proposals import SENSES
from polhode.judge.meaning._vocabulary import constant
from polhode.judge.states._bound_claim import EQUALITY
from polhode.judge.text._cues import Cues, Role
from polhode.judge.text._in_force import Chosen, InForce
from polhode.judge.text._text_line import components_of_turning, essential_coordinates

_HENCE = Role.CONSEQUENCE
#: What a bold letter stands for by habit only, with how a text would say that it does.
_HABITS = {"position": "position", "acceleration": "accelerat"}
_OSCILLATION = re.compile(
    r"\b(?:period|frequency|amplitude|takes"
    r"|time (?:for|of) (?:one|a)(?: full)? (?:turn|revolution|round|swing))\b[^.]{0,20}\Z",
    re.I,
)
_LENGTH = re.compile(r"\b(?:radius|diameter|length|height|distance)\b[^.]{0,20}\Z", re.I)
#: A speed of a point that the model has no name for.
_OF_A_POINT = re.compile(
    r"\b(?:speed|velocity|acceleration) of (?:the|its|an?) (?:[\w-]+ )?"
    r"(?:end|tip|edge|rim|point)\b[^.]{0,20}\Z",
    re.I,
)
#: A time that belongs to a turn about an axis, and not to an oscillation.
_OF_A_TURN = re.compile(
    r"\b(?:time (?:for|of) (?:one|a)|period of (?:the |its |one )?)\s*(?:full |complete )?"
    r"(?:turn|revolution|rotation|precession|circuit)\b[^.]{0,20}\Z",
    re.I,
)
_ANGULAR_VELOCITY = Name("omega")
_CONSTANT = Name("constant")
#: Words right before a letter that they give a meaning: "the moment of inertia about the end is".
_IS = re.compile(r"\b(?:is|are|be)\s*:?\s*\Z", re.I)
_OSCILLATIONS = " of small oscillations"
_ROUTHIAN = "routhian"
_NUMBERS = ("pi", "degree", "e", "i")
_POTENTIALS = (Name("U"), Name("V"), Name("W"), Name("Phi"))
_EFFECTIVE = "effective potential energy"


def deviation(judged: JudgedLine, equations: Equations) -> Mapping[Node, Expr] | None:
    """The deviation that a line defines by the quantity that it changes, as θ = π/2 + ε does.

    In θ = θ₀ + ε and ω₂ = Ω + ε the value in the motion that is departed from is a constant of the
    text's own.
    """
    relations = judged.line.statement.relations
    if len(relations) != 1 or relations[0].signs != ("=",):
        return None
    notation = judged.line.in_force.notation(equations, {})
    known = notation.vocabulary
    unknown = list(dict.fromkeys(n for n in judged.line.letters if not known.has(n)))
    by_label = _letters_by_label(judged, notation)
    unknown = by_label if judged.bound is not None else unknown
    used = {n for n in walk(relations[0].sides[1]) if isinstance(n, Name)}
    own = {n for n in used if n not in known.declared and n not in known.stated}
    if not unknown:
        return None
    letter = unknown[-1]
    new = constant(letter)
    meanings: dict[Node, Expr] = {letter: new}
    if not judged.line.in_force.start:
        values = (n for n in own - {letter} if n.subscript or n.letter not in _NUMBERS)
        meanings |= {n: constant(n) for n in values}
    try:
        left, right = map(notation.stating(meanings).value, relations[0].sides)
    except (PolhodeError, ArithmeticError):
        return None
    if not isinstance(left, Expr) or left.symbol not in {*equations.coordinates, *equations.speeds}:
        return None
    if not isinstance(right, Expr) or right.diff(as_symbol(new)).rational not in (1, -1):
        return None
    slope, rest = right.diff(as_symbol(new)), right.subs({new: ZERO})
    if letter in by_label and (rest.varies or not rest):
        return None
    if judged.line.is_steady and rest in meanings.values():  # θ₀, which it keeps on an orbit
        departing = [kept for kept, _ in steady_momenta(ByIdentity(equations))]
        if any(left.symbol in kept for kept in departing):
            value = Expr.generator(steady_value(left.symbol))
            meanings = {n: value if meaning == rest else meaning for n, meaning in meanings.items()}
            rest = value
    return {**meanings, letter: (left - rest) / slope}


def _letters_by_label(judged: JudgedLine, notation: Notation) -> list[Node]:
    """Letters that are read as coordinates which the declaration writes with a label: x for x_w.

    Beside another coordinate and a value of it, as in r = r₀ + x, they are the text's own.
    """
    known = notation.vocabulary
    own = (*known.declared, *known.stated)
    letters = (n for n in judged.line.letters if n not in own)
    meanings = ((n, known.find(n)) for n in dict.fromkeys(letters))
    symbols = ((n, m.symbol) for n, m in meanings if isinstance(m, Expr))
    return [n for n, s in symbols if s is not None and s.kind is SymbolKind.COORDINATE]


def with_named(stated: InForce, cues: Cues, equations: Equations) -> InForce:
    """With the letters that words use for the effective potential, where the system has one."""
    for latex in cues.effective:
        with suppress(PolhodeError, ArithmeticError):
            letter, _ = read_latex(f"{latex} = 0").relations[0].sides
            found = replace(stated, named={**stated.named, letter: _EFFECTIVE})
            if letter in _POTENTIALS and found.notation(equations, {}).value(letter):
                stated = found
    return stated


def with_meaning_of_words(own: InForce, judged: JudgedLine) -> InForce:
    """With the meanings that the words of a line have chosen for letters in it.

    After "let I = ml²/3 be the moment of inertia about the pivot" it is no longer open, nor is ω
    after "it oscillates with ω² = g/l".
    """
    chosen = _chosen_by_words(judged)
    first = judged.line.statement.relations[0].sides[0]
    is_let = judged.line.cues.introduces
    named = {n: m for n, m in chosen.items() if _OSCILLATIONS in m or (is_let and n == first)}
    return replace(own, named={**own.named, **named}) if named else own


def called_by_words(judged: JudgedLine) -> Mapping[Node, str]:
    """What words call the letter on the left, for later parts: "the moment about the end is I =".

    In its own part words may go on to speak of another one, as of that about the centre.
    """
    if not _IS.search(judged.line.cues.words_before):
        return {}
    first = judged.line.statement.relations[0].sides[0]
    return {n: m for n, m in _chosen_by_words(judged).items() if n == first}


def _chosen_by_words(judged: JudgedLine) -> Chosen:
    """The meanings of the letters of a true line whose words choose among them."""
    notation = judged.judgement.notation
    if notation is None or not (judged.line.cues.meant and judged.verdict.holds):
        return {}
    used = set(judged.line.letters)
    return {n: meaning for n, meaning in notation.vocabulary.chosen.items() if n in used}


def introduced(judged: JudgedLine, equations: Equations) -> Mapping[Node, Meaning]:
    """A letter that words introduce and the line defines, whatever it may mean in the model."""
    cues = judged.line.cues
    is_called = any(kind.search(cues.words_before) for kind in (_OSCILLATION, _LENGTH))
    # "where Γ = ...", of a letter that texts define as often as not
    answers = {way.verdict.answer for way in judged.verdict.by_reading}
    is_said_where = cues.role is Role.DEFINITION and Answer.DEFINITION in answers
    if not (cues.introduces or cues.named or is_called or is_said_where):
        return {}
    return _definition(judged, judged.line.in_force.notation(equations, {}))


def defined_or_wrong(judged: JudgedLine, equations: Equations) -> Mapping[Node, Meaning]:
    """A letter that an ambiguous line defines or, with its meanings in the model, is wrong about.

    Which of both is for its author to say; the lines after it use the letter as it is written here.
    """
    answers = {way.verdict.answer for way in judged.verdict.by_reading}
    is_open = answers == {Answer.DEFINITION, Answer.FAILS}
    if judged.verdict.answer is not Answer.AMBIGUOUS or not is_open:
        return {}
    return _definition(judged, judged.line.in_force.notation(equations, {}))


def _definition(
    judged: JudgedLine, notation: Notation, is_new: Callable[[Name], bool] = lambda letter: True
) -> Mapping[Node, Meaning]:
    """The letter on the left, or whose square is there, if it is new, with its value.

    No declared letter.
    """
    relations = judged.line.statement.relations
    if len(relations) != 1 or {*relations[0].signs} - {*EQUALITY, "≈"}:
        return {}
    side, value, *_ = relations[0].sides
    match side:
        case Power(Name() as letter, Number("2")):
            is_square = True
        case Name() as letter:
            is_square = False
        case _:
            return {}
    if letter in notation.vocabulary.declared or not is_new(letter):
        return {}
    with suppress(PolhodeError, ArithmeticError):
        found = notation.value(value)
        if not is_square:
            return {letter: found}
        if isinstance(found, Expr):
            return {letter: sqrt(found)}
    return {}


def letter_for_speed(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning]:
    """A new letter for an independent speed, such as Ω for that of a steady precession.

    By common usage it may have another meaning in the model, the magnitude of an angular velocity.
    Small letters and those with a label, such as ω₂ and v, are claimed to equal a speed instead,
    but for ω on the right, as in ω₃ = ω.
    """
    relations = judged.line.statement.relations
    notation = judged.judgement.notation or judged.line.in_force.notation(equations, {})
    if judged.line.cues.role is _HENCE or len(relations) != 1:
        return {}
    *sides, last = relations[0].sides
    if len(sides) < 2 or last != _CONSTANT:  # "φ' = Ω = const"
        sides.append(last)
    if len(sides) != 2 or not {*relations[0].signs} <= {"=", "≈"}:
        return {}
    for letter, other in permutations(sides):
        is_named = letter == _ANGULAR_VELOCITY and letter is sides[1]
        if not isinstance(letter, Name) or letter.subscript:
            continue
        if not (is_named or letter.letter[:1].isupper()):
            continue
        is_new = letter not in judged.line.earlier
        if not is_new or {letter} & {*notation.vocabulary.declared, *notation.vocabulary.stated}:
            continue
        with suppress(PolhodeError, ArithmeticError):
            speed = notation.value(other)
            if isinstance(speed, Expr) and _is_speed(speed, notation, equations):
                return {letter: speed}
    return {}


def constant_speed(judged: JudgedLine, equations: Equations) -> dict[Node, Expr]:
    """A letter without a meaning for the speed that it is equal or close to: ω₂ ≈ ω₀."""
    relations, notation = (
        judged.line.statement.relations,
        judged.line.in_force.notation(equations, {}),
    )
    if len(relations) != 1 or relations[0].signs not in (("=",), ("≈",)):
        return {}
    for letter, other in permutations(relations[0].sides):
        error = judged.verdict.error
        is_unknown = isinstance(error, UnknownLetterError) and error.symbol == spelled(letter)
        if isinstance(letter, Name) and is_unknown:
            with suppress(PolhodeError, ArithmeticError):
                speed = notation.value(other)
                if isinstance(speed, Expr) and _is_speed(speed, notation, equations):
                    return {letter: speed}
    return {}


def constant_named(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning]:
    """The letter of a constant of the motion, with what a true line says is constant: "… = C"."""
    line, relation = judged.line, judged.line.statement.relations[0]
    letter = relation.sides[-1]
    if not (judged.verdict.holds and isinstance(letter, Name) and relation.signs == ("=",)):
        return {}
    notation = line.in_force.notation(equations, {})
    if notation.vocabulary.has(letter):
        return {}
    with suppress(PolhodeError, ArithmeticError):
        return {letter: notation.value(relation.sides[0])}
    return {}


def letter_by_equation(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning]:
    """A letter of the text's own with the value that makes its first equation true.

    So P - mg sin θ = mbθ̇² says what "the force P along the rod" is.
    """
    line, relations = judged.line, judged.line.statement.relations
    error = judged.verdict.error
    if not isinstance(error, UnknownLetterError) or len(relations) != 1:
        return {}
    letter = next((n for n in line.letters if spelled(n) == error.symbol), None)
    if not isinstance(letter, Name) or letter.decoration or relations[0].signs != ("=",):
        return {}
    notation = line.in_force.notation(equations, {})
    is_known = letter in line.earlier and notation.vocabulary.readings_of(letter)
    rates = (p for p in walk(relations[0]) if isinstance(p, Dots | Derivative | At))
    behind = re.split(r"[.;](?=\s|\Z)", line.relation.after, maxsplit=1)[0]
    is_given = re.search(rf"[$(\[]\s*{re.escape(write_latex(letter))}\s*(?:=|\\approx)", behind)
    if is_known or is_given or any(letter in walk(rate) for rate in rates):
        return {}
    with suppress(PolhodeError, ArithmeticError):
        rest, slope = _linear_in(letter, judged, notation)
        balance = rest + slope * constant(letter)
        is_balance = len(list(balance.numerator.terms())) > 2  # no "V = mgh"
        if is_balance and slope and not slope.varies:
            value = -rest / slope
            return {letter: value} if _fits({letter: value}, judged, equations) else {}
    return {}


def named_by_equation(judged: JudgedLine, equations: Equations) -> dict[Node, Meaning]:
    """A length or number that words name, by the equation behind "where" that determines it.

    So "a circle of radius R, where Rφ' = v" says what R is.
    """
    line, cues = judged.line, judged.line.cues
    relations = line.statement.relations
    if cues.role is not Role.DEFINITION or len(relations) != 1 or relations[0].signs != ("=",):
        return {}
    notation = line.in_force.notation(equations, {})
    known = {*notation.vocabulary.declared, *notation.vocabulary.stated}
    for latex in cues.named:
        with suppress(PolhodeError, ArithmeticError):
            letter = read_latex(f"{latex} = 0").relations[0].sides[0]
            if isinstance(letter, Name) and letter in {*line.letters} - known:
                rest, slope = _linear_in(letter, judged, notation)
                return {letter: -rest / slope} if rest and slope else {}
    return {}


def _linear_in(letter: Name, judged: JudgedLine, notation: Notation) -> tuple[Expr, Expr]:
    """The difference of both sides without a letter, and its factor; zero if it is not linear."""
    new = constant(letter)
    sides = judged.line.statement.relations[0].sides
    left, right = map(notation.stating({letter: new}).value, sides)
    if not isinstance(left, Expr) or not isinstance(right, Expr):
        return ZERO, ZERO
    slope = (left - right).diff(as_symbol(new))
    is_linear = as_symbol(new) not in slope.symbols()
    return (left - right).subs({new: ZERO}), slope if is_linear else ZERO


def _fits(letters: Mapping[Node, Meaning], judged: JudgedLine, equations: Equations) -> bool:
    """Whether all terms of a line are of one dimension with letters that it defines."""
    line = judged.line
    stated = replace(line, in_force=line.in_force.defining(letters))
    return in_context(stated, equations, {}, "motion").fits


def other_sense(judged: JudgedLine, equations: Equations) -> Iterator[dict[Node, Meaning]]:
    """Letters of the line that the text may count the other way than the axis of the model does.

    A moment of inertia, which does not vary, has no sense. An angle about a fixed axis has, if
    nothing depends on it.
    """
    notation = judged.line.in_force.notation(equations, {})
    essential = essential_coordinates(equations)
    turning: dict[Node, Expr] = {}
    if list(_senses(_ANGULAR_VELOCITY, notation)):
        free = (q for q in equations.coordinates if q not in essential)
        turning = {name_of(q.published): Expr.generator(q) for q in free}
    for letter in dict.fromkeys(judged.line.letters):
        if not isinstance(letter, Name) or letter in judged.line.earlier:
            continue
        if letter in turning:
            yield {letter: -turning[letter]}
        for phrase in _senses(letter, notation):
            value = notation.choosing({letter: phrase}).value(letter)
            if isinstance(value, Expr) and any(s.kind.varies for s in value.symbols()):
                yield {letter: -value}


def _senses(letter: Name, notation: Notation) -> Iterator[str]:
    """The phrases for what a letter means that has a sense about an axis, or along a path."""
    phrases = (p for r in notation.vocabulary.readings([letter]) for p in r.phrases)
    return (p for p in phrases if p.endswith(SENSES))


def _is_speed(value: Expr, notation: Notation, equations: Equations) -> bool:
    """Whether a value is a speed, a rate of a coordinate or a component of a body's turning."""
    speeds = {*equations.speeds, *(q.derivative() for q in equations.coordinates)}
    return value.symbol in speeds or value in components_of_turning(notation)


def _is_of_a_point(letter: Name, judged: JudgedLine) -> bool:
    is_known = letter in judged.line.in_force.defined
    said = judged.line.cues.words_before
    return not is_known and any(words.search(said) for words in (_OF_A_POINT, _OF_A_TURN))


def letter_of_its_own(judged: JudgedLine, equations: Equations) -> Mapping[Node, Meaning]:
    """A letter that a line which does not hold gives a meaning of its own; empty for a claim.

    A text may use a letter again, "Let ε = θ - π", and vectors that it describes are its own: an
    **r** from the contact to the centre is not the position of the centre in the model.
    """

    def is_new(letter: Name) -> bool:
        is_described = _is_described(letter, judged) or _is_of_oscillation(letter, judged)
        is_described = is_described or _is_other_routhian(letter, judged)
        return is_described or _is_of_a_point(letter, judged) or _is_named_again(letter, judged)

    if judged.judgement.notation is None:
        return {}
    # Other letters have one of their own readings, in which both sides are scalars or both vectors.
    chosen = [way.chosen for way in judged.verdict.by_reading] or [{}]
    ways = ({letter: read.meaning for letter, read in way.items()} for way in chosen)
    notations = (judged.line.in_force.notation(equations, way) for way in ways)
    found = (_definition(judged, notation, is_new) for notation in notations)
    return next((new for new in found if new and all(starmap(_is_alike, new.items()))), {})


def _is_other_routhian(letter: Name, judged: JudgedLine) -> bool:
    """Whether it is the Routhian of some cyclic coordinates, where the model's is that of all.

    It is L - p q' for those that the text ignores, in either sign.
    """
    notation, sides = judged.judgement.notation, judged.line.statement.relations[0].sides
    sense = notation.vocabulary.sense(letter) if notation is not None else None
    if notation is None or sense is None or not any(_ROUTHIAN in r.phrase for r in sense.readings):
        return False
    mechanics = notation.vocabulary.mechanics
    with suppress(PolhodeError, ArithmeticError):
        value, space = notation.value(sides[1]), phase_space(mechanics)
        lagrangian = mechanics.in_rates(mechanics.lagrangian())
        ignorable = [
            Expr.generator(rate) * space.momenta[momentum]
            for rate, momentum in space.rates.items()
            if momentum in space.cyclic
        ]
        for count in range(1, len(ignorable)):
            for some in combinations(ignorable, count):
                routhian = lagrangian - sum(some, ZERO)
                if isinstance(value, Expr) and mechanics.in_rates(value) in (routhian, -routhian):
                    return True
    return False


def _is_alike(letter: Node, meaning: Meaning) -> bool:
    """Whether a letter is bold exactly if it stands for a vector."""
    is_bold = isinstance(letter, Name) and bool(letter.decoration)
    return isinstance(meaning, Vector) == is_bold


def _is_of_oscillation(letter: Name, judged: JudgedLine) -> bool:
    """Whether words or its value make it a period or a frequency, unlike the model's letter."""
    notation = judged.judgement.notation
    sense = notation.vocabulary.sense(letter) if notation is not None else None
    if sense is not None and all(_OSCILLATIONS in r.phrase for r in sense.readings):
        return False  # the model has one itself
    is_called = _OSCILLATION.search(judged.line.cues.words_before) is not None
    is_time = any(TIME in member.dimensions for member in judged.verdict.at_odds)
    return is_time or (is_called and bool(judged.verdict.at_odds))


def _is_named_again(letter: Name, judged: JudgedLine) -> bool:
    """Whether a letter of the text is introduced once more, with words such as "let"."""
    stated = judged.line.in_force.defined
    return letter in stated and judged.line.cues.introduces


def _is_described(letter: Name, judged: JudgedLine) -> bool:
    """Whether it is a vector for which the model has a habitual meaning, and the text another."""
    cues, notation = judged.line.cues, judged.judgement.notation
    sense = notation.vocabulary.sense(letter) if notation is not None else None
    phrases = [reading.phrase for reading in sense.readings] if sense is not None else []
    habits = [sign for p in phrases for habit, sign in _HABITS.items() if p.startswith(habit)]
    if letter.decoration != "vector" or not habits:
        return False
    if any(re.search(sign, cues.sentence, re.I) for sign in habits):
        return False
    return cues.introduces or cues.role is Role.DEFINITION or _stands_alone(judged)


def _stands_alone(judged: JudgedLine) -> bool:
    """Whether the left side stands in its sentence before, as a formula by itself."""
    left = judged.line.relation.latex.partition("=")[0].strip()
    places = re.findall(r"\$([^$]*)\$|\\\((.*?)\\\)", judged.line.cues.sentence)
    return any(left in (one.strip(), other.strip()) for one, other in places)

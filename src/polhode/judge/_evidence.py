"""Whether a line that does not hold is proved to be a slip, or only doubted.

That a line could not be confirmed proves nothing: the letter V may be a speed, the line may be
meant of a start or of an equilibrium. An accusation has to have every letter closed, and positive
evidence of a slip besides: one small change with which the line holds, or terms of different
dimensions. Everything else that fails is a doubt.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex._names import spelled
from polhode.judge.latex._tree import Name, Node, Number
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.text._text_line import TextLine

#: The changes of an author who slips. A term or a factor more or less, or another letter, is none:
#: some change of that kind makes nearly any line hold.
_SLIPS = frozenset(
    {
        "wrong sign",
        "wrong factor",
        "wrong number",
        "wrong power",
        "swapped numbers",
        "fraction upside down",
        "wrong index",
        "swapped component",
        "wrong angle",
        "dot lost",
        "one dot too many",
        *(
            f"{one} where {other} is right"
            for pair in (("sin", "cos"), ("sinh", "cosh"), ("tan", "cot"), ("sech", "tanh"))
            for one, other in (pair, pair[::-1])
        ),
    }
)
_INERTIA = "inertia"
#: Nouns of the quantities that texts introduce by name: "the kinetic energy is T = ...".
_NOUNS = (
    "kinetic energy",
    "potential energy",
    "energy",
    "lagrangian",
    "hamiltonian",
    "angular momentum",
    "momentum",
    "torque",
    "acceleration",
    "velocity",
    _INERTIA,
    "period",
    "frequency",
    "force",
)


@dataclass(frozen=True)
class Evidence:
    """What speaks for a slip in a line that fails, and what is lacking for a proof.

    Attributes:
        slip: the evidence in words; empty for none.
        lacking: why it is no proof; empty where it is one.
    """

    slip: str = ""
    lacking: str = ""

    @property
    def is_proof(self) -> bool:
        """Whether the line is proved to be a slip."""
        return bool(self.slip) and not self.lacking


class ClosedLetters:
    """The letters whose meaning a text has shown, by lines that hold with it."""

    def __init__(self) -> None:
        self._confirmed: set[tuple[Node, str]] = set()

    def confirm(self, judged: JudgedLine) -> None:
        """Take in a line: one that holds, and needs nothing for it, shows what its letters mean."""
        if judged.verdict.holds and not (judged.stated or judged.needs):
            self._confirmed.update(_read_by_usage(judged))

    def left_open(
        self, judged: JudgedLine, among: Collection[str] | None = None
    ) -> tuple[str, ...]:
        """The letters of a line that were read by common usage alone, each with its reading.

        Those of the declaration, those that the text defines, and those that the sentence calls by
        the name of their quantity are closed.

        Args:
            judged: the line.
            among: scalar letters without a label that are looked at; by default all letters, and
                declared forces of another dimension than the terms beside them.
        """
        left = (
            f"{spelled(letter)} as {phrase}"
            for letter, phrase in _read_by_usage(judged)
            if (letter, phrase) not in self._confirmed
            and not _is_named(letter, phrase, judged.line)
            and (among is None or _is_bare(letter, among))
        )
        forces = _forces_at_odds(judged) if among is None else ()
        return tuple(dict.fromkeys([*left, *forces]))


def _read_by_usage(judged: JudgedLine) -> Iterator[tuple[Node, str]]:
    """The letters of a line that have their meaning by common usage, with the phrase for it."""
    notation = judged.judgement.notation
    if notation is None:
        return
    vocabulary = notation.vocabulary
    for name in dict.fromkeys(judged.line.letters):
        sense = None if name in vocabulary.stated else vocabulary.sense(name)
        for reading in sense.readings if sense is not None else ():
            is_declared = reading.phrase.startswith(("axis ", "declared "))
            if not (is_declared and len(reading.phrases) == 1):
                yield reading.letter, reading.phrase


def _is_bare(letter: Node, among: Collection[str]) -> bool:
    """Whether it is one of some letters by itself: Ω, but not the component ω₂ of **ω**."""
    if not isinstance(letter, Name) or letter.subscript or letter.decoration:
        return False
    return letter.letter in among


def _forces_at_odds(judged: JudgedLine) -> Iterator[str]:
    """Reactions in a line whose terms differ in dimension: the text may mean another force.

    The reaction of a constraint in coordinates is a force or a couple as its rate has it.
    """
    notation = judged.judgement.notation
    if notation is None or not judged.verdict.at_odds:
        return
    mechanics = notation.vocabulary.mechanics
    for name in dict.fromkeys(judged.line.letters):
        is_own = name in notation.vocabulary.stated or not isinstance(name, Name)
        if not is_own and mechanics.published(name) in mechanics.equations.reaction_names:
            yield f"{spelled(name)} as declared"


def _is_named(letter: Node, phrase: str, line: TextLine) -> bool:
    """Whether words have the noun for what a phrase says: "the kinetic energy is".

    Of a moment of inertia that the line gives, the sentence before may.
    """
    noun = next((noun for noun in _NOUNS if noun in phrase), "")
    if noun and noun in line.cues.words_before.lower():
        return True
    is_given = letter in (relation.sides[0] for relation in line.statement.relations)
    return noun == _INERTIA and is_given and f"moment of {noun}" in line.cues.two_sentences.lower()


def evidence(judged: JudgedLine, verdict: Verdict, closed: ClosedLetters) -> Evidence:
    """What speaks for a slip in a line that fails.

    Args:
        judged: the line.
        verdict: on it, with a correction where one was found.
        closed: the letters that the text has shown the meaning of.
    """
    slip = _slip(judged, verdict)
    left = closed.left_open(judged)
    if not slip:
        return Evidence(lacking="no single slip was found that explains it")
    if judged.otherwise:
        return Evidence(slip, f"it would hold with {judged.otherwise}")
    if left:
        return Evidence(slip, f"no line of the text confirms that it means {', '.join(left)}")
    return Evidence(slip)


def contradicts_itself(judged: JudgedLine) -> bool:
    """Whether a wrong line is wrong whatever stands before it.

    In a = b = c the first link may be drawn from a line before, and the second only from the first;
    and numbers are equal or not.
    """
    if not judged.line.letters:
        return True
    members = {residual.member for residual in judged.verdict.residuals}
    return bool(members) and 0 not in members


def _slip(judged: JudgedLine, verdict: Verdict) -> str:
    """The evidence of a slip: a change of one kind at one place, or terms at odds."""
    if verdict.answer is not Answer.FAILS:
        return ""
    if verdict.at_odds and not _may_be_another_letter(judged):
        return "its terms have different dimensions"
    correction = verdict.correction
    return correction.what if correction is not None and correction.what in _SLIPS else ""


def _may_be_another_letter(judged: JudgedLine) -> bool:
    """Whether different dimensions may be due to a letter that the text uses for something else.

    In L = T - V the L of a declared length is a Lagrangian; in ẋ = θ̇ = 0 each is compared with
    zero.
    """
    sides = [side for relation in judged.line.statement.relations for side in relation.sides]
    notation = judged.judgement.notation
    declared = notation.vocabulary.declared if notation is not None else {}
    return Number("0") in sides or any(isinstance(s, Name) and s in declared for s in sides)

"""A claim judged in every reading of its letters.

Texts write **L** for the angular momentum about the centre of mass and about a fixed point, and L
for its magnitude or for the Lagrangian. Of all readings those are judged that fit: scalars are set
against scalars, and all terms have one dimension. If all lead to the same answer the verdict
stands, if they differ it is ambiguous.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, product
from math import inf, prod

from polhode.algebra import Expr, Vector, is_positive
from polhode.base import ParseError, PolhodeError
from polhode.judge._dimensions import are_homogeneous
from polhode.judge._notation import Notation
from polhode.judge._verdict import Answer, Read, Verdict, VerdictInReading
from polhode.judge.latex._names import name_latex, spelled
from polhode.judge.latex._tree import (
    At,
    Derivative,
    Differential,
    Dots,
    Name,
    Negative,
    Node,
    Piece,
    PoissonBracket,
    Power,
    Sum,
    walk,
)
from polhode.judge.meaning._bindings import Bound
from polhode.judge.meaning._derivative_readings import derivative_readings
from polhode.judge.meaning._evaluate import HAMILTONIANS, TIME
from polhode.judge.meaning._initial_values import INITIAL, InitialValues
from polhode.judge.meaning._meaning import Meaning
from polhode.judge.meaning._poisson_bracket import OF_COORDINATES_FIRST
from polhode.judge.meaning._proposals import MAGNITUDE, NORMAL_MODES, OWN, is_free, unsigned
from polhode.judge.meaning._relations import BoundRelation, ScalarRelation
from polhode.judge.meaning._small_oscillations import ORDINALS
from polhode.judge.meaning._vocabulary import Reading, Vocabulary
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import TrueMotion

#: Letters of several meanings, each with the one that is taken.
Chosen = Mapping[Node, str]


class TooManyReadingsError(ParseError):
    """Letters that together can be read in more ways than are tried."""


_MOST = 16  # readings of a claim that are judged: four letters of two meanings each
#: Phrases for functions of coordinates, rates and momenta that mechanics differentiates by them.
_ENERGY = re.compile(
    r"(?:(?:effective|[a-z]+al|kinetic) )*energy(?: of .+)?|lagrangian|hamiltonian"
)
_OF_MODE = re.compile(rf"(?:{'|'.join(ORDINALS)}) frequency of small oscillations")
_ALONG_OWN_AXIS = re.compile(r"declared \w+, along axis ")
_ALONG_AXIS = re.compile(r"(?!declared ).*\baxis \S+ of (?P<frame>.+)")
_TURNING = (Name("omega"), Name("Omega"))
_FREQUENCY = "frequency of small oscillations"
_POTENTIALS = {"potential energy", "effective potential energy"}
_MOST_BOUND = 512  # readings that are bound, to see which of them fit


@dataclass(frozen=True)
class BoundReading:
    """A claim bound under one choice of what its letters mean.

    Attributes:
        chosen: that choice, of letters with more than one meaning.
        notation: with it; None where the options of the claim cannot be bound.
        bound: the statement; None where it cannot be bound.
        claim: that it makes; None where it makes none, or is a definition.
        trouble: why it could not be bound.
        unused: for letters read as the text's own, the quantities that the field uses them for.
    """

    chosen: Chosen
    notation: Notation | None
    bound: Bound | None = None
    claim: BoundClaim | None = None
    trouble: Exception | None = None
    unused: tuple[tuple[Node, tuple[str, ...]], ...] = ()

    @cached_property
    def fits(self) -> bool:
        """Whether the claim makes sense: scalars against scalars, and terms of one dimension."""
        if self.notation is None or self.bound is None:
            return False
        if self.claim is None:
            return not self._redefines
        # A number without a unit is given in SI units.
        given = (r for r in self.notation.given if _varied(r.left) and _varied(r.right))
        relations = (*self.claim.members, *given)
        try:
            are_alike = are_homogeneous(self.claim.equations, relations)
            return are_alike and self._starts_as_printed
        except ParseError:
            return False  # a given scalar set against a vector

    @property
    def _redefines(self) -> bool:
        """Whether a definition is that of a known letter at some argument: V(θ) of a velocity V."""
        defined = self.bound.defined if self.bound else ()
        return any(isinstance(n, At) and self.chosen.get(n.of, OWN) != OWN for n in defined)

    @property
    def is_void(self) -> bool:
        """Whether a letter stands for what vanishes identically, among terms that do not."""
        if self.claim is None or self.notation is None:
            return False
        vocabulary = self.notation.vocabulary
        nothing = {n for n in self.chosen if _is_nothing(vocabulary.find(n))}
        printed = [r.printed for r in self.claim.members if r.printed is not None]
        sides = [side for one in printed for side in (one.left, one.right)]
        named = (p for side in sides if side not in nothing for p in walk(side))
        return any(
            p in nothing or (isinstance(p, Name) and _of_component(p) in nothing) for p in named
        )

    def is_variant(self, right: Chosen) -> bool:
        """Whether it differs from a choice under which the claim holds in what says nothing.

        That are signs and boldness, the potential energy on a support that is kept turning with
        or without the energy of its rotation, moments about the centre of mass or about the
        origin, an ω that would be the frequency of small oscillations, the
        order in which normal modes are numbered, another axis at rest than that along which the
        declaration has a component, and the rarer sign of a Poisson bracket.
        """
        return all(
            other == right.get(letter)
            or _ALONG_OWN_AXIS.match(right[letter])
            or right[letter] == OF_COORDINATES_FIRST
            or {other, right[letter]} == _POTENTIALS
            or _about_cm(other) == _about_cm(right[letter])
            or (letter in _TURNING and other.startswith(_FREQUENCY))
            or (letter in NORMAL_MODES and _OF_MODE.match(other) and _OF_MODE.match(right[letter]))
            for letter, other in self.quantities.items()
        )

    @property
    def is_as_declared(self) -> bool:
        """Whether a letter is read as a component along the axis at rest of the declaration."""
        return any(map(_ALONG_OWN_AXIS.match, self.chosen.values()))

    @property
    def has_signed_speed(self) -> bool:
        """Whether v is read as a velocity with a sign, or a force with the sign not declared."""
        return any(
            phrase.startswith(("velocity", "declared")) and phrase != unsigned(phrase)
            for phrase in self.chosen.values()
        )

    @property
    def has_negative_component(self) -> bool:
        """Whether a plain letter is read as a component that is negative on every motion.

        So are the angular acceleration of a yo-yo along an axis that points the other way, and
        T b = -I α with it; most texts mean the magnitude.
        """
        if self.claim is None or self.notation is None:
            return False
        states, vocabulary = self.claim.states(TrueMotion), self.notation.vocabulary
        signed = [n for n, phrase in self.chosen.items() if phrase != unsigned(phrase)]
        values = [m for n in signed if isinstance(m := vocabulary.find(n), Expr)]
        try:
            return any(is_positive(-states.on(value)) for value in values)
        except (PolhodeError, ZeroDivisionError):
            return True  # its sign is not known, such as under a relation that is not solved

    @property
    def quantities(self) -> Chosen:
        """The choice of quantities, whether as vectors, by their magnitudes or with signs."""
        return {letter: unsigned(phrase) for letter, phrase in self.chosen.items()}

    @property
    def speaks_of_start(self) -> bool:
        """Whether a letter of several meanings is read as a value at the start of the motion."""
        return any(phrase.startswith(INITIAL) for phrase in self.chosen.values())

    @property
    def _starts_as_printed(self) -> bool:
        """Whether what is read as a value at the start is the value at the start.

        At the start itself, ω² = ω₀² + (2g/l)(cos θ - cos θ₀) is an identity, as a formula about it
        has to be; ω² = 2ω₀²(cos θ - cos θ₀) is not, so that ω₀ is no initial rate there.
        """
        if self.claim is None or self.notation is None or not self.speaks_of_start:
            return True
        start, mechanics = self.claim.initial, self.notation.vocabulary.mechanics
        printed = [c for c in self.claim.components() if _names_start(start, c)]
        return all(start.is_met(mechanics, c.left, c.right) for c in printed)

    @property
    def binds(self) -> bool:
        """Whether its letters have meanings that can be combined."""
        return self.bound is not None

    @property
    def defines(self) -> tuple[Node, ...]:
        """Letters that are read as the text's own."""
        return tuple(letter for letter, phrase in self.chosen.items() if phrase == OWN)

    @property
    def defines_fixed(self) -> bool:
        """Whether the text would define a letter whose meaning texts do not choose."""
        mechanics = self.notation.vocabulary.mechanics if self.notation else None
        return mechanics is not None and not all(is_free(n, mechanics) for n in self.defines)

    @property
    def is_of_energies(self) -> bool:
        """Whether every letter of several meanings is read as an energy, and there is one."""
        return bool(self.chosen) and all(map(_ENERGY.match, self.chosen.values()))

    def unfit(self, *letters: str) -> str:
        """What the field uses some letters for that are the text's own here, as that does not fit.

        Args:
            letters: in ASCII.
        """
        unused = ((_plain(n), " or ".join(phrases)) for n, phrases in self.unused)
        return "".join(f"; as {what} {n} does not fit" for n, what in unused if n in letters)

    @property
    def defines_usually(self) -> bool:
        """Whether a letter that the text states has the value by which the field knows it."""
        return self.notation is not None and self.notation.vocabulary.states_usual

    @property
    def is_lasting(self) -> bool:
        """Whether no letter that stands for a constant is used as one that varies, or the reverse.

        A rate is not that of a constant, and a lone letter is constant exactly if what it is set
        equal to is.
        """
        if self.claim is None or self.notation is None:
            return True
        members = self.claim.members
        return not self.has_rate_of_constant and all(map(self._is_lasting, members))

    @cached_property
    def has_rate_of_constant(self) -> bool:
        """Whether it contains the rate of a letter that is read as a constant."""
        printed = (r.printed for r in self.claim.members) if self.claim is not None else ()
        sides = (side for one in printed if one is not None for side in (one.left, one.right))
        return any(map(self._has_rate_of_constant, sides))

    def _is_lasting(self, relation: BoundRelation) -> bool:
        printed, left, right = relation.printed, relation.left, relation.right
        if printed is None:
            return True
        if not isinstance(left, Expr) or not isinstance(right, Expr):
            return True
        for node, value, other in ((printed.left, left, right), (printed.right, right, left)):
            if isinstance(node, Name) and not value and other:
                return False  # a letter for what vanishes identically
            is_speed = other.symbol is not None and other.varies
            if is_speed and self.chosen.get(node, "").startswith(_FREQUENCY):
                return False  # ω₁ = ω₀ says what a speed is, and nothing of an oscillation
        letter = printed.left.base if isinstance(printed.left, Power) else printed.left
        is_letter = isinstance(letter, Name) and left and right
        return not is_letter or left.varies == right.varies

    def _has_rate_of_constant(self, node: Node) -> bool:
        """Whether a side contains the rate of a letter that is read as a constant."""
        rates = (
            p.of
            for p in walk(node)
            if isinstance(p, Dots) or (isinstance(p, Derivative) and p.by == TIME)
        )
        terms = (term for of in rates for term in (of.terms if isinstance(of, Sum) else (of,)))
        bare = (term.of if isinstance(term, Negative) else term for term in terms)
        letters = [of for of in bare if of in self.chosen]
        values = [self.notation.vocabulary.find(of) for of in letters if self.notation]
        return any(isinstance(value, Expr) and not value.varies for value in values)


@dataclass(frozen=True)
class JudgedReading:
    """A claim under one choice of what its letters mean, with the verdict before a correction."""

    reading: BoundReading
    verdict: Verdict

    @property
    def told(self) -> VerdictInReading:
        """Its verdict, with the choice as readers are told of it."""
        chosen = {n: Read(_latex(n), p, _plain(n)) for n, p in self.reading.chosen.items()}
        return VerdictInReading(chosen, self.verdict)

    @property
    def failing_members(self) -> float:
        """How many members were found not to hold; infinite where that was not found out."""
        return len({residual.member for residual in self.verdict.residuals}) or inf


def _about_cm(phrase: str) -> str:
    """A moment about the origin as the one about the centre of mass; other phrases as they are."""
    return phrase.replace(" about origin", " about cm")


def _varied(side: Expr | Vector) -> bool:
    return isinstance(side, Vector) or bool(side.symbols())


def _is_nothing(meaning: Meaning | None) -> bool:
    match meaning:
        case Vector():
            return meaning.is_zero
        case Expr():
            return not meaning
    return False


def _of_component(name: Name) -> Name:
    """The vector of which a letter may be the component: **M** of M₁."""
    whole, _, _ = name.subscript.rpartition(",")
    return replace(name, subscript=whole, decoration="vector")


def _names_start(start: InitialValues, component: ScalarRelation) -> bool:
    constants = {s for value in start.values.values() for s in value.symbols()}
    return not constants.isdisjoint(component.difference.symbols())


def choices(vocabulary: Vocabulary, pieces: Iterable[Piece]) -> tuple[Chosen, ...]:
    """Every coherent reading of the letters of some pieces of text, the likeliest first.

    Raises `TooManyReadingsError` for more readings than can be tried.
    """
    pieces = tuple(pieces)
    every = every_reading(vocabulary, pieces)
    usual = {r.letter: r.phrase for r in vocabulary.readings(pieces)}
    readings = [r for r in every if len(r.phrases) > 1 or usual.get(r.letter, r.phrase) != r.phrase]
    settled = [r.phrase for r in every if r not in readings]
    count = prod(len(reading.phrases) for reading in readings)
    if count > _MOST_BOUND:
        raise _too_many([{r.letter: r.phrase for r in readings}], count)
    ways = product(*([(reading, phrase) for phrase in reading.phrases] for reading in readings))
    return tuple(
        {r.letter: phrase for r, phrase in way} for way in ways if _is_coherent(way, settled)
    )


def every_reading(vocabulary: Vocabulary, pieces: Iterable[Piece]) -> tuple[Reading, ...]:
    """The readings of the letters of some pieces of text, and of their derivatives."""
    read = tuple(pieces)
    functions = set(_differentiated(read))
    letters = (_as_energy(r) if r.letter in functions else r for r in vocabulary.readings(read))
    return tuple(dict.fromkeys([*letters, *derivative_readings(vocabulary, read)]))


def _differentiated(pieces: Iterable[Piece]) -> Iterator[Node]:
    """The letters of ∂T/∂q̇ and the like, which are functions of coordinates and rates.

    So is the V of V'(θ). The H in a Poisson bracket is one of coordinates and momenta.
    """
    for piece in (p for each in pieces for p in walk(each)):
        if isinstance(piece, Derivative) and piece.partial and piece.by != TIME:
            yield piece.of.of if isinstance(piece.of, At) else piece.of
        if isinstance(piece, At) and isinstance(piece.of, Name) and piece.of.primes:
            yield replace(piece.of, primes=0)
        if isinstance(piece, PoissonBracket):
            yield from (n for n in (piece.left, piece.right) if n in HAMILTONIANS)


def _as_energy(reading: Reading) -> Reading:
    """The reading, of a letter that may be an energy, without the other quantities it may be."""
    energies = tuple(p for p in reading.phrases if _ENERGY.match(p))
    if not energies or energies == reading.phrases:
        return reading
    phrase = reading.phrase if reading.phrase in energies else energies[0]
    return replace(reading, phrase=phrase, phrases=energies)


def _is_coherent(way: Sequence[tuple[Reading, str]], settled: Sequence[str]) -> bool:
    """Whether moments are about one point, and plain letters all vectors or all magnitudes.

    Euler's second law dL/dt = τ holds about one common point, so mixed choices mean nothing; and
    boldness is lost from a whole formula, if it is. ω and ω₀ in one formula are two quantities, of
    which at most one is the frequency of small oscillations; T and T₀ likewise.
    """
    points = {
        phrase.rpartition(" about ")[2]
        for reading, phrase in way
        if " about " in phrase and not _has_one_point(reading)
    }
    plain = [
        phrase.startswith(MAGNITUDE)
        for reading, phrase in way
        if isinstance(reading.letter, Name)
        and not reading.letter.decoration
        and (phrase.startswith(MAGNITUDE) or MAGNITUDE + unsigned(phrase) in reading.phrases)
    ]
    small = [phrase for _, phrase in way if "of small oscillations" in phrase]
    twice = len(set(small)) < len(small) or any(phrase in settled for phrase in small)
    whole = {r.letter: phrase for r, phrase in way}
    starts = all(_starts_as_read(r.letter, phrase, whole) for r, phrase in way)
    # ω₁ and ω₂ in one formula are both frequencies of normal modes, or neither is.
    modes = {
        bool(_OF_MODE.match(phrase))
        for reading, phrase in way
        if reading.letter in NORMAL_MODES and any(map(_OF_MODE.match, reading.phrases))
    }
    if len(points) > 1 or len(set(plain)) > 1 or len(modes) > 1:
        return False
    return not twice and starts and _is_one_triad(way)


def _is_one_triad(way: Sequence[tuple[Reading, str]]) -> bool:
    """Whether **e**₁′ and **e**₂′ are axes of one frame, as are the ŷ and ẑ of a formula."""
    along = [(found["frame"], r) for r, phrase in way if (found := _ALONG_AXIS.match(phrase))]
    if any(
        one != other and _has_axis_of(first, other) and _has_axis_of(second, one)
        for (one, first), (other, second) in combinations(along, 2)
    ):
        return False
    frames = {
        (reading.letter.primes, phrase.rpartition(" of ")[2])
        for reading, phrase in way
        if isinstance(reading.letter, Name)
        and reading.letter.letter == "e"
        and phrase.startswith("axis ")
        and len(set(reading.phrases) - {OWN}) > 1  # one axis of several frames is no choice
    }
    return len(frames) == len({primes for primes, _ in frames})


def _has_axis_of(reading: Reading, frame: str) -> bool:
    found = (_ALONG_AXIS.match(phrase) for phrase in reading.phrases)
    return any(match["frame"] == frame for match in found if match)


def _starts_as_read(letter: Node, phrase: str, whole: Chosen) -> bool:
    """Whether X₀, read as a value at the start, is one of the quantity that X is read as."""
    if not isinstance(letter, Name) or not phrase.startswith(INITIAL):
        return True
    stem = replace(letter, subscript=letter.subscript.removesuffix("0").rstrip(","))
    return whole.get(stem, phrase.removeprefix(INITIAL)) == phrase.removeprefix(INITIAL)


def _has_one_point(reading: Reading) -> bool:
    return len({p.rpartition(" about ")[2] for p in reading.phrases if " about " in p}) == 1


def _too_many(chosen: Sequence[Chosen], count: int) -> TooManyReadingsError:
    first = chosen[0]
    differing = [n for n in first if any(c[n] != first[n] for c in chosen)] or list(first)
    return TooManyReadingsError(
        f"{', '.join(map(_plain, differing))}, which together can be read in {count} ways",
        expected="letters that say of which body, about which point or along which axis",
        advice=f"choose, as in read {_typed(differing[0], first[differing[0]])}",
    )


def fitting(readings: Sequence[BoundReading]) -> list[BoundReading]:
    """The readings to be judged; where none fits, the likeliest one.

    Raises `TooManyReadingsError` for more than are judged.
    """
    if len(readings) == 1:
        return list(readings)
    fit = [reading.fits for reading in readings]
    unused = _unused(readings, fit)
    readings = [replace(r, unused=tuple(p for p in unused if p[0] in r.defines)) for r in readings]
    found = [reading for reading, fits in zip(readings, fit, strict=True) if fits]
    # Zero has any dimension, so that the rate of a constant would fit all that is wrong.
    if any(r.binds and not r.has_rate_of_constant for r in readings):
        found = [r for r in found if not r.has_rate_of_constant]
    # Whatever its dimension, an ω that has to be a vector is an angular velocity.
    turning = _rotations(readings)
    found = [r for r in found if turning.isdisjoint(r.defines)]
    # A letter is the text's own only where no quantity that the field uses it for fits, unless
    # texts define it as often as not.
    found = _without(found, lambda r: r.defines_fixed)
    # What starts as a formula says of ω₀ is about the start, not about small oscillations.
    found = _without(found, lambda r: not r.speaks_of_start)
    found = _without(found, lambda r: r.is_void)
    if any(r.is_lasting and not r.defines for r in found):
        found = [r for r in found if r.is_lasting]
    if len(found) > 1:
        # What the text defines under a usual letter is the usual quantity, where it can be.
        found = _without(found, lambda r: not r.defines_usually)
    if len(found) > _MOST:
        raise _too_many([r.chosen for r in found], len(found))
    if found:
        return found
    binding = [r for r in readings if r.binds and not r.defines]
    own = [r for r in readings if r.defines and turning.isdisjoint(r.defines)]
    most_own = sorted(own, key=lambda r: -len(r.defines))[:1]
    return most_own or binding[:1] or list(readings[:1])


def _rotations(readings: Sequence[BoundReading]) -> set[Node]:
    """The letters ω that stand for a vector in all readings that make sense."""
    found: dict[Node, set[bool]] = {}
    for reading in readings:
        if reading.binds and reading.notation is not None and not reading.has_rate_of_constant:
            for letter in reading.chosen.keys() - set(reading.defines):
                value = reading.notation.vocabulary.find(letter)
                found.setdefault(letter, set()).add(isinstance(value, Vector))
    return {
        n for n, are in found.items() if isinstance(n, Name) and n.letter == "omega" and all(are)
    }


def _unused(
    readings: Sequence[BoundReading], fit: Sequence[bool]
) -> list[tuple[Node, tuple[str, ...]]]:
    """Letters of which no quantity that the field uses them for fits, with these quantities."""
    found = []
    for letter in dict.fromkeys(n for reading in readings for n in reading.defines):
        phrases = dict.fromkeys(r.chosen[letter] for r in readings if r.chosen[letter] != OWN)
        fitting = (r.chosen[letter] for r, fits in zip(readings, fit, strict=True) if fits)
        if not any(phrase in phrases for phrase in fitting):
            found.append((letter, tuple(phrases)))
    return found


def _without(
    found: list[BoundReading], is_unlikely: Callable[[BoundReading], bool]
) -> list[BoundReading]:
    """The readings without the unlikely ones, unless there are no others."""
    return [r for r in found if not is_unlikely(r)] or found


def agreed(ways: Sequence[JudgedReading]) -> JudgedReading | Verdict:
    """The reading whose verdict stands; an ambiguous verdict where readings that fit differ."""
    judged = [way for way in ways if not way.reading.defines]
    if any(way.verdict.holds for way in judged):
        ways = judged  # what holds for a quantity of the field needs no definition
    # A plain letter is a magnitude, or counted as the angle is, or lost its bold type: texts do
    # not say which, and what holds in one of these ways is right.
    # Only a v is as a rule a speed, so that one with the sign of the path leaves a choice.
    right = [
        way
        for way in ways
        if way.verdict.holds
        and not way.reading.has_signed_speed
        and not way.reading.has_negative_component
    ]
    # A component as it is declared comes first, also where it is not decided.
    right += [w for w in ways if w.verdict.answer is Answer.UNREAD and w.reading.is_as_declared]
    true_readings = [way.reading.quantities for way in right]
    ways = [
        w
        for w in ways
        if w.verdict.holds or w in right or not any(map(w.reading.is_variant, true_readings))
    ]
    by_reading = tuple(way.told for way in ways)
    answers = dict.fromkeys(way.verdict.answer for way in ways)
    if len(answers) == 1:
        # Of a chain that fails in every reading, as much as possible holds in the one meant.
        ways = sorted(ways, key=lambda way: way.failing_members)
        told = tuple(way.told for way in ways)
        return replace(ways[0], verdict=replace(ways[0].verdict, by_reading=told))
    # One reading for each answer, and the letters in which these readings differ.
    first, *others = (next(w for w in ways if w.verdict.answer is a) for a in answers)
    meant = first.reading.chosen
    differing = [n for n in meant if any(w.reading.chosen[n] != meant[n] for w in others)]
    answered = []
    for way in (first, *others):
        read = (f"{_plain(letter)} is {way.reading.chosen[letter]}" for letter in differing)
        answered.append(f"{way.verdict.answer.value} if {' and '.join(read)}")
    likely = next((w for w in (first, *others) if w.verdict.holds), first).reading.chosen
    example = _typed(differing[0], likely[differing[0]])
    reason = f"{'; '.join(answered)}; to choose, state the reading {example}"
    context = first.verdict.context
    return Verdict(Answer.AMBIGUOUS, context, reason=reason, option="read", by_reading=by_reading)


def dropped(readings: Sequence[BoundReading], kept: BoundReading) -> Iterator[str]:
    """Remarks on letters whose likelier meanings do not fit the formula."""
    for letter, phrase in kept.chosen.items():
        others = dict.fromkeys(r.chosen[letter] for r in readings if r.chosen[letter] != phrase)
        unfit = [o for o in others if not any(r.fits for r in readings if r.chosen[letter] == o)]
        likelier = next(iter(dict.fromkeys(r.chosen[letter] for r in readings)))
        if kept.fits and likelier in unfit and OWN not in (phrase, likelier):
            yield f"{_plain(letter)} is not read as {likelier}, which does not fit the formula"


def with_readings(verdict: Verdict, vocabulary: Vocabulary, pieces: Iterable[Piece]) -> Verdict:
    """The verdict with the meanings that the letters of the claim were given.

    An ambiguous verdict lists only the letters that have a single meaning.
    """
    read_in = tuple(pieces)
    every = (*every_reading(vocabulary, read_in), *vocabulary.lagrangians(read_in))
    found = [r for r in every if verdict.answer is not Answer.AMBIGUOUS or len(r.phrases) == 1]
    read = (Read(_latex(r.letter), r.phrase, _plain(r.letter)) for r in found)
    return replace(verdict, readings=tuple(read))


def _typed(letter: Node, phrase: str) -> str:
    """A choice as it is typed: 'L = angular momentum about pivot'."""
    return f"'{_plain(letter)} = {phrase}'"


def _plain(letter: Node) -> str:
    """A letter in ASCII without hat or boldness; d/dtheta for a derivative."""
    if isinstance(letter, Differential):
        return f"d/d{spelled(letter.of)}"
    if isinstance(letter, Dots):
        return f"{_plain(letter.of)}_dot"
    return spelled(replace(letter, decoration="") if isinstance(letter, Name) else letter)


def _latex(letter: Node) -> str:
    match letter:
        case Name():
            return name_latex(letter)
        case Dots(of=Name() as of):
            return rf"\dot{{{name_latex(of)}}}"
        case Differential(of=Name() as by):
            return rf"\frac{{d}}{{d{name_latex(by)}}}"
    return _plain(letter)

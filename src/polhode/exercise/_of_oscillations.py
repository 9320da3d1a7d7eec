"""Questions about small oscillations: their frequencies and periods."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from math import inf, pi

from polhode.algebra import Symbol
from polhode.analyse import Stability, Truth
from polhode.exercise._answers import NumberAnswer
from polhode.exercise._families import eigenvalues, family_words, fixed_values, kind_of, open_speeds
from polhode.exercise._numbers import draw_state
from polhode.exercise._quantities import number_latex
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import LONGEST, value_of
from polhode.solution import inline, listed, root_latex

_MAGNITUDE = re.compile(r"\\left\|([^|]*)\\right\|")


def small_oscillations(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """The angular frequency of small oscillations and their period."""
    subject = occasion.subject
    single = [s for s in subject.rests if _has_frequencies(s)]
    most = max((len(open_speeds(subject, s.family)) for s in single), default=0)
    offered = [s for s in single if len(open_speeds(subject, s.family)) == most]
    for found in occasion.layout.shuffled("frequency", offered):
        question = _frequency(occasion, found)
        if question is not None:
            yield question


def _has_frequencies(found: Stability) -> bool:
    """Whether there are one or two, at definite values of the angles."""
    if found.truth is Truth.NEVER or len(found.frequencies) not in (1, 2):
        return False
    fixed = fixed_values(found.family).values()
    is_fixed = not any(v.varies for v in fixed)
    return is_fixed and all(v.symbol is None and v.symbols() for v in found.frequencies)


def _frequency(occasion: Occasion, found: Stability) -> ExerciseQuestion | None:
    subject, drawn, family = occasion.subject, occasion.drawn, found.family
    values = found.frequencies
    inside = {s for v in values for s in v.symbols() if s.kind.varies}

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        held = all(value_of(c.expression, numbers) > 0 for c in found.conditions)
        return held and all(value_of(v, numbers) > 0 for v in values)

    own = occasion.own.about("frequency")
    wanted = {*open_speeds(subject, family), *inside}
    state = draw_state(subject, wanted, drawn, own, accepts)
    if state is None or not family_words(family):
        return None
    numbers = occasion.values(state)
    rates = [value_of(v, numbers) for v in values]
    exact = eigenvalues(subject, family, drawn, {s: a.si for s, a in state.items()})
    if exact is None or not all(_occurs(rate, exact) for rate in rates):
        return None
    used = [s for s in state if s in inside]
    at = f" at a constant {listed(map(inline, used))}" if used else ""
    where = f" for {stated({s: state[s] for s in used})}" if used else " for the numbers given"
    motion = f"{kind_of(family)} with {family_words(family)}{at}"
    periods = tuple(2 * pi / rate for rate in rates)
    shown = " and ".join(f"${number_latex(p)}$ s" for p in periods)
    if len(values) > 1:
        squares = [(v * v).latex() for v in values]
        return ExerciseQuestion(
            "frequency",
            (Passage(f"Find the periods of the two small oscillations about {motion},{where}."),),
            (NumberAnswer("periods:", periods, "s"),),
            (
                Passage(
                    "The linear equations of small departures have two angular frequencies,",
                    r"\omega^2 = " + r" \quad\text{and}\quad ".join(squares),
                )
                if max(map(len, squares)) <= LONGEST
                else Passage("The linear equations of small departures have two frequencies."),
                Passage(f"The periods are {shown}{where}."),
            ),
        )
    (value,) = values
    text = root_latex(value * value)
    if len(text) > LONGEST:
        return None
    letter = subject.free_letter("S", "W", "U")
    plain, taken = without_magnitudes(text)
    definition = f"{letter} = {plain}"
    also = f"{letter} = {text}" if taken else ""
    signs = f" Take {listed(f'${x}$' for x in taken)} as positive." if taken else ""
    return ExerciseQuestion(
        "frequency",
        (
            Passage(
                f"Find exactly, as a formula, the angular frequency ${letter}$ of small "
                f"oscillations about {motion}, and their period{where}.{signs}"
            ),
        ),
        (
            occasion.sheet.formula(
                letter, plain, [value], definition=definition, also=also, is_positive=True
            ),
            NumberAnswer("period:", periods, "s"),
        ),
        (
            Passage("The linear equations of small departures give", definition),
            Passage(f"so that the period $2\\pi/{letter}$ is {shown}{where}."),
        ),
    )


def without_magnitudes(text: str) -> tuple[str, tuple[str, ...]]:
    """A formula with |x| written as x, and what has to be positive for that."""
    taken = tuple(dict.fromkeys(_MAGNITUDE.findall(text)))
    return _MAGNITUDE.sub(lambda found: found[1], text), taken


def _occurs(rate: float, exponents: tuple[complex, ...]) -> bool:
    return min((abs(v - 1j * rate) for v in exponents), default=inf) <= 1e-5 * rate

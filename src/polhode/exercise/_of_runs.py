"""Questions about the outcome of a motion, with a run as the evidence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from polhode.algebra import PI, Symbol
from polhode.analyse import Stability
from polhode.base import NumericError, PolhodeError
from polhode.derive import automaton
from polhode.exercise._answers import ChoiceAnswer
from polhode.exercise._draws import rounded
from polhode.exercise._families import (
    family_words,
    growth_rate,
    kind_of,
    numeric_state,
    open_speeds,
)
from polhode.exercise._numbers import draw_state
from polhode.exercise._of_thresholds import thresholds
from polhode.exercise._quantities import Amount, number_latex, unit_of
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import ExerciseSubject, value_of
from polhode.simulate import Trajectory, simulate
from polhode.solution import inline

_ASIDE = 1.0  # degrees by which an angle begins aside
_SHARE = 0.01  # of the speed that goes round, by which other speeds begin
_STAYS, _LEAVES = 4.0, 15.0  # times the first departure
_FOLDS = 9.0  # by how many factors of e a growing departure would grow
_MOST = 60.0  # s
_FAR = 90.0  # degrees, beyond which it does not matter how far
_SIDES = ((0.55, 0.8), (1.25, 1.7))


@dataclass(frozen=True)
class _Trial:
    """A motion that begins close to a steady one."""

    stability: Stability
    speeds: Mapping[Symbol, Amount]
    aside: Symbol
    amount: Amount


def outcome(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """Whether a motion that begins close to a steady one stays there."""
    subject = occasion.subject
    tied = [t.stability for t in thresholds(subject)]
    found = [s for s in subject.rests if s in tied] if tied else subject.rests
    offered = [s for s in found if family_words(s.family)]
    for found_one in occasion.own.shuffled("outcome", offered):
        trial = _trial(occasion, found_one)
        question = None if trial is None else _ran(occasion, trial)
        if question is not None:
            yield question
            return


def _trial(occasion: Occasion, found: Stability) -> _Trial | None:
    subject, family = occasion.subject, found.family
    own = occasion.own.about(f"outcome {family}")
    speeds = open_speeds(subject, family)
    state = draw_state(subject, speeds, occasion.drawn, own)
    if state is None:
        return None
    for one in thresholds(subject):
        if one.stability is found:
            low, high = own.choice("side", _SIDES)
            bound = value_of(one.bound, occasion.drawn.values)
            value = rounded(bound * own.between("share", low, high))
            state[one.speed] = Amount(value, state[one.speed].unit)
    aside, amount = _departure(subject, found, state)
    return None if aside is None else _Trial(found, state, aside, amount)


def _departure(
    subject: ExerciseSubject, found: Stability, state: Mapping[Symbol, Amount]
) -> tuple[Symbol | None, Amount]:
    family = found.family
    angles = [q for q in family.reduced.essential if q in family.fixed and subject.is_angle(q)]
    if angles:
        return angles[0], Amount(_ASIDE, "deg")
    still = [s for s in family.reduced.speeds if s in family.fixed]
    largest = max((a.si for a in state.values()), default=0.0)
    if not still or not largest:
        return None, Amount(0.0)
    dimension = subject.dimension(still[0])
    unit_text = "" if dimension is None else unit_of(dimension)
    return still[0], Amount(rounded(_SHARE * largest, 1), unit_text)


def _ran(occasion: Occasion, trial: _Trial) -> ExerciseQuestion | None:
    subject, drawn, family = occasion.subject, occasion.drawn, trial.stability.family
    speeds = {s: a.si for s, a in trial.speeds.items()}
    growth = growth_rate(subject, family, drawn, speeds)
    if growth is None:
        return None
    steady_state = numeric_state(subject, family, drawn, speeds)
    rest = steady_state.get(trial.aside.published, 0.0)
    start: dict[Any, float] = {**steady_state, trial.aside.published: rest + trial.amount.si}
    grows = growth > 1e-6
    duration = rounded(_FOLDS / growth, 1) if grows else _quiet(speeds)
    if not 0 < duration <= _MOST:
        return None
    parameters: dict[Any, float] = {s.published: v for s, v in drawn.values.items() if s != PI}
    try:
        run = simulate(automaton(subject.equations.system), parameters, start, duration)
    except PolhodeError:
        return None
    except (RuntimeError, MemoryError) as failed:  # of the compiler, when there is no memory left
        raise NumericError(
            f"a simulation for a question on {subject.name!r}, which ended with: {failed}",
            expected="enough memory to compile the motion",
            advice="end other programs, or ask for kinds without the outcome of a motion",
        ) from failed
    largest = _largest(run, trial, rest)
    ratio = largest / abs(trial.amount.si)
    if ratio < _STAYS and not grows:
        return _question(occasion, trial, duration, largest, "a")
    if ratio > _LEAVES and grows:
        return _question(occasion, trial, duration, largest, "b")
    return None


def _quiet(speeds: Mapping[Symbol, float]) -> float:
    """A duration of some turns for a motion that does not leave."""
    fastest = max((abs(v) for v in speeds.values()), default=0.0)
    return min(rounded(60 / fastest, 1), 10.0) if fastest else 5.0


def _largest(run: Trajectory, trial: _Trial, rest: float) -> float:
    """The largest departure of what began aside; infinite for a body that went flat."""
    if run.events[-1].kind == "goes flat":
        return inf
    return float(np.max(np.abs(run[trial.aside] - rest)))


def _happened(subject: ExerciseSubject, trial: _Trial, largest: float) -> str:
    """How far a motion went from the steady one, in words."""
    letter, unit_text = inline(trial.aside), trial.amount.unit
    if largest == inf:
        return f"the {subject.bodies[0].name} falls flat"
    reached = rounded(largest / trial.amount.si * trial.amount.number)
    if unit_text == "deg" and reached > _FAR:
        return f"{letter} departs by more than {Amount(_FAR, unit_text).printed}"
    return f"{letter} departs by {Amount(reached, unit_text).printed} at most"


def _question(
    occasion: Occasion, trial: _Trial, duration: float, largest: float, right: str
) -> ExerciseQuestion:
    subject, family = occasion.subject, trial.stability.family
    letter = inline(trial.aside)
    limit = Amount(10 * trial.amount.number, trial.amount.unit).printed
    span = f"during the first ${number_latex(duration, 1)}$ s"
    state = f" with {stated(trial.speeds)}" if trial.speeds else ""
    happened = _happened(subject, trial, largest)
    exponent = "no exponent of small departures has a positive real part"
    if right == "b":
        exponent = "an exponent of small departures has a positive real part"
    return ExerciseQuestion(
        "outcome",
        (
            Passage(
                f"The motion begins close to {kind_of(family)} {family_words(family)}{state}, but "
                f"with {letter} larger by {trial.amount.printed}. What becomes of it {span}?"
            ),
        ),
        (ChoiceAnswer("outcome:", frozenset({right}), ("a", "b")),),
        (
            Passage(
                f"({right}). With these numbers {exponent}. A simulation agrees: {span} {happened}."
            ),
        ),
        (
            f"{letter} stays within {limit} of its steady value",
            f"{letter} departs from it by more than {limit}",
        ),
    )

"""Families of steady motions: what they fix, in words, and their linear equations at numbers."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from polhode.algebra import ONE, Expr, Symbol
from polhode.analyse import SteadyMotion
from polhode.base import PolhodeError
from polhode.exercise._numbers import DrawnNumbers
from polhode.exercise._quantities import plain_amount
from polhode.exercise._subject import ExerciseSubject, value_of
from polhode.solution import inline, listed

_ROUNDING = 1e-3  # of the largest exponent: zeros that coincide are found to half the digits


def fixed_values(family: SteadyMotion) -> dict[Symbol, Expr]:
    """What a family fixes, angles first, without the rates of its coordinates, which vanish."""
    own = family.reduced.essential
    kept = {s: v for s, v in family.fixed.items() if not (s.order and s.base() in own)}
    return dict(sorted(kept.items(), key=lambda pair: (pair[0] not in own, pair[0].published)))


def given_of(family: SteadyMotion) -> tuple[str, ...]:
    """The same as restrictions of a claim."""
    return tuple(f"{s.published} = {value}" for s, value in fixed_values(family).items())


def family_words(family: SteadyMotion) -> str:
    """The same in words with formulas; empty where nothing is fixed."""
    values = fixed_values(family).items()
    return listed(f"${inline(s)[1:-1]} = {v.latex()}$" for s, v in values) if values else ""


def open_speeds(subject: ExerciseSubject, family: SteadyMotion) -> tuple[Symbol, ...]:
    """Speeds that a family leaves open and that matter."""
    idle = subject.setting.idle_speeds
    return tuple(s for s in family.reduced.speeds if s not in {*family.fixed, *idle})


def kind_of(family: SteadyMotion) -> str:
    """Whether anything moves in a steady motion, in words."""
    speeds = family.reduced.speeds
    moves = any(family.fixed.get(s, ONE) for s in speeds)
    return "the steady motion" if moves else "the equilibrium"


# -- at numbers ------------------------------------------------------------------------------------


def numeric_state(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> dict[str, float]:
    """SI values of the coordinates and speeds of one motion of a family, keyed by their names."""
    known = {**drawn.values, **speeds}
    fixed = {s.published: value_of(v, known) for s, v in fixed_values(family).items()}
    others = {
        q.published: _elsewhere(subject, q)
        for q in subject.equations.coordinates
        if q not in family.reduced.essential
    }
    return others | fixed | {s.published: v for s, v in speeds.items()}


def _elsewhere(subject: ExerciseSubject, coordinate: Symbol) -> float:
    """A regular value of a coordinate that nothing depends on."""
    typical = plain_amount(subject.start.get(coordinate.published, ""))
    if typical is not None and typical.number:
        return typical.si
    return 1.0 if subject.is_angle(coordinate) else 0.0


def growth_rate(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> float | None:
    """The largest real part of the exponents of small departures, by linearising at numbers."""
    found = eigenvalues(subject, family, drawn, speeds)
    if found is None:
        return None
    largest = max(map(abs, found), default=0.0)
    growth = max((v.real for v in found), default=0.0)
    return growth if growth > _ROUNDING * largest else 0.0


def eigenvalues(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> tuple[complex, ...] | None:
    """Exponents of small departures at numbers; None where the motion is not steady.

    They are the eigenvalues of the slopes of the accelerations, and share neither the
    characteristic polynomial nor the conditions of the exact analysis.
    """
    idle = dict.fromkeys(subject.setting.idle_speeds, 0.0)
    known = {**idle, **drawn.values, **speeds}
    try:
        fixed = {s: value_of(v, known) for s, v in family.fixed.items()}
        values = {**known, **fixed}
        rates = np.array([value_of(rate, values) for rate in subject.rates])
        slopes = np.array([[value_of(e, values) for e in row] for row in subject.slopes])
    except (PolhodeError, ZeroDivisionError):
        return None
    moving = np.array([abs(values[s]) for s in family.reduced.state])
    scale = 1.0 + float(np.max(np.abs(slopes) @ moving, initial=0.0))
    if not (np.isfinite(slopes).all() and np.all(np.abs(rates) <= 1e-8 * scale)):
        return None
    return tuple(map(complex, np.linalg.eigvals(slopes)))

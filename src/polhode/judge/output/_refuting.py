"""The motion that starts from a state which refutes a line, to be played on a page."""

from __future__ import annotations

import re
from contextlib import suppress
from fractions import Fraction
from math import atan
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge._reviewed import Mark, Review
from polhode.judge._verdict import Counterexample
from polhode.simulate import simulate
from polhode.view import Scene, scenery

_DURATIONS = (3.0, 1.0, 0.3)  # s; the shorter ones for motions that cannot be followed for longer
_MOST = 8  # scenes of a page, each of which takes some room in it
_HALF_ANGLE = re.compile(r"2\*atan\((-?[0-9]+(?:/[0-9]+)?)\)")  # as a `Counterexample` gives angles


def refuting_scenes(review: Review, equations: Equations) -> dict[int, Scene]:
    """Pictures of the states that refute the errors of a review, by the index of their line.

    They show the motion from the state on, without formulas and numbers, which might be the answer
    that a student is to find. A state that does not determine the motion, or whose motion cannot be
    followed, has none.
    """
    found: dict[int, Scene] = {}
    for number, line in enumerate(review.lines):
        example = line.verdict.counterexample if line.verdict else None
        if example is None or line.mark is not Mark.ERROR or len(found) == _MOST:
            continue
        title = f"The motion from a state that refutes line {line.line}"
        if (shown := _played(example, equations, title)) is not None:
            found[number] = shown
    return found


def _played(example: Counterexample, equations: Equations, title: str) -> Scene | None:
    read = {name: _number(text) for name, text in example.values.items()}
    values = {name: value for name, value in read.items() if value is not None}
    parameters = {symbol.published for symbol in equations.parameters}
    speeds = {symbol.published for symbol in equations.speeds}
    # Coordinates on which nothing depends may be missing; they start at zero.
    coordinates = {symbol.published for symbol in equations.coordinates} & set(values)
    if equations.functions or not parameters | speeds <= set(values):
        return None
    given: dict[str | Symbol | Expr, Any] = {name: values[name] for name in parameters}
    start: dict[str | Symbol | Expr, Any] = {name: values[name] for name in speeds | coordinates}
    for duration in _DURATIONS:
        with suppress(PolhodeError):
            return scenery(simulate(equations, given, start, duration), title=title)
    return None


def _number(text: str) -> float | None:
    """The value of an exact number of a counterexample; None for another."""
    with suppress(ValueError, ZeroDivisionError):
        if found := _HALF_ANGLE.fullmatch(text):
            return 2 * atan(Fraction(found[1]))
        return float(Fraction(text))
    return None

"""What became of a motion, in words: extremes, start and end, the steady motion it began beside."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, repeat
from math import pi
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, compile_program
from polhode.analyse import stability, steady
from polhode.base import NumericError
from polhode.catalogue import RunCase, exact_values
from polhode.cli._printing import wrapped
from polhode.derive import Equations
from polhode.simulate import Trajectory, unit_of
from polhode.study import largest

_DIGITS = 6
_CLOSE = 3  # times the departure at the start: a motion within it stays close
_ROUNDING = 1e-14  # values below it, in SI units or of the greatest value, are shown as zero


@dataclass(frozen=True)
class Extremes:
    """The least and the greatest value of a quantity along a motion, SI, and when they occur, s."""

    least: float
    least_at: float
    greatest: float
    greatest_at: float

    def as_json(self) -> dict[str, float]:
        """As the command line prints it."""
        return {
            "min": self.least,
            "min_at": self.least_at,
            "max": self.greatest,
            "max_at": self.greatest_at,
        }


def extremes(motion: Trajectory, name: str) -> Extremes:
    """The extremes of a quantity, by name.

    Raises:
        DeclarationError: for a name that the system does not have.
    """
    greatest, greatest_at = largest(motion, name, 1.0)
    least, least_at = largest(motion, name, -1.0)
    return Extremes(-least, least_at, greatest, greatest_at)


@dataclass(frozen=True)
class StartingBeside:
    """The steady motion beside which a motion begins.

    Attributes:
        family: the steady motion.
        condition: of its stability.
        is_stable: whether the condition is met by the numbers of the motion.
        departures: of each coordinate or speed that it fixes, at the start and the greatest, SI.
    """

    family: str
    condition: str
    is_stable: bool
    departures: Mapping[str, tuple[float, float]]

    def as_json(self) -> dict[str, Any]:
        """As the command line prints it."""
        return {
            "family": self.family,
            "stable_when": self.condition,
            "stable": self.is_stable,
            "departures": {n: {"start": a, "max": b} for n, (a, b) in self.departures.items()},
        }


def beside(
    equations: Equations, motion: Trajectory, fixed: Mapping[str, str], start: Mapping[str, float]
) -> StartingBeside:
    """The steady motion with these values, whether it is stable, and how far the motion leaves it.

    Raises:
        NumericError: where there is no such steady motion, or its stability is not decided.
    """
    at = exact_values(equations, fixed)
    families = steady(equations, at)
    if not families:
        raise NumericError("no such steady motion", expected="a motion that begins beside one")
    judged = stability(families[0])
    values = {**motion.parameters, **start}
    met = all(_value(condition.expression, values) > 0 for condition in judged.conditions)
    departures = {}
    for symbol, value in at.items():
        level = _value(value, values)
        found = extremes(motion, symbol.published)
        begun = abs(float(motion.evaluate(symbol.published, 0.0)) - level)
        far = max(abs(found.least - level), abs(found.greatest - level))
        departures[symbol.published] = (begun, far)
    return StartingBeside(str(families[0]), str(judged), met, departures)


def _value(expression: Expr, numbers: Mapping[Any, float]) -> float:
    """An expression of parameters and start values; speeds that are not given are zero."""
    known = {str(name): float(value) for name, value in numbers.items()}
    varying = (symbol for symbol in expression.symbols() if symbol.name != "pi")
    symbols: tuple[Symbol, ...] = tuple(sorted(varying, key=str))
    arguments = [known.get(symbol.published, 0.0) for symbol in symbols]
    return float(compile_program([expression], symbols).function()(*arguments)[0])


@dataclass(frozen=True)
class Course:
    """What became of a motion.

    Attributes:
        motion: the motion.
        case: the question it answers, if it is one of the text's.
        beside: the steady motion it began beside.
        ends: quantities at the start and at the end, SI.
        extremes: the least and greatest values of quantities.
    """

    motion: Trajectory
    case: RunCase | None
    beside: StartingBeside | None
    ends: Mapping[str, tuple[float, float]]
    extremes: Mapping[str, Extremes]

    def as_json(self) -> dict[str, Any]:
        """As the command line prints it."""
        case, near = self.case, self.beside
        return {
            "case": case and {"name": case.name, "asks": case.asks},
            "beside": near and near.as_json(),
            "compared": {n: {"start": a, "end": b} for n, (a, b) in self.ends.items()},
            "extremes": {name: found.as_json() for name, found in self.extremes.items()},
        }

    def lines(self) -> Iterator[str]:
        """The same as lines of text."""
        if self.case is not None:
            yield from wrapped("case", f"{self.case.name}: {self.case.asks}".split())
        if self.beside is not None:
            yield from wrapped("begins beside", self._beside_words(self.beside))
        for label, (name, values) in zip(_labels("start, end"), self.ends.items(), strict=False):
            before, after = (self._shown(name, value) for value in values)
            yield from wrapped(label, [f"{name} = {before} at the start, {after} at the end"])
        for label, (name, found) in zip(_labels("extremes"), self.extremes.items(), strict=False):
            least = f"{self._shown(name, found.least)} at {found.least_at:.4g} s"
            most = f"{self._shown(name, found.greatest)} at {found.greatest_at:.4g} s"
            yield from wrapped(label, [f"{name} from {least}", f"to {most}"])

    def _beside_words(self, near: StartingBeside) -> Iterator[str]:
        yield f"{near.family}:"
        yield f"{near.condition},"
        yield f"which is {'' if near.is_stable else 'not '}so here."
        for name, (begun, far) in near.departures.items():
            if not begun:
                continue
            start, most = self._shown(name, begun), self._shown(name, far)
            goes = "stays within" if far < _CLOSE * begun else "leaves it by up to"
            yield f"{name} begins {start} from it and"
            yield f"{goes} {most}."

    def _shown(self, name: str, value: float) -> str:
        """A value with its unit; angles in degrees, and rounding as zero."""
        known = self.extremes.get(name)
        size = max(abs(known.least), abs(known.greatest)) if known else 1.0
        value = 0.0 if abs(value) < _ROUNDING * max(size, 1.0) else value
        unit = unit_of(self.motion, name)
        if unit == "rad":
            return f"{value * 180 / pi:.{_DIGITS}g} deg"
        return f"{value:.{_DIGITS}g} {unit}".rstrip()


def _ends(motion: Trajectory, name: str) -> tuple[float, float]:
    """A quantity at the start and at the end of a motion."""
    first, last = motion.evaluate(name, np.array([0.0, float(motion.duration)]))
    return float(first), float(last)


def _labels(first: str) -> Iterator[str]:
    """A label for the first line of several."""
    return chain([first], repeat(""))


def course_of(
    case: RunCase | None,
    watch: Sequence[str],
    equations: Equations,
    motion: Trajectory,
    start: Mapping[str, float],
) -> Course:
    """What became of a motion that answers a question, or of quantities to be watched.

    Raises:
        DeclarationError: for a quantity that the system does not have.
    """
    watched = dict.fromkeys((*(case.watch if case else ()), *watch))
    compared = case.compare if case else ()
    near = case.beside if case else {}
    return Course(
        motion,
        case,
        beside(equations, motion, near, start) if near else None,
        {name: _ends(motion, name) for name in compared},
        {name: extremes(motion, name) for name in watched},
    )

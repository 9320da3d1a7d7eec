"""Steady motions and thresholds of a system, and where a state stands relative to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import isfinite, prod
from typing import Any

import numpy as np

from polhode.algebra import FLOATS, Expr, Generator, Symbol, compile_program
from polhode.analyse import Branch, Condition, Stability, SteadyMotion, Truth, stability, steady
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.lab._controls import unit_of
from polhode.view import typeset

_LARGEST = 1e15
_REMEMBERED = 512  # formulas
_LONGEST = 1500  # letters of a formula that is still shown
Values = Mapping[str, float]


@dataclass(frozen=True)
class Family:
    """A family of steady motions with what is known of its stability."""

    motion: SteadyMotion

    @cached_property
    def judged(self) -> Stability | NumericError:
        """Its stability, or why the coordinates cannot tell."""
        try:
            return stability(self.motion)
        except NumericError as undecided:
            return undecided

    def standing(self, state: Values) -> dict[str, Any]:
        """The family as plain data, with every quantity's value at a state.

        Args:
            state: parameters, coordinates and speeds in SI units, by published name.
        """
        here = {**state, **self._held(state)}
        document: dict[str, Any] = {
            "formula": _formula(self.motion.latex()),
            "spoken": str(self.motion)[:_LONGEST],
            "on": _finite(self._distance(state)),
            "branches": [self._branch(branch, here) for branch in self.motion.branches],
            "set": {n: v for n, v in self._held(state).items() if isfinite(v)},
        }
        if isinstance(self.judged, NumericError):
            return document | {"undecided": str(self.judged), "conditions": [], "frequencies": []}
        return document | {
            "stable": self.judged.truth.value,
            "conditions": [_condition(c, here) for c in self.judged.conditions],
            "frequencies": [_named(e, here) for e in self.judged.frequencies],
            "growth": [_named(e, here) for e in self.judged.growth],
            "loss": self.judged.loss,
        }

    def _branch(self, branch: Branch, here: Values) -> dict[str, Any]:
        name, equations = branch.quantity.symbol, self.motion.reduced.equations
        return {
            "formula": _formula(f"{branch.quantity.latex()} = {branch.value.latex()}"),
            "name": name.published if name else "",
            "unit": unit_of(name, equations) if name else "",
            "value": _finite(_value(branch.value, here)),
        }

    def _held(self, state: Values) -> dict[str, float]:
        """What has a definite value on the family."""
        return {s.published: _value(e, state) for s, e in self.motion.fixed.items()}

    def _distance(self, state: Values) -> float:
        """How far a state is from the family: the largest of what vanishes on it, each against
        the sizes of its terms with sines and cosines left out."""
        return max((_departure(e, state) for e in self.motion.conditions), default=0.0)


def _departure(expression: Expr, state: Values) -> float:
    known = {"pi": np.pi, **state}
    size = sum(
        abs(number) * prod(abs(known.get(g.published, 0.0)) ** p for g, p in _symbols(powers))
        for powers, number in expression.numerator.terms()
    )
    return abs(_value(expression.numerator, state)) / size if size else 0.0


def _symbols(powers: Mapping[Generator, int]) -> Iterator[tuple[Symbol, int]]:
    return ((g, power) for g, power in powers.items() if isinstance(g, Symbol))


def families_of(equations: Equations) -> list[Family]:
    """All families; none where there is no steady motion or none can be found."""
    try:
        return [Family(motion) for motion in steady(equations)]
    except PolhodeError:
        return []


def _condition(condition: Condition, here: Values) -> dict[str, Any]:
    """An inequality, and the ratio of what speaks for it to what speaks against it.

    The threshold is where the ratio is one.
    """
    if condition.truth is not Truth.OPEN:
        return {"formula": "", "spoken": condition.truth.value, "ratio": None}
    terms = [_value(term, here) for term in _terms(condition.expression)]
    above, below = sum(t for t in terms if t > 0), -sum(t for t in terms if t < 0)
    ratio = above / below if below else float("inf")
    return {
        "formula": _formula(condition.latex()),
        "spoken": str(condition)[:_LONGEST],
        "holds": above > below,
        "ratio": _finite(ratio),
    }


def _terms(expression: Expr) -> Iterator[Expr]:
    for powers, number in expression.numerator.terms():
        factors = (Expr.generator(generator) ** power for generator, power in powers.items())
        yield prod(factors, start=Expr.of(number))


def _named(expression: Expr, here: Values) -> dict[str, Any]:
    value = _finite(_value(expression, here))
    return {"formula": _formula(expression.latex()), "value": value}


@lru_cache(_REMEMBERED)
def _formula(latex: str) -> str:
    return typeset(latex) if len(latex) <= _LONGEST else ""


def _value(expression: Expr, known: Values) -> float:
    """Not a number where it is not defined."""
    symbols = tuple(expression.symbols())
    values = {"pi": np.pi, **known}
    function = compile_program([expression], symbols).function(FLOATS)
    try:
        return float(function(*(values.get(s.published, 0.0) for s in symbols))[0])
    except (ArithmeticError, ValueError):
        return float("nan")


def _finite(value: float) -> float | None:
    """None for what is not defined, or grows beyond what can be meant."""
    return value if isfinite(value) and abs(value) < _LARGEST else None

"""The system of an exercise: its equations, and what is known to hold on it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from math import nan

import numpy as np

from polhode.algebra import (
    PI,
    Expr,
    Symbol,
    SymbolKind,
    compile_program,
    dimension_of,
    pi,
    variables,
)
from polhode.analyse import (
    Invariant,
    Stability,
    SteadyMotion,
    reduced,
    stability,
    steady,
)
from polhode.base import (
    LENGTH,
    PURE,
    TIME,
    Dimension,
    NumericError,
    ParseError,
    PolhodeError,
    UnitError,
    within,
)
from polhode.derive import Equations, is_angle
from polhode.exercise._answers import FormulaAnswer, PartMark
from polhode.exercise._places import places_on_bodies
from polhode.judge import Answer, CheckRequest, Verdict, check
from polhode.model import Body, Rope
from polhode.solution import PATIENCE, Setting, Solution, moving_integrals, solution

#: Characters of a formula that a student can be asked for.
LONGEST = 170
_SPECIAL = (pi / 2, Expr.of(0), pi)


@dataclass(frozen=True, eq=False)
class ExerciseSubject:
    """A system that questions are asked about.

    Attributes:
        equations: derived from the declaration.
        title: heading.
        typical: values of parameters near which numbers are drawn, as text, by published name.
        start: typical values of coordinates and speeds.
        name: by which the command line finds the system.
    """

    equations: Equations
    title: str
    typical: Mapping[str, str]
    start: Mapping[str, str]
    name: str
    _known: dict[tuple[object, ...], Answer] = field(default_factory=dict, repr=False)
    _accepted: dict[FormulaAnswer, bool] = field(default_factory=dict, repr=False)

    @cached_property
    def setting(self) -> Setting:
        """Vectors and frames of the first body."""
        return Setting(self.equations)

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """All bodies."""
        return tuple(self.equations.system.bodies)

    @cached_property
    def worked(self) -> Solution | PolhodeError:
        """The worked solution, or why there is none."""
        try:
            return solution(self.equations)
        except PolhodeError as missing:
            return missing

    @cached_property
    def tensions(self) -> dict[str, Rope]:
        """Ropes by the names of their tensions."""
        restraints = self.equations.kinetics.restraints
        ropes = (e for e in self.equations.system.elements if isinstance(e, Rope))
        return {r.name: rope for rope in ropes for r in restraints[rope.name]}

    # -- judging --------------------------------------------------------------------------------

    def answer(
        self,
        latex: str,
        context: str = "motion",
        let: Sequence[str] = (),
        given: Sequence[str] = (),
        small: Sequence[str] = (),
    ) -> Answer:
        """What is found of a claim, which is judged once; UNREAD where it is not decided."""
        key = (latex, context, tuple(let), tuple(given), tuple(small))
        if key not in self._known:
            positive = tuple(map(str, self.equations.assumed_positive))
            try:
                verdict = check(
                    latex,
                    self.equations,
                    context=context,
                    let=let,
                    given=given,
                    small=small,
                    positive=positive,
                    seconds=PATIENCE,
                )
                self._known[key] = verdict.answer
            except (NumericError, ParseError):
                self._known[key] = Answer.UNREAD
        return self._known[key]

    def holds(
        self,
        latex: str,
        context: str = "motion",
        let: Sequence[str] = (),
        given: Sequence[str] = (),
        small: Sequence[str] = (),
    ) -> bool:
        """Whether a claim is judged to hold."""
        found = self.answer(latex, context, let, given, small)
        return found in (Answer.HOLDS, Answer.APPROXIMATE)

    def fails(self, latex: str) -> bool:
        """Whether a claim about every motion is refuted; no correction is sought."""
        key = (latex, "motion", (), (), ())
        if key not in self._known:
            request = CheckRequest(latex, positive=tuple(map(str, self.equations.assumed_positive)))
            try:
                found = within(
                    PATIENCE, lambda tell: _first_verdict(request, self.equations), advice=""
                )
            except (NumericError, ParseError):
                return False
            self._known[key] = found.answer
        return self._known[key] is Answer.FAILS

    def accepts(self, expected: FormulaAnswer) -> bool:
        """Whether the right answer is marked as right; it is judged once."""
        if expected not in self._accepted:
            found = expected.marked(expected.latex, self.equations).mark
            self._accepted[expected] = found is PartMark.RIGHT
        return self._accepted[expected]

    # -- analysis -------------------------------------------------------------------------------

    @cached_property
    def invariants(self) -> tuple[Invariant, ...]:
        """First integrals; none where they cannot be searched."""
        try:
            return moving_integrals(self.equations)
        except PolhodeError:
            return ()

    @cached_property
    def families(self) -> tuple[SteadyMotion, ...]:
        """Steady motions that a relation ties, and those at special angles that none does."""
        try:
            found = steady(self.equations)
        except (PolhodeError, ZeroDivisionError):
            return ()
        return found

    @cached_property
    def rests(self) -> tuple[Stability, ...]:
        """Stability of the families without a relation, also at special values of an angle."""
        found = {str(f): f for f in (*self.families, *self._at_special_angles())}
        return tuple(filter(None, map(_stability, found.values())))

    def _at_special_angles(self) -> Iterator[SteadyMotion]:
        try:
            essential = reduced(self.equations).essential
        except PolhodeError:
            return
        if len(essential) != 1 or not is_angle(self.equations, essential[0]):
            return
        for value in _SPECIAL:
            try:
                yield from steady(self.equations, {essential[0]: value})
            except (PolhodeError, ZeroDivisionError):
                continue

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """Rates of the essential coordinates and the speeds, in terms of them."""
        system = reduced(self.equations)
        accelerations = self.equations.accelerations
        return (*system.rates, *(accelerations[s.derivative()] for s in system.speeds))

    @cached_property
    def slopes(self) -> tuple[tuple[Expr, ...], ...]:
        """Derivatives of these rates with respect to the essential coordinates and the speeds."""
        state = reduced(self.equations).state
        return tuple(tuple(rate.diff(s) for s in state) for rate in self.rates)

    @cached_property
    def places(self) -> dict[Symbol, Symbol]:
        """Coordinates that matter whose rates are components of a velocity, with these speeds."""
        e = self.equations
        matter = variables([*e.motion, e.energy, e.kinetic_energy])
        rates = {q: e.kinematics[q.derivative()].symbol for q in e.coordinates if q in matter}
        return {q: s for q, s in rates.items() if s in e.speeds and s is not None and not s.order}

    # -- names and dimensions -------------------------------------------------------------------

    def dimension(self, symbol: Symbol) -> Dimension | None:
        """Of a parameter, a coordinate, a speed or an acceleration."""
        base = self.equations.dimensions.get(symbol.base())
        if base is None and symbol.base() in self.equations.coordinates:
            base = PURE
        if base is None and symbol in self._placing:
            base = LENGTH
        return None if base is None else base / TIME**symbol.order

    @cached_property
    def _placing(self) -> frozenset[Symbol]:
        """Parameters that are multiples of places, of which the equations do not tell it."""
        known = dict(self.equations.dimensions)
        places = (at for _, at in places_on_bodies(self.equations.system))
        found = ((c, s) for at in places for c in at.components for s in c.symbols())
        return frozenset(
            s
            for c, s in found
            if s not in known and not s.kind.varies and _is_pure(c.diff(s), known)
        )

    def dimension_of(self, expression: Expr) -> Dimension | None:
        """Of an expression, if it is known."""
        known = {s: d for s in expression.symbols() if (d := self.dimension(s)) is not None}
        return dimension_of(expression, known)

    def is_angle(self, symbol: Symbol) -> bool:
        """Whether a quantity is stated in degrees."""
        return is_angle(self.equations, symbol)

    @cached_property
    def names(self) -> frozenset[str]:
        """Published names that mean something already."""
        e = self.equations
        known = (
            *e.coordinates,
            *e.speeds,
            *e.kinematics,
            *e.dependent,
            *e.parameters,
            *e.functions,
        )
        moments = {f"I_{label}" for label in (*self.setting.axes.labels, "x", "y", "z")}
        forces = {self.setting.force_name(element)[0] for element in self.setting.forced}
        own = {s.published for s in known} | set(e.components)
        return frozenset(own | moments | forces | self.tensions.keys())

    def free_letter(self, *candidates: str) -> str:
        """The first of some published names that means nothing yet."""
        return next(name for name in (*candidates, "Q", "B", "D", "K") if name not in self.names)


def _is_pure(slope: Expr, known: Mapping[Symbol, Dimension]) -> bool:
    if not slope.symbols() <= known.keys():
        return False
    try:
        return dimension_of(slope, known) in (None, PURE)
    except UnitError:
        return False


class _RefutedError(Exception):
    """Ends the judging of a claim as soon as it has failed."""

    def __init__(self, verdict: Verdict) -> None:
        super().__init__(verdict.reason)
        self.verdict = verdict


def _first_verdict(request: CheckRequest, equations: Equations) -> Verdict:
    def refuted(verdict: Verdict) -> None:
        raise _RefutedError(verdict)

    try:
        return request.judged(equations, refuted)
    except _RefutedError as found:
        return found.verdict


def _stability(family: SteadyMotion) -> Stability | None:
    if family.relations:
        return None
    try:
        return stability(family)
    except (PolhodeError, ZeroDivisionError):
        return None


def value_of(expression: Expr, values: Mapping[Symbol, float]) -> float:
    """The value of an expression in doubles; NaN where it is not real.

    Raises `NumericError` for a symbol without a value.
    """
    symbols = sorted((s for s in expression.symbols() if s != PI), key=lambda s: s.published)
    missing = [s.published for s in symbols if s not in values]
    if missing:
        raise NumericError(f"no value for {', '.join(missing)}", expected="a number for each")
    try:
        with np.errstate(all="ignore"):
            return float(_compiled(expression, tuple(symbols))(*(values[s] for s in symbols))[0])
    except (ValueError, ZeroDivisionError, OverflowError):
        return nan


@lru_cache(256)
def _compiled(expression: Expr, symbols: tuple[Symbol, ...]) -> Callable[..., Sequence[float]]:
    """Numbers are drawn many times for the same formulas."""
    return compile_program([expression], symbols).function()


def letters_of(expressions: Sequence[Expr]) -> tuple[str, ...]:
    """LaTeX of the letters in expressions, without dots."""
    found = {s.base() for e in expressions for s in e.symbols() if s.kind is not SymbolKind.TIME}
    return tuple(sorted({Expr.generator(s).latex() for s in found} - {r"\pi"}))


def in_words(text: str) -> str:
    """A name as words: "rolling-disk" as "rolling disk"."""
    return re.sub(r"[-_/]+", " ", text)

"""Inequalities claimed to be equivalent to an exact condition of the system: `threshold`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial, reduce
from itertools import product
from math import pi

import numpy as np

from polhode.algebra import PI, ZERO, Expr, Symbol, SymbolKind, variables
from polhode.analyse import Truth, reduced, stability
from polhode.base import ByIdentity, ParseError, PolhodeError
from polhode.derive import Equations
from polhode.judge._verdict import (
    Answer,
    ComparedCondition,
    Decides,
    Evidence,
    Refuted,
    Residual,
    Verdict,
)
from polhode.judge.contexts._counterexample import example_where
from polhode.judge.contexts._equations import failed, failures
from polhode.judge.contexts._inequality import definite_sign, strict_sign
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.meaning._small_oscillations import circular_parts
from polhode.judge.states._bound_claim import EQUALITY, SENSE, STRICT, BoundClaim
from polhode.judge.states._claim_domain import AnyState, ClaimDomain
from polhode.judge.states._numeric import Array, number
from polhode.judge.states._sample_points import ExactPoint, is_physical, physical_symbols
from polhode.judge.states._steady_states import SteadyStates, steady_states

_SAMPLES = 40  # physical states from which the search for a distinguishing state starts
_DRAWN = 4000  # states drawn, physical or not
_DECADES = 3.0  # by how many powers of ten a value is varied up and down
_STEPS = 240  # values tried on such a line
_BESIDE = 1e-5  # relative distance of neighbours that must distinguish too, to exclude rounding


def judged_threshold(claim: BoundClaim) -> Verdict:
    """Whether the inequalities together are equivalent to an exact condition.

    That is the condition of linear stability of a family of steady motions, with all its parts
    together, or the condition of its existence. If it is even in a speed, the magnitude of that
    speed is meant. Equivalence is proved from signs or refuted by a physical state; if neither
    succeeds, it stays undecided.
    """
    if any(map(claim.says_choice, range(len(claim.members)))):
        raise ParseError("± in a threshold", expected="one sign, or a magnitude")
    signs = [relation.sign for relation in claim.members]
    equalities = [c for c in claim.components() if signs[c.member] in EQUALITY]
    anywhere = claim.states(AnyState)
    wrong = list(failures(claim.only({c.member for c in equalities}), [anywhere]))
    if wrong:
        return failed(wrong, "threshold")
    claimed = [c for c in claim.components() if c not in equalities]
    if others := [signs[c.member] for c in claimed if signs[c.member] not in SENSE]:
        raise ParseError(
            f"the sign {others[0]} in a threshold", expected="one of " + " ".join(SENSE)
        )
    if not claimed:
        raise ParseError("no inequality", expected="one with < or > in the context threshold")
    known = (*exact_conditions(claim), *_existence_in_speeds_of(claimed, claim))
    if not known:
        raise ParseError(
            "a threshold where nothing depends on the parameters",
            expected="a steady motion that is stable or exists under a condition",
            advice="restrict the claim to the motion that is meant",
            option="given",
        )
    compared = [(exact, _comparison(claimed, exact, claim)) for exact in known]
    proved = next((exact for exact, comparison in compared if comparison.is_proved), None)
    if proved is not None:
        return _equivalent(claimed, proved, claim)
    undecided = next((exact for exact, c in compared if c.distinguishing_state is None), None)
    if undecided is None:
        return _of_special_motion(claimed, claim) or _refuted(claimed[0], *compared[0])
    return Verdict(
        Answer.UNREAD,
        "threshold",
        reason=f"it was read, but whether it is equivalent to {undecided} was neither proved nor "
        "refuted",
    )


def _of_special_motion(claimed: Sequence[ScalarRelation], claim: BoundClaim) -> Verdict | None:
    """Ambiguous where it is the condition of motions at an angle that the claim leaves unsaid.

    A text that says "a disk rolls stably for ω₃² > g/3a" means a disk on edge, and k > mgl is that
    of an upright pendulum; without an angle the condition could be meant at any inclination, and is
    false there.
    """
    said = {s for c in claimed for s in c.difference.symbols()} | set(claim.given)
    unsaid = (q for q in reduced(claim.equations).essential if q not in said)
    for coordinate, value in product(unsaid, (Expr.generator(PI) / 2, ZERO)):
        if coordinate not in claim.equations.coordinates:
            continue
        given = {**claim.given, coordinate: value}
        special: tuple[ExactCondition, ...] = ()
        with suppress(PolhodeError):  # no steady motion there, or none that the angles describe
            special = exact_conditions(replace(claim, given=given))
        for exact in special:
            if _comparison(claimed, exact, replace(claim, given=given)).is_proved:
                return Verdict(
                    Answer.AMBIGUOUS,
                    "threshold",
                    reason=f"it holds as {exact}, and fails for steady motions in general; if the "
                    f"former is meant, state it: given {coordinate.published} = {value}",
                    option="given",
                )
    return None


def _equivalent(
    claimed: Sequence[ScalarRelation], exact: ExactCondition, claim: BoundClaim
) -> Verdict:
    """Holds; undecided for ≥ and ≤, since linear stability decides nothing at equality."""
    not_strict = [c for c in claimed if claim.members[c.member].sign not in STRICT]
    if not_strict and exact.decides is Decides.STABILITY:
        return Verdict(
            Answer.UNREAD,
            "threshold",
            reason=f"it was read and is equivalent to {exact}, except at equality, where linear "
            "stability decides nothing; write < or >",
        )
    reason = f"equivalent to {exact}"
    return Verdict(Answer.HOLDS, "threshold", reason, compared=exact.as_compared)


def _refuted(component: ScalarRelation, exact: ExactCondition, comparison: Comparison) -> Verdict:
    residual = Residual(component.member, component.label, component.difference)

    def evidence() -> Evidence:
        """A motion that the inequality allows and the condition does not, or the reverse."""

        def differs(point: ExactPoint) -> bool:
            return bool(comparison.agree(point.floats()) == 0)

        try:
            return example_where(differs, component, residual, exact.states)
        except PolhodeError:
            return None, None

    return Refuted(
        Answer.FAILS,
        "threshold",
        reason=f"not equivalent to {exact}; some motions satisfy one and not the other",
        residuals=(residual,),
        compared=exact.as_compared,
        evidence=evidence,
    )


# -- exact conditions of the model ----------------------------------------------------------------


@dataclass(frozen=True)
class ExactCondition:
    """A condition of the model: several expressions, all of which have to be positive.

    Attributes:
        expressions: what has to be positive.
        decides: stability or existence.
        states: where the condition applies.
        motions: the family of steady motions, if they are one and at a fixed angle.
    """

    expressions: tuple[Expr, ...]
    decides: Decides
    states: ClaimDomain
    motions: str = ""

    def __str__(self) -> str:
        parts = " and ".join(f"{e} > 0" for e in self.expressions)
        motions = f" of the steady motions {self.motions}" if self.motions else ""
        return (
            f"the condition{'s' * (len(self.expressions) > 1)} of {self.decides.value}{motions}, "
            f"{parts}"
        )

    @property
    def as_compared(self) -> ComparedCondition:
        """What a verdict says of it."""
        return ComparedCondition(str(self), self.decides, bool(self.motions))


def exact_conditions(claim: BoundClaim) -> tuple[ExactCondition, ...]:
    """The conditions of the model that a threshold may state, under the restrictions of a claim."""
    given = tuple(claim.given.items())
    return _conditions(ByIdentity(claim.equations), given, claim.relations, claim.positive)


@lru_cache(maxsize=16)
def _conditions(
    key: ByIdentity[Equations],
    given: tuple[tuple[Symbol, Expr], ...],
    relations: tuple[Expr, ...],
    positive: tuple[Expr, ...],
) -> tuple[ExactCondition, ...]:
    """Conditions of stability and of existence, for every family that obeys the restrictions."""
    claim = BoundClaim(((),), key.subject, dict(given), relations, positive=positive)
    anywhere = claim.states(AnyState)
    return tuple(
        condition
        for family in steady_states(claim)
        for condition in (*_stability(family), *_existence(family, anywhere))
    )


def _stability(family: SteadyStates) -> Iterator[ExactCondition]:
    if family.family is None:
        return
    try:
        conditions = stability(family.family).conditions
    except PolhodeError:
        return
    found = tuple(family.on(c.expression) for c in conditions if c.truth is Truth.OPEN)
    if found and all(found):  # one that vanishes is that of a family at the boundary of another
        motions = "" if family.family.relations else str(family.family)
        yield ExactCondition(found, Decides.STABILITY, family, motions)


def _existence(family: SteadyStates, anywhere: AnyState) -> Iterator[ExactCondition]:
    branches = family.family.branches if family.family is not None else ()
    every = (c.expression.subs(dict(family.given)) for b in branches for c in b.exists)
    found = tuple(dict.fromkeys(e for e in every if e.rational is None))
    if found:
        yield ExactCondition(found, Decides.EXISTENCE, anywhere)
    # Of A cos θ + B sin θ + C = 0, that some angle fulfils it: A² + B² > C².
    relations = family.family.relations if family.family is not None else ()
    for relation in (r.subs(dict(family.given)) for r in relations):
        for angle in sorted(relation.symbols() & {*family.equations.coordinates}, key=str):
            if (parts := circular_parts(relation, angle)) is not None and parts[2]:
                by_cosine, by_sine, rest = parts
                inclined = by_cosine**2 + by_sine**2 - rest**2
                yield ExactCondition(
                    (inclined,), Decides.EXISTENCE, replace(anywhere, relations=())
                )


def _existence_in_speeds_of(
    claimed: Sequence[ScalarRelation], claim: BoundClaim
) -> Iterator[ExactCondition]:
    """Conditions for a rate to be real at a given value of the speed that inequalities are about.

    By Euler's angles a top precesses steadily where an equation for φ̇ and ψ̇ has a real root φ̇;
    the condition is one on ω₃ = ψ̇ + φ̇ cos θ or p_ψ if that is what the text holds fixed.
    """
    anywhere = claim.states(AnyState)
    differences = [anywhere.on(c.difference) for c in claimed]
    for family in steady_states(claim):
        if family.family is None or not family.family.branches:
            continue
        rate = family.family.branches[0].quantity.symbol
        (relation,) = family.family.relations
        for difference, speed in product(differences, family.equations.speeds):
            if rate is None or speed == rate or not (by_speed := difference.diff(speed)):
                continue
            share = difference.diff(rate) / by_speed  # of the rate in what is held fixed
            held = Expr.generator(speed) - share * Expr.generator(rate)
            if not share or {rate, speed} & share.symbols():
                continue
            if rate not in difference.subs({speed: held}).symbols():
                turned = replace(family.family, relations=(relation.subs({speed: held}),))
                back = {speed: Expr.generator(speed) + share * Expr.generator(rate)}
                for branch in turned.branches[:1]:
                    found = (c.expression.subs({**family.given, **back}) for c in branch.exists)
                    yield ExactCondition(tuple(found), Decides.EXISTENCE, anywhere)


# -- the two compared -----------------------------------------------------------------------------


@dataclass(frozen=True)
class PrintedBound:
    """One side greater than the other."""

    greater: Expr
    less: Expr


def _comparison(
    claimed: Sequence[ScalarRelation], exact: ExactCondition, claim: BoundClaim
) -> Comparison:
    bounds = []
    for component in claimed:
        sides = [exact.states.on(side) for side in (component.left, component.right)]
        upward = SENSE[claim.members[component.member].sign] > 0
        bounds.append(PrintedBound(*sides) if upward else PrintedBound(*reversed(sides)))
    differences = [bound.greater - bound.less for bound in bounds]
    speeds = {
        s
        for e in differences
        for s in e.symbols()
        if s.kind.varies and not s.positive and (s.order or s.kind is SymbolKind.SPEED)
    }
    # Speeds in which the condition is even, but that the text bounds as if they were positive: the
    # stability of a sleeping top needs ω₃² large, and texts write ω₃ > …
    magnitudes = frozenset(
        s
        for s in speeds
        if all(map(partial(_is_even, s), exact.expressions))
        and not all(map(partial(_is_even, s), differences))
    )
    return Comparison(tuple(bounds), exact.expressions, exact.states, magnitudes)


def _is_even(symbol: Symbol, expression: Expr) -> bool:
    return expression.subs({symbol: -Expr.generator(symbol)}) == expression


@dataclass(frozen=True)
class Comparison:
    """Inequalities of a text compared with conditions of the model, all of them together.

    Attributes:
        claimed: the inequalities, on the states.
        conditions: what has to be positive there.
        states: where they are compared, of physical bodies.
        magnitudes: speeds in which the conditions are even: their magnitudes are meant.
    """

    claimed: tuple[PrintedBound, ...]
    conditions: tuple[Expr, ...]
    states: ClaimDomain
    magnitudes: frozenset[Symbol]

    # -- proof ----------------------------------------------------------------------------------

    @cached_property
    def is_proved(self) -> bool:
        """Whether the conditions follow from the inequalities and the reverse, by signs.

        Each inequality has up to two forms, a - b > 0 and a² - b² > 0; any of them may serve, but
        one choice must serve both ways.
        """
        images = self._positive
        claimed = (PrintedBound(b.greater.subs(images), b.less.subs(images)) for b in self.claimed)
        conditions = tuple(c.subs(images) for c in self.conditions)
        given = [tuple(_forms(bound, self._signs)) for bound in claimed]
        return any(
            all(self._follows(condition, forms) for condition in conditions)
            and all(self._follows(form, conditions) for form in forms)
            for forms in product(*given)
        )

    def _follows(self, conclusion: Expr, premises: Sequence[Expr]) -> bool:
        """Whether an expression is positive wherever the premises are."""
        return strict_sign(conclusion, self._signs) == 1 or any(
            self._is_at_least(conclusion, premise) for premise in premises
        )

    def _is_at_least(self, conclusion: Expr, premise: Expr) -> bool:
        """Whether conclusion = c · premise + r with c > 0 and r ≥ 0.

        Candidates for c are the ratios of any two monomials, so that r has fewer terms.
        """
        if strict_sign(conclusion / premise, self._signs) == 1:
            return True
        denominators = (conclusion.denominator, premise.denominator)
        if any(strict_sign(below, self._signs) != 1 for below in denominators):
            return False
        target, known = conclusion.numerator, premise.numerator
        ratios = (one / other for one, other in product(target.summands(), known.summands()))
        return any(
            strict_sign(ratio, self._signs) == 1 and definite_sign(rest, self._signs) == 1
            for ratio in dict.fromkeys(ratios)
            if (rest := target - ratio * known)
        )

    @cached_property
    def _positive(self) -> dict[Symbol, Expr]:
        """Speeds whose magnitude is meant, each replaced by a positive symbol."""
        named = ((s, Symbol(f"{s.published}_size", positive=True)) for s in self.magnitudes)
        return {s: Expr.generator(magnitude) for s, magnitude in named}

    @cached_property
    def _signs(self) -> tuple[Expr, ...]:
        return tuple(e.subs(self._positive) for e in self.states.signs)

    # -- refutation -----------------------------------------------------------------------------

    def agree(self, values: Mapping[Symbol, Array | float]) -> Array:
        """1 where claim and condition both hold or both fail, 0 where only one holds.

        It is nan where no physical body has these values.
        """
        with np.errstate(all="ignore"):
            sides = [(number(b.greater, values), number(b.less, values)) for b in self.claimed]
            conditions = [number(c, values) for c in self.conditions]
            allowed = np.asarray(is_physical(self.states, values))
            for speed in self.magnitudes:
                allowed = allowed & (np.asarray(values[speed]) > 0)
            for value in (*(v for pair in sides for v in pair), *conditions):
                allowed = allowed & np.isfinite(value)
            claimed = reduce(np.logical_and, (a > b for a, b in sides))
            exactly = reduce(np.logical_and, (c > 0 for c in conditions))
        alike = np.asarray(claimed == exactly, dtype=float)
        return np.asarray(np.where(allowed, alike, np.nan))

    @cached_property
    def _variables(self) -> frozenset[Symbol]:
        sides = (side for bound in self.claimed for side in (bound.greater, bound.less))
        return frozenset(variables([*sides, *self.conditions])) - {PI}

    @cached_property
    def distinguishing_state(self) -> dict[Symbol, float] | None:
        """A state that satisfies only the claim or only the condition; None if none is found."""
        for start in self._starts:
            for symbol in sorted(self._variables, key=lambda s: s.name):
                found = self._beside(start, symbol)
                if found is not None:
                    return found
        return None

    @cached_property
    def _starts(self) -> tuple[dict[Symbol, float], ...]:
        """Physical states, values of which are spread over two decades."""
        random = np.random.default_rng(1)  # a fixed seed, so that verdicts repeat
        needed = (self._variables | physical_symbols(self.states)) - {PI}
        drawn = {s: self._drawn(s, random) for s in sorted(needed, key=lambda s: s.published)}
        known = np.flatnonzero(np.isfinite(self.agree(drawn)))[:_SAMPLES]
        return tuple({s: float(values[i]) for s, values in drawn.items()} for i in known)

    def _drawn(self, symbol: Symbol, random: np.random.Generator) -> Array:
        size = np.asarray(10 ** random.uniform(-1, 1, _DRAWN))
        if symbol.positive or symbol in self.magnitudes:
            return size
        if symbol.kind is SymbolKind.COORDINATE and not symbol.order:
            return np.asarray(random.uniform(-pi, pi, _DRAWN))
        return np.asarray(size * random.choice([-1, 1], _DRAWN))

    def _beside(self, start: Mapping[Symbol, float], symbol: Symbol) -> dict[Symbol, float] | None:
        """A state that satisfies only one, on a line through a start along which one number varies.

        Its neighbours on the line must do so too, lest rounding at a boundary decide.
        """
        line = start[symbol] * 10 ** np.linspace(-_DECADES, _DECADES, _STEPS)
        if not symbol.positive and symbol not in self.magnitudes:
            line = np.concatenate((-line[::-1], line))
        others = {s: np.full(line.shape, value) for s, value in start.items()}
        agreed = [
            self.agree({**others, symbol: line * factor})
            for factor in (1 - _BESIDE, 1.0, 1 + _BESIDE)
        ]
        differing = np.flatnonzero(np.all(np.array(agreed) == 0, axis=0))
        if not len(differing):
            return None
        return {**start, symbol: float(line[differing[len(differing) // 2]])}


def _forms(bound: PrintedBound, signs: Sequence[Expr]) -> Iterator[Expr]:
    """Expressions that are positive exactly where an inequality a > b holds.

    These are a - b; a² - b² if neither side is negative; b² - a² if neither is positive.
    """
    above, below = bound.greater, bound.less
    if above != below:
        yield above - below
    try:
        senses = {definite_sign(side, signs) for side in (above, below) if side}
    except PolhodeError:
        return
    squares = above * above - below * below
    if squares and len(senses) == 1 and senses != {0}:
        yield squares * senses.pop()

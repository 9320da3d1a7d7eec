"""Candidate corrections of claims that are judged as a whole, screened by numbers.

An exact judgement takes milliseconds to seconds; there are hundreds of candidates. A screen holds a
few states, and lets a candidate pass if the claim may be true there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice
from math import pi
from typing import TypeAlias

import numpy as np

from polhode.algebra import PI, Expr, Symbol, SymbolKind
from polhode.judge.contexts._number import judged_number
from polhode.judge.contexts._remainder import SMALLNESS, images_of
from polhode.judge.contexts._steady import steady_roots
from polhode.judge.contexts._threshold import ExactCondition, exact_conditions
from polhode.judge.states._bound_claim import EQUALITY, SENSE, BoundClaim
from polhode.judge.states._claim_domain import ClaimDomain, TrueMotion
from polhode.judge.states._numeric import NO_VALUE, Array, number, numbers
from polhode.judge.states._sample_points import (
    SamplePoints,
    SymbolValues,
    is_physical,
    physical_symbols,
    real_states,
    sample_points,
)
from polhode.judge.states._steady_states import steady_states

#: Whether some members of a claim may be true, by numbers.
Screen = Callable[[BoundClaim, Collection[int]], bool]

_Roots: TypeAlias = tuple[tuple[tuple[Symbol, Expr], ...], ...]

_STATES = 5  # at which a limit is taken; at some of them a root may not be real
_SIZES = (2.0**-4, 2.0**-7)  # of the smallness
_BITS = 3  # between them
_STEP = 0.5  # by how much the order of a remainder has to rise
_ROUNDING = 1e-11  # relative; a remainder of this size is none
_NOTHING = 1e-14  # what is left of terms of order one that cancel
_CLOSE = 1e-7  # relative; of sides that are to be equal
_DRAWN = 1500  # states of a threshold, physical or not


def screens(claim: BoundClaim, context: str) -> Iterator[Screen]:
    """Screens for claims of the same context, the strictest first; without states, all pass.

    In a limit, a correction that also holds for other parameters than those given, such as other
    moments of inertia, comes first.
    """
    running = {s: e for s, e in claim.given.items() if s.kind.varies}
    if context == "limit" and len(running) < len(claim.given):
        yield _screen(replace(claim, given=running), context)
    yield _screen(claim, context)


def _screen(claim: BoundClaim, context: str) -> Screen:
    try:
        return _SCREENS[context](claim)
    except NO_VALUE:
        return _all_pass


def _all_pass(claim: BoundClaim, members: Collection[int]) -> bool:
    return True


# -- limits ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _LimitScreen:
    """Whether the remainders of a claim are of higher order than those of the wrong one.

    Attributes:
        claim: the wrong one.
        near: states near the limit, all of one size of the smallness after those of another.
    """

    claim: BoundClaim
    near: SamplePoints

    def __call__(self, claim: BoundClaim, members: Collection[int]) -> bool:
        """Whether, for every choice of ±, the remainder is smaller on some reading of the claim."""
        roots = self._roots(claim)
        key = frozenset(members), roots
        if key not in self._before:
            self._before[key] = tuple(self._orders(self.claim, members, roots))
        branches = zip(self._before[key], self._orders(claim, members, roots), strict=False)
        return all(any(map(_has_risen, old, new)) for old, new in branches)

    @cached_property
    def _before(self) -> dict[tuple[frozenset[int], _Roots], tuple[list[Array], ...]]:
        return {}

    def _roots(self, claim: BoundClaim) -> _Roots:
        """Values of what a claim gives, a speed or an angle, in steady motion."""
        said = frozenset(s for c in claim.components() if (s := c.left.symbol) is not None)
        if said not in self._found:
            try:
                roots = tuple(steady_roots(self.claim, said, lambda exact: exact))
            except NO_VALUE:
                roots = ()
            self._found[said] = tuple(tuple(root.items()) for root in roots)
        return self._found[said]

    @cached_property
    def _found(self) -> dict[frozenset[Symbol], _Roots]:
        return {}

    def _orders(
        self, claim: BoundClaim, members: Collection[int], roots: _Roots
    ) -> Iterator[list[Array]]:
        """For every choice of ±, the orders of the remainders as printed and on steady roots."""
        for branch in range(len(claim.branches)):
            components = [c for c in claim.components(branch) if c.member in members]
            pairs = [(c.left, c.right) for c in components]
            rooted = ([(a.subs(root), b.subs(root)) for a, b in pairs] for root in map(dict, roots))
            yield [self._of_pairs(each) for each in (pairs, *rooted)]

    def _of_pairs(self, pairs: Sequence[tuple[Expr, Expr]]) -> Array:
        left = self.near.values([one for one, _ in pairs])
        right = self.near.values([other for _, other in pairs])
        rest, size = np.abs(left - right), np.abs(left) + np.abs(right)
        rest[rest <= _ROUNDING * size + _NOTHING] = 0.0
        wide, close = np.split(rest, 2, axis=1)
        with np.errstate(all="ignore"):
            orders = np.log2(wide / close) / _BITS
        orders = np.where(close == 0, np.inf, orders)
        return np.asarray(np.fmin.reduce(orders, axis=1))


def _has_risen(before: Array, after: Array) -> bool:
    if before.shape != after.shape or np.isnan(after).any():
        return False
    rise = np.where(np.isinf(after), np.inf, after - np.where(np.isinf(before), 1e3, before))
    kept = np.isinf(before) & np.isinf(after)
    return bool(((rise > -_STEP) | kept).all() and (rise[~kept] > _STEP).any())


def _limit(claim: BoundClaim) -> Screen:
    states = claim.states(TrueMotion)
    sides = [e for c in claim.components() for e in (c.left, c.right)]
    images = images_of(tuple(claim.small))
    drawn = islice(real_states(states, sides), _STATES)
    free = [_restricted(state.free, claim.given) for state in drawn]
    near = [
        SymbolValues(_scaled(values, images, size), states, seed)
        for size in _SIZES
        for seed, values in enumerate(free)
    ]
    return _LimitScreen(claim, SamplePoints(tuple(near)))


def _restricted(values: dict[Symbol, float], given: Mapping[Symbol, Expr]) -> dict[Symbol, float]:
    """Free values with the restricted ones among them at the values they are given."""
    found = {s: float(number(e, values)) for s, e in given.items() if s in values}
    return {**values, **found}


def _scaled(
    values: dict[Symbol, float], images: dict[Symbol, Expr], size: float
) -> dict[Symbol, float]:
    known = {**values, SMALLNESS: size}
    new = {s: float(number(image, known)) for s, image in images.items() if s in values}
    return {**values, **new}


# -- thresholds -----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Region:
    """Physical states, and at which of them a condition of the model holds.

    Attributes:
        states: where it applies.
        values: of every symbol.
        inside: whether it holds.
    """

    states: ClaimDomain
    values: dict[Symbol, Array]
    inside: Array

    def admits(self, claim: BoundClaim) -> bool:
        """Whether a claim holds at these states just where the condition does."""
        claimed = np.ones_like(self.inside)
        for component in claim.components():
            sides = [self._at(side) for side in (component.left, component.right)]
            sign = claim.members[component.member].sign
            if sign in EQUALITY:
                if not np.allclose(sides[0], sides[1], rtol=_CLOSE, equal_nan=True):
                    return False
            elif sign in SENSE:
                claimed = np.logical_and(claimed, (sides[0] - sides[1]) * SENSE[sign] > 0)
        return bool((claimed == self.inside).all())

    def _at(self, side: Expr) -> Array:
        value = numbers([self.states.on(side)], self.values, self.inside.shape)[0]
        return np.asarray(value)


def _threshold(claim: BoundClaim) -> Screen:
    regions = [_region(claim, exact) for exact in exact_conditions(claim)]

    def admitted(changed: BoundClaim, members: Collection[int]) -> bool:
        return any(region.admits(changed) for region in regions)

    return admitted


def _region(claim: BoundClaim, exact: ExactCondition) -> _Region:
    equations = claim.equations
    symbols = {*equations.parameters, *equations.coordinates, *equations.speeds}
    symbols |= physical_symbols(exact.states)
    symbols |= {s for e in exact.expressions for s in e.symbols()}
    random = np.random.default_rng(1)  # a fixed seed, so that corrections repeat
    # Speeds are drawn positive, since a threshold speaks of their magnitudes.
    values = {
        s: random.uniform(-pi, pi, _DRAWN)
        if s.kind is SymbolKind.COORDINATE and not s.order
        else 10 ** random.uniform(-1, 1, _DRAWN)
        for s in sorted(symbols - {PI}, key=lambda s: s.published)
    }
    allowed = np.broadcast_to(np.asarray(is_physical(exact.states, values)), _DRAWN)
    kept = {s: v[allowed] for s, v in values.items()}
    conditions = numbers([*exact.expressions], kept, (int(allowed.sum()),))
    return _Region(exact.states, kept, np.asarray((conditions > 0).all(axis=0)))


# -- steady motions -------------------------------------------------------------------------------


def _steady(claim: BoundClaim) -> Screen:
    """Whether, at every state of some family of steady motions, one branch of a ± holds."""
    sides = [e for c in claim.components() for e in (c.left, c.right)]
    points = [sample_points(family, sides) for family in steady_states(claim)]
    points = [samples for samples in points if samples.size]

    def may_hold(changed: BoundClaim, members: Collection[int]) -> bool:
        return any(_holds_somehow(changed, members, samples) for samples in points)

    return may_hold


def _holds_somehow(claim: BoundClaim, members: Collection[int], samples: SamplePoints) -> bool:
    wrong = np.full(samples.size, np.inf)
    for branch in range(len(claim.branches)):
        components = [c for c in claim.components(branch) if c.member in members]
        left = samples.values([c.left for c in components])
        right = samples.values([c.right for c in components])
        with np.errstate(all="ignore"):  # a changed side may have no value at some state
            rest = np.abs(left - right) / (np.abs(left) + np.abs(right) + _CLOSE)
        wrong = np.fmin(wrong, rest.max(axis=0))
    return bool((wrong < _CLOSE).all())


# -- numbers --------------------------------------------------------------------------------------


def _has_digits(claim: BoundClaim, members: Collection[int]) -> bool:
    return judged_number(claim).holds


# -- along a motion -------------------------------------------------------------------------------


def _launch(claim: BoundClaim) -> Screen:
    # Deferred: it loads the simulator.
    from polhode.judge.contexts._initial_value import at_start, judged_along

    if claim.when != "initially":
        return lambda changed, members: judged_along(changed).holds
    sides = [e for c in claim.components() for e in (c.left, c.right)]
    start = sample_points(at_start(claim).states(TrueMotion), sides)
    return lambda changed, members: _may_begin(changed, members, start)


def _may_begin(claim: BoundClaim, members: Collection[int], start: SamplePoints) -> bool:
    """Whether equations hold at the start, and inequalities do or have equal sides there."""
    for component in claim.components():
        if component.member in members:
            left, right = start.values([component.left, component.right])
            close = _CLOSE * (np.abs(left) + np.abs(right) + _CLOSE)
            sign = claim.members[component.member].sign
            over = (right - left) * SENSE[sign] if sign in SENSE else np.abs(left - right)
            if not (over <= close).all():
                return False
    return True


_SCREENS: dict[str, Callable[[BoundClaim], Screen]] = {
    "limit": _limit,
    "threshold": _threshold,
    "number": lambda claim: _has_digits,
    "steady": _steady,
    "launch": _launch,
}

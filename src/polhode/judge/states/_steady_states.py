"""Steady motions as domains of claims."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

from polhode.algebra import PI, ZERO, Expr, Symbol, eliminate
from polhode.analyse import SteadyMotion, steady
from polhode.base import ByIdentity, NumericError
from polhode.derive import Equations
from polhode.judge.states._bound_claim import BoundClaim
from polhode.judge.states._claim_domain import TrueMotion

_KEPT = 64


@dataclass(frozen=True)
class SteadyStates(TrueMotion):
    """The states of one family: its fixed values, its relations, all accelerations zero."""

    family: SteadyMotion | None = None

    @cached_property
    def resting(self) -> frozenset[Symbol]:
        """Angles that stay at a fixed value, such as 0, and rates of cyclic ones that are zero."""
        if self.family is None or self.family.relations:
            return frozenset()
        essential = self.family.reduced.essential
        rates = {q.derivative() for q in self.equations.coordinates if q not in essential}
        free = {q: value for q, value in self._fixed.items() if q not in self.given}
        still = {q for q, value in free.items() if q in rates and value == ZERO}
        return frozenset(
            still | {q for q, v in free.items() if q in essential and v.symbols() <= {PI}}
        )

    @property
    def speed_relations(self) -> tuple[Expr, ...]:
        """What vanishes in these motions, values that depend on other speeds or angles included."""
        values = (Expr.generator(s) - v for s, v in self._fixed.items() if v.varies)
        return (*self.settled_relations, *values)

    def _settled(self, expression: Expr) -> Expr:
        return super()._settled(expression.subs(self._at_rest)).subs(self._fixed)

    def _field_states(self) -> None:
        return None  # its relations between speeds and angles need not be linear

    @cached_property
    def _fixed(self) -> dict[Symbol, Expr]:
        return dict(self.family.fixed) if self.family else {}

    @cached_property
    def _at_rest(self) -> dict[Symbol, Expr]:
        """Accelerations of all independent speeds."""
        return dict.fromkeys(self.equations.acceleration_symbols, ZERO)


def steady_states(claim: BoundClaim) -> tuple[SteadyStates, ...]:
    """Every family of steady motions that obeys the claim's own restrictions.

    Families at which the coordinates are singular are left out: for an upright axis, precession and
    spin cannot be told apart. Raises `NumericError` where no other is left, since any claim would
    hold on none.
    """
    given = tuple(claim.given.items())
    return _families(ByIdentity(claim.equations), given, claim.relations, claim.positive)


@lru_cache(maxsize=_KEPT)
def _families(
    key: ByIdentity[Equations],
    given: tuple[tuple[Symbol, Expr], ...],
    relations: tuple[Expr, ...],
    positive: tuple[Expr, ...],
) -> tuple[SteadyStates, ...]:
    found = []
    for family in steady(key.subject, dict(given)):
        rows = [[entry.subs(family.fixed) for entry in row] for row in key.subject.mass.rows]
        # Coordinates are singular where the mass matrix is.
        is_singular = bool(rows) and bool(eliminate(rows, [ZERO] * len(rows)).free)
        if not is_singular:
            vanishing = (*family.relations, *relations)
            # g = l φ̇² cos θ says that cos θ is positive.
            symbols = {s for relation in family.relations for s in relation.symbols()}
            known = sorted((s for s in symbols if s.positive), key=str)
            signs = (*positive, *map(Expr.generator, known))
            found.append(SteadyStates(key.subject, dict(given), vanishing, signs, family))
    if not found:
        raise NumericError(
            "restrictions under which the coordinates are singular in every steady motion",
            expected="an angle at which the motion determines their rates",
            advice="judge the claim in the context limit, with the angle small",
        )
    return tuple(found)

"""How a changed statement is read, and which residuals must vanish for it to hold."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Protocol

from polhode.algebra import Expr
from polhode.judge.contexts._remainder import vanished
from polhode.judge.contexts._steady import solved_members
from polhode.judge.latex._tree import Node, Statement
from polhode.judge.meaning._meaning import Side
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim
from polhode.judge.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.judge.states._sample_points import SamplePoints, sample_points
from polhode.judge.states._steady_states import steady_states


class RepairNotation(Protocol):
    """The part of a notation that repair uses to read statements."""

    def read_claim(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes; `extra` are further letters it may use."""

    def value(self, node: Node, extra: Mapping[str, Expr] = MappingProxyType({})) -> Side:
        """The meaning of one node; `extra` are further letters in it."""

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters of the text, with their dots, that a correction may use."""

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters that may stand for vectors, and that a correction may use."""


@dataclass(frozen=True)
class AtLimit:
    """Reads statements of order zero at the limit itself, where all small quantities vanish.

    Attributes:
        notation: reads them near the limit.
        claim: the claim that states the small quantities.
    """

    notation: RepairNotation
    claim: BoundClaim

    def read_claim(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes there."""
        near = self.notation.read_claim(statement, extra)
        return replace(near, given={**near.given, **vanished(self.claim.small)}, small=())

    def near(self, there: BoundClaim) -> BoundClaim:
        """The same claim near the limit."""
        return replace(there, given=self.claim.given, small=self.claim.small)

    def value(self, node: Node, extra: Mapping[str, Expr] = MappingProxyType({})) -> Side:
        """The meaning of one node."""
        return self.notation.value(node, extra)

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters that a correction may use."""
        return self.notation.names

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters of vectors that a correction may use."""
        return self.notation.vectors


# -- residuals ------------------------------------------------------------------------------------

#: Residuals of a claim, each with the member it belongs to.
Residuals = Callable[[BoundClaim], list[tuple[int, Expr]]]


@dataclass(frozen=True, eq=False)
class Trials:
    """Expressions that vanish where a claim holds, and states to try them at.

    Attributes:
        states: where the claim should hold.
        samples: some of these states by numbers.
        residuals: gives those of any claim of the same form, such as a corrected one.
    """

    states: ClaimDomain
    samples: SamplePoints
    residuals: Residuals

    def vanishing(self, claim: BoundClaim, members: Collection[int]) -> list[Expr]:
        """The residuals of some members of a claim."""
        return [e for m, e in self.residuals(claim.only(members)) if m in members]


def trials(claim: BoundClaim, context: str) -> Trials:
    """Residuals and sample states of a claim, by its context."""
    return _TRIALS[context](claim)


def _on(states: ClaimDomain, claim: BoundClaim, residuals: Residuals) -> Trials:
    return Trials(states, sample_points(states, [e for _, e in residuals(claim)]), residuals)


def _differences(claim: BoundClaim) -> list[tuple[int, Expr]]:
    return [(component.member, component.difference) for component in claim.components()]


def _steady(claim: BoundClaim) -> Trials:
    """Differences of the sides in steady motion; for a member that gives a speed by a root, the
    relation between steady speeds with that root put in."""
    family, *_ = steady_states(claim)
    if not solved_members(claim, 0):
        return _on(family, claim, _differences)
    relations = [r.numerator for r in family.settled_relations]

    def relations_met(changed: BoundClaim) -> list[tuple[int, Expr]]:
        solved = solved_members(changed, 0)
        return [(s.member, r.subs({s.quantity: s.value})) for s in solved for r in relations]

    return _on(claim.states(TrueMotion), claim, relations_met)


def _launch(claim: BoundClaim) -> Trials:
    # Deferred: it loads the simulator.
    from polhode.judge.contexts._initial_value import at_start, sample_points_along

    if claim.when == "initially" and all(r.sign in EQUALITY for r in claim.members):
        return _on(at_start(claim).states(TrueMotion), claim, _differences)
    states, samples = sample_points_along(claim)
    return Trials(states, samples, _differences)


_TRIALS: dict[str, Callable[[BoundClaim], Trials]] = {
    "identity": lambda claim: _on(claim.states(AnyState), claim, _differences),
    "motion": lambda claim: _on(claim.states(TrueMotion), claim, _differences),
    "steady": _steady,
    "launch": _launch,
}

#: Contexts in which residuals can be fitted.
FITTED = tuple(_TRIALS)

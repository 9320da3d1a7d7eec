"""What must vanish for a claim to hold, in each context, at states where to try it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from polhode.algebra import Expr
from polhode.claims.contexts._remainder import vanished
from polhode.claims.contexts._steady import solved_members
from polhode.claims.latex._tree import Node, Statement
from polhode.claims.meaning._components import Side
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._claim_domain import AnyState, ClaimDomain, TrueMotion
from polhode.claims.states._sample_points import SamplePoints, sample_points
from polhode.claims.states._steady_states import steady_states

# What repair needs to know of how a statement is read.


class RepairNotation(Protocol):
    """What repair needs to know of how a statement is read."""

    def asked(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes; `extra` are further letters it may use."""
        ...

    def value(self, node: Node) -> Side:
        """What one node stands for."""
        ...

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters of the text, with their dots, that a correction may use."""
        ...

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters that may stand for vectors, and that a correction may use."""
        ...


_CLOSE = 1e-7

#: What must vanish, with the member of the claim it belongs to.
Residuals = Callable[[BoundClaim], list[tuple[int, Expr]]]


@dataclass(frozen=True, eq=False)
class Trials:
    """Expressions that vanish where a claim holds, and states to try them at.

    Attributes:
        states: the circumstances.
        bench: numbers of some of the states.
        residuals: of any claim of the same form, such as a corrected one.
    """

    states: ClaimDomain
    bench: SamplePoints
    residuals: Residuals

    def left(self, asked: BoundClaim, members: Collection[int]) -> list[Expr]:
        """What must vanish for some of the members of a claim."""
        return [e for m, e in self.residuals(asked.only(members)) if m in members]


def trials(asked: BoundClaim, context: str) -> Trials:
    """Where a claim can be tried, by its context."""
    return _TRIALS[context](asked)


def _on(states: ClaimDomain, asked: BoundClaim, residuals: Residuals) -> Trials:
    return Trials(states, sample_points(states, [e for _, e in residuals(asked)]), residuals)


def _differences(asked: BoundClaim) -> list[tuple[int, Expr]]:
    return [(component.member, component.difference) for component in asked.components()]


def _identity(asked: BoundClaim) -> Trials:
    return _on(asked.states(AnyState), asked, _differences)


def _motion(asked: BoundClaim) -> Trials:
    return _on(asked.states(TrueMotion), asked, _differences)


def _steady(asked: BoundClaim) -> Trials:
    family, *_ = steady_states(asked)
    if not solved_members(asked, 0):
        return _on(family, asked, _differences)
    states = asked.states(TrueMotion)
    relations: Sequence[Expr] = [r.numerator for r in family.settled_relations]

    def put_in(changed: BoundClaim) -> list[tuple[int, Expr]]:
        pairs = solved_members(changed, 0)
        return [(p.member, r.subs({p.quantity: p.value})) for p in pairs for r in relations]

    return _on(states, asked, put_in)


def _launch(asked: BoundClaim) -> Trials:
    from polhode.claims.contexts._initial_value import sample_points_along  # it needs the simulator

    states, bench = sample_points_along(asked)
    return Trials(states, bench, _differences)


_TRIALS: dict[str, Callable[[BoundClaim], Trials]] = {
    "identity": _identity,
    "motion": _motion,
    "steady": _steady,
    "launch": _launch,
}

#: Contexts in which what is left can be fitted.
FITTED = tuple(_TRIALS)


# Claims to order zero read where what is small has vanished.


@dataclass(frozen=True)
class AtLimit:
    """How statements are read at the limit itself.

    Attributes:
        reading: how they are read near it.
        claim: whose small quantities vanish.
    """

    reading: RepairNotation
    claim: BoundClaim

    def asked(self, statement: Statement, extra: Mapping[str, Expr]) -> BoundClaim:
        """The claim a statement makes there."""
        near = self.reading.asked(statement, extra)
        return replace(near, given={**near.given, **vanished(self.claim.small)}, small=())

    def near(self, there: BoundClaim) -> BoundClaim:
        """The same claim near the limit."""
        return replace(there, given=self.claim.given, small=self.claim.small)

    def value(self, node: Node) -> Side:
        """What one node stands for."""
        return self.reading.value(node)

    @property
    def names(self) -> tuple[Node, ...]:
        """Letters that a correction may use."""
        return self.reading.names

    @property
    def vectors(self) -> tuple[Node, ...]:
        """Letters of vectors that a correction may use."""
        return self.reading.vectors

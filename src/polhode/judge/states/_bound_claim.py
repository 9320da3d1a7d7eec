"""A claim bound to a system, ready to be judged."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TypeVar, cast

from polhode.algebra import ZERO, Expr, Symbol
from polhode.base import ByIdentity
from polhode.derive import Equations
from polhode.judge.latex._tree import Node
from polhode.judge.meaning._initial_values import InitialValues
from polhode.judge.meaning._relations import BoundRelation, ScalarRelation, components
from polhode.judge.states._claim_domain import ClaimDomain

States = TypeVar("States", bound=ClaimDomain)

_KEPT = 64

#: Signs that claim the equality of both sides.
EQUALITY = ("=", "≡")
#: The sign of left - right that each relation sign claims.
SENSE = {">": 1, "≥": 1, "<": -1, "≤": -1}
#: Of these, the signs that exclude equality.
STRICT = (">", "<")
#: Signs that compare magnitudes in a limit; they bound nothing.
MAGNITUDES = ("≫", "≪")


@dataclass(frozen=True)
class Small:
    """A quantity that is taken as small.

    Attributes:
        quantity: it vanishes in the limit: θ - π/2, Ω, or 1/ω for a large ω.
        order: highest power of it that the claim keeps; None if no order is stated.
        symbol: what is eliminated by it, where several symbols could be; None for the first.
    """

    quantity: Expr
    order: int | None = None
    symbol: Symbol | None = None


@lru_cache(maxsize=_KEPT)
def restricted_states(
    kind: type[ClaimDomain],
    key: ByIdentity[Equations],
    given: tuple[tuple[Symbol, Expr], ...],
    relations: tuple[Expr, ...],
    positive: tuple[Expr, ...],
) -> ClaimDomain:
    """The states, kept because reducing expressions on them takes most of the time.

    The value given to a reaction, or to a speed that the constraints determine, restricts the
    motion like any other relation.
    """
    states = kind(key.subject, dict(given), relations, positive)
    values = {s: e for s, e in given if states.determines(s)}
    if not values:
        return states
    relations = (*relations, *(Expr.generator(s) - e for s, e in values.items()))
    return kind(key.subject, {s: e for s, e in given if s not in values}, relations, positive)


@dataclass(frozen=True)
class BoundClaim:
    """A claim and where it should hold.

    Attributes:
        branches: the members of the claim; two tuples of them where it says ±.
        equations: of the system.
        given: symbols restricted to values.
        relations: further expressions that vanish, such as L² - 2 I₂ T.
        small: quantities that are small.
        positive: expressions that the text takes as positive.
        digits: for every member, half a unit of the last printed digit of a number.
        start: for claims about a motion, initial values.
        when: for statements about a motion, when they hold: always, never, sometimes, initially,
            finally.
        defined: letters that the claim itself defines; their definitions are not members.
        initial: the start that it speaks of by initial values; its relations are among the others.
    """

    branches: tuple[tuple[BoundRelation, ...], ...]
    equations: Equations
    given: Mapping[Symbol, Expr] = field(default_factory=dict)
    relations: tuple[Expr, ...] = ()
    small: tuple[Small, ...] = ()
    positive: tuple[Expr, ...] = ()
    digits: Mapping[int, Expr] = field(default_factory=dict)
    start: Mapping[Symbol, Expr] = field(default_factory=dict)
    when: str = ""
    defined: tuple[Node, ...] = ()
    initial: InitialValues = field(default_factory=InitialValues)

    @property
    def members(self) -> tuple[BoundRelation, ...]:
        """The members, on the first branch."""
        return self.branches[0]

    def components(self, branch: int = 0) -> tuple[ScalarRelation, ...]:
        """All members of a branch, component by component."""
        numbered = enumerate(self.branches[branch])
        return tuple(c for i, r in numbered for c in components(i, r.left, r.right))

    def says_choice(self, member: int) -> bool:
        """Whether ± makes a member differ from branch to branch."""
        first, *others = (branch[member] for branch in self.branches)
        return any(other.left != first.left or other.right != first.right for other in others)

    def states(self, kind: type[States]) -> States:
        """The states of a kind on which the claim should hold."""
        given = tuple(self.given.items())
        found = restricted_states(
            kind, ByIdentity(self.equations), given, self.relations, self.positive
        )
        return cast(States, found)

    def only(self, members: Collection[int]) -> BoundClaim:
        """The claim of some members alone; the others become 0 = 0, so that numbers stay."""
        branches = tuple(
            tuple(r if i in members else NOTHING for i, r in enumerate(branch))
            for branch in self.branches
        )
        return replace(self, branches=branches)


#: The relation 0 = 0, in place of a member that is judged elsewhere.
NOTHING = BoundRelation(ZERO, "=", ZERO)

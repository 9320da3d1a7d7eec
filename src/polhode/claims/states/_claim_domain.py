"""The states on which a context asks a claim to hold."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.meaning._meaning import with_signs
from polhode.claims.states._elimination import eliminated
from polhode.claims.states._rates import on_constraints, on_motion
from polhode.derive import Equations

_KEPT = 1024


@dataclass(frozen=True)
class ClaimDomain(ABC):
    """A set of states, and what expressions are on them.

    Attributes:
        equations: of the system.
        given: symbols that the claim itself restricts to values, such as θ = π/2.
        relations: further expressions that vanish, such as L² - 2 I₂ T.
        positive: what the text takes as positive besides.
    """

    equations: Equations
    given: Mapping[Symbol, Expr] = field(default_factory=dict)
    relations: tuple[Expr, ...] = ()
    positive: tuple[Expr, ...] = ()

    def on(self, expression: Expr) -> Expr:
        """An expression on these states; zero exactly where it vanishes on all of them."""
        known = self._found
        if expression not in known:
            if len(known) >= _KEPT:
                known.clear()
            found = self._on(expression)
            known[expression] = with_signs(found, self._known_signs) if self.positive else found
        return known[expression]

    @cached_property
    def _found(self) -> dict[Expr, Expr]:
        """What was found for expressions; the same ones are asked for again and again."""
        return {}

    def of(self, symbol: Symbol) -> Expr:
        """One symbol on these states."""
        if symbol not in self._images:
            self._images[symbol] = self.on(Expr.generator(symbol))
        return self._images[symbol]

    @cached_property
    def _images(self) -> dict[Symbol, Expr]:
        return {}

    def _on(self, expression: Expr) -> Expr:
        try:
            settled = self._settled(expression.subs(self._given_parameters))
            restricted = settled.subs(self.given)
        except ZeroDivisionError:
            raise NumericError(
                f"the restriction {self._restriction}, where a denominator vanishes",
                expected="a restriction under which all terms stay finite",
            ) from None
        return eliminated(restricted, self.settled_relations)

    @abstractmethod
    def _settled(self, expression: Expr) -> Expr:
        """With everything replaced that these states determine."""

    @cached_property
    def settled_relations(self) -> tuple[Expr, ...]:
        """What vanishes on these states besides, in terms of what is left open."""
        return tuple(self._settled(r.subs(self.given)).subs(self.given) for r in self.relations)

    @cached_property
    def signs(self) -> tuple[Expr, ...]:
        """All that is positive on these states; what a restriction makes vanish is not."""
        told = (*self.equations.assumed_positive, *self.positive)
        return tuple(e for e in told if self.on(e))

    @cached_property
    def _known_signs(self) -> tuple[Expr, ...]:
        return (*self.positive, *map(self._on, self.positive))

    @cached_property
    def _given_parameters(self) -> dict[Symbol, Expr]:
        return {s: e for s, e in self.given.items() if not s.kind.varies}

    @property
    def _restriction(self) -> str:
        return ", ".join(f"{s.published} = {e}" for s, e in self.given.items())

    @cached_property
    def _reactions(self) -> dict[Symbol, Expr]:
        """Reaction components that Newton's laws determine."""
        names = {Symbol(name): reaction_symbol(name) for name in self.equations.components}
        values = (_renamed(value, names) for value in self.equations.components.values())
        found = zip(names.values(), values, strict=True)
        return {symbol: value for symbol, value in found if value.symbol != symbol}


def _renamed(expression: Expr, names: Mapping[Symbol, Symbol]) -> Expr:
    """With other symbols of the same names, so that both do not meet in one expression."""
    images = {g: names.get(g, g) if isinstance(g, Symbol) else g for g in expression.generators}
    return expression.recast({g: Expr.generator(image) for g, image in images.items()})


@dataclass(frozen=True)
class AnyState(ClaimDomain):
    """All states that obey the constraints and their derivatives; forces and accelerations free."""

    def _settled(self, expression: Expr) -> Expr:
        return on_constraints(expression, self.equations)


@dataclass(frozen=True)
class TrueMotion(ClaimDomain):
    """All states with the accelerations and reactions of the motion."""

    def _settled(self, expression: Expr) -> Expr:
        forces = {s for s in expression.symbols() if s.base() in self._reactions}
        return on_motion(expression.subs({s: self._force(s) for s in forces}), self.equations)

    def _force(self, symbol: Symbol) -> Expr:
        """A reaction component on the motion, or one of its rates."""
        value = on_motion(self._reactions[symbol.base()], self.equations)
        for _ in range(symbol.order):
            value = on_motion(self.equations.rate(value), self.equations)
        return value

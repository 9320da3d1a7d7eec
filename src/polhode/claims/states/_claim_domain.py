"""The states on which a claim is asked to hold, and what expressions are on them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod

from polhode.algebra import ONE, Expr, Symbol, factors, is_positive
from polhode.base import NumericError
from polhode.claims.balance._declared import reaction_symbol
from polhode.claims.meaning._meaning import with_signs
from polhode.derive import Equations

_KEPT = 1024  # expressions


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
        known = self._reduced
        if expression not in known:
            if len(known) >= _KEPT:
                known.clear()
            found = self._on(expression)
            known[expression] = with_signs(found, self._known_signs) if self.positive else found
        return known[expression]

    @cached_property
    def _reduced(self) -> dict[Expr, Expr]:
        """Expressions and what they are on these states: the same ones occur again and again."""
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
        # parameters first: accelerations and reactions are much shorter once they are given
        parameters = {s: e for s, e in self.given.items() if not s.kind.varies}
        try:
            settled = self._settled(expression.subs(parameters))
            restricted = settled.subs(self.given)
        except ZeroDivisionError:
            restriction = ", ".join(f"{s.published} = {e}" for s, e in self.given.items())
            raise NumericError(
                f"the restriction {restriction}, which makes a denominator vanish",
                expected="a restriction under which all terms stay finite",
            ) from None
        return eliminated(restricted, self.settled_relations)

    @abstractmethod
    def _settled(self, expression: Expr) -> Expr:
        """The expression with everything replaced that these states determine."""

    @cached_property
    def settled_relations(self) -> tuple[Expr, ...]:
        """The relations in terms of what these states leave open."""
        return tuple(self._settled(r.subs(self.given)).subs(self.given) for r in self.relations)

    @cached_property
    def signs(self) -> tuple[Expr, ...]:
        """All that is positive on these states; what a restriction makes vanish is not."""
        assumed = (*self.equations.assumed_positive, *self.positive)
        return tuple(e for e in assumed if self.on(e))

    @cached_property
    def _known_signs(self) -> tuple[Expr, ...]:
        return (*self.positive, *map(self._on, self.positive))

    @cached_property
    def _reactions(self) -> dict[Symbol, Expr]:
        """Reaction components that Newton's laws determine."""
        names = {Symbol(name): reaction_symbol(name) for name in self.equations.components}
        values = (_renamed(value, names) for value in self.equations.components.values())
        found = zip(names.values(), values, strict=True)
        return {symbol: value for symbol, value in found if value.symbol != symbol}


def _renamed(expression: Expr, names: Mapping[Symbol, Symbol]) -> Expr:
    """With other symbols of the same names, so that both never meet in one expression."""
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
        forces: dict[Symbol, Expr] = {}
        for symbol in (s for s in expression.symbols() if s.base() in self._reactions):
            value = on_motion(self._reactions[symbol.base()], self.equations)
            for _ in range(symbol.order):
                value = on_motion(self.equations.rate(value), self.equations)
            forces[symbol] = value
        return on_motion(expression.subs(forces), self.equations)


# -- rates of any order, in terms of the independent ones -----------------------------------------


def on_constraints(expression: Expr, equations: Equations) -> Expr:
    """With every rate that the constraints give put in terms of independent speeds and their rates.

    Accelerations of the independent speeds stay as they are: no dynamics is used.
    """
    given = {s: e for s in expression.symbols() if (e := _by_constraints(s, equations)) is not None}
    return expression.subs(given) if given else expression


def _by_constraints(symbol: Symbol, equations: Equations) -> Expr | None:
    """What the constraints make of a symbol; None where it is independent."""
    base, motion = symbol.base(), equations.kinetics
    rate = base.derivative()
    if base in equations.dependent:
        value, times = equations.dependent[base], symbol.order
    elif symbol.order and rate in motion.kinematics and rate not in equations.speeds:
        value, times = motion.kinematics[rate], symbol.order - 1
    else:
        return None
    for _ in range(times):
        value = on_constraints(value.chain(motion.rate), equations)
    return value


def on_motion(expression: Expr, equations: Equations) -> Expr:
    """With the accelerations besides replaced by those of the true motion, whatever the order."""
    settled = on_constraints(expression, equations)
    accelerations: dict[Symbol, Expr] = {}
    for symbol in settled.symbols():
        speed = next((s for s in equations.speeds if s.base() == symbol.base()), None)
        if speed is not None and speed.order < symbol.order:
            value = equations.accelerations[speed.derivative()]
            for _ in range(symbol.order - speed.order - 1):
                value = equations.rate(value)
            accelerations[symbol] = value
    return settled.subs(accelerations) if accelerations else settled


# -- expressions where given relations vanish -----------------------------------------------------


def eliminated(expression: Expr, relations: Sequence[Expr]) -> Expr:
    """An expression with one quantity eliminated by each relation that is to vanish.

    Each relation is solved for a quantity that it is linear in; a parameter where possible, so
    that nothing is lost but states where its factor vanishes.

    Raises `NumericError` for a relation that is linear in nothing, and where what is positive by
    declaration would vanish.
    """
    pending = list(relations)
    sizes: dict[Symbol, Expr] = {}  # of what is positive by declaration
    while pending:
        relation = _essential(pending.pop(0))
        if not relation:
            continue
        symbol, value = solved(relation)
        expression = expression.subs({symbol: value})
        pending = [other.subs({symbol: value}) for other in pending]
        sizes = {s: size.subs({symbol: value}) for s, size in sizes.items()}
        if symbol.positive:
            sizes[symbol] = value
        for vanished in (s for s, size in sizes.items() if not size):
            raise NumericError(
                f"conditions that are met only where {vanished.published} vanishes",
                expected="conditions that some body meets",
                advice="restrict angles and speeds one by one, such as theta = pi/2",
            )
    return expression


def _essential(relation: Expr) -> Expr:
    """The factors of a relation that can vanish, each once: a mass is no way to make it hold.

    Raises `NumericError` where no factor can.
    """
    if not relation:
        return relation
    able = [f for f in factors(relation.numerator)[1] if not is_positive(f) and not is_positive(-f)]
    if not able:
        raise NumericError(
            f"the condition {relation} = 0, which nothing meets",
            expected="conditions that do not contradict one another or the model",
        )
    return prod(able, start=ONE).numerator


def solved(relation: Expr) -> tuple[Symbol, Expr]:
    """A symbol that a relation is linear in, and its value where the relation vanishes."""
    candidates = sorted(relation.symbols(), key=lambda s: (s.kind.varies, s.published))
    for symbol in candidates:
        slope = relation.diff(symbol)
        if slope and symbol not in slope.symbols():
            rest = relation - slope * Expr.generator(symbol)
            if symbol not in rest.symbols():
                return symbol, -rest / slope
    raise NumericError(
        f"the relation {relation} = 0",
        expected="one that is linear in some quantity",
        advice="restrict an angle, such as theta = pi/2",
    )

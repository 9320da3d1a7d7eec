"""The states on which a claim should hold, and expressions reduced on them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import prod

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Generator,
    NoResidueError,
    Symbol,
    Vanishing,
    factors,
    is_positive,
    length,
    merged_roots,
    sqrt,
)
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.meaning._meaning import with_signs
from polhode.judge.meaning._mechanics import by_constraints, on_constraints
from polhode.judge.states._field_states import FieldStates

_KEPT = 1024  # reduced expressions; corrections try many that never occur again


@dataclass(frozen=True)
class ClaimDomain(ABC):
    """A set of states, and expressions reduced on them.

    Attributes:
        equations: of the system.
        given: symbols that the claim itself restricts to values, such as θ = π/2.
        relations: further expressions that vanish, such as L² - 2 I₂ T.
        positive: further quantities that the text takes as positive.
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
            found = merged_roots(self._on(expression))
            known[expression] = with_signs(found, self._known_signs) if self.positive else found
        return known[expression]

    def vanishing(self, *factors: Expr) -> Vanishing:
        """Whether a product vanishes on all of these states.

        Decided by exact evaluation at a random state in a prime field, before anything is expanded;
        where that is not possible, by expanding it.
        """
        if not all(factors):
            return Vanishing(True)
        if factors not in self._decided:
            if len(self._decided) >= _KEPT:
                self._decided.clear()
            self._decided[factors] = self._vanishing(factors)
        return self._decided[factors]

    def _vanishing(self, factors: tuple[Expr, ...]) -> Vanishing:
        if self.field is not None:
            try:
                return self.field.vanishing(*factors)
            except (NoResidueError, ZeroDivisionError):
                pass
        return Vanishing(not prod(map(self.on, factors), start=ONE))

    @cached_property
    def _decided(self) -> dict[tuple[Expr, ...], Vanishing]:
        return {}

    @cached_property
    def field(self) -> FieldStates | None:
        """These states in a prime field; None where they obey further relations."""
        return None if self.relations else self._field_states()

    def _field_states(self) -> FieldStates | None:
        return None

    @cached_property
    def closed(self) -> dict[Symbol, Expr]:
        """Values of some quantities, parameters where possible, with which all loops are closed.

        Empty where a closure is linear in no quantity: velocities are then those of loops that stay
        as they are, closed or not.
        """
        found: dict[Symbol, Expr] = {}
        for closure in self.equations.closures:
            gap = closure.subs(self.given).subs(found)
            if not gap:
                continue
            # A loop r φ = 0 closes where φ is zero, and not with a body of no size.
            ways = [way for way in _linear_in(gap) if way[0].kind.varies or way[2]]
            if not ways:
                return {}
            symbol, slope, rest = min(ways, key=lambda way: (way[0].kind.varies, length(way[1])))
            value = -rest / slope
            found = {s: e.subs({symbol: value}) for s, e in found.items()} | {symbol: value}
        return found

    @cached_property
    def _reduced(self) -> dict[Expr, Expr]:
        """Reduced expressions, kept because the same ones occur again and again."""
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
        # Parameters are replaced first: accelerations and reactions are much shorter with them.
        # State variables are replaced last, since rates have to be taken before, not after.
        parameters = {s: e for s, e in self.given.items() if not s.kind.varies}
        try:
            settled = self._settled(expression.subs(parameters))
            restricted = settled.subs(self.given).subs(self._closed_beside_relations)
        except ZeroDivisionError:
            given = ", ".join(f"{s.published} = {e}" for s, e in self.given.items())
            raise NumericError(
                f"the restriction {given}, which makes a denominator vanish"
                if given
                else "a denominator that vanishes on every motion",
                expected="terms that stay finite",
            ) from None
        return self._eliminated(restricted)

    def _eliminated(self, expression: Expr) -> Expr:
        return eliminated(expression, self.settled_relations)

    def determines(self, symbol: Symbol) -> bool:
        """Whether a reaction or a speed has a value on these states, by the others."""
        is_speed = symbol.order < 2 and by_constraints(symbol, self.equations) is not None
        is_named = is_speed or symbol in self._reactions
        return is_named and self._settled(Expr.generator(symbol)).symbol != symbol

    @abstractmethod
    def _settled(self, expression: Expr) -> Expr:
        """The expression with all quantities replaced that these states determine."""

    @cached_property
    def settled_relations(self) -> tuple[Expr, ...]:
        """The relations in terms of the quantities that these states leave free."""
        settled = (self._settled(r.subs(self.given)).subs(self.given) for r in self.relations)
        return tuple(r.subs(self._closed_beside_relations) for r in settled)

    @property
    def _closed_beside_relations(self) -> dict[Symbol, Expr]:
        """With which loops are closed where a relation is eliminated: E = mgl contains heights."""
        return self.closed if self.relations else {}

    @cached_property
    def signs(self) -> tuple[Expr, ...]:
        """The expressions assumed positive, except those that a restriction makes vanish."""
        return tuple(e for e in self.assumed_positive if self.on(e))

    @property
    def assumed_positive(self) -> tuple[Expr, ...]:
        """The expressions assumed positive."""
        return (*self.equations.assumed_positive, *self.positive)

    @cached_property
    def _known_signs(self) -> tuple[Expr, ...]:
        reduced = [*map(self._on, self.positive)]
        return (*self.positive, *reduced, *filter(None, map(_only_sign, reduced)))

    @cached_property
    def _reactions(self) -> dict[Symbol, Expr]:
        """Reaction components that Newton's laws determine."""
        names = {Symbol(name): reaction_symbol(name) for name in self.equations.components}
        values = (_renamed(value, names) for value in self.equations.components.values())
        found = zip(names.values(), values, strict=True)
        return {symbol: value for symbol, value in found if value.symbol != symbol}


def _only_sign(positive: Expr) -> Expr | None:
    """The one factor, positive like the product, whose sign its others leave open."""
    coefficient, powers = factors(positive)
    odd = [f for f, power in powers.items() if power % 2 and not is_positive(f)]
    unknown = [f for f in odd if not is_positive(-f)]
    turns = (coefficient < 0) != bool((len(odd) - len(unknown)) % 2)
    return (-unknown[0] if turns else unknown[0]) if len(unknown) == 1 else None


def _renamed(expression: Expr, names: Mapping[Symbol, Symbol]) -> Expr:
    """The expression with each parameter F replaced by the function of time of the same name.

    Reactions are parameters in `derive` but vary in claims; two symbols of one name must not meet.
    """
    images = {g: names.get(g, g) if isinstance(g, Symbol) else g for g in expression.generators}
    return expression.recast({g: Expr.generator(image) for g, image in images.items()})


@dataclass(frozen=True)
class AnyState(ClaimDomain):
    """All states that obey the constraints and their derivatives; forces and accelerations free."""

    def _settled(self, expression: Expr) -> Expr:
        return on_constraints(expression, self.equations)

    def _field_states(self) -> FieldStates:
        signs = bool(self.positive)
        return FieldStates(self.equations, self.given, {}, False, self.closed, self.on, signs)


@dataclass(frozen=True)
class TrueMotion(ClaimDomain):
    """All states with the accelerations and reactions of the motion."""

    def _settled(self, expression: Expr) -> Expr:
        forces: dict[Symbol, Expr] = {}
        for symbol in (s for s in expression.symbols() if s.base() in self._reactions):
            value = on_motion(self._reactions[symbol.base()], self.equations)
            for _ in range(symbol.order):  # rates of reactions follow along the true motion
                value = on_motion(self.equations.rate(value), self.equations)
            forces[symbol] = value
        return on_motion(expression.subs(forces), self.equations)

    def _field_states(self) -> FieldStates | None:
        signs = bool(self.positive)
        return FieldStates(
            self.equations, self.given, self._reactions, True, self.closed, self.on, signs
        )


@dataclass(frozen=True)
class IrreducibleStates(TrueMotion):
    """True motions on which relations are no products: of these, one factor would be lost."""

    def _eliminated(self, expression: Expr) -> Expr:
        return eliminated(expression, self.settled_relations, self._irreducible)

    def _irreducible(self, relation: Expr) -> Expr:
        found = factors(relation.numerator)[1]
        open_ = [f for f in found if f not in self._nonzero and -f not in self._nonzero]
        if len(open_) > 1:
            raise NumericError(
                f"the relation {relation} = 0, of which several factors may vanish",
                expected="relations that are no products",
            )
        return open_[0] if open_ else relation

    @cached_property
    def _nonzero(self) -> frozenset[Expr]:
        """What cannot vanish since a length would: the z of l = z / cos θ."""
        lengths = (e for s, e in self._closed_beside_relations.items() if s.positive)
        return frozenset(f for e in lengths for f in factors(e.numerator)[1])


# -- rates of any order, in terms of the independent ones -----------------------------------------


def on_motion(expression: Expr, equations: Equations) -> Expr:
    """An expression with accelerations, and rates of any higher order, of the true motion."""
    constrained = on_constraints(expression, equations)
    accelerations: dict[Symbol, Expr] = {}
    for symbol in constrained.symbols():
        speed = next((s for s in equations.speeds if s.base() == symbol.base()), None)
        if speed is not None and speed.order < symbol.order:
            value = equations.accelerations[speed.derivative()]
            for _ in range(symbol.order - speed.order - 1):
                value = equations.rate(value)
            accelerations[symbol] = value
    return constrained.subs(accelerations) if accelerations else constrained


# -- expressions where given relations vanish -----------------------------------------------------


def _whole(relation: Expr) -> Expr:
    return relation


def eliminated(
    expression: Expr, relations: Sequence[Expr], accepted: Callable[[Expr], Expr] = _whole
) -> Expr:
    """An expression with one quantity eliminated by each relation that vanishes.

    Each relation is solved for a quantity in which it is linear: a parameter where possible, or
    coordinates and speeds where that would leave no body, as with L_x = L_y = 0. Only states at
    which the coefficient of that quantity vanishes are lost.

    Args:
        expression: on all states.
        relations: that vanish.
        accepted: refuses relations, or returns them.

    Raises `NumericError` for a relation that is linear in no quantity, and if a quantity declared
    positive would have to vanish.
    """
    try:
        return _eliminated(expression, relations, _parameters_first, accepted)
    except (NumericError, ZeroDivisionError) as error:
        try:
            return _eliminated(expression, relations, _states_first, accepted)
        except (NumericError, ZeroDivisionError):
            raise error from None


def _parameters_first(symbol: Symbol) -> tuple[bool, str]:
    return symbol.kind.varies, symbol.published


def _states_first(symbol: Symbol) -> tuple[bool, str]:
    return not symbol.kind.varies, symbol.published


_Order = Callable[[Symbol], tuple[bool, str]]


def _eliminated(
    expression: Expr, relations: Sequence[Expr], order: _Order, accepted: Callable[[Expr], Expr]
) -> Expr:
    """The expression, with quantities eliminated in an order."""
    pending, postponed = list(relations), list[Expr]()
    positive: dict[Symbol, Expr] = {}  # values of eliminated quantities that are declared positive
    while pending:
        relation = accepted(_without_positive_factors(pending.pop(0)))
        if not relation:
            continue
        try:
            symbol, value = solved(relation, order)
        except NumericError:
            if _vanishes_with(expression, relation):
                return ZERO
            if not expression and not _is_beyond_sines(relation):
                continue
            if not pending or relation in postponed:
                raise
            postponed.append(relation)  # it may be a factor of what the others leave
            pending.append(relation)
            continue
        expression = expression.subs({symbol: value})
        pending = [other.subs({symbol: value}) for other in pending]
        positive = {s: e.subs({symbol: value}) for s, e in positive.items()}
        if symbol.positive:
            positive[symbol] = value
        for vanished in (s for s, e in positive.items() if not e):
            raise NumericError(
                f"conditions that are met only where {vanished.published} vanishes",
                expected="conditions that some body meets",
                advice="restrict angles and speeds one by one, such as theta = pi/2",
            )
    return expression


def _vanishes_with(expression: Expr, relation: Expr) -> bool:
    """Whether an expression contains every factor of a relation that is linear in no quantity."""
    contained = factors(expression.numerator)[1]
    return all(f in contained or -f in contained for f in factors(relation.numerator)[1])


def _without_positive_factors(relation: Expr) -> Expr:
    """The product of the factors that can vanish, each to the first power.

    In m² θ = 0, only θ can vanish, and in Ω θ = 0 as well, but for a turntable at rest. Raises
    `NumericError` if no factor can.
    """
    if not relation:
        return relation
    found = factors(relation.numerator)[1]
    vanishing = [f for f in found if not is_positive(f) and not is_positive(-f)]
    if not vanishing:
        raise NumericError(
            f"the condition {relation} = 0, which no state meets",
            expected="conditions that do not contradict one another or the model",
        )
    others = [f for f in vanishing if f.symbol is None or f.symbol.kind.varies]
    return prod(others or vanishing, start=ONE).numerator


def solved(relation: Expr, order: _Order = _parameters_first) -> tuple[Symbol, Expr]:
    """A symbol in which a relation is linear, and its value where the relation vanishes.

    Failing that, a positive symbol of which it contains nothing but the square.
    """
    ways: Iterable[tuple[Symbol, Expr, Expr]] = _linear_in(relation, order)
    if order is _states_first:  # the shortest of several rates
        ways = sorted(ways, key=lambda way: (not way[0].kind.varies, length(way[1]), str(way[0])))
    for symbol, slope, rest in ways:
        return symbol, -rest / slope
    for symbol in sorted((s for s in relation.symbols() if s.positive), key=order):
        by_square, rest = relation.diff(symbol).diff(symbol) / 2, relation.subs({symbol: ZERO})
        is_square = relation == by_square * Expr.generator(symbol) ** 2 + rest
        if by_square and is_square and symbol not in by_square.symbols():
            return symbol, sqrt(-rest / by_square)
    if _is_beyond_sines(relation):
        raise NumericError(
            f"the condition {relation} = 0, which no state meets",
            expected="a sine or cosine between -1 and 1",
        )
    has_root = any(g.depth and not _is_circular(g) for g in relation.generators)
    raise NumericError(
        f"the relation {relation} = 0",
        expected="one that is linear in some quantity",
        advice="state it without the root, such as L_x = 0 and L_y = 0 for L along z"
        if has_root
        else "restrict an angle, such as theta = pi/2",
    )


def _is_beyond_sines(relation: Expr) -> bool:
    """Whether a relation gives a sine or cosine a value beyond ±1, as sin θ - 2 = 0 does."""
    terms = {tuple(powers.items()): c for powers, c in relation.numerator.terms()}
    constant = terms.pop((), None)
    if constant is None or len(terms) != 1:
        return False
    (((generator, power), *others), slope), *_ = terms.items()
    is_sine = not isinstance(generator, Symbol) and _is_circular(generator)
    return is_sine and power == 1 and not others and abs(constant) > abs(slope)


def _is_circular(generator: Generator) -> bool:
    """Whether a function is a sine or a cosine, for which d²f/dx² = -f."""
    pairs = [generator.partner(), *(g.partner() for g in generator.companions() if g.depth)]
    return any(pair is not None and pair[1] < 0 for pair in pairs)


def _linear_in(
    relation: Expr, order: _Order = _parameters_first
) -> Iterator[tuple[Symbol, Expr, Expr]]:
    """The symbols in which a relation is linear, each with its coefficient and the other terms."""
    for symbol in sorted(relation.symbols(), key=order):
        slope = relation.diff(symbol)
        if slope and symbol not in slope.symbols():
            rest = relation - slope * Expr.generator(symbol)
            if symbol not in rest.symbols():
                yield symbol, slope, rest

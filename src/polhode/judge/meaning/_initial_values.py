"""Initial values such as θ₀, ω₀ or E₀: constants, tied to the motion by what is conserved.

In θ̇² = (2g/l)(cos θ - cos θ₀) the pendulum is released at θ₀. Its energy is that of the start,
which is at rest unless an initial rate is printed as well. What no letter says of the start remains
free: a spherical pendulum that is released at θ₀ may be turning about the vertical.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    as_symbol,
    time,
)
from polhode.base import DeclarationError
from polhode.judge.meaning._derived_quantities import (
    hamiltonian,
    in_independent_rates,
    phase_space,
)
from polhode.judge.meaning._meaning import BindingError
from polhode.judge.meaning._mechanics import Mechanics, by_constraints, on_constraints
from polhode.model import DryFriction

_MARK = "_0"

#: The beginning of the phrase for an initial value.
INITIAL = "initial value of "


def initial_value(symbol: Symbol) -> Symbol:
    """The constant that a text writes for the value of a coordinate or speed at the start."""
    return Symbol(f"{symbol.published}{_MARK}", SymbolKind.PARAMETER)


def at_the_start(mechanics: Mechanics, quantity: Expr) -> Expr | None:
    """A function of coordinates and rates at the start; None for any other quantity.

    What is conserved is what it was at the start.
    """
    in_rates = _in_rates(mechanics, quantity)
    try:
        if in_rates in tuple(_conserved(mechanics)):
            return in_rates
    except BindingError:
        pass  # nothing is known to be conserved
    state = tuple(_state(mechanics))
    varying = {s for s in in_rates.symbols() if s.kind.varies or s == as_symbol(time)}
    if not varying or not varying <= {*state}:
        return None
    return in_rates.subs({s: Expr.generator(initial_value(s)) for s in state})


@dataclass(frozen=True)
class InitialValues:
    """The start of the motion that a formula speaks of.

    Attributes:
        relations: expressions that vanish along the motion from there.
        solved: initial rates that the momenta determine which are conserved.
        values: of coordinates and rates at the start.
        at_rest: whether rates that the formula does not mention were taken as zero.
        unsaid: rates of which the formula says nothing, and which are free at the start.
        free: all rates that are free there, also those that it speaks of at other times.
        placed: coordinates of which it says nothing, and which were taken as zero at the start.
        stated: restrictions of the text, those of initial values among them.
    """

    relations: tuple[Expr, ...] = ()
    solved: Mapping[Symbol, Expr] = field(default_factory=dict)
    values: Mapping[Symbol, Expr] = field(default_factory=dict)
    at_rest: bool = False
    unsaid: tuple[Symbol, ...] = ()
    free: tuple[Symbol, ...] = ()
    placed: tuple[Symbol, ...] = ()
    stated: Mapping[Symbol, Expr] = field(default_factory=dict)

    def at_start(self, mechanics: Mechanics, quantity: Expr) -> Expr:
        """The value of a quantity at the start."""
        known = {**self.solved, **self.stated, as_symbol(time): ZERO}
        return _in_rates(mechanics, quantity).subs(self.values).subs(known).subs(self.stated)

    def is_met(self, mechanics: Mechanics, left: Expr, right: Expr) -> bool:
        """Whether two sides are equal at the start, as those of a formula about it have to be.

        The ω₀ of sin ω₀t is no rate at the start.
        """
        difference, clock = left - right, as_symbol(time)
        if any(clock in g.symbols() for g in difference.generators if g != clock):
            return False
        try:
            return not self.at_start(mechanics, difference)
        except ZeroDivisionError:
            return False  # a side grows beyond all bounds at the start

    @property
    def remarks(self) -> tuple[str, ...]:
        """What was assumed of the start."""
        at_rest = ", ".join(
            f"{s.published} = 0" for s, e in self.values.items() if s.order and not e
        )
        start = f"with {at_rest}" if self.free else "at rest"
        rest = (f"taking the motion to start {start}, as no initial rate is printed",)
        places = (f"taking the motion to start at {q.published} = 0" for q in self.placed)
        return (*(rest if self.at_rest else ()), *places)


def start_of(
    mechanics: Mechanics, sides: Iterable[Expr], stated: Mapping[Symbol, Expr]
) -> InitialValues:
    """The start that some expressions speak of by initial values; none if they do not.

    Args:
        mechanics: of the system.
        sides: the expressions.
        stated: restrictions of the text, those of initial values among them.

    Raises `BindingError` where what is conserved depends on further initial values, or nothing is
    and the expressions do not depend on time.
    """
    known = _known(mechanics)
    sides = tuple(sides)
    if all(known.keys().isdisjoint(side.symbols()) for side in sides):
        return InitialValues()  # nearly every formula
    printed = {s for side in sides for s in mechanics.in_rates(side).symbols()}
    used = {known[s] for s in printed if s in known}
    if not used:
        return InitialValues()
    try:
        conserved = tuple(_conserved(mechanics))
    except BindingError:
        if all(as_symbol(time) not in side.symbols() for side in sides):
            raise
        conserved = (ZERO,)  # x = x₀ + v₀ t may be true all the same
    relevant = {s for q in conserved for s in q.symbols() if s.kind.varies}
    is_moving = any(s.order for s in used)
    speeds = {s for s in _state(mechanics) if s.kind is SymbolKind.SPEED and not s.order}
    values, open_ = {s: Expr.generator(initial_value(s)) for s in used | speeds}, []
    for q in mechanics.declared.coordinates:
        rate = q.derivative()
        if rate in used:
            continue
        initial = initial_value(rate)
        if q in used and not is_moving:
            values[rate] = stated.get(initial, ZERO)
            continue
        values[rate] = stated.get(initial, Expr.generator(initial))
        open_ += [rate] if rate in relevant and initial not in stated else []
    placed = {s: stated[initial_value(s)] for s in relevant if initial_value(s) in stated}
    values = {**placed, **values}
    missing = sorted((s for s in relevant - {*values} if not s.order), key=str)
    if missing and not is_moving:
        names = ", ".join(s.published for s in missing)
        raise BindingError(
            f"initial values, but none of {names}",
            expected="initial values of all quantities that the energy depends on",
            advice="judge it in the context launch, with the start of the motion",
        )
    values |= dict.fromkeys(missing, ZERO)
    whole, *momenta = (q - q.subs(values) for q in conserved)
    rates = [s for s in relevant if s.order and s not in used and values[s]]
    free = [initial for s in rates if (initial := initial_value(s)) not in stated]
    bound = ((s, by_constraints(s, mechanics.equations)) for s in used)
    tied = (Expr.generator(s) - e for s, e in bound if e is not None)
    held = [mechanics.in_rates(e).subs(values) for e in tied]
    open_rates = {s for e in held for s in e.symbols()}.intersection(map(initial_value, values))
    unknown = {*free, *open_rates}.difference(map(initial_value, used))
    solved, relations = _solved([*momenta, *held], sorted(unknown, key=str))
    energy = whole.subs(solved)
    if energy.symbols().isdisjoint(free):  # otherwise it only says how large a free rate was
        relations.append(energy)
    return InitialValues(
        tuple(filter(None, relations)),
        solved,
        values,
        any(s.order and not value for s, value in values.items()),
        tuple(rate for rate in open_ if rate not in printed),
        tuple(open_),
        tuple(missing),
        stated,
    )


def _solved(
    relations: Sequence[Expr], unknowns: Sequence[Symbol]
) -> tuple[dict[Symbol, Expr], list[Expr]]:
    """Values of unknowns for which linear relations vanish, and the relations that are left."""
    found: dict[Symbol, Expr] = {}
    left: list[Expr] = []
    for relation in relations:
        rest = relation.subs(found)
        symbol = next((s for s in unknowns if s not in found and rest.diff(s)), None)
        if symbol is None:
            left.append(rest)
            continue
        value = -rest.subs({symbol: ZERO}) / rest.diff(symbol)
        found = {s: e.subs({symbol: value}) for s, e in found.items()} | {symbol: value}
    return found, left


def _in_rates(mechanics: Mechanics, quantity: Expr) -> Expr:
    """By the rates of independent coordinates, where constraints determine the others."""
    try:
        return in_independent_rates(mechanics, quantity)
    except DeclarationError:
        return mechanics.in_rates(on_constraints(quantity, mechanics.equations))


@lru_cache(maxsize=16)  # systems
def _known(mechanics: Mechanics) -> dict[Symbol, Symbol]:
    """Coordinates and rates by their initial values."""
    return {initial_value(s): s for s in _state(mechanics)}


def _state(mechanics: Mechanics) -> Iterator[Symbol]:
    """Coordinates and their rates, and the angular velocities of a body without angles."""
    for q in mechanics.declared.coordinates:
        yield from (q, q.derivative())
    for speed in mechanics.declared.speeds:
        if not speed.order and mechanics.in_rates(Expr.generator(speed)).symbol == speed:
            yield speed


def _conserved(mechanics: Mechanics) -> Iterator[Expr]:
    """The Hamiltonian and the momenta of cyclic coordinates, by coordinates and rates.

    The energy alone where a body rolls.
    """
    equations = mechanics.equations
    rubs = any(isinstance(element, DryFriction) for element in equations.system.elements)
    momenta: list[Expr] = []
    try:
        space, whole = phase_space(mechanics), hamiltonian(mechanics)
        momenta += (space.momenta[s] for s in sorted(space.cyclic, key=str))
    except DeclarationError as error:
        whole = _in_rates(mechanics, mechanics.energy())
        quasi = any(s.kind is SymbolKind.SPEED and not s.order for s in whole.symbols())
        if quasi or equations.rate(equations.energy):
            raise BindingError(
                f"initial values; {error.given}",
                expected=error.expected,
                advice="judge it in the context launch, with the start of the motion",
            ) from None
    if mechanics.has_other_loads or rubs or as_symbol(time) in whole.symbols():
        raise BindingError("initial values", expected="a system that conserves energy")
    yield whole
    yield from momenta

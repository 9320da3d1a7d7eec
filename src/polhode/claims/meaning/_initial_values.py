"""Initial values such as θ₀: constants of a text, tied to the motion by what is conserved.

In θ̇² = (2g/l)(cos θ - cos θ₀) the pendulum is released at θ₀. Its energy is that of the start,
which is at rest unless an initial rate is printed as well.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind
from polhode.base import DeclarationError
from polhode.claims.meaning._derived_quantities import phase_space
from polhode.claims.meaning._meaning import BindingError
from polhode.claims.meaning._mechanics import Mechanics
from polhode.model import Gravity, Spring

_MARK = "_0"

#: The beginning of the phrase for an initial value.
INITIAL = "initial value of "


def initial_value(symbol: Symbol) -> Symbol:
    """The constant that a text writes for the value of a coordinate or speed at the start."""
    return Symbol(f"{symbol.published}{_MARK}", SymbolKind.PARAMETER)


@dataclass(frozen=True)
class InitialValues:
    """The start of the motion that a formula speaks of.

    Attributes:
        relations: expressions that vanish along the motion from there.
        at_rest: whether rates that the formula does not mention were taken as zero.
    """

    relations: tuple[Expr, ...] = ()
    at_rest: bool = False


def start_of(mechanics: Mechanics, sides: Iterable[Expr]) -> InitialValues:
    """The start that some expressions speak of by initial values; none if they do not.

    Raises `BindingError` where what is conserved depends on further initial values.
    """
    known = {initial_value(s): s for s in _state(mechanics)}
    used = {known[s] for side in sides for s in side.symbols() if s in known}
    if not used:
        return InitialValues()
    if not all(isinstance(load, Gravity | Spring) for load in mechanics.equations.system.loads):
        raise BindingError("initial values", expected="a system that conserves energy")
    at_start: dict[Symbol, Expr] = {}
    for symbol in _state(mechanics):
        if symbol in used:
            at_start[symbol] = Expr.generator(initial_value(symbol))
        elif symbol.order:
            at_start[symbol] = ZERO
    found = tuple(q - q.subs(at_start) for q in _conserved(mechanics))
    left = {s for q in _conserved(mechanics) for s in q.symbols() if s.kind.varies} - {*at_start}
    if left:
        names = ", ".join(sorted(s.published for s in left))
        raise BindingError(
            f"initial values, but none of {names}",
            expected="initial values of all quantities that the energy depends on",
            advice="judge it in the context launch, with the start of the motion",
        )
    is_at_rest = any(s.order and s not in used for s in at_start)
    return InitialValues(tuple(relation for relation in found if relation), is_at_rest)


def _state(mechanics: Mechanics) -> Iterator[Symbol]:
    for q in mechanics.declared.coordinates:
        yield from (q, q.derivative())


def _conserved(mechanics: Mechanics) -> Iterator[Expr]:
    """The energy and the momenta of cyclic coordinates, by coordinates and rates."""
    try:
        space = phase_space(mechanics)
    except DeclarationError as error:
        raise BindingError(error.given, expected=error.expected) from None
    yield mechanics.in_rates(mechanics.energy())
    yield from (space.momenta[s] for s in sorted(space.cyclic, key=str))

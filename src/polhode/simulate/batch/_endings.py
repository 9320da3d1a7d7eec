"""What ends the motions of one contact mode that go side by side."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, sqrt
from polhode.derive import Guard
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._task import AS_DECLARED
from polhode.simulate.contact._carried import slip_symbols
from polhode.simulate.contact._hybrid_system import CompiledMode


@dataclass(frozen=True)
class Ending:
    """What ends the motions of a mode.

    Attributes:
        positive: while the mode lasts, but for a least value.
        kind: of the event that ends the motion as a whole; empty where it goes on from there.
        mode: that a motion ends in.
        guard: of the contact mode, where the motion goes on in another.
        least: value at which it has fallen.
        slips: the slip velocity that vanishes soon after.
    """

    positive: Expr
    kind: str
    mode: str
    guard: Guard | None = None
    least: float = 0.0
    slips: tuple[Symbol, Symbol] | None = None


def endings_of(mode: CompiledMode, near_flat: float, until: Collection[str]) -> tuple[Ending, ...]:
    """What may end a mode, in the order of its guards."""
    return tuple(_endings(mode, near_flat, until))


def _endings(mode: CompiledMode, near_flat: float, until: Collection[str]) -> Iterator[Ending]:
    name = mode.mode.name
    for guard in mode.mode.guards:
        if guard.kind == "near-flat":
            yield Ending(guard.positive, "goes flat", guard.kind, guard, near_flat)
            continue
        kind = guard.kind if guard.kind in until else ""
        if guard.kind != "sticks":
            yield Ending(guard.positive, kind, name, guard)
            continue
        slips = _slips(mode, guard)
        if set(slips) <= set(mode.flow.core.symbols):
            first, second = (Expr.generator(s) for s in slips)
            speed = sqrt(first * first + second * second)
            yield Ending(speed, kind, name, guard, slips=slips)
    yield from vanishings_of(mode.dynamics, name)


def _slips(mode: CompiledMode, guard: Guard) -> tuple[Symbol, Symbol]:
    contacts = (touch.contact for touch in mode.mode.touches)
    return next(slip_symbols(c) for c in contacts if guard.contact and c.name == guard.contact.name)


def vanishings_of(dynamics: Dynamics, mode: str) -> Iterator[Ending]:
    """Lengths that vanish: a motion that comes to that is followed by itself.

    Seen by a series, the length goes on below zero.
    """
    for root in dynamics.lengths:
        length = Expr.generator(root)
        yield Ending(length, "", mode, Guard(None, "vanishes", length))


def sides_of(positive: Collection[Expr]) -> tuple[Ending, ...]:
    """Of equations that are kept to: the side for which they were derived."""
    return tuple(Ending(side, "", AS_DECLARED) for side in positive)

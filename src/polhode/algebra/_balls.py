"""Whether an expression with named parts vanishes: its value at random states, in balls.

A ball holds the value for certain. One that does not hold zero proves that the expression is not
zero; where all do, to a hundred digits and more, it is taken to vanish.
"""

from __future__ import annotations

from functools import lru_cache
from hashlib import blake2b
from typing import Any

from flint import acb, arb, ctx, fmpq

from polhode.algebra._expression import Expr
from polhode.algebra._functions import Elementary
from polhode.algebra._generators import Generator, Symbol
from polhode.algebra._parts import NamedPart
from polhode.algebra._ring import Polynomial, Ring
from polhode.algebra._roots import SquareRoot
from polhode.algebra._special import PI

Ball = Any  # flint.acb: python-flint ships no usable type information

_BITS = 448
_STATES = (1, 2)
_MEMORY = 65536


def vanishes(expression: Expr) -> bool:
    """Whether it is zero at every one of a few random states."""
    return all(value(expression, state).contains(0) for state in _STATES)


def value(expression: Expr, state: int) -> Ball:
    """What an expression is at one of the random states."""
    with ctx.workprec(_BITS):
        above = _polynomial(expression.ring, expression.num, state)
        return above / _polynomial(expression.ring, expression.den, state)


def _polynomial(ring: Ring, polynomial: Polynomial, state: int) -> Ball:
    total = acb(0)
    for monomial, coefficient in polynomial.terms():
        term = acb(arb(fmpq(coefficient)))
        for generator, power in zip(ring.generators, monomial, strict=True):
            if power:
                term *= _value(generator, state) ** int(power)
        total += term
    return total


@lru_cache(_MEMORY)
def _value(generator: Generator, state: int) -> Ball:
    match generator:
        case NamedPart():
            return value(generator.meaning, state)
        case SquareRoot():
            return value(generator.radicand, state).sqrt()
        case Elementary():
            return getattr(value(generator.argument, state), generator.name)()
        case Symbol() if generator == PI.symbol:
            return acb.pi()
    drawn = _random(f"{state} {generator.key}")
    return acb(arb(drawn if generator.positive else drawn - fmpq(1, 2)))


def _random(seed: str) -> fmpq:
    """A number from 1/8 to 9/8 that looks like any other."""
    drawn = int.from_bytes(blake2b(seed.encode(), digest_size=16).digest(), "big")
    return fmpq(1, 8) + fmpq(drawn, 2**128)

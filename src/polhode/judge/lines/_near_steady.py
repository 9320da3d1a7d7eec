"""Small departures from a steady motion, with the momenta that this motion has.

In θ = θ₀ + ε a text departs from a motion on which θ stays θ₀. The cyclic momenta go on to be those
of that motion, p(θ, φ̇) = p(θ₀, φ̇₀), and θ₀ and φ̇₀ obey the condition for it to be steady.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind
from polhode.analyse import reduced, steady
from polhode.base import ByIdentity, PolhodeError
from polhode.derive import Equations
from polhode.judge.meaning._derived_quantities import phase_space
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.text._in_force import InForce


def steady_value(symbol: Symbol) -> Symbol:
    """The value that a coordinate or speed keeps in the motion that a text departs from."""
    return Symbol(f"{symbol.published} of the steady motion", SymbolKind.PARAMETER)


def kept_values(stated: InForce) -> dict[Symbol, Expr]:
    """The coordinates that depart from values in a steady motion, with these values."""
    found = {q: Expr.generator(steady_value(q)) for q in stated.departures}
    return {q: v for q, v in found.items() if not stated.departures[q].subs({q: v})}


def under_steady_momenta(stated: InForce, equations: Equations) -> Iterator[InForce]:
    """With the momenta of each steady motion that the text may depart from."""
    kept = frozenset(kept_values(stated))
    for departing, relations in steady_momenta(ByIdentity(equations)) if kept else ():
        if departing == kept:
            yield stated.under(relations)


@lru_cache(maxsize=16)
def steady_momenta(
    key: ByIdentity[Equations],
) -> tuple[tuple[frozenset[Symbol], tuple[BoundRelation, ...]], ...]:
    """For each family of steady motions, the coordinates that may depart, and what then holds.

    Empty for a rolling disk: not every one of its conserved quantities is a momentum.
    """
    try:
        return tuple(_found(key.subject))
    except (PolhodeError, ZeroDivisionError):
        return ()


def _found(
    equations: Equations,
) -> Iterator[tuple[frozenset[Symbol], tuple[BoundRelation, ...]]]:
    space = phase_space(Mechanics(equations))
    momenta = [on_constraints(p, equations) for s, p in space.momenta.items() if s in space.cyclic]
    essential = reduced(equations).essential
    state = {s: Expr.generator(steady_value(s)) for s in (*essential, *equations.speeds)}
    state |= {q.derivative(): ZERO for q in essential}
    moving = [p for p in momenta if p.symbols() & {*equations.speeds}]
    for family in steady(equations):
        if family.relations and not family.fixed.keys() & {*essential}:
            conserved = [BoundRelation(p, "=", p.subs(state)) for p in moving]
            conditions = [BoundRelation(r.subs(state), "=", ZERO) for r in family.relations]
            yield frozenset(essential), (*conserved, *conditions)

"""Poisson brackets of functions of coordinates and momenta."""

from __future__ import annotations

from polhode.algebra import ZERO, Expr
from polhode.base import DeclarationError
from polhode.judge.latex._tree import Name
from polhode.judge.meaning._derived_quantities import in_independent_rates, phase_space
from polhode.judge.meaning._meaning import BindingError
from polhode.judge.meaning._mechanics import Mechanics

#: Stands for the sign of all brackets of a text, as a letter of two meanings.
BRACKET = Name("bracket")

#: The first is that of Goldstein, § 9.5; the second that of Landau and Lifshitz, § 42.
SIGNS = OF_COORDINATES_FIRST, OF_MOMENTA_FIRST = (
    "sum of (df/dq)(dg/dp) - (df/dp)(dg/dq)",
    "sum of (df/dp)(dg/dq) - (df/dq)(dg/dp)",
)


def poisson_bracket(mechanics: Mechanics, first: Expr, second: Expr) -> Expr:
    """Σ ∂f/∂q ∂g/∂p - ∂f/∂p ∂g/∂q over the independent coordinates.

    Raises `BindingError` for a system without momenta conjugate to all coordinates, and for what is
    no function of coordinates and momenta, such as a reaction.
    """
    try:
        space = phase_space(mechanics)
        both = [space.by_momenta(in_independent_rates(mechanics, e)) for e in (first, second)]
    except DeclarationError as error:
        raise BindingError(f"a Poisson bracket: {error.given}", expected=error.expected) from None
    known = {q for rate in space.rates for q in (rate.base(), space.rates[rate])}
    others = {s for e in both for s in e.symbols() if s.kind.varies and s not in known}
    if others:
        raise BindingError(
            f"a Poisson bracket with {', '.join(sorted(s.published for s in others))}",
            expected="two functions of coordinates and momenta",
        )
    f, g = both
    found = ZERO
    for rate, momentum in space.rates.items():
        q = rate.base()
        found += f.diff(q) * g.diff(momentum) - f.diff(momentum) * g.diff(q)
    return space.by_rates(found)

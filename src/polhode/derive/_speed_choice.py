"""Which speeds are independent: a choice that constraints leave, and that may have to change.

The constraints give the dependent speeds as D u + d in terms of the independent ones, u. Where D
grows without limit, as 1/cos φ does for a sleigh described by its velocity along x, the choice is
singular although the motion is not, and other speeds have to be independent.
"""

from __future__ import annotations

from collections.abc import Iterable

from polhode.algebra import Expr, Symbol, SymbolKind, has_parts, is_positive, total
from polhode.derive._constraints import partial_velocity
from polhode.derive._derive import derive_in_parts
from polhode.derive._equations import Equations
from polhode.model import System, with_independent


def may_become_singular(equations: Equations) -> bool:
    """Whether a choice of independent speeds may become singular somewhere.

    It does where a denominator of the dependent speeds vanishes; of expressions in named parts,
    the denominators are not known.
    """
    return any(
        has_parts(dependent)
        or any(s.kind is not SymbolKind.PARAMETER for s in dependent.denominator.symbols())
        for dependent in equations.dependent.values()
    )


def may_be_singular(equations: Equations) -> bool:
    """Whether a choice of independent speeds may be singular somewhere or for some parameters."""
    return any(
        has_parts(dependent) or not is_positive(dependent.denominator)
        for dependent in equations.dependent.values()
    )


def inertia_of(equations: Equations, speed: Symbol) -> Expr:
    """The inertia that resists a speed alone, before constraints, in kg, kg m² or the like.

    Its root makes speeds of different dimensions comparable: T = ½ Σ (√mᵢ uᵢ)² without coupling.
    """

    def terms() -> Iterable[Expr]:
        for body, motion in equations.kinetics.unconstrained.items():
            velocity, angular = (partial_velocity(v, speed) for v in motion)
            along = angular.express(body.axes)
            couple = body.inertia.times(along.components)
            yield velocity.dot(velocity) * body.mass
            yield total(w * c for w, c in zip(along.components, couple, strict=True))

    return total(terms())


def on_independent(system: System, speeds: Iterable[Symbol]) -> Equations:
    """The equations of a system on other independent speeds, to be evaluated.

    Long expressions are kept under names: in speeds that nobody chose for it, the closed form may
    be much longer than that of the declaration.
    """
    return derive_in_parts(with_independent(system, map(Expr.generator, speeds)))

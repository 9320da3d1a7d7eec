"""Quantities that only a motion as a whole has: where its path curves, how fast it precesses."""

from __future__ import annotations

from polhode.algebra import ZERO, Expr, Symbol, Vector, as_symbol, linear_parts, solve, sqrt
from polhode.base import DeclarationError
from polhode.derive import Equations


def radius_of_curvature(place: Vector) -> Vector:
    """From the centre of curvature of a point's path to the point, m; for no straight path."""
    velocity = place.dt()
    across = velocity.cross(velocity.dt())
    outwards = velocity.cross(across)
    return outwards * (velocity.dot(velocity) / across.dot(across))


def uniform_velocity(equations: Equations, velocity: Vector) -> Vector:
    """The one velocity at which there is no acceleration, m/s."""
    wanted = tuple(
        speed
        for speed in equations.speeds
        if any(speed in a.symbols() for a in equations.accelerations.values())
    )
    settled = equations.kinetics.resolve(velocity)
    rows = [linear_parts(equations.accelerations[s.derivative()], wanted) for s in wanted]
    try:
        found = solve([row for row, _ in rows], [-rest for _, rest in rows])
    except ZeroDivisionError:
        raise DeclarationError(
            "the uniform velocity", expected="a system in which just one does not change"
        ) from None
    return settled.subs({Expr.generator(s): v for s, v in zip(wanted, found, strict=True)})


def precession(equations: Equations, rate: Expr, slower: bool) -> Expr:
    """The smaller or larger of two rates of steady motion, for quick spin, rad/s."""
    from polhode.analyse import steady  # few texts speak of it

    symbol = as_symbol(rate)
    for family in steady(equations):
        for relation in family.relations:
            coefficients = _quadratic(relation, symbol)
            if coefficients is not None:
                return _root(*coefficients, slower=slower)
    raise DeclarationError(
        f"slow and fast {symbol.published}", expected="a steady motion with two values of it"
    )


def _quadratic(relation: Expr, symbol: Symbol) -> tuple[Expr, Expr, Expr] | None:
    second = relation.diff(symbol).diff(symbol)
    if not second or symbol in second.symbols():
        return None
    still = {symbol: ZERO}
    return second / 2, relation.diff(symbol).subs(still), relation.subs(still)


def _root(a: Expr, b: Expr, c: Expr, *, slower: bool) -> Expr:
    """Of a x² + b x + c, the root that vanishes with c or the other one, b/a taken as negative."""
    root = sqrt(1 - 4 * a * c / b**2)
    return -b / (2 * a) * (1 - root if slower else 1 + root)

"""Bodies with the inertia of their shape, unless `inertia=` gives another."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from polhode.algebra import Expr, ExprLike
from polhode.model._body import Body
from polhode.model._declared import positive, three
from polhode.model._frame import Frame
from polhode.model._spin import About, Free
from polhode.model._surface import BaseEdge, Block, Ellipsoidal, LowerEdge, Rim, Round


def disk(
    name: str, *, mass: ExprLike, radius: ExprLike, axes: Frame, axis: str = "3", **more: Any
) -> Body:
    """A thin uniform disk spinning about `axis`: m a²/4 about diameters, m a²/2 about the axis."""
    return _rimmed(name, mass, radius, axes, axis, Fraction(1, 4), more)


def hoop(
    name: str, *, mass: ExprLike, radius: ExprLike, axes: Frame, axis: str = "3", **more: Any
) -> Body:
    """A thin uniform hoop spinning about `axis`: m a²/2 about diameters, m a² about the axis."""
    return _rimmed(name, mass, radius, axes, axis, Fraction(1, 2), more)


def _rimmed(
    name: str,
    mass: ExprLike,
    radius: ExprLike,
    axes: Frame,
    axis: str,
    share: Fraction,
    more: dict[str, Any],
) -> Body:
    across = Expr.of(mass) * Expr.of(radius) ** 2 * share
    moments = 2 * across, across
    return _round(name, mass, moments, axes, Rim(Expr.of(radius), axis), more)


def _round(
    name: str,
    mass: ExprLike,
    moments: tuple[Expr, Expr],
    axes: Frame,
    surface: Rim,
    more: dict[str, Any],
) -> Body:
    """A body that is round about the axis of its surface, with its moments about and across it."""
    about, across = moments
    inertia = [about if i == axes.position(surface.axis) else across for i in range(3)]
    more = {"spin": About(surface.axis), "surface": surface, "inertia": inertia, **more}
    return Body(name, mass=mass, axes=axes, **more)


def sphere(
    name: str,
    *,
    mass: ExprLike,
    radius: ExprLike,
    axes: Frame,
    inertia: ExprLike | None = None,
    **more: Any,
) -> Body:
    """A ball: 2 m a²/5 if uniform, or the given moment of inertia about its diameters.

    `axes` need not turn with it; they may be those of its support.
    """
    moment = Fraction(2, 5) * Expr.of(mass) * Expr.of(radius) ** 2 if inertia is None else inertia
    surface = Round(Expr.of(radius))
    more = {"spin": Free(), **more}
    return Body(name, mass=mass, inertia=[moment] * 3, axes=axes, surface=surface, **more)


def ellipsoid(
    name: str,
    *,
    mass: ExprLike,
    half_axes: tuple[ExprLike, ExprLike, ExprLike],
    axes: Frame,
    **more: Any,
) -> Body:
    """A uniform solid ellipsoid with half-axes along its axes: m (b² + c²)/5 and so on."""
    first, second, third = map(Expr.of, three(half_axes, f"half-axes of body {name!r}"))
    surface = Ellipsoidal((first, second, third))
    a, b, c = (half**2 for half in surface.half_axes)
    moments = [Expr.of(mass) * s / 5 for s in (b + c, c + a, a + b)]
    more = {"surface": surface, "inertia": moments, **more}
    return Body(name, mass=mass, axes=axes, **more)


def rod(
    name: str, *, mass: ExprLike, length: ExprLike, axes: Frame, axis: str = "x", **more: Any
) -> Body:
    """A thin uniform rod along `axis`: m l²/12 across it, zero about it."""
    across = Expr.of(mass) * positive(length, f"length of {name!r}") ** 2 / 12
    moments = [Expr.of(0) if i == axes.position(axis) else across for i in range(3)]
    return Body(name, mass=mass, axes=axes, **{"inertia": moments, **more})


def cylinder(
    name: str,
    *,
    mass: ExprLike,
    radius: ExprLike,
    height: ExprLike,
    axes: Frame,
    axis: str = "3",
    **more: Any,
) -> Body:
    """A uniform solid cylinder about `axis`, touching with the edge of its lower face."""
    mass, radius = Expr.of(mass), positive(radius, f"radius of {name!r}")
    height = positive(height, f"height of {name!r}")
    moments = mass * radius**2 / 2, mass * (3 * radius**2 + height**2) / 12
    return _round(name, mass, moments, axes, LowerEdge(radius, axis, -height / 2), more)


def cone(
    name: str,
    *,
    mass: ExprLike,
    radius: ExprLike,
    height: ExprLike,
    axes: Frame,
    axis: str = "3",
    **more: Any,
) -> Body:
    """A uniform solid cone about `axis`, from its base to its apex, touching with its base's edge.

    Its centre of mass is a quarter of the height above the base: 3 m a²/10 about the axis, and
    3 m (4 a² + h²)/80 across it.
    """
    mass, radius = Expr.of(mass), positive(radius, f"radius of {name!r}")
    height = positive(height, f"height of {name!r}")
    across = mass * (4 * radius**2 + height**2) * Fraction(3, 80)
    moments = mass * radius**2 * Fraction(3, 10), across
    return _round(name, mass, moments, axes, BaseEdge(radius, axis, -height / 4, height), more)


def box(
    name: str,
    *,
    mass: ExprLike,
    sides: tuple[ExprLike, ExprLike, ExprLike],
    axes: Frame,
    **more: Any,
) -> Body:
    """A uniform solid box with sides along its axes: m (b² + c²)/12 and so on.

    It touches nothing by itself: contacts name its corners, `at=axes.vector(a/2, b/2, -c/2)`.
    """
    given = three(sides, f"sides of body {name!r}")
    a, b, c = (Expr.of(positive(side, f"side of {name!r}")) for side in given)
    squares = (b**2 + c**2, c**2 + a**2, a**2 + b**2)
    moments = [Expr.of(mass) * square / 12 for square in squares]
    own = {"inertia": moments, "surface": Block((a, b, c))}
    return Body(name, mass=mass, axes=axes, **{**own, **more})


def point_mass(name: str, *, mass: ExprLike, axes: Frame, **more: Any) -> Body:
    """A particle: no moment of inertia and no rotation."""
    return Body(name, mass=mass, inertia=(0, 0, 0), axes=axes, **more)

"""Bodies made of others that are fixed to one another: a hammer, a dumbbell, a pendulum's bob."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from polhode.algebra import ONE, ZERO, Matrix, Vector, total
from polhode.base import DeclarationError
from polhode.model._body import Body, parallel_axis
from polhode.model._declared import is_varying, of_type
from polhode.model._frame import Frame

#: A body, and its centre of mass from a point that all parts share, m.
Part = tuple[Body, Vector]


def compound(name: str, parts: Iterable[Part], *, axes: Frame, **more: Any) -> Body:
    """One rigid body made of several, with their mass and inertia by the parallel-axis theorem.

    Its centre of mass is at `centre_of_mass(parts)` from the point that the places are from: what
    is at r from there is at r less that vector in the body.

    Args:
        name: of the body.
        parts: bodies with the places of their centres of mass, m, from any one point of the body:
            ``[(shaft, axes.zero), (head, axes["x"] * l)]``. Their axes are at rest in `axes`. They
            serve for mass and inertia alone; spin and surface of a part do not matter, and it is
            not in the system.
        axes: along which the inertia is given, as of any body.
        more: further arguments of `Body`, such as `spin_about`, `surface` and `tag`.

    Raises:
        DeclarationError: for parts that move in the body, and for none.
    """
    listed = _listed(name, parts)
    of_type(axes, Frame, f"axes of body {name!r}", "give the frame of its inertia")
    centre = centre_of_mass(listed)
    inertia = Matrix.diagonal([ZERO] * 3)
    for body, place in listed:
        _require_fixed(name, body, place, axes)
        turned = body.axes.rotation_to(axes)
        own = turned @ body.inertia @ turned.T
        away = (place - centre).express(axes).components
        inertia = inertia + own + parallel_axis(body.mass, away)
    mass = total(body.mass for body, _ in listed)
    return Body(name, mass=mass, axes=axes, **{"inertia": inertia, **more})


def centre_of_mass(parts: Iterable[Part]) -> Vector:
    """The centre of mass of bodies, from the point that their places are from, m.

    Args:
        parts: bodies with the places of their centres of mass, m.

    Raises:
        DeclarationError: for none, and for massless ones.
    """
    listed = _listed("centre_of_mass", parts)
    mass = total(body.mass for body, _ in listed)
    if mass.is_zero:
        raise DeclarationError(
            "a centre of mass of massless bodies", expected="a body with a mass among them"
        )
    first, *others = (place * body.mass for body, place in listed)
    return sum(others, start=first) * (ONE / mass)


def _listed(name: str, parts: Iterable[Part]) -> list[Part]:
    listed = list(parts) if isinstance(parts, Iterable) else []
    pairs = [part for part in listed if isinstance(part, tuple) and len(part) == 2]
    if not listed or len(pairs) != len(listed):
        raise DeclarationError(
            f"parts of {name!r}: {parts!r}"[:200],
            expected="bodies, each with the place of its centre of mass",
            advice='as in [(shaft, axes.zero), (head, axes["x"] * l)]',
        )
    for body, place in pairs:
        of_type(body, Body, f"a part of {name!r}", "give the body and its place")
        of_type(place, Vector, f"the place of {body.name!r}", 'give it as axes["x"] * l')
    return pairs


def _require_fixed(name: str, body: Body, place: Vector, axes: Frame) -> None:
    """Refuse a part that turns or moves in the body."""
    entries = (*body.axes.rotation_to(axes).entries, *place.express(axes).components)
    moving = {s.published for e in entries for s in e.symbols() if is_varying(s)}
    if moving:
        raise DeclarationError(
            f"part {body.name!r} of {name!r}, which moves with {', '.join(sorted(moving))}",
            expected="parts that are fixed to one another",
            advice="give the parts the axes of the whole, or axes turned by constant angles from "
            "them; bodies that move on one another are joined by a Hinge or another joint",
        )

"""Curved supports in words: what they are, and what the coordinates of a body on them are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

from polhode.model import (
    Cone,
    CurvedSupport,
    Cylinder,
    Graph,
    Parametric,
    Revolution,
    Sphere,
    Torus,
)
from polhode.solution._lines import inline


@dataclass(frozen=True)
class _Surface:
    """Words for a surface.

    Attributes:
        what: it is.
        where: what its coordinates are.
        sides: where bodies are, "inside" and otherwise.
    """

    what: str
    where: str
    sides: tuple[str, str] = ("the inside", "the outside")


def surface_words(support: CurvedSupport) -> str:
    """A curved support, with the coordinates of a body on it."""
    surface = _surface(support)
    if not surface.what:
        return "a curved surface"
    side = surface.sides[0] if support.inside else surface.sides[1]
    what = surface.what
    if support.carrier is not None:
        what = f"the {support.carrier.name}, {what}"
    return f"{side} of {what}; of the point of contact, {surface.where}"


def _axis(support: CurvedSupport) -> str:
    return support.axis.removeprefix("-")


def _letters(support: CurvedSupport) -> tuple[str, str]:
    u, v = map(inline, support.uv)
    return u, v


@singledispatch
def _surface(support: CurvedSupport) -> _Surface:
    return _Surface("", "")


@_surface.register
def _(support: Sphere) -> _Surface:
    u, v = _letters(support)
    from_ = "bottom" if support.inside else "top"
    return _Surface(
        f"a sphere of radius {inline(support.radius)}",
        f"{u} and {v} are its longitude and latitude from the {from_}",
    )


@_surface.register
def _(support: Cylinder) -> _Surface:
    u, v = _letters(support)
    return _Surface(
        f"a cylinder of radius {inline(support.radius)} with its axis along ${_axis(support)}$",
        f"{u} is its angle about the axis and {v} its distance along it",
    )


@_surface.register
def _(support: Cone) -> _Surface:
    u, v = _letters(support)
    half = inline(support.half_angle)
    return _Surface(
        f"a cone of half-angle {half} with its axis along ${_axis(support)}$",
        f"{u} is its angle about the axis and {v} its distance from the apex",
    )


@_surface.register
def _(support: Torus) -> _Surface:
    u, v = _letters(support)
    return _Surface(
        f"a torus about ${_axis(support)}$ whose tube has the radius {inline(support.tube)} and "
        f"its middle the radius {inline(support.radius)}",
        f"{u} is its angle about the axis and {v} that about the middle of the tube",
    )


_UPPER = ("the upper side", "the lower side")


@_surface.register
def _(support: Graph) -> _Surface:
    u, v = _letters(support)
    x, y = support.frame.others(_axis(support))
    return _Surface(
        f"the surface ${_axis(support)} = {support.elevation.latex()}$",
        f"{u} and {v} are its coordinates along ${x}$ and ${y}$",
        _UPPER,
    )


@_surface.register
def _(support: Revolution) -> _Surface:
    u, v = _letters(support)
    return _Surface(
        f"the surface of revolution ${_axis(support)} = {support.elevation.latex()}$",
        f"{u} is its angle about the axis and {v} its distance from it",
        _UPPER,
    )


@_surface.register
def _(support: Parametric) -> _Surface:
    u, v = _letters(support)
    x, y, z = (support.renamed(component).latex() for component in support.place)
    first, second = (rf"\partial\mathbf r/\partial {q.latex()}" for q in support.uv)
    normal = rf"{first} \times {second}"
    return _Surface(
        rf"the surface of the points $\mathbf r = ({x},\; {y},\; {z})$",
        f"{u} and {v} are its coordinates",
        (f"the side against ${normal}$", f"the side of ${normal}$"),
    )

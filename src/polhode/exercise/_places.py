"""What stands in a declaration: places on bodies, and all expressions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from polhode.algebra import Expr, Symbol, Vector
from polhode.model import Body, BodyPoint, Element


def places_on_bodies(part: Any) -> Iterator[tuple[Body, Vector]]:
    """Places on bodies at which anything acts, each from the centre of mass."""
    if isinstance(part, BodyPoint):
        yield part.body, part.offset
        return
    at = getattr(part, "at", None)
    if isinstance(part, Element) and isinstance(at, Vector):
        yield part.bodies[0], at
    for inner in _inside(part):
        yield from places_on_bodies(inner)


def expressions_of(part: Any) -> Iterator[Expr]:
    """All expressions of a declaration."""
    if isinstance(part, Expr):
        yield part
    for inner in _inside(part):
        yield from expressions_of(inner)


def _inside(part: Any) -> tuple[Any, ...]:
    if isinstance(part, tuple):
        return part
    if not is_dataclass(part) or isinstance(part, Symbol | Expr | type):
        return ()
    return tuple(getattr(part, field.name) for field in fields(part))

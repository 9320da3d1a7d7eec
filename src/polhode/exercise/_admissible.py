"""Values of parameters that a system can have: its bodies exist, and its parts lie within them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import sqrt

import numpy as np

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import LENGTH, NumericError
from polhode.exercise._places import expressions_of, places_on_bodies
from polhode.exercise._subject import ExerciseSubject, value_of
from polhode.model import Body, Round, second_moments

#: How far a uniform body reaches over its radius of gyration, by how many directions it extends in:
#: half a rod √3, the radius of a disk 2, that of a sphere √5.
_REACH = {1: sqrt(3), 2: 2.0, 3: sqrt(5)}
_CLEARLY = 1.2  # times as large is what is larger
_ROUNDING = 1e-6
_FITS = 0.1  # of 1, for a hollow much wider than the body in it


@dataclass(frozen=True)
class Admissible:
    """What the parameters of a system have to obey.

    Attributes:
        bodies: whose masses and moments of inertia are positive, none above the sum of the others.
        places: on bodies, at lengths of their own from the centre of mass: within the body.
        ordered: pairs of lengths of which the first is the larger.
        rounded: bodies that touch with a sphere, in which their centre of mass is.
        limits: what is positive where bodies fit into the hollows that they touch.
    """

    bodies: tuple[Body, ...]
    places: tuple[tuple[Body, Vector], ...]
    ordered: tuple[tuple[Symbol, Symbol], ...]
    rounded: tuple[tuple[Body, Round], ...]
    limits: tuple[Expr, ...]

    @classmethod
    def of(cls, subject: ExerciseSubject) -> Admissible:
        """What the declaration says or implies.

        Of two lengths whose difference is declared, such as R - a, that with a capital letter is
        the larger.
        """
        system = subject.equations.system

        def is_length(symbol: Symbol) -> bool:
            return not symbol.kind.varies and subject.dimension(symbol) == LENGTH

        places = dict.fromkeys(
            (body, at)
            for body, at in places_on_bodies(system)
            if _has_own_length(body, at, is_length)
        )
        pairs = dict.fromkeys(
            pair for e in expressions_of(system) if (pair := _difference(e, is_length))
        )
        rounded = ((b, b.surface) for b in subject.bodies if isinstance(b.surface, Round))
        limits = (
            limit
            for limit in subject.equations.limits
            if not any(s.kind.varies for s in limit.symbols())
        )
        return cls(subject.bodies, tuple(places), tuple(pairs), tuple(rounded), tuple(limits))

    def admits(self, values: Mapping[Symbol, float]) -> bool:
        """Whether the system can have these parameters."""
        return (
            all(is_legal(body, values) for body in self.bodies)
            and all(_is_within(body, at, values) for body, at in self.places)
            and all(values[large] > _CLEARLY * values[small] for large, small in self.ordered)
            and all(_is_in_sphere(body, surface, values) for body, surface in self.rounded)
            and all(value_of(limit, values) > _FITS for limit in self.limits)
        )


def is_legal(body: Body, values: Mapping[Symbol, float]) -> bool:
    """Whether a body can have this mass and these moments of inertia."""
    if body.mass and not value_of(body.mass, values) > 0:
        return False
    rows = [[value_of(e, values) for e in row] for row in body.inertia.rows]
    low, middle, high = np.linalg.eigvalsh(np.array(rows))
    slack = 1e-9 * max(abs(high), 1e-300)
    is_thin = not all(body.inertia[i, i] for i in range(3))  # a rod, or a particle
    return bool(low >= (-slack if is_thin else _ROUNDING * high) and high <= low + middle + slack)


def _is_within(body: Body, at: Vector, values: Mapping[Symbol, float]) -> bool:
    """Whether a place is within a body, as far as its inertia tells how large it is."""
    moments = second_moments(body.inertia)
    sizes = [value_of(moments[i, i], values) for i in range(3)]
    extends = [size > _ROUNDING * max(sizes) for size in sizes]
    if not any(extends):  # a particle
        return True
    reach = _REACH[sum(extends)] / sqrt(value_of(body.mass, values))
    try:
        place = [value_of(c, values) for c in at.express(body.axes).components]
    except NumericError:  # it moves
        return True
    found = zip(place, sizes, extends, strict=True)
    return all(abs(c) <= (1 + _ROUNDING) * reach * sqrt(size) for c, size, has in found if has)


def _is_in_sphere(body: Body, surface: Round, values: Mapping[Symbol, float]) -> bool:
    """Whether the centre of mass is in the sphere, and no mass need be outside it."""
    radius, offset = value_of(surface.radius, values), abs(value_of(surface.offset, values))
    spread = sum(value_of(body.inertia[i, i], values) for i in range(3)) / 2  # ∫ r² dm
    around = radius**2 - offset**2  # the most that ∫ r² dm can be is this times the mass
    return _CLEARLY * offset < radius and spread <= value_of(body.mass, values) * around


# -- what a declaration implies --------------------------------------------------------------------


def _has_own_length(body: Body, at: Vector, is_length: Callable[[Symbol], bool]) -> bool:
    """Whether a body is sized by lengths, and a place on it by another length."""
    sized = {s for row in body.inertia.rows for e in row for s in e.symbols() if is_length(s)}
    placed = {s for c in at.components for s in c.symbols() if is_length(s)}
    return bool(sized and placed - sized)


def _difference(
    expression: Expr, is_length: Callable[[Symbol], bool]
) -> tuple[Symbol, Symbol] | None:
    """The larger and the smaller of two lengths whose difference an expression is."""
    symbols = sorted(expression.symbols(), key=lambda s: s.published[0].islower())
    if len(symbols) != 2 or not all(map(is_length, symbols)):
        return None
    large, small = symbols
    slopes = [expression.diff(s) for s in symbols]
    if any(s.symbols() or not s for s in slopes):
        return None
    signs = [value_of(s, {}) > 0 for s in slopes]
    is_capital = [s.published[0].isupper() for s in symbols]
    return (large, small) if signs[0] != signs[1] and is_capital == [True, False] else None

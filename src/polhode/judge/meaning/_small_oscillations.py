"""Frequencies and periods of small oscillations about steady motions, as letters stand for them.

Each is a function of the mechanics of a system, in SI units, and raises `DeclarationError` for a
system that does not have it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from functools import lru_cache

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, cos, is_positive, pi, sin, sqrt
from polhode.base import DeclarationError, PolhodeError
from polhode.judge.meaning._derived_quantities import phase_space
from polhode.judge.meaning._mechanics import Mechanics

ORDINALS = ("first", "second", "third")

_READABLE = 24  # terms of the square of a frequency; none is printed that has more
_FEW = 3  # speeds of a system whose small oscillations are sought; more take seconds


def frequencies(mechanics: Mechanics) -> dict[str, Expr]:
    """The frequency of small oscillations about each steady motion that has just one, rad/s."""
    return {name: values[0] for name, values in _of_modes(mechanics).items() if len(values) == 1}


def normal_frequencies(mechanics: Mechanics) -> dict[str, tuple[Expr, ...]]:
    """Those of the normal modes about each steady motion that has two or more, rad/s."""
    return {name: values for name, values in _of_modes(mechanics).items() if len(values) > 1}


def has_speed(mechanics: Mechanics, frequency: Expr) -> bool:
    """Whether a frequency depends on speeds, such as on the spin of a top."""
    return any(s.order or s in mechanics.equations.speeds for s in frequency.symbols())


@lru_cache(maxsize=16)  # systems
def _of_modes(mechanics: Mechanics) -> dict[str, tuple[Expr, ...]]:
    """The frequencies of small oscillations about each steady motion that may be stable.

    They may depend on the speeds of that motion, such as on the spin of a disk.
    """
    from polhode.analyse import Truth, stability, steady  # loaded only for the texts that need it

    if len(mechanics.equations.speeds) > _FEW:
        return {}

    def found() -> Iterator[tuple[str, tuple[Expr, ...]]]:
        for family in steady(mechanics.equations):
            name, resting = str(family), _resting_at_zero(mechanics, family.relations)
            if resting:
                name = ", ".join(f"{q.published} = 0" for q in resting)
            try:
                small = stability(family, resting)
                if any(len(square.num.monoms()) > _READABLE for square in small.squares):
                    continue
                values = tuple(_by_places(w, family.relations) for w in small.frequencies)
                is_unstable = any(c.truth is Truth.NEVER for c in small.conditions)
            except (PolhodeError, ZeroDivisionError):
                continue  # such as for an upright top in angles that are singular there
            if is_unstable:
                continue
            yield name, values
            for q in mechanics.equations.coordinates if family.relations and not resting else ():
                if not any(relation.subs({q: ZERO}) for relation in family.relations):
                    yield f"{q.published} = 0", tuple(v.subs({q: ZERO}) for v in values)

    modes = _in_a_plane(mechanics)
    with suppress(PolhodeError, ZeroDivisionError):
        modes |= dict(found())
    # Where a spin decides, as for a gyrocompass, a frequency known by a place is another motion's.
    spinning = [any(has_speed(mechanics, v) for v in values) for values in modes.values()]
    return {
        family: values
        for (family, values), spins in zip(modes.items(), spinning, strict=True)
        if spins or not (any(spinning) and any(v.varies for v in values))
    }


def _resting_at_zero(mechanics: Mechanics, relations: Sequence[Expr]) -> dict[Symbol, Expr]:
    """Coordinates that together may be zero in a steady motion, of which there are several.

    So are the angles of coupled pendulums, whose other equilibria are given by no formula.
    """
    symbols = {s for relation in relations for s in relation.symbols()}
    zeros = {q: ZERO for q in mechanics.equations.coordinates if q in symbols}
    try:
        is_met = len(zeros) > 1 and not any(relation.subs(zeros) for relation in relations)
    except ZeroDivisionError:
        return {}
    return zeros if is_met else {}


def _by_places(frequency: Expr, relations: tuple[Expr, ...]) -> Expr:
    """A frequency without what the relations of a steady motion determine.

    That of a circular orbit is known by its radius r as well as by the rate of turning; that of a
    bead on a hoop that is kept turning at Ω by Ω as well as by the inclination.
    """
    square = frequency * frequency
    for relation in relations:
        for rate in sorted((s for s in relation.symbols() if s.order), key=str):
            by_square = relation.diff(rate).diff(rate) / 2
            rest = relation.subs({rate: ZERO})
            if rate not in by_square.symbols() and not relation.diff(rate).subs({rate: ZERO}):
                square = square.subs({rate: sqrt(-rest / by_square)})
        for q in (s for s in relation.symbols() if s.kind is SymbolKind.COORDINATE):
            square = _inclined(square, relation, q)
    return sqrt(square)


def circular_parts(relation: Expr, angle: Symbol) -> tuple[Expr, Expr, Expr] | None:
    """A, B and C of A cos θ + B sin θ + C; None for another function of an angle."""
    cosine, sine = cos(Expr.generator(angle)), sin(Expr.generator(angle))
    slope = relation.diff(angle)
    swing = -slope.diff(angle)
    parts = swing * cosine - slope * sine, swing * sine + slope * cosine, relation - swing
    is_circular = slope and not any(angle in part.symbols() for part in parts)
    return parts if is_circular else None


def _inclined(square: Expr, relation: Expr, angle: Symbol) -> Expr:
    """A quantity at the angle where A cos θ + B sin θ + C vanishes, if B or C is zero.

    Of the two angles where A cos θ + B sin θ vanishes it is the one at which the quantity is
    positive.
    """
    parts = circular_parts(relation, angle)
    if parts is None or any(s.kind.varies for part in parts for s in part.symbols()):
        return square
    by_cosine, by_sine, rest = parts
    if rest and by_sine:
        return square
    size = sqrt(by_cosine**2 + by_sine**2)
    even = -rest / by_cosine if rest else by_sine / size
    odd = sqrt(1 - even**2) if rest else -by_cosine / size
    (cosine,), (sine,) = (f(Expr.generator(angle)).generators for f in (cos, sin))
    found = square.recast({cosine: even, sine: odd})
    return -found if not rest and is_positive(-found) else found


def _in_a_plane(mechanics: Mechanics) -> dict[str, tuple[Expr, ...]]:
    """The frequency of particles that swing without turning about the vertical.

    There, the angle φ about the vertical is singular: a spherical pendulum hanging down. With the
    cyclic rates zero, T = A q̇²/2 and V are those of one coordinate q, and ω² = V″/A.
    """
    if any(any(row) for body in mechanics.bodies for row in body.inertia.rows):
        return {}
    try:
        space = phase_space(mechanics)
    except (PolhodeError, ZeroDivisionError):
        return {}
    free = [r for r, momentum in space.rates.items() if momentum not in space.cyclic]
    if len(free) != 1 or not space.cyclic:
        return {}
    (rate,) = free
    planar = {r: ZERO for r in space.rates if r != rate}
    q, lagrangian = rate.base(), mechanics.in_rates(mechanics.lagrangian()).subs(planar)
    size, force = lagrangian.diff(rate).diff(rate), mechanics.potential_energy().diff(q)
    found: dict[str, tuple[Expr, ...]] = {}
    for place in (ZERO, pi):
        try:
            slope, pull = (e.subs({q: place}) for e in (force, force.diff(q)))
        except ZeroDivisionError:
            continue  # 1/r of an attraction
        if not slope and is_positive(pull):
            found[f"{q.published} = {place}"] = (sqrt(pull / size.subs({q: place})),)
    return found if len(found) == 1 else {}


def frequency(mechanics: Mechanics, about: str = "") -> Expr:
    """Of small oscillations about a steady motion, rad/s."""
    known = frequencies(mechanics)
    if about in known:
        return known[about]
    if len(known) != 1 or about:
        raise DeclarationError(
            "the frequency of small oscillations",
            expected=f"one about {' or about '.join(known)}" if known else "a system that has one",
        )
    return next(iter(known.values()))


def normal_frequency(mechanics: Mechanics, which: str, about: str = "") -> Expr:
    """That of the first, second … normal mode about a steady motion, rad/s."""
    known = normal_frequencies(mechanics)
    values = known.get(about, ()) if about or len(known) != 1 else next(iter(known.values()))
    if ORDINALS.index(which) >= len(values):
        raise DeclarationError(f"the {which} normal frequency", expected="a system that has one")
    return values[ORDINALS.index(which)]


def period(mechanics: Mechanics, about: str = "") -> Expr:
    """Of small oscillations about a steady motion, s."""
    return 2 * pi / frequency(mechanics, about)


def number_per_second(mechanics: Mechanics, about: str = "") -> Expr:
    """Of small oscillations about a steady motion: the reciprocal of their period, Hz."""
    return frequency(mechanics, about) / (2 * pi)

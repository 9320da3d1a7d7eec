"""Numbers for what a figure draws: one generic attitude of the system."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import combinations
from math import radians
from typing import Any

from polhode.algebra import (
    PI,
    Compiled,
    Expr,
    Symbol,
    SymbolKind,
    Vector,
    as_symbol,
    compile_program,
    with_jacobian,
)
from polhode.derive import Equations
from polhode.model import Body, Cone, Frame, Gravity, Rim, Rope, Round

Point = tuple[float, float, float]

_OTHERS = (58.0, 35.0, 25.0, 20.0)  # degrees, for the rotations after the first
_LETTERS = {"theta": 58.0, "alpha": 24.0, "lambda_": 50.0}
_INSTANT = 0.6  # s
_FROM_APEX = 2.0
_SMALL, _LONG = 0.45, 1.3  # radii, and other lengths, where there are both


@dataclass(frozen=True)
class FigureState:
    """A system at one attitude.

    Attributes:
        equations: of the system.
        first: degrees of its first rotation.
    """

    equations: Equations
    first: float
    _programs: dict[Expr, float] = field(default_factory=dict, compare=False, repr=False)

    @cached_property
    def values(self) -> dict[Symbol, float]:
        """Angles at generic values, lengths near one, closed loops closed."""
        found = self.chosen
        closures = self.equations.closures
        if not closures:
            return found
        free = [q for q in self.equations.coordinates if q not in angles_of(self.equations)]
        for unknown in (free, list(self.equations.coordinates)):
            closed = _closed(closures, found, tuple(unknown))
            if closed is not None:
                return closed
        return found

    @cached_property
    def chosen(self) -> dict[Symbol, float]:
        """Values before loops are closed."""
        angles = angles_of(self.equations)
        found = dict(zip(angles, map(radians, (self.first, *_OTHERS, *_OTHERS)), strict=False))
        for symbol in found:
            if symbol.name in _LETTERS:
                found[symbol] = radians(_LETTERS[symbol.name])
        found = {**_radii(self.equations), **_spread(self.equations), **found}
        found |= _from_apexes(self.equations)
        return {**_apart(self.equations, found), **found}

    def number(self, expression: Expr) -> float:
        """The value of an expression."""
        if expression not in self._programs:
            self._programs[expression] = value_of(expression, self.values)
        return self._programs[expression]

    def point(self, vector: Vector) -> Point:
        """Components along the laboratory's axes."""
        x, y, z = (self.number(c) for c in vector.express(root_of(self.equations)).components)
        return x, y, z

    def moved(self, vector: Vector, symbols: tuple[Symbol, ...]) -> Callable[..., Point]:
        """The same as a function of how much some symbols are changed."""
        components = vector.express(root_of(self.equations)).components
        letters = {s for component in components for s in component.symbols()}
        others = sorted(letters - {*symbols, PI}, key=lambda symbol: symbol.published)
        function = compile_program(components, (*symbols, *others)).function()
        here = [self.values.get(s, _default(s)) for s in (*symbols, *others)]
        chosen, fixed = here[: len(symbols)], here[len(symbols) :]

        def point(*changes: float) -> Point:
            moved = (value + by for value, by in zip(chosen, changes, strict=True))
            x, y, z = function(*moved, *fixed)
            return float(x), float(y), float(z)

        return point

    def centre(self, body: Body) -> Point:
        """Of mass."""
        return self.point(self.equations.kinetics.places[body])


def root_of(equations: Equations) -> Frame:
    """The axes of the laboratory."""
    return equations.system.bodies[0].axes.root


def up_of(equations: Equations) -> Vector | None:
    """Unit vector opposite to gravity, or upwards on the Earth; None where nothing tells."""
    root = root_of(equations)
    loads = (load for load in equations.system.loads if isinstance(load, Gravity))
    return next((load.up or root[root.labels[2]] for load in loads), root.skyward)


def frames_of(equations: Equations) -> Iterator[tuple[Frame, Body]]:
    """Every rotation from the laboratory, with the first body that it leads to or that touches."""
    seen = set[Frame]()
    contacts = equations.system.contacts
    every = [(body.axes, body) for body in equations.system.bodies]
    for axes, body in [*every, *((c.on.axes, c.body) for c in contacts)]:
        for frame in reversed(axes.lineage):
            if frame.parent is not None and frame not in seen:
                seen.add(frame)
                yield frame, body


def angles_of(equations: Equations) -> tuple[Symbol, ...]:
    """The letters in the angles of all frames, without π and the time."""
    every = [
        symbol
        for frame, _ in frames_of(equations)
        for symbol in sorted(frame.angle.symbols(), key=str)
        if len(frame.angle.symbols() - {PI}) == 1
    ]
    return tuple(dict.fromkeys(s for s in every if s != PI and s.kind is not SymbolKind.TIME))


def _radii(equations: Equations) -> dict[Symbol, float]:
    """Radii are less than the other lengths, where there are others."""
    surfaces = [body.surface for body in equations.system.bodies]
    radii = {
        symbol for s in surfaces if isinstance(s, Rim | Round) for symbol in s.radius.symbols()
    }
    vectors = [*equations.kinetics.places.values(), *(r.arm for r in equations.reactions.values())]
    every = {symbol for v in vectors for c in v.components for symbol in c.symbols()}
    others = {s for s in every if s.kind is SymbolKind.PARAMETER and s != PI} - radii
    others -= set(angles_of(equations))
    if not radii or not (others or _from_apexes(equations)):
        return {}
    return {**dict.fromkeys(others, _LONG), **dict.fromkeys(radii, _SMALL)}


def _from_apexes(equations: Equations) -> dict[Symbol, float]:
    """Distances along cones from their apexes."""
    cones = (c.on for c in equations.system.contacts if isinstance(c.on, Cone))
    return {as_symbol(cone.uv[1]): _FROM_APEX for cone in cones}


def _spread(equations: Equations) -> dict[Symbol, float]:
    """Bodies that can be anywhere stand apart, and hang where a rope holds them."""
    found: dict[Symbol, float] = {}
    hang = any(isinstance(element, Rope) for element in equations.system.elements)
    steps = (0.0, 1.3, -1.1 if hang else 0.5)
    for i, place in enumerate(equations.kinetics.places.values()):
        for component, step in zip(place.components, steps, strict=True):
            symbol = component.symbol
            if symbol is not None and symbol.kind is SymbolKind.COORDINATE:
                found.setdefault(symbol, i * step)
    return found


def _apart(equations: Equations, values: dict[Symbol, float]) -> dict[Symbol, float]:
    """Different lengths where two bodies would be drawn at one place if all lengths were equal."""
    for first, second in combinations(equations.kinetics.places.values(), 2):
        gap = (first - second).express(root_of(equations)).components
        if any(gap) and all(abs(value_of(component, values)) < 1e-9 for component in gap):
            letters = {s for c in gap for s in c.symbols() if s.kind is SymbolKind.PARAMETER}
            free = sorted(letters - {PI} - values.keys(), key=lambda s: s.published)
            return {symbol: 0.7 + 0.6 * i for i, symbol in enumerate(free)}
    return {}


def value_of(expression: Expr, values: dict[Symbol, float]) -> float:
    """An expression at these values; what has none is one, a rate or coordinate zero."""
    known, function = _function_of(expression)
    return float(function(*(values.get(symbol, _default(symbol)) for symbol in known))[0])


@lru_cache(maxsize=1024)
def _function_of(expression: Expr) -> tuple[tuple[Symbol, ...], Compiled]:
    """An expression compiled, with its symbols in order; most are asked for at many states."""
    symbols = (symbol for symbol in expression.symbols() if symbol != PI)
    known = tuple(sorted(symbols, key=lambda symbol: symbol.published))
    return known, compile_program([expression], known).function()


def _default(symbol: Symbol) -> float:
    if symbol.kind is SymbolKind.TIME:
        return _INSTANT
    return 1.0 if symbol.kind is SymbolKind.PARAMETER else 0.0


_STEPS = 60  # of Newton's method
_SHORTEST = 1e-12  # rad or a unit of length: shorter steps are rounding


def _closed(
    closures: tuple[Expr, ...], start: dict[Symbol, float], unknown: tuple[Symbol, ...]
) -> dict[Symbol, float] | None:
    """Values at which closed loops are closed; None where none are near.

    By Newton's method, with the shortest step that closes them to first order, halved for as long
    as it opens them further.
    """
    import numpy as np

    if not unknown:
        return None
    letters = {symbol for closure in closures for symbol in closure.symbols()}
    others = sorted(letters - {*unknown, PI}, key=lambda symbol: symbol.published)
    program = compile_program(closures, (*unknown, *others))
    varied = with_jacobian(program, len(unknown)).function()
    fixed = [start.get(symbol, _default(symbol)) for symbol in others]

    def opened(numbers: Any) -> tuple[Any, Any]:
        """By how much loops are open, and the derivatives of that."""
        gaps, slopes = np.split(np.array(varied(*numbers.tolist(), *fixed)), [len(closures)])
        return gaps, slopes.reshape(len(closures), len(unknown))

    numbers = np.array([start.get(symbol, 0.0) for symbol in unknown], dtype=float)
    for _ in range(_STEPS):
        gaps, slopes = opened(numbers)
        step = np.linalg.lstsq(slopes, -gaps, rcond=None)[0]
        while np.linalg.norm(opened(numbers + step)[0]) > np.linalg.norm(gaps) and np.any(step):
            step = np.where(np.abs(step) < _SHORTEST, 0.0, step / 2)
        if not np.any(numbers + step != numbers):
            break
        numbers = numbers + step
    if np.max(np.abs(opened(numbers)[0])) > 1e-9:
        return None
    return {**start, **dict(zip(unknown, numbers.tolist(), strict=True))}

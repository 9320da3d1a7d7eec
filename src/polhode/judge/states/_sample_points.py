"""States of a domain at which relations are tried: one with exact values, or many by numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache, partial
from itertools import islice
from math import atan
from random import Random
from typing import Any

import numpy as np

from polhode.algebra import (
    PI,
    Expr,
    Generator,
    Symbol,
    SymbolKind,
    sqrt,
    under_name,
    variables,
)
from polhode.base import ByIdentity, NumericError
from polhode.derive import Equations
from polhode.judge.states._claim_domain import ClaimDomain
from polhode.judge.states._field_states import FieldStates
from polhode.judge.states._numeric import NO_VALUE, Array, number, numbers, rationals

_STATES = 6  # so many that no wrong correction holds at all of them by chance
_TRIES = 40
_ROUNDING = 1e-9  # relative; for a flat body I₁ + I₂ = I₃ exactly, up to rounding

# -- one state with simple exact numbers ----------------------------------------------------------

_SIMPLE = [Fraction(n, d) for d in (1, 2, 3) for n in range(1, 8) if n % d or d == 1]
_HALF_TANGENTS = [Fraction(n, d) for d in range(2, 8) for n in range(1, d) if d % n or n == 1]


@dataclass(frozen=True)
class ExactPoint:
    """Exact values of symbols; an angle is given by t = tan(θ/2).

    Then sin θ = 2t/(1 + t²) and cos θ = (1 - t²)/(1 + t²) are rational.

    Attributes:
        numbers: value of every symbol that is not an angle, SI.
        half_tangents: tan(θ/2) of the symbols of which sines and cosines are taken.
    """

    numbers: Mapping[Symbol, Fraction]
    half_tangents: Mapping[Symbol, Fraction]

    def __call__(self, expression: Expr) -> Expr:
        """The exact value of an expression: rational, or a root of rationals.

        Raises `NumericError` where it has no exact value of that sort, and `ZeroDivisionError`.
        """
        return expression.recast({g: self._value(g) for g in expression.generators})

    def _value(self, generator: Generator) -> Expr:
        if generator == PI:
            return Expr.generator(generator)
        if isinstance(generator, Symbol):
            if generator not in self.numbers:
                raise _not_exact(generator)
            return Expr.constant(self.numbers[generator])
        meaning = under_name(generator)
        if meaning is not None:
            return self(meaning)
        partner = generator.partner() or _odd(generator)
        if generator.depth and generator.partner() is None:
            return sqrt(self(generator.arguments[0]))
        angle, part = _angle(generator)
        tangent = self.half_tangents.get(angle)
        if partner is None or partner[1] > 0 or tangent is None:
            raise _not_exact(generator)
        cosine = Expr.of((1 - tangent**2) / (1 + tangent**2))
        sine = Expr.of(2 * tangent / (1 + tangent**2))
        if part == Fraction(1, 2):  # half-angle formulas; the angle lies between 0 and π
            sine, cosine = sqrt((1 - cosine) / 2), sqrt((1 + cosine) / 2)
        elif part != 1:
            raise _not_exact(generator)
        return cosine if generator.partner() else sine

    def floats(self) -> dict[Symbol, float]:
        """All values as numbers, angles in radians."""
        angles = {s: 2 * atan(tangent) for s, tangent in self.half_tangents.items()}
        return {**{s: float(v) for s, v in self.numbers.items()}, **angles}

    def described(self) -> dict[str, str]:
        """All values as text under their published names."""
        plain = {s.published: str(v) for s, v in self.numbers.items()}
        angles = {s.published: f"2*atan({t})" for s, t in self.half_tangents.items()}
        return dict(sorted({**plain, **angles}.items()))


def on_closed_loops(point: ExactPoint, states: ClaimDomain) -> ExactPoint:
    """The point with the quantities changed that close the loops; rounded where they are roots.

    Raises what `NO_VALUE` lists where no value closes them.
    """
    if not states.closed:
        return point
    known = point.floats()
    values = {s: float(number(value, known)) for s, value in states.closed.items()}
    rounded = {s: Fraction(repr(value)) for s, value in values.items()}
    return replace(point, numbers={**point.numbers, **rounded})


def exact_point(
    expressions: Iterable[Expr],
    symbols: Iterable[Symbol],
    seed: int,
    pool: Sequence[Fraction] = _SIMPLE,
) -> ExactPoint:
    """A point with simple values for all symbols; those under a sine or cosine are angles."""
    random = Random(seed)
    angles = {a for e in expressions for g in e.generators for a in _angles(g)}
    # A fixed order, so that the same seed gives the same point in every process.
    ordered = sorted({*symbols} - {PI}, key=lambda s: s.published)
    draw, draw_tangent = _draws(random, pool), _draws(random, _HALF_TANGENTS)
    plain = {s: draw(s) for s in ordered if s not in angles}
    tangents = {s: draw_tangent(s) for s in ordered if s in angles}
    if seed % 3 == 2:  # a claim such as |sin θ| = sin θ is refuted by a negative angle only
        tangents = {s: random.choice([1, -1]) * t for s, t in tangents.items()}
    return ExactPoint(plain, tangents)


def _draws(random: Random, pool: Sequence[Fraction]) -> Callable[[Symbol], Fraction]:
    """Draws values from a pool without repetition as long as it lasts; some rates are negative.

    Equal values would make differences such as I₁ - I₂ vanish and hide what they multiply.
    """
    left: list[Fraction] = []

    def draw(symbol: Symbol) -> Fraction:
        if not left:
            left.extend(random.sample(pool, len(pool)))
        value = left.pop()
        free = symbol.kind is not SymbolKind.PARAMETER and not symbol.positive
        return -value if free and symbol.order and random.random() < 1 / 3 else value

    return draw


@lru_cache(maxsize=65536)
def _angles(generator: Generator) -> tuple[Symbol, ...]:
    """Symbols of which the generator takes a sine or cosine, also under roots."""
    meaning = under_name(generator)
    if meaning is not None:
        return tuple(dict.fromkeys(a for g in meaning.generators for a in _angles(g)))
    odd = _odd(generator)
    if odd is not None and odd[1] < 0:
        if not generator.arguments[0].symbols():  # the sine of a number, such as sin 1
            return ()
        try:
            angle = _angle(generator)[0]
        except NumericError:  # cos γt, whose γ and t are drawn as they are
            return ()
        return () if angle == PI else (angle,)
    inner = (g for argument in generator.arguments for g in argument.generators)
    return tuple(a for g in inner for a in _angles(g))


def _odd(generator: Generator) -> tuple[Generator, int] | None:
    """The odd function of the pair that a function belongs to, sin or sinh, and the pair's sign.

    The sign is that of d²f/dx² = ±f: -1 for sine and cosine, 1 for the hyperbolic pair.
    """
    pairs = (g.partner() for g in generator.companions() if g.depth)
    own = generator.partner()
    return own or next((pair for pair in pairs if pair and pair[0] == generator), None)


def _angle(generator: Generator) -> tuple[Symbol, Fraction]:
    """Symbol and factor of the argument c θ of a sine or cosine."""
    argument = generator.arguments[0]
    symbols = argument.symbols()
    if len(symbols) != 1:
        raise _not_exact(generator)
    (symbol,) = symbols
    factor = (argument / Expr.generator(symbol)).rational
    if factor is None:
        raise _not_exact(generator)
    return symbol, factor


def _not_exact(generator: Generator) -> NumericError:
    return NumericError(
        f"{Expr.generator(generator)} at a point of exact numbers",
        expected="polynomials, roots, and sines and cosines of single angles",
    )


# -- many states by numbers -----------------------------------------------------------------------


class SymbolValues(dict[Symbol, float]):
    """The value of every symbol at one state, computed on first use.

    Args:
        free: values of the symbols that the domain leaves free.
        states: the domain.
        seed: for drawing further free symbols.
    """

    def __init__(self, free: Mapping[Symbol, float], states: ClaimDomain, seed: int) -> None:
        super().__init__(free)
        self._free = dict(self)
        self._states = states
        self._seed = seed
        self._generators: dict[Generator, Any] = {}
        self._accelerations: dict[Symbol, float] = {}

    @property
    def free(self) -> dict[Symbol, float]:
        """The values that were given or drawn, from which all others follow."""
        return dict(self._free)

    def __missing__(self, symbol: Symbol) -> float:
        field = self._states.field
        if field is not None and field.is_long and not field.is_drawn(symbol):
            self[symbol] = self._solved(symbol, field)
            return self[symbol]
        image = self._states.of(symbol)
        unknown = image.symbols() - self._free.keys() - {PI}
        self._free |= exact_point((), unknown, self._seed + len(self._free)).floats()
        self[symbol] = number(image, self._free, self._generators)
        return self[symbol]

    def _solved(self, symbol: Symbol, field: FieldStates) -> float:
        """The value of a determined symbol, from those that determine it.

        Raises `NumericError` for rates of accelerations and reactions, which take too long.
        """
        speed = field.speed_of(symbol)
        beyond = symbol.order - speed.order - 1 if speed is not None else symbol.order
        if beyond > 0 and (speed is not None or symbol.base() in field.reactions):
            raise NumericError(
                f"the rate {symbol.published} in a system of long equations",
                expected="accelerations and reactions, or what is determined without them",
            )
        value = field.determined(symbol)
        if value is not None:
            return float(number(value, self, self._generators))
        if not self._accelerations:
            rows, right = field.equations.mass.rows, field.equations.forcing
            mass = [[number(m, self, self._generators) for m in row] for row in rows]
            forcing = [number(f, self, self._generators) for f in right]
            solved = np.linalg.solve(np.array(mass), np.array(forcing)).tolist()
            self._accelerations.update(
                zip(field.equations.acceleration_symbols, solved, strict=True)
            )
        return self._accelerations[symbol]


@dataclass(frozen=True, eq=False)
class SamplePoints:
    """Several states of a domain, for a quick check whether relations can hold.

    Attributes:
        states: the value of every symbol, state by state.
    """

    states: tuple[SymbolValues, ...]

    @property
    def size(self) -> int:
        """How many states there are."""
        return len(self.states)

    def values(self, expressions: Sequence[Expr]) -> Array:
        """Values of expressions: (expressions, states); nan where there is none."""
        columns = self._columns(variables(expressions) - {PI})
        return numbers(expressions, columns, (self.size,))

    def function(self, expressions: Sequence[Expr], unknown: Symbol) -> Callable[[Array], Array]:
        """Values of expressions as a function of one symbol that no state fixes, state by state."""
        columns = self._columns(variables(expressions) - {PI, unknown})
        found = rationals(expressions, unknown, columns, (self.size,))
        if found is None:
            return lambda at: numbers(expressions, {**columns, unknown: at}, at.shape)

        def evaluated(at: Array) -> Array:
            with np.errstate(all="ignore"):
                return np.array([function(at) for function in found]).reshape(len(found), *at.shape)

        return evaluated

    def _columns(self, symbols: Iterable[Symbol]) -> dict[Symbol, Array]:
        """The values of each symbol over the states."""
        found = {}
        for symbol in symbols:
            if symbol not in self._known:
                self._known[symbol] = np.array([state[symbol] for state in self.states])
            found[symbol] = self._known[symbol]
        return found

    @cached_property
    def _known(self) -> dict[Symbol, Array]:
        return {}


def sample_points(states: ClaimDomain, expressions: Iterable[Expr]) -> SamplePoints:
    """States with independent numbers for everything the domain leaves open."""
    return SamplePoints(tuple(islice(real_states(states, expressions), _STATES)))


def real_states(states: ClaimDomain, expressions: Iterable[Expr]) -> Iterator[SymbolValues]:
    """States of a domain, one after another: those drawn at which all values are real."""
    used = [states.on(e) for e in expressions]
    used += [*states.settled_relations, *states.signs]
    used += list(states.equations.accelerations.values())
    equations = states.equations
    symbols = {s for e in used for s in e.symbols()}
    symbols |= {*equations.coordinates, *equations.speeds, *equations.parameters}
    for seed in range(1000, 1000 + _TRIES):
        try:
            point = on_closed_loops(exact_point(used, symbols, seed), states)
        except NO_VALUE:
            continue
        found = SymbolValues(point.floats(), states, seed)
        if _is_real(found, states, symbols):
            yield found


def _is_real(state: SymbolValues, states: ClaimDomain, symbols: Iterable[Symbol]) -> bool:
    """Whether all values at a state are real, and positive where required; stores them in it."""
    ordered = tuple(symbols)
    try:
        values = numbers([states.of(s) for s in ordered], state, ())
        positive = numbers([states.on(e) for e in states.signs], state, ()) > 0
    except NO_VALUE:
        return False
    state.update(zip(ordered, values.tolist(), strict=True))
    return bool(positive.all() and np.isfinite(values).all())


# -- conditions on physical bodies: positive parameters, possible moments of inertia --------------


def is_physical(states: ClaimDomain, values: Mapping[Symbol, Any]) -> Any:
    """Whether bodies can have these values, which may be arrays of one shape.

    Quantities declared or derived as positive must be positive, also where the domain determines
    them, and no moment of inertia may exceed the sum of the other two.
    """
    met: Any = np.bool_(True)
    with np.errstate(all="ignore"):
        for condition in _conditions(states, partial(number, values=values, known={})):
            met = np.logical_and(met, condition)
            if not np.any(met):
                break  # the others may be long
    return met


def _conditions(states: ClaimDomain, value: Callable[[Expr], Any]) -> Iterator[Any]:
    """Whether each of them is met, from the values of expressions."""
    above, not_below = _inequalities(ByIdentity(states.equations))
    for larger, size in not_below:
        least = -_ROUNDING * np.abs(value(states.on(size)))
        yield value(states.on(larger)) >= least
    for e in (*states.signs, *above):
        found = value(states.on(e))
        yield np.isfinite(found) & (found > 0)  # infinite where a denominator of it is zero


def physical_symbols(states: ClaimDomain) -> frozenset[Symbol]:
    """The symbols whose values decide whether bodies are physical."""
    above, not_below = _inequalities(ByIdentity(states.equations))
    every = (*states.signs, *above, *(e for pair in not_below for e in pair))
    return frozenset(s for e in every for s in states.on(e).symbols())


@lru_cache(maxsize=16)
def _inequalities(
    key: ByIdentity[Equations],
) -> tuple[tuple[Expr, ...], tuple[tuple[Expr, Expr], ...]]:
    """Expressions that must be positive, and those that must not be negative, with their scale.

    The latter are I₁₁ = ∫(y² + z²) dm, I₂₂ + I₃₃ - I₁₁ = 2 ∫x² dm and so on, along any axes.
    """
    inertias: list[tuple[Expr, Expr]] = []
    for body in key.subject.system.bodies:
        moments = [body.inertia[i, i] for i in range(3)]
        whole = moments[0] + moments[1] + moments[2]
        for moment in filter(None, moments):
            inertias += [(moment, whole), (whole - 2 * moment, whole)]
    signed = {s for s in key.subject.parameters if s.positive}
    signed |= {s for pair in inertias for e in pair for s in e.symbols() if s.positive}
    ordered = sorted(signed, key=lambda s: s.published)
    return tuple(map(Expr.generator, ordered)), tuple(inertias)

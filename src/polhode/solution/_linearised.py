"""Small departures from a steady motion with numbers put in, and how fast they grow."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from math import floor, log10
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, compile_program
from polhode.base import NumericError, PolhodeError
from polhode.derive import Equations
from polhode.judge import Answer, Verdict
from polhode.model import Gravity
from polhode.simulate import Dynamics, idle_parameters, read_parameters, read_start
from polhode.solution._example import Example
from polhode.solution._lines import SolutionLine, inline, listed
from polhode.solution._typical import given_latex, number_latex, quantity_latex, unit_of
from polhode.study import linearise

Array = NDArray[np.float64]

_DIGITS = 5
_ZERO = 1e-9  # relative size of an entry that is rounding
_STEP = 1e-3  # of differences, whose error is of fourth order
_SHOWN = (0.4, 0.8, 1.0, 1.2, 1.6, 2.0)  # of the given speed, where exponents are printed
_PLACES, _NARROW = 101, 1e-12  # speeds between which changes are looked for, and how closely
_NAMES = (r"\mathbf M", r"\mathbf C_1", r"\mathbf K_0", r"\mathbf K_2")


def linearised(equations: Equations, example: Example | None) -> Iterator[SolutionLine]:
    """The linear equations about the steady motion of an example, and where it is stable."""
    if example is None:
        yield SolutionLine(
            "The linear equations of small departures from a steady motion have no short form in "
            "letters. With values of the parameters (--set) and of the speed (--start) they are "
            "worked out here in numbers."
        )
        return
    for steady in _parts_of_start(equations, example):
        try:
            departures = Departing(equations, example.parameters, *steady)
        except PolhodeError:  # not a steady motion, or not one with departures of this form
            continue
        yield from departures.lines()
        return
    yield SolutionLine("The start is close to no steady motion with one speed that may be chosen.")


def _parts_of_start(
    equations: Equations, example: Example
) -> Iterator[tuple[Symbol, dict[str, float]]]:
    """A speed of the start with most of its other values, the largest number of them first."""
    speeds = {s.published: s for s in equations.speeds}
    given = {str(name): float(value) for name, value in example.start.items() if float(value)}
    for size in range(len(given), 0, -1):
        for chosen in combinations(given, size):
            moving = [speeds[name] for name in chosen if name in speeds]
            if len(moving) == 1:
                yield moving[0], {name: given[name] for name in chosen}


class Departing:
    """M q̈ + v C₁ q̇ + (g K₀ + v² K₂) q = 0 for departures q from a steady motion at speed v.

    Rates of rigid bodies are quadratic in the speeds, so that C is proportional to v; K is the part
    of the loads, which is there at rest too, and one that grows as v².

    Raises `PolhodeError` for a motion that is not steady, and for departures that are coupled to
    speeds without coordinates.
    """

    def __init__(
        self,
        equations: Equations,
        parameters: Mapping[Any, Any],
        speed: Symbol,
        steady: Mapping[str, float],
    ) -> None:
        self.equations, self.parameters, self.speed = equations, parameters, speed
        self.steady = dict(steady)
        self.value = self.steady.pop(speed.published)
        self._known: dict[float, tuple[tuple[str, ...], Array]] = {}
        names, matrix = self._matrix(self.value)
        self.angles = tuple(n for n in names if f"{n}_dot" in names)
        own = [names.index(n) for q in self.angles for n in (q, f"{q}_dot")]
        rest = [i for i in range(len(names)) if i not in own]
        if not own or np.any(np.abs(matrix[np.ix_(own, rest)]) > _ZERO * np.max(np.abs(matrix))):
            raise NumericError(
                "departures that are coupled to speeds without coordinates",
                expected="coordinates with their own rates",
            )
        loads = equations.system.loads
        gravity = next((load for load in loads if isinstance(load, Gravity)), None)
        self.weight = gravity.g if gravity is not None and len(loads) == 1 else None

    # -- the matrices ---------------------------------------------------------------------------

    @cached_property
    def matrices(self) -> tuple[Array, Array, Array, Array]:
        """M, C₁, K₀ and K₂, with exact derivatives."""
        twice = 2 * self.value
        inertia = self._at_rest([e for row in self._mass for e in row]).reshape(
            len(self.angles), -1
        )
        (slow, stiff), (_, stiffer) = (self._exact(inertia, v) for v in (self.value, twice))
        growing = (stiffer - stiff) / (twice**2 - self.value**2)
        resting = (stiff - self.value**2 * growing) / self._g
        return inertia, slow / self.value, resting, growing

    @cached_property
    def checked(self) -> tuple[Array, Array, Array, Array]:
        """The same from differences of accelerations, and from kinetic energies."""
        rates = [f"{q}_dot" for q in self.angles]
        each = {a: self._kinetic(a) for a in rates}
        inertia = np.array(
            [
                [self._kinetic(a, b) - each[a] - each[b] if a != b else 2 * each[a] for b in rates]
                for a in rates
            ]
        )
        moving = 1.5 * self.value
        slow, stiff = (-inertia @ self._slopes(names, moving) for names in (rates, self.angles))
        resting = -inertia @ self._slopes(self.angles, 0.0)
        return inertia, slow / moving, resting / self._g, (stiff - resting) / moving**2

    @property
    def _g(self) -> float:
        if self.weight is None:
            return 1.0
        return float(self._at_rest([self.weight])[0])

    @property
    def _mass(self) -> list[list[Expr]]:
        names = [s.published for s in self.equations.speeds]
        places = [names.index(f"{q}_dot") for q in self.angles]
        return [[self.equations.mass.rows[i][j] for j in places] for i in places]

    def _matrix(self, speed: float) -> tuple[tuple[str, ...], Array]:
        if speed not in self._known:
            at: dict[Any, float] = {**self.steady, self.speed.published: speed}
            found = linearise(self.equations, self.parameters, at)
            self._known[speed] = found.states, found.matrix
        return self._known[speed]

    def _exact(self, inertia: Array, speed: float) -> tuple[Array, Array]:
        names, matrix = self._matrix(speed)
        rows = [names.index(f"{q}_dot") for q in self.angles]
        columns = [names.index(q) for q in self.angles]
        return -inertia @ matrix[np.ix_(rows, rows)], -inertia @ matrix[np.ix_(rows, columns)]

    @cached_property
    def _dynamics(self) -> Dynamics:
        return Dynamics(self.equations, {}, idle_parameters(self.equations, self.parameters))

    @cached_property
    def _numbers(self) -> dict[Symbol, float]:
        return read_parameters(self._dynamics, self.parameters)

    def _state(self, speed: float, **changed: float) -> list[float]:
        at: dict[Any, float] = {**self.steady, self.speed.published: speed}
        at |= {name: at.get(name, 0.0) + change for name, change in changed.items()}
        return list(map(float, read_start(self._dynamics, at, self._numbers).state))

    def _at_rest(self, expressions: list[Expr], moving: Sequence[str] = ()) -> Array:
        """Values in the place of the steady motion, with some speeds 1 and the others zero."""
        equations = self.equations
        symbols = (*equations.coordinates, *equations.speeds, *self._numbers)
        values = self._state(0.0)[: len(equations.coordinates)]
        values += [float(s.published in moving) for s in equations.speeds]
        program = compile_program(expressions, symbols).function()
        return np.array(program(*values, *self._numbers.values()), dtype=float)

    def _kinetic(self, *moving: str) -> float:
        return float(self._at_rest([self.equations.kinetic_energy], moving)[0])

    @cached_property
    def _rates(self) -> Callable[..., Sequence[float]]:
        return self._dynamics.program(self._dynamics.rates, self._dynamics.arguments).function()

    def _accelerations(self, speed: float, name: str, change: float) -> Array:
        state = self._state(speed, **{name: change})
        names = [s.derivative().published for s in self._dynamics.states]
        found = self._rates(*state, *self._numbers.values(), 0.0)
        return np.array([float(found[names.index(f"{q}_ddot")]) for q in self.angles])

    def _slopes(self, names: Sequence[str], speed: float) -> Array:
        """Derivatives of the accelerations by differences, one column for each name."""
        columns = []
        for name in names:
            near, far = (
                (self._accelerations(speed, name, h) - self._accelerations(speed, name, -h))
                / (2 * h)
                for h in (_STEP, 2 * _STEP)
            )
            columns.append((4 * near - far) / 3)
        return np.array(columns).T

    # -- what is printed ------------------------------------------------------------------------

    def lines(self) -> Iterator[SolutionLine]:
        """The linear equations, the exponents at several speeds, and where stability changes."""
        equations = self.equations
        v = inline(self.speed)
        letters = {s.published: s for s in (*equations.coordinates, *equations.speeds)}
        place = [
            f"${Expr.generator(letters[n]).latex()} = {given_latex(equations, letters[n], value)}$"
            for n, value in self.steady.items()
        ]
        at = f" with {listed(place)} and all other" if place else ", with all"
        known = {s: self.parameters.get(s.published) for s in equations.parameters}
        values = [
            f"${Expr.generator(s).latex()} = {given_latex(equations, s, float(value))}$"
            for s, value in known.items()
            if value is not None
        ]
        yield SolutionLine(f"Now put in numbers: {listed(values)}.")
        angles = [Expr.generator(letters[q]).latex() for q in self.angles]
        g = "" if self.weight is None else rf"{self.weight.latex()}\,"
        speed = Expr.generator(self.speed).latex()
        q = _in_brackets(angles)
        found = dict(zip(_NAMES, self.matrices, strict=True))
        verdict = self._verdict(self.matrices)
        yield SolutionLine(
            f"A steady motion is possible at any speed {v}{at} coordinates and speeds zero. "
            f"Small departures $\\mathbf q = {q}$ from it obey, to first order,",
            rf"\mathbf M\ddot{{\mathbf q}} + {speed}\,\mathbf C_1\dot{{\mathbf q}} + "
            rf"\left({g}\mathbf K_0 + {speed}^2\,\mathbf K_2\right)\mathbf q \approx 0",
            "linear",
            "limit",
            verdict=verdict,
        )
        words = (
            "Velocity terms are proportional to the speed and centrifugal ones to its square, "
            "since the accelerations of rigid bodies are quadratic in the speeds. In SI units"
        )
        for name, matrix in found.items():
            yield SolutionLine(
                words, f"{name} = {_matrix_latex(matrix)}", context="number", verdict=verdict
            )
            words = ""
        yield from self._exponents(v)
        yield from self._changes(v)

    def _verdict(self, found: Sequence[Array]) -> Verdict:
        """Whether the printed digits are those of the second computation."""
        for matrix, other in zip(found, self.checked, strict=True):
            size = float(np.max(np.abs(matrix)))
            for value, second in zip(matrix.flat, other.flat, strict=True):
                _require_digits(float(value), float(second), size)
        return Verdict(Answer.HOLDS, "number")

    def _roots(self, speed: float, matrices: tuple[Array, Array, Array, Array]) -> list[complex]:
        inertia, slow, resting, growing = matrices
        damping, stiffness = speed * slow, self._g * resting + speed**2 * growing
        count = len(self.angles)
        whole = np.block(
            [
                [np.zeros((count, count)), np.eye(count)],
                [-np.linalg.solve(inertia, stiffness), -np.linalg.solve(inertia, damping)],
            ]
        )
        return sorted(np.linalg.eigvals(whole).tolist(), key=lambda z: (-z.real, -z.imag))

    def _exponents(self, v: str) -> Iterator[SolutionLine]:
        words = (
            r"With $\mathbf q \propto e^{\lambda t}$ this has solutions where the determinant of "
            r"$\lambda^2\mathbf M + \lambda\,\mathbf C + \mathbf K$ vanishes. The exponents "
            r"$\lambda$, in $\mathrm{s^{-1}}$, are"
        )
        letter = self._letter(r"\lambda", "s")
        words = words.replace(r"\lambda", letter)
        for factor in _SHOWN:
            speed = factor * self.value
            roots = self._roots(speed, self.matrices)
            seconds = self._roots(speed, self.checked)
            for root, second in zip(roots, seconds, strict=True):
                _require_digits(root.real, second.real, abs(root), 4)
                _require_digits(root.imag, second.imag, abs(root), 4)
            written = r",\ ".join(_complex_latex(z) for z in roots if z.imag >= 0)
            value = given_latex(self.equations, self.speed, speed)
            yield SolutionLine(
                words,
                rf"{v.strip('$')} = {value}: \quad {letter} = {written}",
                context="number",
                verdict=Verdict(Answer.HOLDS, "number"),
            )
            words = ""

    def _letter(self, *candidates: str) -> str:
        used = {Expr.generator(s).latex() for s in self.equations.parameters}
        return next(letter for letter in candidates if letter not in used)

    def _growing(self, speed: float, matrices: tuple[Array, Array, Array, Array]) -> int:
        return sum(root.real > 0 for root in self._roots(speed, matrices))

    def _found_changes(self) -> Iterator[tuple[float, int, int]]:
        """Speeds at which the number of growing exponents changes, and it before and after."""
        low, high = (factor * self.value for factor in (_SHOWN[0] / 4, _SHOWN[-1]))
        places = np.linspace(low, high, _PLACES).tolist()
        counts = [self._growing(place, self.matrices) for place in places]
        for a, b, before, after in zip(places, places[1:], counts, counts[1:], strict=False):
            while before != after and b - a > _NARROW * b:
                middle = (a + b) / 2
                a, b = (
                    (middle, b) if self._growing(middle, self.matrices) == before else (a, middle)
                )
            if before != after:
                yield (a + b) / 2, before, after

    def _changes(self, v: str) -> Iterator[SolutionLine]:
        """Where stability changes, between the smallest and the largest speed."""
        unit = unit_of(self.equations, Expr.generator(self.speed))
        for speed, before, after in self._found_changes():
            nearest = min(self._roots(speed, self.matrices), key=lambda root: abs(root.real))
            how = "an exponent passes through zero, without oscillation"
            if abs(nearest.imag) > _ZERO * self.value:
                rate = quantity_latex(abs(nearest.imag), "rad/s", _DIGITS)
                how = f"two exponents cross the imaginary axis at ${rate}$, which is an oscillation"
            step = 2 * 10 ** (floor(log10(speed)) - _DIGITS + 1)
            sides = (self._growing(speed + d, self.checked) for d in (-step, step))
            if (before, after) != tuple(sides):
                raise _disagreement(speed)
            goes = f"{_number(before)} before, {_number(after)} after"
            yield SolutionLine(
                f"Stability changes where {how}. The number of growing exponents is {goes}:",
                f"{v.strip('$')} = {quantity_latex(speed, unit, _DIGITS)}",
                context="number",
                verdict=Verdict(Answer.HOLDS, "number"),
            )
            if not after:
                yield SolutionLine("Above it no small departure grows.")


def _number(count: int) -> str:
    return ("none", "one", "two", "three", "four")[count] if count < 5 else str(count)


def _matrix_latex(matrix: Array) -> str:
    size = float(np.max(np.abs(matrix))) or 1.0
    rows = [
        " & ".join("0" if abs(x) < _ZERO * size else number_latex(x, _DIGITS) for x in row)
        for row in matrix.tolist()
    ]
    return _in_brackets(rows)


def _in_brackets(rows: Sequence[str]) -> str:
    return r"\begin{pmatrix} " + r" \\ ".join(rows) + r" \end{pmatrix}"


def _complex_latex(value: complex) -> str:
    if not value.imag:
        return number_latex(value.real, 4)
    return rf"{number_latex(value.real, 4)} \pm {number_latex(value.imag, 4)}\,i"


def _require_digits(value: float, second: float, size: float, digits: int = _DIGITS) -> None:
    """Raise `NumericError` unless two values agree within a unit of the last printed digit."""
    last = 10.0 ** (floor(log10(abs(value))) - digits + 1) if value else 0.0
    if abs(value - second) > max(last, 10 * _ZERO * size):
        raise _disagreement(value)


def _disagreement(value: float) -> NumericError:
    return NumericError(
        f"a number of the linear equations, {value:g}, that a second computation does not confirm",
        expected="derivatives that agree with differences of the accelerations",
        advice="report it with the declaration and the values",
    )

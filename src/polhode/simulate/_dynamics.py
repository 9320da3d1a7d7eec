"""The equations of one contact mode, ready to be evaluated and integrated."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

from polhode.algebra import (
    ONE,
    ZERO,
    Compiled,
    Expr,
    LinearSolve,
    Matrix,
    Program,
    Row,
    SquareRoot,
    Symbol,
    SymbolKind,
    compile_program,
    has_parts,
    length,
    linear_parts,
    roots_in,
    stored,
    texts_of,
    time,
    with_roots,
)
from polhode.base import DeclarationError, NumericError
from polhode.simulate.integrate._number_types import DOUBLES, NumberType


class EquationsOfMotion(Protocol):
    """The interface of the equations of one contact mode, which `derive.Equations` provides."""

    @property
    def system(self) -> Any: ...
    @property
    def coordinates(self) -> tuple[Symbol, ...]: ...
    @property
    def speeds(self) -> tuple[Symbol, ...]: ...
    @property
    def kinematics(self) -> Mapping[Symbol, Expr]: ...
    @property
    def dependent(self) -> Mapping[Symbol, Expr]: ...
    @property
    def mass(self) -> Matrix: ...
    @property
    def forcing(self) -> tuple[Expr, ...]: ...
    @property
    def components(self) -> Mapping[str, Expr]: ...
    @property
    def undetermined(self) -> tuple[str, ...]: ...
    @property
    def energy(self) -> Expr: ...
    @property
    def power(self) -> Expr: ...
    @property
    def closures(self) -> tuple[Expr, ...]: ...
    @property
    def assumed_positive(self) -> tuple[Expr, ...]: ...
    @property
    def parameters(self) -> tuple[Symbol, ...]: ...
    @property
    def functions(self) -> tuple[Symbol, ...]: ...
    @property
    def computed(self) -> EquationsOfMotion:
        """With distances that lose no digits however far from the origin they are."""
        ...


CLOCK = time.symbol or Symbol("t", SymbolKind.TIME)
#: Stands for the work done by everything that is not in the potential, J.
WORK = Symbol("work done", SymbolKind.COORDINATE)

Made = TypeVar("Made")

# Programs kept for one set of equations: far more than its modes, sides and quantities need, unless
# ever new expressions are evaluated, as a laboratory may. All are then dropped, which costs less
# than keeping track of their use.
_MOST = 2048

_SHORT = 500  # terms up to which programs are not kept on disk


class Memory(Generic[Made]):
    """Results, kept for as long as the object lives that they were computed from.

    Objects are compared by identity. Results must not refer to the object, or it would never be
    freed.
    """

    def __init__(self) -> None:
        self._of: dict[int, dict[Hashable, Made]] = {}

    def recall(self, owner: object, asked: Hashable, make: Callable[[], Made]) -> Made:
        """The result kept under a key; if there is none, that of `make`, which is then kept."""
        place = id(owner)
        if place not in self._of:
            self._of[place] = {}
            weakref.finalize(owner, self._of.pop, place, None)
        results = self._of[place]
        found = results.get(asked)
        if found is None:
            found = make()
            if len(results) >= _MOST:
                results.clear()
            results[asked] = found
        return found


_programs: Memory[Program] = Memory()


def sign_symbol(root: SquareRoot) -> Symbol:
    """The symbol of the sign, from -1 to 1, that keeps the argument of an absolute value at zero.

    Filippov's convex combination of both sides: x/|x| may take any value between them.
    """
    return Symbol(f"sign of {root.plain}", SymbolKind.SPEED)


def _varies(root: SquareRoot) -> bool:
    return any(s.kind is not SymbolKind.PARAMETER for s in root.symbols())


def constants(expressions: Iterable[Expr]) -> Iterator[Symbol]:
    """The parameters in expressions."""
    for expression in expressions:
        for symbol in sorted(expression.symbols(), key=lambda symbol: symbol.published):
            if symbol.kind is SymbolKind.PARAMETER and symbol.name != "pi":
                yield symbol


@dataclass(frozen=True)
class Dynamics:
    """Equations of one contact mode together with the prescribed functions of time.

    Attributes:
        equations: exact equations of motion.
        prescribed: every prescribed function as an expression of time.
        idle: parameters of the declaration that dropped out of the equations but have values.
        auxiliary: quantities that are integrated although they follow from the state, with their
            rates: computed from the state, they would be only rounding near zero.
        meanings: expressions that other symbols of the equations stand for.
        embedding: coordinates and speeds of other modes, in terms of those of this one.
        sides: of absolute values: 1 or -1 where their arguments are positive or negative, 0 where
            they are held at zero.
    """

    equations: EquationsOfMotion
    prescribed: Mapping[Symbol, Expr]
    idle: tuple[Symbol, ...] = ()
    auxiliary: Mapping[Symbol, Expr] = field(default_factory=dict)
    meanings: Mapping[Symbol, Expr] = field(default_factory=dict)
    embedding: Mapping[Symbol, Expr] = field(default_factory=dict)
    sides: Mapping[SquareRoot, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "equations", self.equations.computed)

    @cached_property
    def states(self) -> tuple[Symbol, ...]:
        """Coordinates, independent speeds, and auxiliary states."""
        return (*self.equations.coordinates, *self.equations.speeds, *self.auxiliary)

    @cached_property
    def without_auxiliary(self) -> Dynamics:
        """The same equations on coordinates and speeds alone, for modes in which nothing slides."""
        return replace(self, auxiliary={}, meanings={})

    @cached_property
    def parameters(self) -> tuple[Symbol, ...]:
        """Every constant that has a value."""
        driving = constants(self.prescribed.values())
        return tuple(dict.fromkeys((*self.equations.parameters, *driving, *self.idle)))

    @cached_property
    def arguments(self) -> tuple[Symbol, ...]:
        """States, parameters, time: the arguments of compiled functions."""
        return (*self.states, *self.parameters, CLOCK)

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """Time derivatives of the states."""
        equations = self.equations
        own = (*equations.coordinates, *equations.speeds)
        return (
            *(Expr.generator(symbol.derivative()) for symbol in own),
            *self.auxiliary.values(),
        )

    @cached_property
    def accelerations(self) -> LinearSolve:
        """The accelerations, as the solution of mass · accelerations = forcing.

        An argument of an absolute value that is held at zero adds an equation, that its rate (or
        second rate) vanishes, and its sign an unknown. The sign stands in the forcing linearly:
        [[M, −S], [K, 0]] (u̇, σ) = (f, −k).
        """
        unknowns = tuple(speed.derivative() for speed in self.equations.speeds)
        mass = Matrix(tuple(tuple(map(self.on_side, row)) for row in self.equations.mass.rows))
        forcing = tuple(map(self.on_side, self.equations.forcing))
        held = [root for root, side in self.sides.items() if not side]
        if not held:
            return LinearSolve(unknowns, mass, forcing)
        signs = tuple(sign_symbol(root) for root in held)
        parts = [linear_parts(force, signs) for force in forcing]
        kept = [self._zero_condition(root) for root in held]
        none = (ZERO,) * len(held)
        above = [(*row, *(-c for c in own)) for row, (own, _) in zip(mass.rows, parts, strict=True)]
        below = [(*row, *none) for row, _ in kept]
        right = (*(rest for _, rest in parts), *(-rest for _, rest in kept))
        return LinearSolve((*unknowns, *signs), Matrix((*above, *below)), right)

    def _zero_condition(self, root: SquareRoot) -> tuple[Row, Expr]:
        """The condition that keeps an argument at zero: K u̇ + k = 0, as the row K and the rest k.

        The argument is differentiated until accelerations occur, twice at most.
        """
        argument = self.on_side(root.plain or ZERO)
        for _ in range(2):
            row = tuple(argument.diff(speed) for speed in self.equations.speeds)
            rest = argument.chain(self._rate)
            if any(row):
                return row, rest
            argument = rest
        raise NumericError(
            f"{root.plain} that stays zero",
            expected="an argument of an absolute value that accelerations depend on",
            advice="end the motion before, or start elsewhere",
        )

    def _rate(self, symbol: Symbol) -> Expr:
        """Rate of a symbol if all accelerations are zero."""
        if symbol in self.equations.speeds or not symbol.kind.varies:
            return ONE if symbol == CLOCK else ZERO
        rate = symbol.derivative()
        return self.on_side(self.equations.kinematics.get(rate, Expr.generator(rate)))

    # -- absolute values ------------------------------------------------------------------------

    def on(self, sides: Mapping[SquareRoot, int]) -> Dynamics:
        """The same equations on given sides of absolute values; the same object every time."""
        key = tuple(sides.items())
        if key not in self._by_sides:
            self._by_sides[key] = replace(self, sides=sides) if sides else self
        return self._by_sides[key]

    @cached_property
    def _by_sides(self) -> dict[Any, Dynamics]:
        return {}

    def on_side(self, expression: Expr) -> Expr:
        """An expression with |x| replaced by x or -x wherever the side is known."""
        return self._with_sides(expression) if self.sides else expression

    def _with_sides(self, expression: Expr) -> Expr:
        """An expression with known sides; roots are recognised in the independent speeds only."""
        if not any(map(_varies, roots_in([expression]))):
            return expression
        return with_roots(expression.subs(self._rates_by_speeds), self._images)

    @cached_property
    def _rates_by_speeds(self) -> dict[Symbol, Expr]:
        """Rates of coordinates and dependent speeds in terms of the independent speeds."""
        table = {**self.equations.kinematics, **self.equations.dependent}
        return {s: e for s, e in table.items() if s not in self.equations.speeds}

    @cached_property
    def _images(self) -> dict[SquareRoot, Expr]:
        def image(root: SquareRoot, side: int) -> Expr:
            sign = Expr.constant(side) if side else Expr.generator(sign_symbol(root))
            return sign * (root.plain or ZERO)

        return {root: image(root, side) for root, side in self.sides.items()}

    @cached_property
    def undecided(self) -> tuple[SquareRoot, ...]:
        """Absolute values in the equations whose arguments vary in time, inner ones first."""
        return tuple(root for root in self._roots if root.plain is not None)

    @cached_property
    def lengths(self) -> tuple[SquareRoot, ...]:
        """The other square roots that vary in time, such as lengths of vectors."""
        return tuple(root for root in self._roots if root.plain is None)

    @cached_property
    def _roots(self) -> tuple[SquareRoot, ...]:
        equations = self.equations
        entries = equations.mass.entries
        relations = (*equations.kinematics.values(), *equations.dependent.values())
        driven = (*self.prescribed.values(), *self.auxiliary.values())
        own = (*entries, *equations.forcing, equations.power, *relations, *driven)
        return tuple(root for root in roots_in(map(self._with_sides, own)) if _varies(root))

    def program(
        self,
        expressions: Iterable[Expr],
        arguments: tuple[Symbol, ...],
        turned: Mapping[Symbol, Symbol] = MappingProxyType({}),
    ) -> Program:
        """A program that computes expressions in any symbols of the system; kept for later use."""
        wanted = tuple(map(self.on_side, expressions))
        key = (wanted, arguments, tuple(turned.items()), self._meanings_key)

        def compiled() -> Program:
            return compile_program(wanted, arguments, self.meaning, (self.accelerations,), turned)

        def kept() -> Program:
            if not self._is_long(wanted):  # compiled in less time than it takes to read a file
                return compiled()
            angles = (f"{angle.published} {less.name}" for angle, less in turned.items())
            texts = (*texts_of(wanted), "with", *self._texts, "turned", *angles)
            return stored(texts, arguments, compiled)

        return _programs.recall(self.equations, key, kept)

    def _is_long(self, wanted: tuple[Expr, ...]) -> bool:
        entries = self.equations.mass.entries
        involved = (*wanted, *entries, *self.equations.forcing)
        return any(map(has_parts, involved)) or sum(map(length, involved)) > _SHORT

    @cached_property
    def _texts(self) -> tuple[str, ...]:
        """Texts that determine what every symbol means, for programs kept on disk."""
        equations = self.equations
        found = [
            " ".join(s.published for s in equations.speeds),
            *(f"{root.key} {side}" for root, side in self.sides.items()),
        ]
        for table in (equations.kinematics, equations.dependent, self.prescribed, self.meanings):
            names = (symbol.published for symbol in table)
            found += (" ".join(names), *texts_of(table.values()))
        entries = equations.mass.entries
        return (*found, *texts_of(entries), *texts_of(equations.forcing))

    @cached_property
    def _meanings_key(self) -> tuple[Any, ...]:
        """The expressions that symbols stand for, apart from the equations: in keys of programs."""
        own = (self.prescribed, self.meanings, self.sides)
        return tuple(tuple(table.items()) for table in own)

    def function(
        self,
        expressions: Iterable[Expr],
        arguments: tuple[Symbol, ...] | None = None,
        turned: Mapping[Symbol, Symbol] = MappingProxyType({}),
        numbers: NumberType = DOUBLES,
    ) -> Compiled:
        """Expressions as a function of NumPy arrays of `arguments`; kept for later use."""
        key = (tuple(expressions), arguments or self.arguments, tuple(turned.items()), numbers)
        if key not in self._made:
            wanted, given, *_ = key
            self._made[key] = self.program(wanted, given, turned).function(numbers.arithmetic)
        return self._made[key]

    @cached_property
    def _made(self) -> dict[Any, Compiled]:
        return {}

    def meaning(self, symbol: Symbol) -> Expr | None:
        """The expression of a symbol that is neither state, parameter nor acceleration, or None."""
        meaning = self._meaning(symbol)
        return None if meaning is None else self.on_side(meaning)

    def _meaning(self, symbol: Symbol) -> Expr | None:
        equations = self.equations
        for table in (equations.kinematics, equations.dependent, self.prescribed, self.meanings):
            if symbol in table:
                return table[symbol]
        if symbol == WORK:
            return ZERO
        if symbol in self.embedding and symbol not in self.states:
            return self.embedding[symbol]
        if symbol.kind is SymbolKind.FUNCTION and not symbol.order:
            raise DeclarationError(
                f"no motion for the prescribed function {symbol.published}(t)",
                expected="an expression of time for every prescribed function",
                advice=f"add it to forcing, as in {{{symbol.published}: sin(2*t)}}",
            )
        return self._derivative(symbol)

    def _derivative(self, symbol: Symbol) -> Expr | None:
        if not symbol.order or symbol.kind is SymbolKind.PARAMETER:
            return None
        lower = Symbol(symbol.name, symbol.kind, symbol.order - 1)
        if lower in self.accelerations.unknowns:
            raise DeclarationError(
                f"{symbol.published}, the rate of an acceleration",
                expected="derivatives up to accelerations",
                advice="difference the acceleration along the trajectory",
            )
        meaning = self.meaning(lower)
        return meaning.dt() if meaning is not None else None


# -- quantities of a motion, by published name -----------------------------------------------------

_MOVING = (SymbolKind.COORDINATE, SymbolKind.SPEED)


def moving(dynamics: Dynamics) -> dict[str, Expr]:
    """Coordinates, speeds and rates by published name, those of other modes included."""
    equations = dynamics.equations
    own = (*equations.coordinates, *equations.speeds, *equations.kinematics, *equations.dependent)
    embedding = {s.published: value for s, value in dynamics.embedding.items() if s.kind in _MOVING}
    return {symbol.published: Expr.generator(symbol) for symbol in own} | embedding


def readable(dynamics: Dynamics, invariants: Mapping[str, Expr]) -> dict[str, Expr]:
    """Quantities of one contact mode, by published name."""
    equations = dynamics.equations
    rates = (*equations.speeds, *equations.kinematics, *equations.dependent)
    moving = (*equations.coordinates, *rates, *(rate.derivative() for rate in rates))
    auxiliary = (symbol for symbol in dynamics.auxiliary if symbol != WORK)
    symbols = (CLOCK, *moving, *auxiliary, *dynamics.parameters, *equations.functions)
    powers = getattr(equations, "powers", {})
    return {
        **{symbol.published: Expr.generator(symbol) for symbol in symbols},
        **{f"power_{name}": power for name, power in powers.items()},
        **equations.components,
        "energy": equations.energy,
        "power": equations.power,
        "work": Expr.generator(WORK),
        **{symbol.published: value for symbol, value in dynamics.embedding.items()},
        **invariants,
    }


def quantity_names(equations: EquationsOfMotion, embedding: Mapping[Symbol, Expr]) -> set[str]:
    """The names of all quantities that can be read in a contact mode."""
    return set(readable(Dynamics(equations, {}, embedding=embedding), {}))

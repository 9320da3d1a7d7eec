"""The equations of motion as a flow: a core that is integrated, and quadratures over it.

Cyclic coordinates (spin angles, positions) and the work done grow without influencing the
accelerations. Left out of the core, they do not affect its steps, however large they become, and
as integrals of known functions they are accurate to rounding.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import inf, lcm, pi

import numpy as np

from polhode.algebra import ZERO, Compiled, Expr, Op, Program, Symbol, SymbolKind, arrays
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate.integrate._arrays import Array, rows

# -- how time occurs explicitly: a step of the integrator foresees a polynomial of it, but no pulse


def degree_in(program: Program, argument: Symbol) -> float:
    """The highest degree to which any step of a program is a polynomial of an argument.

    Zero where the argument does not occur; infinite where a step is no polynomial of it.
    """
    place = program.arguments.index(argument)
    degrees = list[float]()
    for step in program.instructions:
        own = [degrees[operand] for operand in step.operands]
        degrees.append(1.0 if (step.op, step.value) == (Op.ARG, place) else _degree(step.op, own))
    return max(degrees, default=0.0)


def _degree(op: Op, own: list[float]) -> float:
    match op:
        case Op.MUL:
            return sum(own)
        case Op.DIV:
            return inf if own[1] else own[0]
        case Op.ADD | Op.SUB | Op.NEG:
            return max(own)
        case _:
            return inf if any(own) else 0.0


# -- the part of a coordinate or a speed that is a function of time alone -----------------------
#
# A body that sticks to a shaken support moves with it: if its velocity were integrated over many
# periods, the body would drift away from the support by accumulated rounding.


@dataclass(frozen=True)
class Primitive:
    """A rate, split into a part whose integral is known and the rest.

    Attributes:
        known: the integral of the first part, an expression of prescribed functions of time.
        rest: of the rate.
    """

    known: Expr
    rest: Expr


def primitive(dynamics: Dynamics, state: Symbol, rate: Expr) -> Primitive:
    """The part of a state's rate that is a constant times the rates of prescribed functions."""
    full = _written_out(dynamics, state)
    if full is None:
        return Primitive(ZERO, rate)
    # c·ẋ(t) with a prescribed x(t) and a constant c integrates to c·x(t).
    symbols = [s for s in full.generators if isinstance(s, Symbol)]
    driving_rates = [s for s in symbols if s.kind is SymbolKind.FUNCTION and s.order > 0]
    known = ZERO
    for symbol in driving_rates:
        coefficient = full.diff(symbol)
        if all(s.kind is SymbolKind.PARAMETER for s in coefficient.symbols()):
            integrated = Symbol(symbol.name, symbol.kind, symbol.order - 1)
            known = known + coefficient * Expr.generator(integrated)
            full = full - coefficient * Expr.generator(symbol)
    return Primitive(known, full) if known else Primitive(ZERO, rate)


def _written_out(dynamics: Dynamics, state: Symbol) -> Expr | None:
    """The rate of a coordinate, or of a speed that has a row of the equations to itself."""
    equations, own = dynamics.equations, state.derivative()
    if own in equations.kinematics:
        return dynamics.on_side(equations.kinematics[own].subs(equations.dependent))
    if own not in dynamics.accelerations.unknowns:
        return None
    row = dynamics.accelerations.unknowns.index(own)
    masses = dynamics.accelerations.matrix.rows[row]
    alone = not any(mass for k, mass in enumerate(masses) if k != row)
    return dynamics.accelerations.right[row] / masses[row] if alone else None


@dataclass(frozen=True)
class Stage:
    """States whose rates follow from the states of earlier stages (and, in the core, their own).

    Arguments of the programs are all symbols of the flow, of which later ones are not used, then
    parameters and time.

    Attributes:
        symbols: the states.
        program: their rates; of a quadrature, less those of what is known of it.
        known: the part of each quadrature that is a function of time.
    """

    symbols: tuple[Symbol, ...]
    program: Program
    known: Program | None = None

    @cached_property
    def rates(self) -> Compiled:
        """The program, on arrays."""
        return self.program.function(arrays())

    @cached_property
    def known_values(self) -> Compiled | None:
        """The known parts, on arrays."""
        return self.known.function(arrays()) if self.known is not None else None


@dataclass(frozen=True)
class Flow:
    """A core and the quadratures over it, stage by stage.

    Attributes:
        core: the states that are integrated as differential equations.
        periods: of each core state: the period, rad, of an angle that occurs only within sines
            and cosines; None for others.
        turned: of those angles: the symbol of the angle less whole turns.
        stages: the quadratures.
        parameters: constants, in the order of the programs' arguments.
    """

    core: Stage
    periods: tuple[float | None, ...]
    turned: Mapping[Symbol, Symbol]
    stages: tuple[Stage, ...]
    parameters: tuple[Symbol, ...]

    @classmethod
    def of(cls, program: Program, size: int) -> Flow:
        """A flow of which all is core, no angle is reduced and nothing is known.

        Args:
            program: the rates of as many first arguments; between these and time, which is the
                last, are the parameters.
        """
        states, parameters = program.arguments[:size], program.arguments[size:-1]
        return cls(Stage(states, program), (None,) * size, {}, (), parameters)

    @cached_property
    def degree(self) -> float:
        """Degree to which time occurs explicitly; infinite where it is not in a polynomial."""
        return max(degree_in(stage.program, CLOCK) for stage in (self.core, *self.stages))

    def values(self, function: Compiled, states: Array, parameters: Array, times: Array) -> Array:
        """Values of the functions of a stage, shape (functions, times).

        Args:
            states: rows of the states of earlier stages; later ones are not read.
        """
        later = [0.0] * (len(self.symbols) - len(states))
        found: Array = rows(function(*states, *later, *parameters, times), len(times))
        return found

    def rest(self, states: Mapping[Symbol, float], parameters: Array, time: float) -> Array:
        """The states in the order of the flow, less the parts that are known functions of time."""
        rests = [np.array([states[symbol] for symbol in self.core.symbols])]
        for stage in self.stages:
            own = np.array([states[symbol] for symbol in stage.symbols])
            if stage.known_values is not None:
                nothing, now = np.empty(0), np.array([time])
                own = own - self.values(stage.known_values, nothing, parameters, now)[:, 0]
            rests.append(own)
        return np.concatenate(rests)

    @property
    def states(self) -> tuple[Symbol, ...]:
        """All states, in the order in which the flow has them."""
        return (*self.core.symbols, *self._later)

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """The states, with the angles less whole turns after the core."""
        return (*self.core.symbols, *self.turned.values(), *self._later)

    @property
    def _later(self) -> tuple[Symbol, ...]:
        return tuple(symbol for stage in self.stages for symbol in stage.symbols)


def flow_of(dynamics: Dynamics, *, reduced: bool) -> Flow:
    """The flow of all states and the work: with the smallest core if `reduced`, else all in it."""
    rates = dict(zip(dynamics.states, dynamics.rates, strict=True))
    if dynamics.equations.power or not rates:
        rates[WORK] = dynamics.equations.power
    peeled = list(_peeled(_influences(dynamics, rates))) if reduced else []
    layers = tuple(reversed(peeled))
    outer = tuple(symbol for layer in layers for symbol in layer)
    core = tuple(symbol for symbol in rates if symbol not in outer)
    given = (*outer, *dynamics.parameters, CLOCK)
    program = dynamics.program([rates[s] for s in core], (*core, *given))
    periods = tuple(period_in(program, i) for i in range(len(core)))
    turned = {
        angle: Symbol(f"{angle.name} less whole turns", SymbolKind.COORDINATE)
        for angle, period in zip(core, periods, strict=True)
        if period
    }
    arguments = (*core, *turned.values(), *given)
    stages = []
    for layer in layers:
        parts = [primitive(dynamics, s, rates[s]) for s in layer]
        rests = dynamics.program([part.rest for part in parts], arguments, turned)
        known = dynamics.program([part.known for part in parts], arguments, turned)
        stages.append(Stage(layer, rests, known if any(p.known for p in parts) else None))
    return Flow(Stage(core, program), periods, turned, tuple(stages), dynamics.parameters)


def _influences(dynamics: Dynamics, rates: dict[Symbol, Expr]) -> dict[Symbol, set[Symbol]]:
    """The states that the rate of each state depends on."""
    states = tuple(rates)
    program = dynamics.program(rates.values(), (*states, *dynamics.parameters, CLOCK))
    reached: list[set[Symbol]] = []
    for step in program.instructions:
        found = set[Symbol]().union(*(reached[i] for i in step.operands))
        if step.op is Op.ARG and isinstance(step.value, int) and step.value < len(states):
            found.add(states[step.value])
        reached.append(found)
    return {s: reached[i] for s, i in zip(states, program.outputs, strict=True)}


def _peeled(influences: dict[Symbol, set[Symbol]]) -> Iterator[tuple[Symbol, ...]]:
    """Layers of states, outermost first, that influence no others; at least one state remains.

    A state that influences only itself is not such: its own rate depends on it.
    """
    remaining = dict(influences)
    while len(remaining) > 1:
        influencing = set[Symbol]().union(*remaining.values())
        layer = tuple(symbol for symbol in remaining if symbol not in influencing)
        if not layer:
            return
        if len(layer) == len(remaining):  # an integrator needs at least one state
            layer = layer[:-1]
        yield layer
        remaining = {s: needs for s, needs in remaining.items() if s not in layer}


def period_in(program: Program, argument: int) -> float | None:
    """The period of a program in an argument that occurs only in sines and cosines, else None."""
    steps = program.instructions
    place = next((i for i, s in enumerate(steps) if (s.op, s.value) == (Op.ARG, argument)), None)
    if place is None or place in program.outputs:
        return None
    # sin(k q) with k = n/d has the period 2π d/n, of which 2π d is a multiple: all of them share
    # 2π times the least common multiple of the denominators.
    unit = 1
    for i, step in enumerate(steps):
        if place in step.operands and step.op not in (Op.SIN, Op.COS):
            factor = _factor_of_angle(program, i, place)
            if factor is None:
                return None
            unit = lcm(unit, factor.denominator)
    return 2 * pi * unit


def _factor_of_angle(program: Program, i: int, place: int) -> Fraction | None:
    """k if step i is k times the argument and only enters sines and cosines, else None."""
    steps = program.instructions
    others = [steps[operand] for operand in steps[i].operands if operand != place]
    users = [step.op for step in steps if i in step.operands]
    scaled = steps[i].op is Op.MUL and len(others) == 1 and others[0].op is Op.CONST
    if not scaled or i in program.outputs or not set(users) <= {Op.SIN, Op.COS}:
        return None
    return Fraction(others[0].value or 0)

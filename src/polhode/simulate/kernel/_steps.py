"""The loop over the steps of a motion, in WebAssembly.

One rule: the order is N = ⌈1 − ½ ln ε⌉ for a relative tolerance ε, and the step e⁻²·e^(−0.7/(N−1))
times the radius of convergence. This is the least (size/|cₖ|)^(1/k) over the last eight orders k,
where |cₖ| is the largest coefficient of any state, and the size the largest state, at least one.
Eight orders, as there are motions of which only every fourth coefficient is not zero.

Series are in powers of the time in a unit near the length of a step, or coefficients of high order
would leave the range of doubles where everything is fast. It is a power of two: it rounds nothing.

Source: Jorba and Zou, Experimental Mathematics 14 (2005) 99–117, sections 3.2 and 3.3.
"""

from __future__ import annotations

from enum import IntEnum
from math import inf, nan

from polhode.simulate.kernel._assembly import (
    F64,
    I32,
    Function,
    Module,
    Value,
    Variable,
    absolute,
    called,
    constant,
    denied,
    largest,
    least,
    load,
    selected,
    to_double,
)
from polhode.simulate.kernel._elementary import Elementary, elementary
from polhode.simulate.kernel._guards import NOISE, guard_fall
from polhode.simulate.kernel._layout import (
    BEGIN,
    DOUBLE_PLACES,
    INTEGER_PLACES,
    RECORD_HEAD,
    TABLE,
    Layout,
)
from polhode.simulate.kernel._recurrences import evaluation

_LAST = 8  # orders from which the radius of convergence is estimated
_LEAST_UNIT, _LARGEST_UNIT = 2.0**-64, 2.0**64  # s
_FINER = 2.0**-16  # factor of the unit where coefficients are not finite


class Status(IntEnum):
    """Why a call of the kernel has ended."""

    GOING = 0  # it has taken as many steps as it was asked for
    GOAL = 1  # the end is reached
    BROKEN = 2  # a coefficient, of a guard too, is not finite: the motion cannot be continued
    FALL = 3  # a guard has fallen below zero, where the last step ends
    STOPPED = 4  # by the host; never returned by the kernel


def kernel_module() -> Module:
    """The kernel: what every system shares, to which the host adds a tape.

    Its functions are `start`, to be called when parameters, time and state have been set;
    `advance`, which takes the most steps of one call and returns a `Status`; and `values`, which
    computes all outputs at the present state.
    """
    module = Module()
    functions = elementary(module, TABLE)
    assert TABLE + functions.table_size <= BEGIN
    evaluate = evaluation(module, functions)
    series = _series(module, evaluate)
    length = _natural(module, series, _length(module, functions))
    fall = _fall(module, evaluate)
    taken = _taken(module)
    _start(module, evaluate)
    _values(module, evaluate)
    _advance(module, length, fall, taken)
    return module


def kernel_binary() -> bytes:
    """The kernel as a file that every host reads."""
    return kernel_module().binary(BEGIN)


def kernel_file(layout: Layout, note: bytes) -> bytes:
    """The kernel with the tape of one system, and a note in the section "polhode"."""
    module = kernel_module()
    for address, content in layout.image().items():
        module.data(address, content)
    module.note("polhode", note)
    return module.binary(layout.size)


# -- the head of the memory -----------------------------------------------------------------------

_NOWHERE = constant(I32, 0)


def _integer(name: str) -> Value:
    return load(I32, _NOWHERE, INTEGER_PLACES[name])


def _double(name: str) -> Value:
    return load(F64, _NOWHERE, DOUBLE_PLACES[name])


def _set_integer(f: Function, name: str, value: Value) -> None:
    f.store(_NOWHERE, value, INTEGER_PLACES[name])


def _set_double(f: Function, name: str, value: Value) -> None:
    f.store(_NOWHERE, value, DOUBLE_PLACES[name])


# -- one step -------------------------------------------------------------------------------------


def _start(module: Module, evaluate: Function) -> None:
    f = module.function("start", [], [], shown=True)
    i = f.variable(I32)
    for name, count in (("carries", "states"), ("sizes", "guards")):
        with f.count(i, 0, _integer(count)):
            f.store(_integer(name) + (i << 3), constant(F64, 0))
    _set_double(f, "rest", constant(F64, 0))
    _set_double(f, "unit", constant(F64, 1))
    _set_double(f, "length", constant(F64, 1))
    f.call(evaluate, _integer("constant"), _integer("varying"), 0, _integer("row"))


def _values(module: Module, evaluate: Function) -> None:
    f = module.function("values", [], [], shown=True)
    _set_clock(f)
    f.call(evaluate, _integer("varying"), _integer("end"), 0, _integer("row"))


def _set_clock(f: Function) -> None:
    """The series of the time since the beginning of a step."""
    clock = f.let(_integer("rows") + _integer("states") * _integer("row"))
    f.store(clock, _double("time") + _double("rest"))
    f.store(clock, _double("unit"), 8)


def _series(module: Module, evaluate: Function) -> Function:
    """The Taylor series of the states, from their values and the time."""
    f = module.function("series", [], [])
    row, order, rates = (f.let(_integer(name)) for name in ("row", "order", "rates"))
    first, states = f.let(_integer("rows")), f.let(_integer("states"))
    unit = f.let(_double("unit"))
    _set_clock(f)
    k, i, state = (f.variable(I32) for _ in range(3))
    with f.count(k, 0, order):
        f.call(evaluate, _integer("varying"), _integer("end"), k, row)
        f.set(state, first + (k << 3))
        with f.count(i, 0, states):
            rate = load(F64, load(I32, rates + (i << 2)) + (k << 3))
            f.store(state, rate * unit / to_double(k + 1), 8)
            f.add(state, row)
    return f


def _length(module: Module, functions: Elementary) -> Function:
    """The length of a step by the rule above, in units of the series.

    Zero or NaN where a coefficient is not finite.
    """
    size = _size(module)
    f = module.function("length", [], [F64])
    order = f.let(_integer("order"))
    scale = f.let(called(functions.log, largest(called(size, 0), 1.0)))
    exponent = f.let(constant(F64, inf))
    k = f.variable(I32)
    with f.count(k, selected(order > _LAST, order - (_LAST - 1), constant(I32, 1)), order + 1):
        last = called(functions.log, called(size, k))
        f.set(exponent, least(exponent, (scale - last) / to_double(k)))
    f.give(called(functions.exp, exponent) * _double("share"))
    return f


def _natural(module: Module, series: Function, length: Function) -> Function:
    """Evaluate the series and give the length of a step, s.

    Zero or NaN where coefficients are not finite in any unit of the time.
    """
    f = module.function("natural", [], [F64])
    last, unit, found = f.let(_double("length")), f.let(_double("unit")), f.variable(F64)
    with f.repeat_while((unit * 0.5 > last) & (unit > _LEAST_UNIT)):
        f.set(unit, unit * 0.5)
    with f.repeat_while((unit * 2.0 < last) & (unit < _LARGEST_UNIT)):
        f.set(unit, unit * 2.0)
    _set_double(f, "unit", unit)
    f.call(series)
    f.set(found, called(length))
    with f.repeat_while(denied(found > 0.0) & (unit > _LEAST_UNIT)):
        f.set(unit, unit * _FINER)
        _set_double(f, "unit", unit)
        f.call(series)
        f.set(found, called(length))
    f.set(found, found * unit)
    with f.when((found > 0.0) & (found < inf)):
        _set_double(f, "length", found)
    f.give(found)
    return f


def _size(module: Module) -> Function:
    """The largest coefficient of one order of any state, in multiples of its unit."""
    f = module.function("size", [I32], [F64])
    (order,) = f.parameters
    coefficient, weight = f.let(_integer("rows") + (order << 3)), f.let(_integer("weights"))
    found, i = f.variable(F64), f.variable(I32)
    with f.count(i, 0, _integer("states")):
        f.set(found, largest(found, absolute(load(F64, coefficient)) * load(F64, weight)))
        f.add(coefficient, _integer("row"))
        f.add(weight, 8)
    f.give(found)
    return f


def _fall(module: Module, evaluate: Function) -> Function:
    """The share of a step of some length at which the first guard falls; infinite if none does.

    The length is in units of the series. NaN where a guard has no finite value, so that a fall
    would go unnoticed.
    """
    fall_of = guard_fall(module)
    f = module.function("fall", [F64], [F64])
    (length,) = f.parameters
    row, order, powers = (f.let(_integer(name)) for name in ("row", "order", "powers"))
    falls, sizes = f.let(_integer("falls")), f.let(_integer("sizes"))
    i, place, guard = f.variable(I32), f.variable(I32), f.variable(I32)
    power, size, first = f.variable(F64), f.variable(F64), f.let(constant(F64, inf))
    f.call(evaluate, _integer("varying"), _integer("end"), order, row)
    with f.count(i, 0, _integer("guards")):
        f.set(guard, load(I32, _integer("guard_rows") + (i << 2)))
        f.set(power, 1.0)
        f.set(size, 0.0)
        with f.count(place, 0, row, by=8):
            coefficient = load(F64, guard + place)
            f.store(powers + place, selected(coefficient.equals(0.0), 0.0, coefficient * power))
            f.add(size, absolute(load(F64, powers + place)))
            f.set(power, power * length)
        f.set(size, largest(size, load(F64, sizes)))
        f.store(sizes, size)
        found = called(fall_of, powers, _integer("work"), order, size * NOISE)
        f.store(falls, selected(size < inf, found, constant(F64, nan)))
        f.set(first, least(first, load(F64, falls)))
        f.add(falls, 8)
        f.add(sizes, 8)
    f.give(first)
    return f


def _taken(module: Module) -> Function:
    """Write the record of a step of some length, and go to its end."""
    f = module.function("taken", [I32, F64], [])
    record, length = f.parameters
    for place, value in enumerate((_double("time"), _double("rest"), length)):
        f.store(record, value, 8 * place)
    row, target = f.let(_integer("row")), f.let(record + 8 * RECORD_HEAD)
    state, carry = f.let(_integer("rows")), f.let(_integer("carries"))
    i, k = f.variable(I32), f.variable(I32)
    power, change = f.variable(F64), f.variable(F64)
    scaled = f.let(length / _double("unit"))
    with f.count(i, 0, _integer("states")):
        # coefficients of the powers of the share of the step that has passed
        f.store(target, load(F64, state))
        f.set(power, 1.0)
        with f.count(k, 8, row, by=8):
            f.set(power, power * scaled)
            coefficient = load(F64, state + k)
            # a polynomial has no powers beyond its own, however long the step
            share = selected(coefficient.equals(0.0), 0.0, coefficient * power)
            f.store(target + k, share)
        # their sum, the smallest first
        f.set(change, load(F64, carry))
        f.set(k, row - 8)
        with f.repeat_while(k > 0):
            f.add(change, load(F64, target + k))
            f.set(k, k - 8)
        total, error = _sum_and_error(f, load(F64, state), change)
        f.store(state, total)
        f.store(carry, error)
        f.add(state, row)
        f.add(target, row)
        f.add(carry, 8)
    time, error = _sum_and_error(f, _double("time"), length)
    time, error = _sum_and_error(f, time, error + _double("rest"))
    _set_double(f, "time", time)
    _set_double(f, "rest", error)
    return f


def _sum_and_error(f: Function, a: Value, b: Value) -> tuple[Variable, Variable]:
    """a + b rounded, and its error (Knuth)."""
    x, y = f.let(a), f.let(b)
    total = f.let(x + y)
    part = f.let(total - x)
    return total, f.let((x - (total - part)) + (y - part))


# -- the loop -------------------------------------------------------------------------------------


def _advance(module: Module, length: Function, fall: Function, taken: Function) -> None:
    f = module.function("advance", [I32], [I32], shown=True)
    (most,) = f.parameters
    status, done = f.variable(I32), f.variable(I32)
    record, remaining = f.let(_integer("records")), f.variable(F64)
    share = f.variable(F64)
    with f.repeat_while((done < most) & status.equals(Status.GOING)):
        step = f.let(least(called(length), _double("longest")))
        f.set(remaining, (_double("goal") - _double("time")) - _double("rest"))
        with f.when(step >= remaining):
            f.set(step, remaining)
            f.set(status, Status.GOAL)
        with f.when(denied(step > 0.0)):
            is_there = remaining <= 0.0
            f.set(status, selected(is_there, Status.GOAL, constant(I32, Status.BROKEN)))
            f.otherwise()
            with f.when(_integer("guards")):
                f.set(share, called(fall, step / _double("unit")))
                with f.when(share <= 1.0):
                    f.set(step, step * share)
                    f.set(status, Status.FALL)
                with f.when(share.differs(share)):
                    f.set(step, 0.0)
                    f.set(status, Status.BROKEN)
            with f.when(step > 0.0):
                f.call(taken, record, step)
                f.add(record, _integer("record"))
                f.add(done, 1)
            with f.when(status.equals(Status.GOAL)):
                _set_double(f, "time", _double("goal"))
                _set_double(f, "rest", constant(F64, 0))
    _set_integer(f, "done", done)
    f.give(status)

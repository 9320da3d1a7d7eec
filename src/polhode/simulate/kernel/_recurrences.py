"""Taylor coefficients of the results of a tape, one order after the other, in WebAssembly.

The k-th coefficient of a result follows from those of its operands up to the k-th and its own up to
the (k − 1)-th. With a = Σ aⱼ τʲ, as sums over j:

    a b           Σ aⱼ bₖ₋ⱼ
    a / b         (aₖ − Σ bⱼ cₖ₋ⱼ) / b₀,  j ≥ 1, for the quotient c
    √a            (aₖ − Σ cⱼ cₖ₋ⱼ) / (2 c₀),  1 ≤ j < k, for the root c
    exp a = e     Σ j aⱼ eₖ₋ⱼ / k
    sin a, cos a  Σ j aⱼ cₖ₋ⱼ / k and −Σ j aⱼ sₖ₋ⱼ / k, likewise sinh a, cosh a without the sign

Source: Griewank and Walther, Evaluating Derivatives, 2nd ed., section 13.2.
"""

from __future__ import annotations

from polhode.simulate.kernel._assembly import (
    F64,
    I32,
    Function,
    Module,
    Value,
    called,
    load,
    square_root,
    to_double,
)
from polhode.simulate.kernel._elementary import Elementary

#: Bytes of a step of the tape: its kind, and the addresses of the rows of its result and operands.
STEP = 16
_EIGHT = 8  # bytes of a coefficient


def evaluation(module: Module, functions: Elementary) -> Function:
    """The function that evaluates the coefficients of one order.

    Its parameters are the addresses where the steps of the tape begin and end, the order, and the
    bytes of a row.
    """
    return _Evaluation(module, functions).function


class _Evaluation:
    def __init__(self, module: Module, functions: Elementary) -> None:
        self._functions = functions
        self._convolution = _convolution(module)
        self._self_convolution = _self_convolution(module, self._convolution)
        self.function = f = module.function("evaluate", [I32, I32, I32, I32], [])
        step, end, self._order, self._row = f.parameters
        self._place = f.let(self._order * _EIGHT)  # of the coefficient in each row
        self._number = f.let(to_double(self._order))
        self._target, self._first, self._second = (f.variable(I32) for _ in range(3))
        with f.repeat_while(step < end):
            for k, variable in enumerate((self._target, self._first, self._second), 1):
                f.set(variable, load(I32, step, 4 * k))
            f.choose(load(I32, step), [  # in the order of `Recurrence`
                self._add, self._subtract, self._negate, self._multiply, self._square, self._scale,
                self._divide, self._reduce, self._root, self._exponential, self._circular,
                self._hyperbolic,
            ])  # fmt: skip
            f.add(step, STEP)

    # -- coefficients ---------------------------------------------------------------------------

    def _now(self, row: Value) -> Value:
        """The coefficient of this order."""
        return load(F64, row + self._place)

    def _store(self, value: Value, rows: int = 0) -> None:
        """The coefficient of this order of the result, or of a row after it."""
        target = self._target + self._row * rows if rows else self._target
        self.function.store(target + self._place, value)

    def _sum(self, a: Value, b: Value) -> Value:
        """Σ aⱼ bₖ₋ⱼ for j from 1 to k."""
        return called(self._convolution, a + _EIGHT, b + self._place - _EIGHT, self._order)

    # -- one step each --------------------------------------------------------------------------

    def _add(self) -> None:
        self._store(self._now(self._first) + self._now(self._second))

    def _subtract(self) -> None:
        self._store(self._now(self._first) - self._now(self._second))

    def _negate(self) -> None:
        self._store(-self._now(self._first))

    def _multiply(self) -> None:
        second = self._second + self._place
        self._store(called(self._convolution, self._first, second, self._order + 1))

    def _square(self) -> None:
        self._store(called(self._self_convolution, self._first, self._place))

    def _scale(self) -> None:
        self._store(self._now(self._first) * load(F64, self._second))

    def _divide(self) -> None:
        known = self._sum(self._second, self._target)
        self._store((self._now(self._first) - known) / load(F64, self._second))

    def _reduce(self) -> None:
        self._store(self._now(self._first) / load(F64, self._second))

    def _root(self) -> None:
        f = self.function
        with f.when(self._order.equals(0)):
            self._store(square_root(load(F64, self._first)))
            f.otherwise()
            known = called(self._self_convolution, self._target + _EIGHT, self._place - 2 * _EIGHT)
            self._store((self._now(self._first) - known) / (load(F64, self._target) * 2.0))

    def _exponential(self) -> None:
        f = self.function
        derivative = f.let(self._target + self._row)
        self._store(self._now(self._first) * self._number, 1)
        with f.when(self._order.equals(0)):
            self._store(called(self._functions.exp, load(F64, self._first)))
            f.otherwise()
            self._store(self._sum(derivative, self._target) / self._number)

    def _circular(self) -> None:
        self._pair(self._functions.sin, self._functions.cos, -1.0)

    def _hyperbolic(self) -> None:
        self._pair(self._functions.sinh, self._functions.cosh, 1.0)

    def _pair(self, odd: Function, even: Function, sign: float) -> None:
        """Two functions of which each is the derivative of the other, up to a sign."""
        f = self.function
        partner, derivative = f.let(self._target + self._row), f.let(self._target + self._row * 2)
        self._store(self._now(self._first) * self._number, 2)
        with f.when(self._order.equals(0)):
            self._store(called(odd, load(F64, self._first)))
            self._store(called(even, load(F64, self._first)), 1)
            f.otherwise()
            self._store(self._sum(derivative, partner) / self._number)
            self._store(self._sum(derivative, self._target) * sign / self._number, 1)


def _convolution(module: Module) -> Function:
    """Σ aⱼ b₋ⱼ over so many terms, from the addresses of a₀ and b₀.

    Even and odd terms are summed apart, as a sum has to wait for the one before it.
    """
    f = module.function("convolution", [I32, I32, I32], [F64])
    a, b, terms = f.parameters
    even, odd = f.variable(F64), f.variable(F64)
    last = f.let(a + (terms - 1) * _EIGHT)
    with f.repeat_while(a < last):
        f.add(even, load(F64, a) * load(F64, b))
        f.add(odd, load(F64, a, _EIGHT) * load(F64, b - _EIGHT))
        f.add(a, 2 * _EIGHT)
        f.set(b, b - 2 * _EIGHT)
    with f.when(a.equals(last)):
        f.add(even, load(F64, a) * load(F64, b))
    f.give(even + odd)
    return f


def _self_convolution(module: Module, convolution: Function) -> Function:
    """Σ aⱼ aₖ₋ⱼ for j from 0 to k, from the address of a₀ and 8 k; zero for k = −1."""
    f = module.function("self_convolution", [I32, I32], [F64])
    a, place = f.parameters
    with f.when(place < 0):
        f.give(0.0)
    pairs = f.let(place + _EIGHT >> 4)
    total = f.let(called(convolution, a, a + place, pairs) * 2.0)
    with f.when((place & _EIGHT).equals(0)):
        middle = load(F64, a + pairs * _EIGHT)
        f.add(total, middle * middle)
    f.give(total)
    return f

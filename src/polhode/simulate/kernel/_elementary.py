"""Sine, cosine, exponential, logarithm and hyperbolic functions in WebAssembly.

WebAssembly has none of them, and those of its hosts differ in the last bit. These are accurate to
less than one unit in the last place (ulp) for all doubles, and use nothing but IEEE 754 operations,
each rounded once: every host computes the same bits.

The largest part of each result is kept exactly, or as the unevaluated sum of two doubles, and a
Taylor polynomial gives only the rest, whose rounding then is a fraction of an ulp.

Sources: Muller, Elementary Functions, 3rd ed., chapters 3 and 11 (polynomials and reduction); Payne
and Hanek, SIGNUM Newsletter 18 (1983) 19–24 (angles of any size); Cody and Waite, Software Manual
for the Elementary Functions (reduction by a constant in two parts); Dekker, Numerische Mathematik
18 (1971) 224–242 (sums and products of doubles without error).
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import factorial, inf, log, nan

import flint

from polhode.simulate.kernel._assembly import (
    F64,
    I32,
    I64,
    Function,
    Module,
    Value,
    Variable,
    absolute,
    bits_of,
    called,
    constant,
    double_of_bits,
    load,
    narrowed,
    nearest,
    selected,
    to_double,
    to_integer,
    widened,
    with_sign_of,
)


@dataclass(frozen=True)
class Elementary:
    """The functions of a module, each of one double with one result.

    Attributes:
        table_size: bytes of the memory that their table takes up.
    """

    sin: Function
    cos: Function
    exp: Function
    log: Function
    sinh: Function
    cosh: Function
    table_size: int


def elementary(module: Module, table: int) -> Elementary:
    """Add the functions to a module, with their table at an address of its memory."""
    content = _two_over_pi()
    module.data(table, content)
    product = _product(module)
    reduce = _reduce(module, product, table)
    sine, cosine = _sine(module), _cosine(module, product)
    power_of_two = _times_power_of_two(module)
    exponential = _exponential(module)
    return Elementary(
        sin=_circular(module, "sin", reduce, sine, cosine, 0),
        cos=_circular(module, "cos", reduce, sine, cosine, 1),
        exp=_exp(module, exponential, power_of_two),
        log=_log(module, product),
        sinh=_sinh(module, exponential, power_of_two),
        cosh=_cosh(module, exponential, power_of_two, product),
        table_size=len(content),
    )


# -- sums and products without error --------------------------------------------------------------


def _exact_sum(f: Function, a: Value, b: Value) -> tuple[Variable, Variable]:
    """a + b rounded, and its error, where a is zero or |a| ≥ |b| (Dekker)."""
    total = f.let(a + b)
    return total, f.let(b - (total - a))


_SPLIT = 2.0**27 + 1  # times a double: its upper 26 bits follow without error (Veltkamp)


def _product(module: Module) -> Function:
    """a b rounded, and its error; not near the ends of the range of doubles (Dekker)."""
    f = module.function("product", [F64, F64], [F64, F64])
    a, b = f.parameters
    halves = []
    for factor in (a, b):
        scaled = f.let(factor * _SPLIT)
        upper = f.let(scaled - (scaled - factor))
        halves.append((upper, f.let(factor - upper)))
    (a_1, a_0), (b_1, b_0) = halves
    rounded = f.let(a * b)
    f.give(rounded, a_0 * b_0 - (((rounded - a_1 * b_1) - a_0 * b_1) - a_1 * b_0))
    return f


def _polynomial(x: Variable, coefficients: Sequence[Fraction]) -> Value:
    """By rising power, in Horner's form."""
    total = constant(F64, float(coefficients[-1]))
    for coefficient in coefficients[-2::-1]:
        total = total * x + float(coefficient)
    return total


def _alternating(first: int, last: int) -> list[Fraction]:
    """±1/n! for every second n, the first one positive."""
    return [Fraction((-1) ** k, factorial(n)) for k, n in enumerate(range(first, last + 1, 2))]


def _inverse_factorials(first: int, last: int, by: int = 1) -> list[Fraction]:
    return [Fraction(1, factorial(n)) for n in range(first, last + 1, by)]


# -- sine and cosine ------------------------------------------------------------------------------
#
# An angle is n·π/2 + r with |r| ≤ π/4. Its share of π/2 is found in integers (Payne and Hanek): the
# angle is m·2^e with a whole number m of 53 bits, and of the digits of 2/π only those count that
# make less than four quarter turns with m·2^e, down to some 100 bits beyond the smallest share that
# a double can have, 2⁻⁶² (Muller, section 11.3). Digits are of 28 bits: the products of two digits
# of m with those of 2/π, and their sum, fit into 64 bits.

_DIGIT = 28  # bits
_MASK = 2**_DIGIT - 1
_COLUMNS = 8  # digits of the product
_LEADING = 2  # zeros before the digits of 2/π in the table: m·2^e may be as small as 1/2
_DIGITS = 36 + _COLUMNS + _LEADING  # for exponents up to 2^1023


def _precise(bits: int, number: str) -> int:
    """2/π, π/2 or ln 2 times 2^bits, less its fraction."""
    with flint.ctx.workprec(bits + 64):
        values = {
            "2/π": 2 / flint.arb.pi(),
            "π/2": flint.arb.pi() / 2,
            "ln 2": flint.arb(2).log(),
        }
        floor = (values[number] * flint.arb(2) ** bits).floor().unique_fmpz()
    assert floor is not None
    return int(floor)


def _two_over_pi() -> bytes:
    number = _precise((_DIGITS - _LEADING) * _DIGIT, "2/π")
    digits = [number >> _DIGIT * k & _MASK for k in range(_DIGITS)]
    return struct.pack(f"<{_DIGITS}q", *reversed(digits))


def _in_parts(number: str, first_bits: int) -> tuple[float, float]:
    """A constant as the sum of a double of so many bits and another double."""
    precise = Fraction(_precise(200, number), 2**200)
    scale = 2**first_bits
    first = Fraction(round(precise * scale), scale)
    return float(first), float(precise - first)


def _reduce(module: Module, product: Function, table: int) -> Function:
    """r as the sum of two doubles, and n modulo 4, of a finite angle with |x| > π/4."""
    f = module.function("reduce", [F64], [F64, F64, I32])
    (x,) = f.parameters
    bits = f.let(bits_of(x))
    low, high = f.let(bits & _MASK), f.let((bits >> _DIGIT & (2**24 - 1)) | 2**24)
    # m·2^e with e = 28 first + shift + 2, where first counts digits of the table
    exponent = f.let(narrowed(bits >> 52 & 0x7FF) - (1075 + 2) + _LEADING * _DIGIT)
    first = f.let(exponent // _DIGIT)
    shift = f.let(widened(exponent - first * _DIGIT))
    digits = [load(I64, first << 3, table + 8 * k) for k in range(_COLUMNS + 1)]
    columns = _times(f, digits, low, high)
    # shifted to the left, they begin with the two bits of n
    shifted = [
        f.let(((upper << shift) | (lower >> (constant(I64, _DIGIT) - shift))) & _MASK)
        for upper, lower in pairwise(columns)
    ]
    quarter = f.let(narrowed(shifted[0] >> (_DIGIT - 2)))
    f.set(shifted[0], shifted[0] & (_MASK >> 2))
    # from the nearer quarter turn: a share above one half is the complement of one below
    sign = f.let(constant(F64, 1))
    with f.when(narrowed(shifted[0] >> (_DIGIT - 3))):
        f.set(shifted[0], shifted[0] ^ (_MASK >> 2))
        for digit in shifted[1:]:
            f.set(digit, digit ^ _MASK)
        f.set(quarter, quarter + 1)
        f.set(sign, -1.0)
    parts = [to_double(shifted[0] << _DIGIT | shifted[1])]
    parts += [to_double(digit) * 2.0 ** (-_DIGIT * k) for k, digit in enumerate(shifted[2:6], 1)]
    share, first_rest = _exact_sum(f, parts[0], parts[1])
    share, second_rest = _exact_sum(f, share, parts[2])
    rest = f.let(first_rest + (second_rest + (parts[3] + parts[4])))
    # times π/2, in two doubles
    above, below = _in_parts("π/2", 52)
    scale = 2.0 ** (2 - 2 * _DIGIT)
    size, error = f.call(product, share * scale, above)
    r, r_rest = _exact_sum(f, size, error + (share * scale * below + rest * scale * above))
    with f.when(x < 0.0):
        f.set(sign, -sign)
        f.set(quarter, constant(I32, 0) - quarter)
    f.give(r * sign, r_rest * sign, quarter & 3)
    return f


def _times(f: Function, digits: Sequence[Value], low: Variable, high: Variable) -> list[Variable]:
    """The digits of a product of which the second factor has two, without what is carried out."""
    columns = list[Variable]()
    carried: Value = constant(I64, 0)
    for k in reversed(range(_COLUMNS)):
        column = f.let(digits[k] * low + digits[k + 1] * high + carried)
        carried = column >> _DIGIT
        columns.append(f.let(column & _MASK))
    return columns[::-1]


def _sine(module: Module) -> Function:
    """The sine of r + rest, |r| ≤ π/4: r exactly, and a rest of at most 0.08."""
    f = module.function("sine", [F64, F64], [F64])
    r, rest = f.parameters
    z = f.let(r * r)
    tail = _polynomial(z, [-c for c in _alternating(3, 17)])
    f.give(r + (rest * (1.0 - z * 0.5) + r * z * tail))
    return f


def _cosine(module: Module, product: Function) -> Function:
    """The cosine of r + rest, |r| ≤ π/4: 1 − r²/2 as the sum of doubles, and the rest."""
    f = module.function("cosine", [F64, F64], [F64])
    r, rest = f.parameters
    z, z_rest = f.call(product, r, r)
    total, error = _exact_sum(f, constant(F64, 1), z * -0.5)
    tail = z * z * _polynomial(z, _alternating(4, 18))
    f.give(total + (error + (tail - z_rest * 0.5 - r * rest)))
    return f


_EIGHTH_TURN = 0.7853981633974483
_TINY = 2.0**-27  # x² is below half an ulp of one


def _circular(
    module: Module, name: str, reduce: Function, sine: Function, cosine: Function, ahead: int
) -> Function:
    """The sine of x + ahead·π/2."""
    f = module.function(name, [F64], [F64], shown=True)
    (x,) = f.parameters
    with f.when(absolute(x) <= _EIGHTH_TURN):
        if not ahead:  # which keeps the sign of zero
            with f.when(absolute(x) < _TINY):
                f.give(x)
        f.give(called((sine, cosine)[ahead], x, 0.0))
    with f.when((absolute(x) < inf).equals(0)):
        f.give(nan)
    r, rest, quarter = f.call(reduce, x)
    f.add(quarter, ahead)
    value = f.variable(F64)
    with f.when(quarter & 1):
        f.set(value, called(cosine, r, rest))
        f.otherwise()
        f.set(value, called(sine, r, rest))
    f.give(selected(quarter & 2, -value, value))
    return f


# -- exponential and hyperbolic functions ---------------------------------------------------------
#
# x = k ln 2 + r with |r| ≤ ln 2 / 2, where ln 2 = L + M and k L is exact.

_LN_2, _LN_2_REST = _in_parts("ln 2", 40)
_FAR = 60  # k from which on e⁻ˣ is less than 2⁻¹⁰⁰ eˣ
_NEGLIGIBLE, _BEYOND = -746.0, 711.0  # outside, eˣ rounds to zero, and eˣ/2 is infinite


def _exponential(module: Module) -> Function:
    """eˣ = (a + b) 2^k as a, b, k with |b| < 0.08 a, for x between the limits above."""
    f = module.function("exponential", [F64], [F64, F64, I32])
    (x,) = f.parameters
    k = f.let(nearest(x * (1 / log(2))))
    above = f.let(x - k * _LN_2)
    r = f.let(above - k * _LN_2_REST)
    rest = f.let((above - r) - k * _LN_2_REST)
    total, error = _exact_sum(f, constant(F64, 1), r)
    tail = r * r * _polynomial(r, _inverse_factorials(2, 15))
    f.give(total, error + (rest + tail), to_integer(k))
    return f


def _times_power_of_two(module: Module) -> Function:
    """x·2^k for |k| < 2000, rounded once, also where the result is subnormal."""
    f = module.function("times_power_of_two", [F64, I32], [F64])
    x, k = f.parameters
    half = f.let((k + 2048 >> 1) - 1024)
    f.give(x * _power_of_two(half) * _power_of_two(k - half))
    return f


def _power_of_two(k: Value) -> Value:
    return double_of_bits(widened(k + 1023) << 52)


def _exp(module: Module, exponential: Function, times_power_of_two: Function) -> Function:
    f = module.function("exp", [F64], [F64], shown=True)
    (x,) = f.parameters
    with f.when(x.differs(x)):
        f.give(x)
    with f.when(x > _BEYOND):
        f.give(inf)
    with f.when(x < _NEGLIGIBLE):
        f.give(0.0)
    a, b, k = f.call(exponential, x)
    f.give(called(times_power_of_two, a + b, k))
    return f


def _sinh(module: Module, exponential: Function, times_power_of_two: Function) -> Function:
    f = module.function("sinh", [F64], [F64], shown=True)
    (x,) = f.parameters
    size = f.let(absolute(x))
    with f.when(size <= 1.0):
        with f.when(size < _TINY):
            f.give(x)
        z = f.let(x * x)
        f.give(x + x * z * _polynomial(z, _inverse_factorials(3, 19, 2)))
    with f.when((size <= _BEYOND).equals(0)):
        f.give(x * inf)
    a, b, k = f.call(exponential, size)
    total, error = _exact_sum(f, a, -_inverse(f, a, b, k, times_power_of_two))
    f.give(with_sign_of(called(times_power_of_two, total + (error + b), k - 1), x))
    return f


def _cosh(
    module: Module, exponential: Function, times_power_of_two: Function, product: Function
) -> Function:
    f = module.function("cosh", [F64], [F64], shown=True)
    (x,) = f.parameters
    size = f.let(absolute(x))
    with f.when(size <= 1.0):
        with f.when(size < _TINY):
            f.give(1.0)
        z, z_rest = f.call(product, x, x)
        total, error = _exact_sum(f, constant(F64, 1), z * 0.5)
        tail = z * z * _polynomial(z, _inverse_factorials(4, 20, 2))
        f.give(total + (error + (z_rest * 0.5 + tail)))
    with f.when((size <= _BEYOND).equals(0)):
        f.give(size * inf)
    a, b, k = f.call(exponential, size)
    total, error = _exact_sum(f, a, _inverse(f, a, b, k, times_power_of_two))
    f.give(called(times_power_of_two, total + (error + b), k - 1))
    return f


def _inverse(
    f: Function, a: Variable, b: Variable, k: Variable, times_power_of_two: Function
) -> Variable:
    """e⁻ˣ in units of 2^k, at most 0.14 a for x > 1, so that its rounding is not felt."""
    found = f.variable(F64)
    with f.when(k < _FAR):
        f.set(found, called(times_power_of_two, 1.0 / (a + b), k * -2))
    return found


# -- logarithm ------------------------------------------------------------------------------------
#
# x = 2^k m with √½ ≤ m < √2, and ln m = 2 artanh s = 2 s + 2 s³/3 + … with s = (m − 1)/(m + 1).

_SMALLEST_NORMAL = 2.0**-1022
_ROOT_HALF_BITS = 0x3FE6A09E667F3BCD  # of √½


def _log(module: Module, product: Function) -> Function:
    f = module.function("log", [F64], [F64], shown=True)
    (x,) = f.parameters
    with f.when((x > 0.0).equals(0)):
        f.give(selected(x.equals(0.0), -inf, constant(F64, nan)))
    with f.when(x.equals(inf)):
        f.give(x)
    lifted = f.variable(F64)
    with f.when(x < _SMALLEST_NORMAL):
        f.set(x, x * 2.0**54)
        f.set(lifted, 54.0)
    # in units of 2⁵² from the bits of √½ on, the exponent counts from where m is least
    bits = f.let(bits_of(x))
    biased = f.let(bits - (_ROOT_HALF_BITS - (1023 << 52)) >> 52)
    m = double_of_bits(bits - (biased - 1023 << 52))
    k = f.let(to_double(biased - 1023) - lifted)
    over = f.let(m - 1.0)
    under, under_rest = _exact_sum(f, constant(F64, 2), over)
    s = f.let(over / under)
    back, back_rest = f.call(product, s, under)
    s_rest = (((over - back) - back_rest) - s * under_rest) / under
    z = f.let(s * s)
    tail = s * z * _polynomial(z, [Fraction(2, n) for n in range(3, 27, 2)])
    rest = f.let(s_rest * 2.0 + tail)
    with f.when(k.equals(0.0)):
        f.give(s * 2.0 + rest)
    total, error = _exact_sum(f, k * _LN_2, s * 2.0)
    f.give(total + (error + (rest + k * _LN_2_REST)))
    return f

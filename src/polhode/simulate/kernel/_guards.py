"""Where a guard first falls below zero within a step, in WebAssembly.

Over a step a guard is a polynomial p of the share s that has passed, 0 ≤ s ≤ 1. It falls where it
comes to lie below −η for its noise η, so that a graze that is no deeper than rounding does not
count; the root is the last zero of p before, or the beginning of the step if p is negative from
there on. A guard that is zero at the end of a step falls at the beginning of the next.

Both places are found as the first at which a polynomial is negative. In Bernstein's basis no
coefficient is negative where a polynomial is not, and halving the interval brings the coefficients
to the polynomial: the search goes to the left half while that may be negative, else on to the
right, and ends at the last bit of the share. No root is missed, whether simple, double or close to
another.

Source: Farouki, Computer Aided Geometric Design 29 (2012) 379–419, sections 3.3 and 3.4.
"""

from __future__ import annotations

from math import inf

from polhode.simulate.kernel._assembly import (
    F64,
    I32,
    Function,
    Module,
    called,
    constant,
    least,
    load,
    to_double,
)

#: Share of the largest value of a guard: a dip below zero that is no deeper counts as rounding.
NOISE = 2.0**-43
_HALVINGS = 53  # of the step: down to the last bit of a share


def work_size(order: int) -> int:
    """Bytes of memory that the search takes: coefficients of intervals that are to be searched."""
    return 8 * ((order + 1) * (_HALVINGS + 2) + _HALVINGS + 2)


def guard_fall(module: Module) -> Function:
    """The function that gives the share of a step at which a guard falls; infinite if it does not.

    Its parameters are the addresses of the coefficients of the powers of the share and of memory
    for the search, the degree of the polynomial, and the noise.
    """
    first_negative = _first_negative(module)
    to_bernstein = _to_bernstein(module)
    part = _part(module)
    f = module.function("guard_fall", [I32, I32, I32, F64], [F64])
    powers, work, degree, noise = f.parameters
    end = f.let(degree << 3)
    # p(s) ≥ p(0) + the sum of its negative coefficients
    bound, k = f.let(load(F64, powers) + noise), f.variable(I32)
    with f.count(k, 8, end + 8, by=8):
        f.add(bound, least(load(F64, powers + k), 0.0))
    with f.when(bound >= 0.0):
        f.give(inf)
    with f.count(k, 0, end + 8, by=8):
        f.store(work + k, load(F64, powers + k))
    f.store(work, load(F64, work) + noise)
    f.call(to_bernstein, work, degree)
    below = f.let(called(first_negative, work, degree))
    with f.when((below < inf).equals(0)):
        f.give(inf)
    with f.when(below.equals(0.0)):
        f.give(0.0)
    # backwards from there: the first place at which −p is negative
    with f.count(k, 0, end + 8, by=8):
        f.store(work + k, -load(F64, powers + k))
    f.call(to_bernstein, work, degree)
    f.call(part, work, degree, below)
    back = f.let(called(first_negative, work, degree))
    with f.when((back < inf).equals(0)):
        f.give(0.0)
    f.give(below * (1.0 - back))
    return f


def _to_bernstein(module: Module) -> Function:
    """Turn coefficients of powers into those of Bernstein's basis: Σ C(i, k)/C(n, k) aₖ."""
    f = module.function("to_bernstein", [I32, I32], [])
    work, degree = f.parameters
    end, k, i = f.let(degree << 3), f.variable(I32), f.variable(I32)
    choices, number = f.let(constant(F64, 1)), f.variable(F64)
    with f.count(k, 8, end + 8, by=8):
        f.set(number, to_double(k >> 3))
        f.set(choices, choices * (to_double(degree) - number + 1.0) / number)
        f.store(work + k, load(F64, work + k) / choices)
    # the binomial sums, as Pascal's triangle adds them
    with f.count(k, 8, end + 8, by=8):
        f.set(i, end)
        with f.repeat_while(i >= k):
            f.store(work + i, load(F64, work + i) + load(F64, work + i - 8))
            f.set(i, i - 8)
    return f


def _part(module: Module) -> Function:
    """The part of a polynomial from zero to a place, read backwards from that place on."""
    f = module.function("part", [I32, I32, F64], [])
    work, degree, place = f.parameters
    end, k, i = f.let(degree << 3), f.variable(I32), f.variable(I32)
    rest = f.let(1.0 - place)
    # de Casteljau: after the k-th pass the first entry is the k-th coefficient of the part; it is
    # kept where the pass has freed an entry, at the end, which reverses their order
    first = f.variable(F64)
    with f.count(k, 0, end, by=8):
        f.set(first, load(F64, work))
        with f.count(i, 0, end - k, by=8):
            f.store(work + i, load(F64, work + i) * rest + load(F64, work + i + 8) * place)
        f.store(work + end - k, first)
    return f


def _first_negative(module: Module) -> Function:
    """The first share at which a polynomial in Bernstein's basis is negative; infinite if none."""
    is_negative = _is_somewhere_negative(module)
    halve = _halve(module)
    f = module.function("first_negative", [I32, I32], [F64])
    bottom, degree = f.parameters
    row = f.let(degree + 1 << 3)
    # A stack of intervals, the leftmost on top; beyond them, the width of each.
    top, begin = f.let(bottom), f.variable(F64)
    widths = f.let(bottom + row * (_HALVINGS + 2))
    f.store(widths, constant(F64, 1))
    width, depth = f.variable(F64), f.variable(I32)
    with f.repeat_while(depth >= 0):
        f.set(width, load(F64, widths + (depth << 3)))
        with f.when(load(F64, top) < 0.0):
            f.give(begin)
        with f.when(called(is_negative, top, degree) & (width > 2.0**-_HALVINGS)):
            # the right half stays in its place, and the left one goes on top of it
            f.call(halve, top, degree)
            f.store(widths + (depth << 3), width * 0.5)
            f.store(widths + (depth << 3), width * 0.5, 8)
            f.add(top, row)
            f.add(depth, 1)
            f.otherwise()
            f.add(begin, width)
            f.set(top, top - row)
            f.set(depth, depth - 1)
    f.give(inf)
    return f


def _is_somewhere_negative(module: Module) -> Function:
    """Whether a coefficient is negative."""
    f = module.function("is_somewhere_negative", [I32, I32], [I32])
    work, degree = f.parameters
    end = f.let(work + (degree << 3))
    with f.repeat_while(work <= end):
        with f.when(load(F64, work) < 0.0):
            f.give(1)
        f.add(work, 8)
    f.give(0)
    return f


def _halve(module: Module) -> Function:
    """Replace coefficients by those of the right half, and append those of the left (de Casteljau).

    The mean of neighbours, pass by pass: the first entries are the coefficients of the left half.
    """
    f = module.function("halve", [I32, I32], [])
    work, degree = f.parameters
    end, k, i = f.let(degree << 3), f.variable(I32), f.variable(I32)
    left = f.let(work + end + 8)
    with f.count(k, 0, end + 8, by=8):
        f.store(left + k, load(F64, work))
        with f.count(i, 0, end - k, by=8):
            f.store(work + i, (load(F64, work + i) + load(F64, work + i + 8)) * 0.5)
    return f

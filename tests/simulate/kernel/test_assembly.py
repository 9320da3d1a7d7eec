"""The encoder, by what hosts compute with its modules."""

import math
import random

import pytest

from polhode.simulate.kernel import _assembly as wasm
from polhode.simulate.kernel._assembly import F64, I32, I64
from simulate.kernel.hosts import exports


def computed(results, *given, build, parameters=(), size=0):
    """What a function returns whose statements are those of `build`."""
    module = wasm.Module()
    function = module.function("f", parameters, results, shown=True)
    build(function)
    return exports(module.binary(size))["f"](*given)


@pytest.mark.parametrize("number", [0, 1, 63, 64, 127, 128, 255, 624485, 2**31 - 1, 2**63 - 1])
def test_numbers_of_any_size(number):
    def build(f):
        f.give(wasm.constant(I64, number), wasm.constant(I64, -number))

    assert computed([I64, I64], build=build) == [number, -number]


def test_the_examples_of_the_format():
    """Those of the DWARF standard, version 4, figures 22 and 23."""
    assert [wasm.unsigned(n).hex() for n in (2, 127, 128, 129, 12857)] == [
        "02", "7f", "8001", "8101", "b964",
    ]  # fmt: skip
    assert [wasm.signed(n).hex() for n in (2, -2, 127, -127, 128, -128, 129, -129)] == [
        "02", "7e", "ff00", "817f", "8001", "807f", "8101", "ff7e",
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(20))
def test_operations_on_doubles(seed):
    drawn = random.Random(seed)
    a, b = drawn.uniform(-9, 9), drawn.uniform(-9, 9)
    module = wasm.Module()
    f = module.function("f", [F64, F64], [F64] * 13, shown=True)
    x, y = f.parameters
    f.give(
        x + y, x - y, x * y, x / y, -x, wasm.absolute(x), wasm.square_root(wasm.absolute(x)),
        wasm.nearest(x), wasm.least(x, y), wasm.largest(x, y), wasm.with_sign_of(x, y),
        2.0 - x, 2.0 / x,
    )  # fmt: skip
    expected = [
        a + b, a - b, a * b, a / b, -a, abs(a), math.sqrt(abs(a)),
        float(round(a)), min(a, b), max(a, b), math.copysign(a, b), 2 - a, 2 / a,
    ]  # fmt: skip
    assert exports(module.binary(0))["f"](a, b) == expected


def test_comparisons_and_bits():
    module = wasm.Module()
    f = module.function("f", [I32, I32], [I32] * 12, shown=True)
    x, y = f.parameters
    f.give(
        x < y, x <= y, x > y, x >= y, x.equals(y), x.differs(y), x & y, x | y, x ^ y,
        x << y, x >> y, x // y,
    )  # fmt: skip
    found = exports(module.binary(0))["f"](12, 5)
    assert found == [0, 0, 1, 1, 0, 1, 12 & 5, 12 | 5, 12 ^ 5, 12 << 5, 0, 2]


def test_conversions():
    module = wasm.Module()
    f = module.function("f", [F64, I32], [I64, F64, F64, I32, I32, I64], shown=True)
    x, n = f.parameters
    bits = wasm.bits_of(x)
    f.give(
        bits, wasm.double_of_bits(bits), wasm.to_double(n), wasm.to_integer(x),
        wasm.narrowed(bits >> 52), wasm.widened(n),
    )  # fmt: skip
    assert exports(module.binary(0))["f"](2.5, 7) == [0x4004 << 48, 2.5, 7.0, 2, 0x400, 7]


def test_a_loop_that_is_left_and_one_that_counts():
    """The Collatz sequence of 27 has 111 steps; 0 + … + 9 = 45, less 3 and 6."""
    module = wasm.Module()
    f = module.function("f", [I32], [I32, I32], shown=True)
    (n,) = f.parameters
    steps, total, i = f.variable(I32), f.variable(I32), f.variable(I32)
    with f.repeat() as loop:
        f.leave(loop, n.equals(1))
        with f.when(n & 1):
            f.set(n, n * 3 + 1)
            f.otherwise()
            f.set(n, n >> 1)
        f.add(steps, 1)
    with f.count(i, 0, 100) as loop:
        f.leave(loop, i.equals(10))
        with f.when(i.differs(3) & i.differs(6)):
            f.add(total, i)
    f.give(steps, total)
    assert exports(module.binary(0))["f"](27) == [111, 36]


@pytest.mark.parametrize(("which", "value"), [(0, 10), (1, 11), (2, 12), (3, -1), (-1, -1)])
def test_cases(which, value):
    def build(f):
        (n,) = f.parameters
        found = f.let(wasm.constant(I32, -1))
        f.choose(n, [lambda k=k: f.set(found, 10 + k) for k in range(3)])
        f.give(found)

    assert computed([I32], which, build=build, parameters=[I32]) == value


def test_calls_and_memory():
    """Fibonacci numbers by calls that return two, kept in the memory."""
    module = wasm.Module()
    module.data(64, bytes(range(1, 9)))
    following = module.function("following", [F64, F64], [F64, F64])
    a, b = following.parameters
    following.give(b, a + b)
    f = module.function("f", [I32], [F64, I32], shown=True)
    (n,) = f.parameters
    i, x, y = f.variable(I32), f.let(wasm.constant(F64, 0)), f.let(wasm.constant(F64, 1))
    with f.count(i, 0, n):
        u, v = f.call(following, x, y)
        f.set(x, u)
        f.set(y, v)
        f.store(i << 3, x, 1024)
    f.give(wasm.load(F64, n - 1 << 3, 1024), wasm.load(I32, wasm.constant(I32, 64)))
    assert exports(module.binary(65536))["f"](50) == [12586269025.0, 0x04030201]


def test_values_of_different_types_are_not_mixed():
    with pytest.raises(TypeError, match="I32 where F64 is needed"):
        wasm.constant(F64, 1.0) + wasm.constant(I32, 1)

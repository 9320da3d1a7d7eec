"""Elementary functions against mpmath, and the same bits in Node.

Largest errors at 20,000 places of each range, in units in the last place (ulp):
sin 0.716, cos 0.743, exp 0.749, sinh 0.758, cosh 0.646, log 0.521.
"""

import math
import random
import struct

import mpmath
import pytest

from polhode.simulate.kernel._assembly import Module
from polhode.simulate.kernel._elementary import elementary
from simulate.kernel.hosts import exports, in_node

COUNT = 1000  # arguments per range


@pytest.fixture(scope="module")
def binary():
    module = Module()
    elementary(module, 1024)
    return module.binary(65536)


@pytest.fixture(scope="module")
def functions(binary):
    return exports(binary)


def any_double(drawn):
    """Every finite double is as likely as any other."""
    while True:
        (value,) = struct.unpack("<d", drawn.randbytes(8))
        if math.isfinite(value):
            return value


def near_quarter_turns(drawn):
    return drawn.randrange(2 ** drawn.randrange(1, 1000)) * (math.pi / 2)


def subnormal(drawn):
    return drawn.randrange(1, 2**52) * 5e-324 * drawn.choice([-1, 1])


def uniform(low, high):
    return lambda drawn: drawn.uniform(low, high)


ANGLES = {
    "small": uniform(-0.79, 0.79),
    "usual": uniform(-100, 100),
    "large": uniform(-1e8, 1e8),
    "any": any_double,
    "near quarter turns": near_quarter_turns,
    "subnormal": subnormal,
}
SIZES = {
    "small": uniform(-1, 1),
    "usual": uniform(-3, 3),
    "all": uniform(-710, 710),
    "any": any_double,
    "subnormal": subnormal,
}
RANGES = {
    "sin": ANGLES,
    "cos": ANGLES,
    "exp": SIZES | {"subnormal results": uniform(-745, -708)},
    "sinh": SIZES,
    "cosh": SIZES,
    "log": {
        "any": lambda drawn: abs(any_double(drawn)),
        "near one": uniform(0.5, 2),
        "very near one": uniform(1 - 1e-6, 1 + 1e-6),
        "subnormal": lambda drawn: abs(subnormal(drawn)),
    },
}
CASES = [(name, where) for name, ranges in RANGES.items() for where in ranges]

# The double that is nearest to a multiple of π/2 relative to its size: its cosine is 4.7e-19
# (Muller, Elementary Functions, 3rd ed., section 11.3.2).
NEAREST = math.ldexp(6381956970095103, 797)
SPECIAL = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    5e-324,
    -5e-324,
    2.0**-1022,
    NEAREST,
    -NEAREST,
    1.7976931348623157e308,
]


def error(name, argument, found):
    """Of a result, in ulp."""
    with mpmath.workprec(1300 if name in ("sin", "cos") else 150):
        exact = getattr(mpmath, name)(mpmath.mpf(argument))
        is_finite = abs(exact) < mpmath.mpf(2) ** 1024
        rounded = float(exact) if is_finite else math.copysign(math.inf, mpmath.sign(exact))
        if math.isinf(rounded) or math.isinf(found):
            return 0.0 if rounded == found else math.inf
        return float(abs(mpmath.mpf(found) - exact) / mpmath.mpf(math.ulp(rounded)))


@pytest.mark.parametrize(("name", "where"), CASES)
def test_less_than_one_unit_in_the_last_place(functions, name, where):
    drawn = random.Random(f"{name} {where}")
    draw = RANGES[name][where]
    arguments = [draw(drawn) for _ in range(COUNT)]
    assert max(error(name, x, functions[name](x)) for x in arguments) < 1


@pytest.mark.parametrize("name", RANGES)
def test_at_special_places(functions, name):
    arguments = [x for x in SPECIAL if name != "log" or x > 0]
    assert max(error(name, x, functions[name](x)) for x in arguments) < 1


def test_beyond_the_range_of_results(functions):
    inf = math.inf
    assert functions["exp"](-inf) == functions["exp"](-800.0) == 0.0
    assert functions["exp"](inf) == functions["exp"](710.0) == inf
    assert functions["sinh"](-inf) == functions["sinh"](-720.0) == -inf
    assert functions["cosh"](-inf) == functions["cosh"](720.0) == inf
    assert functions["log"](0.0) == functions["log"](-0.0) == -inf
    assert functions["log"](inf) == inf
    undefined = [("sin", inf), ("cos", -inf), ("log", -1.0), *((name, math.nan) for name in RANGES)]
    assert all(math.isnan(functions[name](x)) for name, x in undefined)


@pytest.mark.parametrize("name", ["sin", "sinh"])
def test_odd_functions_keep_the_sign_of_zero(functions, name):
    assert math.copysign(1, functions[name](-0.0)) == -1
    assert math.copysign(1, functions[name](0.0)) == 1


def test_node_computes_the_same_bits(binary, functions, tmp_path):
    file = tmp_path / "functions.wasm"
    file.write_bytes(binary)
    drawn = random.Random(5)
    calls = [
        (name, [draw(drawn) for _ in range(200)])
        for name, ranges in RANGES.items()
        for draw in ranges.values()
    ]
    here = [[functions[name](x) for x in arguments] for name, arguments in calls]
    assert in_node(file, calls) == here

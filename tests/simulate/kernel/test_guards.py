"""Guards: where they fall below zero, by polynomials and motions with known roots."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest

from polhode.algebra import Op
from polhode.simulate.kernel._host import Kernel
from polhode.simulate.kernel._steps import Status
from simulate.kernel.tapes import layout_of, symbols, written


def polynomials(*coefficients):
    """x' = 1, with polynomials of x as guards, from their coefficients by rising power."""
    steps = [(Op.CONST, 1)]
    base = 2  # the arguments are x and t
    outputs = [base]
    for own in coefficients:
        steps.append((Op.CONST, Fraction(own[-1])))
        total = base + len(steps) - 1
        for coefficient in own[-2::-1]:
            steps += [(Op.CONST, Fraction(coefficient)), (Op.MUL, [total, 0])]
            steps.append((Op.ADD, [base + len(steps) - 1, base + len(steps) - 2]))
            total = base + len(steps) - 1
        outputs.append(total)
    return written(symbols(1, 0), steps, outputs)


def followed(program, start=(0.0,), goal=1.0, longest=math.inf):
    """The calls until a guard falls or the goal is reached."""
    kernel = Kernel(layout_of(program, len(start)))
    kernel.start(np.empty(0), 0.0, np.array(start))
    calls = [kernel.advance(goal, longest, 8)]
    while calls[-1].status is Status.GOING:
        calls.append(kernel.advance(goal, longest, 8))
    return calls[-1]


def product(*roots, factor=1.0):
    """Coefficients of a polynomial with these roots, exactly."""
    found = [Fraction(factor)]
    for root in map(Fraction, roots):
        shifted = [Fraction(0), *found]
        found = [s - root * f for s, f in zip(shifted, [*found, Fraction(0)], strict=True)]
    return found


def fall(*coefficients, longest=math.inf, goal=1.0):
    """When the first of some guards falls, None if none does."""
    last = followed(polynomials(*coefficients), goal=goal, longest=longest)
    assert last.status in (Status.FALL, Status.GOAL)
    if last.status is Status.GOAL:
        assert last.end == (goal, 0.0)
        return None
    assert last.state[0] == pytest.approx(last.end[0] + last.end[1], abs=1e-15)
    return last.end[0]


def test_a_simple_root():
    assert fall([0.3, -1]) == pytest.approx(0.3, abs=1e-15)
    assert fall([-0.3, 1], goal=0.2) == 0.0  # negative from the beginning
    assert fall([0.3, 1]) is None


@pytest.mark.parametrize("depth", [0.0, 1e-17, 1e-14])
def test_a_graze_is_no_fall(depth):
    """A double root, or a dip no deeper than rounding."""
    assert fall([0.25 - depth, -1, 1]) is None


@pytest.mark.parametrize("depth", [1e-12, 1e-9, 1e-3])
def test_two_close_roots(depth):
    """(x − ½)² − d falls at ½ − √d, however narrow the dip; the root is known to the noise."""
    expected = 0.5 - math.sqrt(depth)
    assert fall([0.25 - depth, -1, 1]) == pytest.approx(expected, abs=1e-15 / math.sqrt(depth))


def test_a_double_root_before_a_simple_one():
    assert fall(product(0.25, 0.25, 0.75, factor=-1)) == pytest.approx(0.75, abs=1e-14)


def test_a_triple_root():
    """Within the cube root of its rounding."""
    assert fall(product(0.5, 0.5, 0.5, factor=-1)) == pytest.approx(0.5, abs=1e-4)


def test_roots_at_the_ends_of_steps():
    """Steps of ¼, ½ and 1, all exact: the root is the end of one and the beginning of the next."""
    for longest in (0.25, 0.5):
        assert fall([0.5, -1], longest=longest) == 0.5
        # a double root there is none, and neither is the beginning of a rise
        assert fall(product(0.5, 0.5), longest=longest) is None
    assert fall([0, 1]) is None
    assert fall([0, -1]) == 0.0
    assert fall([0, 0.25, -1]) == pytest.approx(0.25, abs=1e-15)
    assert fall([1, -1]) is None  # zero at the goal, and not below


def test_simultaneous_roots():
    last = followed(polynomials([0.5, -1], [2, 0, -8], [1, 1], [0.75, -1]))
    assert last.status is Status.FALL
    assert last.end[0] == pytest.approx(0.5, abs=1e-15)
    # the whole step would have lasted one second
    assert last.falls == pytest.approx([0, 0, math.inf, 0.25], abs=1e-14)


def test_the_first_of_several():
    last = followed(polynomials([0.5, -1], [0.4, -1], [0.6, -1]))
    assert last.end[0] == pytest.approx(0.4, abs=1e-15)
    assert np.argmin(last.falls) == 1


@pytest.mark.parametrize("seed", range(60))
def test_random_roots(seed):
    """Roots a twelfth apart, some of them double: the first simple one is where the guard falls."""
    drawn = random.Random(seed)
    places = drawn.sample(range(1, 12), drawn.randrange(1, 6))
    roots = {place / 12 + drawn.uniform(-0.02, 0.02): drawn.choice([1, 1, 2]) for place in places}
    listed = [root for root, multiplicity in roots.items() for _ in range(multiplicity)]
    sign = (-1) ** len(listed)
    expected = min((root for root, m in roots.items() if m == 1), default=None)
    longest = drawn.choice([math.inf, 0.3, 0.07])
    assert fall(product(*listed, factor=sign * 1000), longest=longest) == (
        expected if expected is None else pytest.approx(expected, abs=1e-8)
    )


def oscillator(frequency):
    """x' = ω y, y' = −ω x, with the guard x."""
    steps = [(Op.CONST, frequency), (Op.MUL, [3, 1]), (Op.MUL, [3, 0]), (Op.NEG, [5])]
    return written(symbols(2, 0), steps, [4, 6, 0])


@pytest.mark.parametrize("phase", [0.1, 1.0, 3.0])
def test_a_motion_up_to_a_guard(phase):
    """x = cos(7 t − φ) falls at (π/2 + φ)/7, and the motion ends there."""
    start = (math.cos(phase), math.sin(phase))
    last = followed(oscillator(7), start, goal=10.0)
    if start[0] < 0:
        assert last.end == (0.0, 0.0)
        assert len(last.lengths) == 0
        return
    assert last.end[0] == pytest.approx((math.pi / 2 + phase) / 7, abs=1e-15)
    assert last.state == pytest.approx([0, -1], abs=2e-15)


def test_a_motion_goes_on_behind_its_guards_where_none_falls():
    """1 + sin falls nowhere, though it touches zero in every turn; 0.999 + sin does."""
    steps = [(Op.NEG, [0]), (Op.CONST, Fraction(1)), (Op.ADD, [0, 4])]
    program = written(symbols(2, 0), steps, [1, 3, 5])
    assert followed(program, (0.0, 1.0), goal=50.0).status is Status.GOAL
    steps[1] = (Op.CONST, Fraction(999, 1000))
    last = followed(written(symbols(2, 0), steps, [1, 3, 5]), (0.0, 1.0), goal=50.0)
    assert last.status is Status.FALL
    assert last.end[0] == pytest.approx(math.pi + math.asin(0.999), abs=1e-12)


@pytest.mark.parametrize("height", [1.0, 1e-6, 1e6])
def test_a_ball_that_falls(height):
    """h − g t²/2: the polynomial takes one long step, and its root has many digits."""
    steps = [(Op.CONST, Fraction(-981, 100))]
    program = written(symbols(2, 0), steps, [1, 3, 0])
    last = followed(program, (height, 0.0), goal=1e6)
    assert last.status is Status.FALL
    assert last.end[0] == pytest.approx(math.sqrt(2 * height / 9.81), rel=1e-9)


@pytest.mark.parametrize("start", [0.0, 0.5])
def test_a_guard_without_a_finite_value_breaks_the_motion_off(start):
    """√(1 − x) has none beyond x = 1, and infinite derivatives there: no step goes past it."""
    steps = [(Op.CONST, 1), (Op.SUB, [2, 0]), (Op.SQRT, [3]), (Op.CONST, 2), (Op.ADD, [4, 5])]
    program = written(symbols(1, 0), steps, [2, 6])
    last = followed(program, (start,), goal=1 - start, longest=0.25)
    assert last.status is Status.GOAL
    beyond = followed(program, (1 + start,), goal=1.0)
    assert beyond.status is Status.BROKEN
    assert beyond.end == (0.0, 0.0)
    across = followed(program, (start,), goal=2.0, longest=0.25)
    assert across.status is Status.BROKEN
    assert across.end[0] == 1 - start

"""Expressions that are kept under names have the values of what they stand for."""

from fractions import Fraction

import pytest

import polhode as ph
from polhode.algebra import named, sin
from polhode.judge.states._numeric import number
from polhode.judge.states._sample_points import exact_point

x, y, z, w = ph.symbols("x y z w", positive=True)
theta = ph.coordinate("theta")
WRITTEN_OUT = x * y + y * z + z * w + w * x + x * sin(theta)


def test_a_part_has_the_value_of_what_it_stands_for():
    part = named(WRITTEN_OUT)
    assert part != WRITTEN_OUT or part.generators != WRITTEN_OUT.generators
    point = exact_point([part], part.symbols(), seed=3)
    assert point(part) == point(WRITTEN_OUT)
    values = point.floats()
    assert number(part, values) == pytest.approx(number(WRITTEN_OUT, values))
    assert theta.symbol in point.half_tangents
    assert isinstance(point(part).rational, Fraction)

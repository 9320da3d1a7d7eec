"""What bodies look like."""

import pytest

import polhode as ph
from polhode.view._shapes import source_of


def evaluated(number) -> float:
    return float(ph.compile_program([number], ()).function()()[0])


LAB = ph.Frame("N")


@pytest.mark.parametrize("sides", [(1.0, 1.0, 1.0), (0.2, 0.3, 0.2), (3.0, 2.0, 1.0)])
def test_a_box_is_drawn_as_one_whatever_its_moments(sides) -> None:
    """Of a cube, or of a box with two equal sides, the inertia is that of a ball or a cylinder."""
    box = ph.box("box", mass=1.0, sides=sides, axes=LAB)
    source = source_of(box.surface, box)
    shape = source.shape([evaluated(number) for number in source.numbers])
    assert (shape.kind, shape.size) == ("box", sides)
    assert (shape.axis, shape.across) == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))

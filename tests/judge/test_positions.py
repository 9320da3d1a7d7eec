"""Letters that a text introduces for the coordinates of a point.

A uniform rod of mass M and length 2L on a string of length l, θ and φ to the vertical: its centre
is at x = l sin θ + L sin φ, at the depth l cos θ + L cos φ.
"""

from functools import cache

import pytest

import polhode as ph
from polhode import Mark

TRUE, DOUBT, OPEN = Mark.TRUE, Mark.DOUBT, Mark.NOT_JUDGED


@cache
def rod_on_a_string() -> ph.Equations:
    M, L, l, g = ph.symbols("M L l g", positive=True)
    lab = ph.Frame("lab")
    string = lab.rotated(-ph.coordinate("theta"), "y")
    axes = lab.rotated(-ph.coordinate("phi"), "y")
    rod = ph.rod("rod", mass=M, length=2 * L, axes=axes, axis="z")
    hung = ph.Pivot(rod, at=axes["z"] * L, to=string["z"] * -l, along=string, name="string")
    plane = ph.Hinge(rod, axis="y", name="plane")
    return ph.derive(ph.System(hung, plane, ph.Gravity(g), name="rod on a string"))


@pytest.mark.parametrize(
    ("definition", "mark"),
    [
        (r"x = l\sin\theta + L\sin\phi", TRUE),
        (r"y = -l\cos\theta - L\cos\phi", TRUE),
        (r"y = l\cos\theta + L\cos\phi + 3 l", TRUE),  # downwards, from elsewhere
        (r"x_{\rm cm} = l\sin\theta + L\sin\phi", TRUE),
        (r"x = \frac{3}{5}(l\sin\theta + L\sin\phi) + \frac{4}{5}(l\cos\theta + L\cos\phi)", TRUE),
        (r"x = l\sin\theta + 2 L\sin\phi", OPEN),  # the free end, for all that is known
        (r"x_{\rm cm} = l\sin\theta + 2 L\sin\phi", DOUBT),
        (r"x_{\rm cm} = 2 l\sin\theta + 2 L\sin\phi", DOUBT),
        (r"y_C = -l\cos\theta + L\cos\phi", DOUBT),
        (r"x_{\rm cm} = l\theta + L\phi", OPEN),  # of small angles
        (r"y_{\rm cm} = \frac{1}{2} l\theta^2 + \frac{1}{2} L\phi^2", OPEN),
        (r"y_{\rm cm} = -\frac{1}{2} L\phi", DOUBT),  # of second order in truth
        (r"w = l\sin\theta + 2 L\sin\phi", OPEN),
    ],
)
def test_a_coordinate_of_the_centre_of_mass(definition, mark):
    (line,) = ph.review(f"${definition}$", rod_on_a_string(), format=".md").lines
    assert line.mark is mark


def test_it_is_defined_for_the_lines_after_it():
    text = r"""$$x_{\rm cm} = l\sin\theta + L\sin\phi, \quad y_{\rm cm} = -l\cos\theta - L\cos\phi$$
The kinetic energy is
$$T = \frac12 M(\dot x_{\rm cm}^2 + \dot y_{\rm cm}^2) + \frac16 M L^2\dot\phi^2$$"""
    marks = [line.mark for line in ph.review(text, rod_on_a_string(), format=".md").lines]
    assert marks == [TRUE, TRUE, TRUE]

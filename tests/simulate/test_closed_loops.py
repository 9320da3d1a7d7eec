"""Dead points, at which a linkage may go on in more than one way: one error wherever it happens."""

from math import pi

import pytest

import polhode as ph
from simulate.examples import declared_four_bar

m, g = ph.symbols("m g", positive=True)
lab = ph.Frame("lab")


def run_of(system, sizes, start, duration=3):
    return ph.simulate(system, dict(zip("abcdmg", sizes, strict=True)), start, duration)


@pytest.mark.parametrize(
    ("lengths", "rate"),
    [
        ((2, 1, 2, 1), 0),  # a parallelogram, which passed with its energy lost
        ((1, 2, 1, 2), 12),  # one whose coupler lines up with the frame
        ((3, 1, 2, 2), 20),  # as long: the shortest and the longest bar equal the other two
    ],
)
def test_a_linkage_that_folds_flat_is_not_followed(lengths, rate):
    start = {"alpha": -0.5, "alpha_dot": rate}
    with pytest.raises(ph.NumericError, match=r"a dead point (at|near) t = .* leave 2 degrees of"):
        run_of(declared_four_bar(), (*lengths, 1, 9.81), start)


def test_nor_does_it_start_there():
    with pytest.raises(
        ph.ConstraintError, match=r"a dead point at the start .* leave 2 degrees of"
    ):
        run_of(declared_four_bar(), (1, 2, 1, 2, 1, 9.81), {"alpha": 0, "beta": 0, "gamma": 0})


def test_a_crank_that_pulls_its_equal_rod_into_line():
    """With one loop equation its gradient vanishes: crank and rod may then turn as one."""
    crank, rod = (lab.rotated(angle, "y") for angle in ph.coordinates("alpha beta"))
    a, b = ph.symbols("a b", positive=True)
    first = ph.rod("crank", mass=m, length=a, axes=crank, axis="x", tag="c")
    second = ph.rod("rod", mass=m, length=b, axes=rod, axis="x", tag="r")
    system = ph.System(
        ph.Pivot(first, at=crank["x"] * (-a / 2), name="bearing"),
        ph.Pivot(second, at=rod["x"] * (-b / 2), to=first.point(crank["x"] * (a / 2)), name="pin"),
        ph.Pivot(second, at=rod["x"] * (b / 2), only="z", name="slide", force="N"),
        ph.Hinge(first, axis="y"),
        ph.Hinge(second, axis="y"),
    )
    with pytest.raises(ph.NumericError, match=r"a dead point (at|near) t = "):
        ph.simulate(system, {m: 1, a: 1, b: 1}, {"alpha": 1, "alpha_dot": 5}, 1)


def test_a_loop_is_closed_on_the_side_of_the_equations():
    """A cone that rolls about its apex: its rim could also lie on the plane from below."""
    r, h, J = ph.symbols("r h J", positive=True)
    phi, theta = ph.coordinates("phi theta")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    base = ph.Rim(r, "3", -h / 4)
    cone = ph.Body("cone", mass=m, inertia=(J, J, J), axes=axes, spin=ph.About("3"), surface=base)
    apex = ph.Pivot(cone, at=axes["3"] * (3 * h / 4), name="apex", force="A")
    system = ph.System(ph.Rolling(cone, on=ph.Plane(lab), name="base"), apex, ph.Gravity(g))
    run = ph.simulate(system, {m: 1, J: 1, r: 0.1, h: 0.4, g: 9.81}, {"phi_dot": 1}, 1)
    assert run.final["theta"] == pytest.approx(pi / 2 + 0.24497866312686414, rel=1e-14)

"""Dead points, at which a linkage may go on in more than one way: one error wherever it happens."""

from math import pi

import pytest

import polhode as ph

m, g = ph.symbols("m g", positive=True)
lab = ph.Frame("lab")
LENGTHS = ph.symbols("a b c", positive=True)
ANGLES = ph.coordinates("alpha beta gamma")
WIDTH = ph.symbol("d", positive=True)


def four_bar():
    """Input, coupler and output bar between two fixed pivots at a distance d."""
    u, v, w = bars = [
        ph.rod(name, mass=m, length=length, axes=lab.rotated(angle, "y"), axis="x", tag=name)
        for name, length, angle in zip("uvw", LENGTHS, ANGLES, strict=True)
    ]
    ends = [bar.axes["x"] * (length / 2) for bar, length in zip(bars, LENGTHS, strict=True)]
    return ph.System(
        ph.Pivot(u, at=-ends[0], name="first"),
        ph.Pivot(v, at=-ends[1], to=u.point(ends[0]), name="second"),
        ph.Pivot(w, at=-ends[2], to=lab["x"] * WIDTH, name="third"),
        ph.Pivot(v, at=ends[1], to=w.point(ends[2]), only="x z", name="fourth", force="H"),
        *(ph.Hinge(bar, axis="y") for bar in bars),
        ph.Gravity(g),
    )


def run_of(system, sizes, start, duration=3):
    return ph.simulate(
        system, dict(zip((*LENGTHS, WIDTH, m, g), sizes, strict=True)), start, duration
    )


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
        run_of(four_bar(), (*lengths, 1, 9.81), start)


def test_nor_does_it_start_there():
    with pytest.raises(
        ph.ConstraintError, match=r"a dead point at the start .* leave 2 degrees of"
    ):
        run_of(four_bar(), (1, 2, 1, 2, 1, 9.81), {"alpha": 0, "beta": 0, "gamma": 0})


def test_a_crank_that_pulls_its_equal_rod_into_line():
    """With one loop equation its gradient vanishes: crank and rod may then turn as one."""
    crank, rod = lab.rotated(ANGLES[0], "y"), lab.rotated(ANGLES[1], "y")
    a, b = LENGTHS[:2]
    first = ph.rod("crank", mass=m, length=a, axes=crank, axis="x", tag="c")
    second = ph.rod("rod", mass=m, length=b, axes=rod, axis="x", tag="r")
    system = ph.System(
        ph.Pivot(first, at=crank["x"] * (-a / 2), name="bearing"),
        ph.Pivot(second, at=rod["x"] * (-b / 2), to=first.point(crank["x"] * (a / 2)), name="pin"),
        ph.Pivot(second, at=rod["x"] * (b / 2), only="z", name="slide", force="N"),
        ph.Hinge(first, axis="y"),
        ph.Hinge(second, axis="y"),
    )
    with pytest.raises(ph.NumericError, match="a dead point (at|near) t = "):
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

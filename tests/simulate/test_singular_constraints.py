"""A linkage on a sphere, held by hinges alone: no closure tells where it folds flat."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve

import polhode as ph

lab = ph.Frame("lab")
m, J = ph.symbols("m J", positive=True)
crank, coupler, rocker = ph.coordinates("q r s")
ARCS = ph.symbols("alpha beta gamma")


def spherical_four_bar():
    """Crank, coupler and rocker, whose hinges all point to the origin; ARCS apart on the sphere."""

    def part(name, axes):
        return ph.Body(name, mass=m, inertia=(J, J, 2 * J), axes=axes, tag=name)

    first, second, third = ARCS
    a = part("a", lab.rotated(crank, "z"))
    b = part("b", a.axes.rotated(first, "x").rotated(coupler, "z"))
    c = part("c", b.axes.rotated(second, "x"))
    d = part("d", c.axes.rotated(rocker, "z"))
    e = part("e", d.axes.rotated(third, "x"))
    pivots = [ph.Pivot(body, name=f"at {body.name}", force="O") for body in (a, b, d)]
    hinges = [ph.Hinge(a, axis="z"), ph.Hinge(b, axis="z", to=a), ph.Hinge(d, axis="z", to=c)]
    welds = [
        ph.Weld(part, to=on.point(), name=f"weld {part.name}", force="R", torque="S")
        for part, on in ((c, b), (e, d))
    ]
    return ph.System(*pivots, *hinges, *welds, ph.Hinge(e, axis="z", name="ground", torque="G"))


def last_axis(angles, arcs):
    """The axis of the last hinge by products of rotation matrices."""
    total = np.eye(3)
    for angle, arc in zip(angles, arcs, strict=True):
        c, s, k, n = np.cos(angle), np.sin(angle), np.cos(arc), np.sin(arc)
        total = total @ [[c, -s * k, s * n], [s, c * k, -c * n], [0, n, k]]
    return total[:, 2]


def moved(arcs, frame_arc, begun):
    fixed = np.array([0, -np.sin(frame_arc), np.cos(frame_arc)])
    others = fsolve(
        lambda rest: (last_axis((begun, *rest), arcs) - fixed)[:2], (1.0, 1.0), xtol=1e-12
    )
    assert last_axis((begun, *others), arcs) == pytest.approx(fixed, abs=1e-13)
    start = {crank: begun, coupler: others[0], rocker: others[1], "q_dot": 1.0}
    numbers = dict(zip(ARCS, arcs, strict=True)) | {m: 1, J: 0.1}
    return ph.simulate(spherical_four_bar(), numbers, start, 6), fixed


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("begun", [1.0, 1.7])
def test_a_spherical_parallelogram_is_not_followed_through_the_position_where_it_folds(begun):
    with pytest.raises(ph.NumericError, match=r"a dead point near t = .* constraints leave 2 deg"):
        moved((0.5, 1.0, 0.5), 1.0, begun)


def test_one_of_other_arcs_keeps_its_last_hinge_in_place_all_round():
    arcs = (0.5, 1.0, 0.9)
    run, fixed = moved(arcs, 1.1, 1.0)
    assert run.drift.energy < 1e-12
    assert run["q"][-1] > run["q"][0] + 0.8 * 2 * pi
    for angles in zip(run["q"], run["r"], run["s"], strict=True):
        assert last_axis(angles, arcs) == pytest.approx(fixed, abs=1e-11)


def test_a_crank_that_turns_a_bar_through_a_massless_ring_meets_no_dead_point():
    """The bar points from the post to the pin: its rate is a known multiple of the crank's."""
    a, r, length, inertia = ph.symbols("a r l I", positive=True)
    axes = lab.rotated(crank, "z")
    wheel = ph.Body("crank", mass=m, inertia=(inertia,) * 3, axes=axes, tag="c")
    bar = ph.rod("bar", mass=m, length=length, axes=lab.rotated(rocker, "z"), tag="b")
    ring = ph.Body("ring", mass=0, axes=bar.axes, tag="r")
    system = ph.System(
        ph.Pivot(wheel, name="axle"),
        ph.Hinge(wheel, axis="z"),
        ph.Pivot(bar, at=bar.axes["x"] * (-length / 2), to=lab["x"] * -a, name="post", force="P"),
        ph.Hinge(bar, axis="z"),
        ph.Slider(ring, axis="x", to=bar.point(), force="S", torque="T"),
        ph.Pivot(ring, to=wheel.point(axes["x"] * r), name="pin", force="Q"),
    )
    numbers = {m: 1.5, length: 3, inertia: 0.1, r: 1, a: 0.4}
    run = ph.simulate(system, numbers, {crank: 0.5, "q_dot": 6}, 2)

    def ratio(angle):
        return (1 + 0.4 * np.cos(angle)) / (1.16 + 0.8 * np.cos(angle))

    # the energy (I + m l² ratio²/3) θ̇²/2 is all there is
    energy = (0.1 + 4.5 * ratio(0.5) ** 2) * 36
    assert run.final["q_dot"] ** 2 * (0.1 + 4.5 * ratio(run.final["q"]) ** 2) == pytest.approx(
        energy, rel=1e-11
    )
    time = quad(lambda q: np.sqrt((0.1 + 4.5 * ratio(q) ** 2) / energy), 0.5, run.final["q"])[0]
    assert time == pytest.approx(2, rel=1e-9)

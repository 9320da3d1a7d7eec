"""A body that comes down to its support with more than its point of contact: where its motion ends.

The energy of a rod that falls on a smooth floor gives its rate: m l²/12 ω²/2 + m v²/2 = m g h, with
v = l ω sin θ/2. In free fall h = g t²/2, whatever the duration of the run.
"""

from dataclasses import dataclass
from math import cos, pi, sqrt

import pytest
from scipy.integrate import quad

import polhode as ph
from polhode.simulate.contact import _hybrid_integrator

m, l, r, J, g, mu = ph.symbols("m l r J g mu", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")
floor = ph.Plane(lab)


@dataclass(frozen=True)
class Foot(ph.Surface):
    """The lower end of a rod along z."""

    half: ph.Expr

    def lowest(self, axes, normal):
        return axes["z"] * -self.half

    def is_symmetric(self, axes, axis):
        return False


def falling_rod():
    axes = lab.rotated(theta, "y")
    rod = ph.rod("rod", mass=m, length=l, axes=axes, axis="z", surface=Foot(l / 2))
    return ph.System(ph.Smooth(rod, on=floor), ph.Hinge(rod, axis="y"), ph.Gravity(g))


def test_a_rod_on_a_smooth_floor_falls_flat_and_not_through_it():
    begin, gravity = 0.1, 9.81
    run = ph.simulate(falling_rod(), {m: 1, l: 1, g: gravity}, {theta: begin}, 3)

    def pace(angle):  # dt/dθ
        lost = 2 * gravity * (cos(begin) - cos(angle)) / 2
        return sqrt((1 / 12 + (1 - cos(angle) ** 2) / 4) / lost)

    # θ = begin + s² takes the pole out of the integrand at the start
    time, _ = quad(lambda s: 2 * s * pace(begin + s * s), 0, sqrt(pi / 2 - begin), epsabs=1e-13)
    assert [event.kind for event in run.events] == ["start", "goes flat", "end"]
    assert run.final["theta"] == pytest.approx(pi / 2, abs=1e-14)
    assert run.events[1].time == pytest.approx(time, abs=1e-12)


def test_equations_of_one_contact_mode_are_not_followed_below_the_floor():
    equations = ph.derive(falling_rod())
    with pytest.raises(ph.NumericError, match=r"cos\(theta\)/2 reaches zero at t = 0.58"):
        ph.simulate(equations, {m: 1, l: 1, g: 9.81}, {theta: 0.1}, 1)


def test_a_body_balanced_on_a_post_may_hang_below_it():
    axes = lab.rotated(theta, "y")
    bird = ph.Body("bird", mass=m, inertia=(J, J, J), axes=axes, surface=ph.Round(r, "z", l))
    parts = (ph.Coulomb(bird, on=floor, mu=0.5), ph.Hinge(bird, axis="y"), ph.Gravity(g))
    run = ph.simulate(ph.System(*parts), {m: 1, J: 0.01, r: 1e-3, l: 0.1, g: 9.81}, {theta: 0.3}, 5)
    assert run.duration == 5
    assert run["theta"].min() < -0.29


@pytest.mark.parametrize("start", [{"theta": 1.2}, {"theta": 0.5, "z": 2, "theta_dot": 3}])
def test_a_cylinder_is_not_followed_beyond_its_side(start):
    """Its upper edge is the lower one there."""
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    can = ph.cylinder("can", mass=m, radius=r, height=l, axes=axes)
    system = ph.System(ph.Coulomb(can, on=floor, mu=0.9), ph.Gravity(g))
    run = ph.simulate(system, {m: 1, r: 0.3, l: 0.5, g: 9.81}, start, 3)
    assert run.events[-2].kind == "goes flat"
    assert run.final["theta"] == pytest.approx(pi / 2, abs=2e-3)


def test_a_cylinder_that_always_lies_on_its_side_rolls_straight():
    can = ph.cylinder("can", mass=m, radius=r, height=l, axes=lab, axis="x")
    rolling = ph.derive(ph.System(ph.Rolling(can, on=floor, name="floor"), ph.Gravity(g)))
    assert rolling.reactions["floor"].couple.is_zero  # the support's is applied below the centre
    axes = lab.rotated(phi, "z").rotated(ph.pi / 2, "x", labels="1 2 3")
    with pytest.raises(ph.DeclarationError, match="turns about the normal"):
        ph.derive(
            ph.System(
                ph.Rolling(ph.cylinder("can", mass=m, radius=r, height=l, axes=axes), on=floor)
            )
        )


@pytest.mark.parametrize("duration", [1, 1e4, 1e9])
def test_a_landing_does_not_depend_on_how_long_the_run_lasts(duration):
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    system = ph.System(ph.Coulomb(ball, on=floor, mu=mu, restitution=0.5), ph.Gravity(g))
    numbers = {m: 1, r: 0.1, g: 9.81, mu: 0.3}
    run = ph.simulate(system, numbers, {"z": 0.11, "v_x": 1}, duration)
    first = sqrt(2 * 0.01 / 9.81)
    bounces = [event.time for event in run.events if event.kind == "bounces"]
    assert bounces[:3] == pytest.approx([first, 2 * first, 2.5 * first], rel=1e-14)
    assert run.final["v_x"] == pytest.approx(5 / 7, rel=1e-14)


@pytest.mark.parametrize("duration", [1, 1e9])
def test_a_free_fall_is_as_accurate_at_its_beginning_however_long_it_lasts(duration):
    stone = ph.point_mass("stone", mass=m, axes=lab)
    z = ph.coordinate("z")
    fall = ph.System(stone, ph.Gravity(g))
    run = ph.simulate(fall, {m: 1, g: 9.81}, {z: 0.01}, duration, events={"ground": z})
    (ground,) = (event.time for event in run.events if event.kind == "ground")
    assert ground == pytest.approx(sqrt(0.02 / 9.81), rel=1e-13)


def test_a_ball_that_bounces_for_ever_is_refused_early(monkeypatch):
    monkeypatch.setattr(_hybrid_integrator, "_EXTRAPOLATED_AT", 100)
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    system = ph.System(ph.Smooth(ball, on=floor, restitution=1), ph.Gravity(g))
    with pytest.raises(ph.NumericError, match="changes 100 times"):
        ph.simulate(system, {m: 1, r: 0.1, g: 9.81}, {"z": 0.1001}, 1e6)

"""A length d, or an angle δ, before another letter: a factor unless there are differentials."""

import pytest

import polhode as ph
from polhode.judge import Answer

m, d, g = ph.symbols("m d g", positive=True)
theta, delta = ph.coordinates("theta delta")
lab = ph.Frame("lab")


def swinging(angle, length):
    bob = ph.point_mass("bob", mass=m, axes=lab.rotated(angle, "y"))
    return ph.System(ph.Pivot(bob, at=bob.axes["z"] * length), ph.Gravity(g), name="pendulum")


@pytest.fixture(scope="module")
def equations():
    return ph.derive(swinging(theta, d))


@pytest.mark.parametrize(
    "latex",
    [
        r"d \ddot\theta + g \sin\theta = 0",
        r"m d g \sin\theta + m d^2 \ddot\theta = 0",
        r"d \dot\theta^2 = \frac{2 E}{m d} + 2 g \cos\theta",
        r"m d\,\frac{d\dot\theta}{dt} = -m g \sin\theta",
        r"\frac{d}{g} \ddot\theta = -\sin\theta",
        "d θ̈ + g sinθ = 0",
    ],
)
def test_it_is_a_factor(latex, equations):
    assert ph.check(latex, equations).holds
    wrong = ph.check(latex.replace("g", "3 g", 1).replace("2 3 g", "3 g"), equations)
    assert wrong.answer is Answer.FAILS


@pytest.mark.parametrize(
    "latex",
    [
        r"dV = m g d \sin\theta\, d\theta",
        r"d\theta/dt = \dot\theta",
        r"dE = 0",
        r"\frac{dE}{dt} = 0",
        r"d\theta = \dot\theta\, dt",
    ],
)
def test_differentials_stay_what_they_are(latex, equations):
    assert ph.check(latex, equations).holds


def test_without_a_length_d_it_has_no_meaning():
    (l,) = ph.symbols("l", positive=True)
    found = ph.check(r"d \ddot\theta + g \sin\theta = 0", ph.derive(swinging(theta, l)))
    assert found.answer is Answer.UNREAD


def test_an_angle_called_delta():
    equations = ph.derive(swinging(delta, d))
    assert ph.check(r"d \ddot\delta + g \delta \approx 0", equations, small=["delta:1"]).holds
    assert ph.check(r"T = \frac12 m d^2 \dot\delta^2", equations).holds
    assert ph.check(r"\delta m = m \delta", equations).holds


def test_solutions_are_written_with_it():
    for route in ("newton", "lagrange"):
        found = ph.solution(swinging(theta, d), route)
        assert any(r"d \ddot{\theta}" in step.latex for step in found.steps)

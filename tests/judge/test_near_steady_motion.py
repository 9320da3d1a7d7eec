"""Small oscillations about a motion that is itself steady: θ = θ₀ + ε on a conical pendulum.

With L_z = ml² sin²θ φ̇ fixed, ω² is that of U = L_z²/(2ml² sin²θ) - mgl cos θ: Landau and Lifshitz,
Mechanics, § 14, problem 1. A bead on a rod that turns at Ω by itself has no such momentum.
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

TRUE, ERROR = ph.Mark.TRUE, ph.Mark.ERROR

TEXT = r"""For a circular orbit $\theta=\theta_0$,
\[ \dot\phi^2 = \frac{g}{l\cos\theta_0}. \]
Small oscillations about this orbit, $\theta = \theta_0+\epsilon$, obey
\[ \ddot\epsilon + \omega^2\epsilon = 0,\qquad \omega^2 = %s . \]
For small $\theta_0$, $\omega \approx %s$."""

RIGHT = r"\frac{g}{l}\,\frac{1+3\cos^2\theta_0}{\cos\theta_0}"


@cache
def pendulum() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    theta, phi = ph.coordinates("theta phi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(-theta, "y", labels="1 2 3")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    string = ph.Pivot(bob, at=axes["3"] * l, name="string", force="T")
    return ph.derive(ph.System(string, ph.Gravity(g), name="spherical pendulum"))


def lines(text: str) -> list[ph.ReviewedLine]:
    found = ph.review(text, pendulum(), format=".tex", seconds=0.0).lines
    return [line for line in found if blamed(line) is not ph.Mark.NOT_JUDGED]


def test_the_frequency_about_a_conical_motion_is_true():
    found = lines(TEXT % (RIGHT, r"2\sqrt{g/l}"))
    assert [blamed(line) for line in found] == [TRUE] * 5
    assert found[2].context == "limit"


@pytest.mark.parametrize(
    ("square", "place"),
    [
        (RIGHT.replace("3", "2"), 3),
        (RIGHT.replace("1+", "1-"), 3),
        (r"\frac{g}{l}\,\frac{1+3\sin^2\theta_0}{\cos\theta_0}", 3),
        (r"\frac{g}{l}", 3),
    ],
)
def test_another_frequency_is_an_error(square, place):
    assert lines(TEXT % (square, r"2\sqrt{g/l}"))[place].mark is ph.Mark.DOUBT


@pytest.mark.parametrize("value", [r"\sqrt{3}\sqrt{g/l}", r"\sqrt{g/l}"])
def test_a_wrong_limit_of_it_is_an_error(value):
    assert lines(TEXT % (RIGHT, value))[-1].mark is ph.Mark.DOUBT


def test_what_is_called_small_further_down_is_not_small_before():
    """That θ₀ is small is said of the last line alone."""
    text = (TEXT % (RIGHT, r"2\sqrt{g/l}")).replace(
        r"\frac{g}{l\cos\theta_0}", r"\frac{g}{l}(1 + \theta_0^2/2)"
    )
    assert blamed(lines(text)[1]) is ERROR


def test_a_tension_without_bars_needs_a_taut_string():
    said = r"The tension is $|\mathbf T| = %s$."
    size = r"mg\cos\theta + ml(\dot\theta^2+\sin^2\theta\,\dot\phi^2)"
    (line,) = lines(said % size)
    assert blamed(line) is ph.Mark.NEEDS
    assert line.needs == r"l \dot{\theta}^2 + l \dot{\phi}^2 \sin^2\theta + g \cos\theta > 0"
    (wrong,) = lines(said % size.replace(r"\dot\theta^2+", r"\dot\theta^2-"))
    assert blamed(wrong) is ERROR


# A bead on a hoop that turns at Ω, θ from the bottom: ω² = Ω² sin²θ₀ where g = aΩ² cos θ₀ (Taylor,
# Classical Mechanics, § 7.6), and θ₀ may lie on either side.
BEAD = r"""For $\Omega^2 > g/a$ the bead oscillates about $\cos\theta_0 = g/(a\Omega^2)$ with
frequency $\omega = \Omega%s\theta_0 = \sqrt{\Omega^2 - g^2/(a^2\Omega^2)}$."""


@pytest.mark.parametrize(("function", "mark"), [(r"\sin", ph.Mark.NEEDS), (r"\cos", ERROR)])
def test_a_root_needs_the_sign_of_what_is_printed_for_it(function, mark):
    system = Path(__file__).parents[2] / "docs/examples/solutions/bead_on_hoop.py"
    equations = ph.derive(runpy.run_path(str(system))["bead_on_hoop"])
    *before, line = ph.review(BEAD % function, equations, format=".tex", seconds=0.0).lines
    assert {blamed(each) for each in before} == {TRUE}
    assert blamed(line) is mark
    assert line.needs == (r"\sin\theta > 0" if mark is ph.Mark.NEEDS else "")


@pytest.mark.parametrize(("value", "mark"), [("", TRUE), ("2", ph.Mark.NOT_JUDGED)])
def test_fast_spin_makes_the_reciprocal_of_the_one_spin_small(value, mark):
    text = rf"""Steady precession. For fast spin the slow precession is
    $\dot\phi \approx \frac{{Mga}}{{{value}I_1\omega_1}}$."""
    (line,) = ph.review(text, ph.derive(PROBLEM_SET["gyroscope"].build()), seconds=0.0).lines
    assert blamed(line) is mark


@cache
def planet_and_car() -> ph.Equations:
    """A planet in polar coordinates, and a car of which x could be the place."""
    m, k, M = ph.symbols("m k M", positive=True)
    r, phi = ph.coordinates("r phi")
    lab = ph.Frame("lab")
    planet = ph.point_mass("planet", mass=m, axes=lab)
    arm = ph.Pivot(planet, to=lab.rotated(phi, "z", labels="r f z")["r"] * r, name="arm")
    car = ph.Pivot(ph.point_mass("car", mass=M, axes=lab, tag="c"), only="y z", name="rail")
    attraction = ph.Potential(-k / r, on=planet)
    return ph.derive(ph.System(arm, car, attraction, name="planet and car"))


@pytest.mark.parametrize(("sign", "mark"), [("+", TRUE), ("-", ERROR)])
def test_x_beside_a_radius_and_its_value_is_a_departure(sign, mark):
    text = rf"""A circular orbit of radius $r_0$ has $\dot\phi^2=\frac{{k}}{{mr_0^3}}$.
    For a small disturbance $r=r_0+x$: $\ddot x {sign} \frac{{k}}{{mr_0^3}}x=0$."""
    found = ph.review(text, planet_and_car(), seconds=0.0).lines
    assert [blamed(line) for line in found] == [TRUE, ph.Mark.NOT_JUDGED, mark]

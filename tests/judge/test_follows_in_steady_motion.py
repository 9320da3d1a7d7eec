"""What a wrong equation says of steady motion and of small departures: later lines follow from it.

Each text has one slip, carried on by hand: Landau and Lifshitz, Mechanics, § 14, problem 1 (the
conical pendulum with the sign of V turned round), § 21 (oscillations about an equilibrium), § 37
(Euler's equations linearised). A further slip in the line that follows is an error of its own.
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

EXAMPLES = Path(__file__).parents[2] / "docs/examples"
TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS

CONICAL = r"""The Lagrangian is
$$L = \frac12 ml^2(\dot\theta^2 + \dot\phi^2\sin^2\theta) - mgl\cos\theta .$$
Since $\phi$ is cyclic, $p_\phi = ml^2\dot\phi\sin^2\theta$ is conserved. The energy is
$$E = \frac12 ml^2\dot\theta^2 + V_{\rm eff}, \qquad
V_{\rm eff} = \frac{p_\phi^2}{2ml^2\sin^2\theta} - mgl\cos\theta .$$
The equation of motion is
$$ml^2\ddot\theta = \frac{p_\phi^2\cos\theta}{ml^2\sin^3\theta} - mgl\sin\theta .$$
Conical motion at $\theta=\theta_0$ requires $\dot\phi^2 = \frac{%s}{l\cos\theta_0}$.
For small oscillations about it, $\theta = \theta_0 + \epsilon$,
$$\ddot\epsilon + \frac gl\,\frac{1+%s\cos^2\theta_0}{\cos\theta_0}\,\epsilon = 0.$$
"""
HOOP = r"""Along the hoop
$$a\ddot\theta = a\Omega^2\sin\theta\cos\theta %s g\sin\theta .$$
Equilibrium: $\sin\theta=0$ or $\cos\theta = %s$.
Write $\theta=\theta_0+\eta$ with small $\eta$. Then $\ddot\eta = %s\sin^2\theta_0\,\eta$."""
RACQUET = r"""$I_1\dot\omega_1 = (I_2-I_3)\omega_2\omega_3$,
$I_2\dot\omega_2 = (I_3-I_1)\omega_3\omega_1$, $I_3\dot\omega_3 = (I_2-I_1)\omega_1\omega_2$.
Let $\omega_1,\omega_3$ be small, and $\omega_2 = \Omega$ constant. Then
$\ddot\omega_1 = %s\frac{(I_2-I_3)(I_2-I_1)}{I_1I_3}\Omega^2\omega_1$."""
BOWL = r"""The ball rolls in the plane $\dot\phi = 0$.
With $V = %s mg(R-a)\cos\theta$,
$$\frac75(R-a)\ddot\theta = %s g\sin\theta .$$
Near the bottom, $\theta = %s\epsilon$, $\ddot\epsilon + \frac{%s g}{7(R-a)}\epsilon = 0$."""
SMALL = r"For small $\theta$, $(I_2+ml^2)\ddot\theta = -mgl\theta %s$."
FAST = r"Slow precession of a fast top: $\dot\phi \approx \frac{%s \mu g l}{I_3\omega_3}$."


@cache
def system(name: str) -> ph.Equations:
    if name == "tennis-racquet":
        return ph.derive(PROBLEM_SET[name].build())
    file = EXAMPLES / ("top.py" if name == "top" else f"solutions/{name}.py")
    return ph.derive(runpy.run_path(str(file))[name])


def marks(text: str, name: str) -> list[ph.Mark]:
    found = ph.review(text, system(name), seconds=0.0).lines
    return [blamed(line) for line in found if blamed(line) is not ph.Mark.NOT_JUDGED]


@pytest.mark.parametrize(
    ("speed", "factor", "expected"),
    [
        ("g", "3", [FOLLOWS, FOLLOWS]),
        ("2g", "3", [ERROR, FOLLOWS]),
        ("g", "2", [FOLLOWS, ERROR]),
    ],
)
def test_a_wrong_effective_potential_is_carried_on(speed, factor, expected):
    found = marks(CONICAL % (speed, factor), "spherical_pendulum")
    assert found == [TRUE, TRUE, TRUE, ERROR, FOLLOWS, TRUE, *expected]


@pytest.mark.parametrize(
    ("sign", "place", "slope", "expected"),
    [
        ("-", r"\frac g{a\Omega^2}", r"-\Omega^2", [TRUE, TRUE, TRUE, TRUE]),
        ("-", r"\frac g{a\Omega^2}", r"\Omega^2", [TRUE, TRUE, TRUE, ERROR]),
        ("+", r"-\frac g{a\Omega^2}", r"-\Omega^2", [ERROR, TRUE, FOLLOWS, TRUE]),
        ("+ 2", r"-\frac{2g}{a\Omega^2}", r"-\Omega^2", [ERROR, TRUE, FOLLOWS, TRUE]),
    ],
)
def test_zeros_of_a_wrong_equation_are_its_equilibria(sign, place, slope, expected):
    assert marks(HOOP % (sign, place, slope), "bead_on_hoop") == expected


@pytest.mark.parametrize(("factor", "mark"), [("", FOLLOWS), ("2", ERROR), ("-", TRUE)])
def test_a_wrong_equation_of_euler_is_linearised(factor, mark):
    *before, last = marks(RACQUET % factor, "tennis-racquet")
    assert before == [TRUE, TRUE, ERROR]
    assert last is mark or (factor == "-" and last is ph.Mark.UNLINKED)


@pytest.mark.parametrize(
    ("signs", "offset", "factor", "expected"),
    [
        (("-", "-"), "", "5", [TRUE, TRUE, TRUE]),
        (("-", "-"), "", "10", [TRUE, TRUE, ERROR]),
        (("", ""), r"\pi + ", "5", [ERROR, FOLLOWS, FOLLOWS]),
        (("", ""), r"\pi + ", "10", [ERROR, FOLLOWS, ERROR]),
    ],
)
def test_near_the_bottom_of_a_bowl(signs, offset, factor, expected):
    assert marks(BOWL % (*signs, offset, factor), "ball_in_bowl") == expected


@pytest.mark.parametrize(
    ("term", "mark"),
    [
        ("", TRUE),
        (r"+ \frac16 mgl\theta^3", TRUE),
        (r"- \frac16 mgl\theta^3", ERROR),
        ("- mgl", ERROR),
    ],
)
def test_what_a_sentence_calls_small_makes_an_equation_one_to_its_order(term, mark):
    assert marks(SMALL % term, "physical_pendulum") == [mark]


@pytest.mark.parametrize(("factor", "expected"), [("", [TRUE]), ("2", [ERROR])])
def test_the_spin_of_a_fast_top_need_not_be_among_its_speeds(factor, expected):
    found = marks(FAST % factor, "top")
    assert found == expected or (factor and TRUE not in found)

"""Letters without the tag of a body: the x of a cart, the I of a pulley, the T of its rope."""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from model.transmissions import atwood
from polhode.judge import Answer

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS


@cache
def cart() -> ph.Equations:
    """A cart on a level rail that carries a pendulum: Kibble and Berkshire, Mechanics, ch. 11."""
    M, m, l, g = ph.symbols("M m l g", positive=True)
    lab = ph.Frame("lab")
    body = ph.point_mass("cart", mass=M, axes=lab, tag="c")
    turned = lab.rotated(-ph.coordinate("theta"), "y", labels="1 2 3")
    bob = ph.point_mass("bob", mass=m, axes=turned, tag="b")
    rod = ph.Pivot(bob, at=turned["3"] * l, to=body.point(), name="rod", force="T")
    rail = ph.Pivot(body, only="y z", name="rail", force="N")
    return ph.derive(ph.System(rail, rod, ph.Gravity(g), name="cart and pendulum"))


@cache
def pulley() -> ph.Equations:
    return ph.derive(atwood())


def marks(text: str, equations: ph.Equations) -> list[ph.Mark]:
    found = ph.review(text, equations, format=".tex", seconds=0.0).lines
    return [blamed(line) for line in found if blamed(line) is not ph.Mark.NOT_JUDGED]


CART = r"""Let $x$ be the position of the cart. Then
\[ T = \tfrac12 (M+m)\dot x^2 + ml\dot x\dot\theta\cos\theta + \tfrac12 ml^2\dot\theta^2 . \]
The momentum $p_x = (M+m)\dot x + ml\dot\theta\cos\theta$ is conserved, and
$l\ddot\theta + \ddot x\cos\theta + g\sin\theta = 0$.
For small oscillations \[ \ddot\theta = -\frac{(M+m)g}{%s l}\theta, \]
so that their frequency is $\omega = \sqrt{\frac{(M+m)g}{%s l}}$
and their period $\tau = %s\pi\sqrt{\frac{%s l}{(M+m)g}}$."""


def test_a_coordinate_goes_by_its_letter_where_one_body_has_it():
    assert marks(CART % ("M", "M", "2", "M"), cart()) == [TRUE] * 6


@pytest.mark.parametrize(("number", "mark"), [("2", FOLLOWS), ("3", ERROR)])
def test_frequency_and_period_follow_from_a_wrong_linear_equation(number, mark):
    found = marks(CART % ("m", "m", number, "m"), cart())
    assert found == [TRUE, TRUE, TRUE, ERROR, FOLLOWS, mark]


# A pulley of moment J with masses on both sides; a is that of mass 2, downwards.
ATWOOD = r"""\[ m_2 g - T_2 = m_2 a, \qquad T_1 - m_1 g = m_1 a,
\qquad (T_2 - T_1)R = I\frac aR . \]
\[ a = \frac{(m_2-m_1)g}{m_1+m_2+%s} \]
For $J = 0$ both tensions are $T = \frac{2m_1m_2g}{m_1+m_2}$."""


@pytest.mark.parametrize(("term", "mark"), [("I/R^2", TRUE), ("2I/R^2", ERROR)])
def test_a_pulley_has_a_moment_of_inertia_and_its_rope_a_tension(term, mark):
    assert marks(ATWOOD % term, pulley()) == [TRUE, TRUE, TRUE, mark, TRUE]


def test_the_tension_of_one_of_two_ropes_is_ambiguous():
    verdict = ph.check("T = m_1(R\\ddot\\alpha + g)", pulley())
    assert verdict.answer is Answer.AMBIGUOUS
    assert ph.check("T = m_1 g", pulley()).answer is Answer.FAILS


# What the text says of a momentum at rest is an assumption; any factor of a rate is right there.
AT_REST = r"""Let $P = (M+m)\dot x + ml\dot\theta\cos\theta$. If the system is at rest, $P = 0$ and
$E = \frac12(M+m)\dot x^2 + %s ml\dot x\dot\theta\cos\theta + \frac12ml^2\dot\theta^2
- mgl\cos\theta$. It started from rest, hence \[ (M+m)\dot x = -%s ml\dot\theta\cos\theta . \]"""


@pytest.mark.parametrize(
    ("factors", "expected"),
    [(("", ""), [TRUE, TRUE]), (("7", ""), [ERROR, TRUE]), (("", "2"), [TRUE, ERROR])],
)
def test_a_system_at_rest_has_no_momentum_but_rates_keep_their_factors(factors, expected):
    assert marks(AT_REST % factors, cart()) == expected

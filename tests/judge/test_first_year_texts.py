r"""Texts of first-year courses: KE and PE, sums of forces, E_i = E_f, parts that refer to (a).

A rod of length l on its end: \ddot\theta = -3g sin θ/2l, and ½ (ml²/3) ω² = mgl cos θ/2 from rest
at a right angle (Young and Freedman, University Physics, ch. 10).
"""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed
from polhode.catalogue import PROBLEM_SET

MARKS = {"T": "true", "E": "error", "F": "follows", "!": "needs", "-": "not-judged"}


@cache
def rod() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    body = ph.rod("rod", mass=m, length=l, axes=axes, axis="z")
    pivot = ph.Pivot(body, at=axes["z"] * (l / 2), name="pivot")
    return ph.derive(ph.System(pivot, ph.Hinge(body, axis="y"), ph.Gravity(g), name="rod"))


@cache
def disk() -> ph.Equations:
    return ph.derive(PROBLEM_SET["rolling-disk"].build())


def marks(text: str, equations: ph.Equations) -> str:
    signs = {mark: sign for sign, mark in MARKS.items()}
    lines = ph.review(text, equations, format=".md", seconds=0.0).lines
    return " ".join(signs[blamed(line).value] for line in lines)


SWING = r"""
(a) The moment of inertia about the end is $I = I_{cm} + m(l/2)^2 = \frac13 ml^2$.

(b) The only force with a torque about the pivot is gravity, so $\sum\tau = %s\frac l2\sin\theta =
I\alpha$. For small angles $\ddot\theta \approx -\frac{3g}{2l}\theta$.

(c) Conservation of energy from rest at $\theta = 90^\circ$: $KE_i + PE_i = KE_f %s PE_f$ gives
$$\tfrac12 I\omega^2 = %s mg\tfrac l2\cos\theta,$$
so at the bottom the speed of the tip is $v = l\omega = \sqrt{3gl}$.
"""


ROLLING = r"""The center of mass moves with $v_{CM}^2 = a^2(\omega_3^2+%s\dot\theta^2)$, so
$$KE_{trans} = \tfrac12 m v_{CM}^2 = \tfrac12 m a^2(\omega_3^2+%s\dot\theta^2).$$
The potential energy is $$PE = mga%s\theta,$$ and the total energy
$$E_{tot} = \frac{ma^2}{8}(6\omega_3^2+5\dot\theta^2+\dot\phi^2\sin^2\theta)+mga%s\theta.$$
Vertically, $\sum F_z = F_N %s mg = ma_z$."""


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        (("", "", r"\sin", r"\sin", "-"), "T T T T T"),
        (("", "", r"\cos", r"\cos", "-"), "T T E F T"),
        (("2", "2", r"\sin", r"\sin", "-"), "E F T T T"),
        (("", "", r"\sin", r"\sin", "+"), "T T T T E"),
    ],
)
def test_labelled_energies_are_no_definitions(pieces: tuple[str, ...], expected: str) -> None:
    assert marks(ROLLING % pieces, disk()) == expected


@cache
def cart() -> ph.Equations:
    M, m, l, g = ph.symbols("M m l g", positive=True)
    lab = ph.Frame("lab")
    body = ph.point_mass("cart", mass=M, axes=lab)
    turned = lab.rotated(-ph.coordinate("theta"), "y")
    bob = ph.point_mass("bob", mass=m, axes=turned, tag="b")
    rail = ph.Pivot(body, only="y z", name="rail", force="N")
    rod = ph.Pivot(bob, at=turned["z"] * l, to=body.point(), name="rod", force="T")
    return ph.derive(ph.System(rail, rod, ph.Gravity(g), name="cart"))


@pytest.mark.parametrize(("factor", "expected"), [("", "T T T"), ("2", "T T E")])
def test_a_limit_at_infinity(factor: str, expected: str) -> None:
    text = rf"""For small oscillations $\ddot\theta = -\frac{{(M+m)g}}{{Ml}}\theta$, so
    $\omega = \sqrt{{\frac{{(M+m)g}}{{Ml}}}}$.
    In the limit $M\to\infty$ this reduces to $\omega=\sqrt{{{factor}g/l}}$."""
    assert marks(text, cart()) == expected


@cache
def sphere() -> ph.Equations:
    m, R, g = ph.symbols("m R g", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))
    ball = ph.sphere("sphere", mass=m, radius=R, axes=slope.axes)
    return ph.derive(ph.System(ph.Rolling(ball, on=slope), ph.Gravity(g), name="sphere"))


DOWN = r"""A sphere of mass $m$ and radius $R$ rolls down an incline of angle $\alpha$.
Along the slope $\sum F_y = mg\sin\alpha - f = %s ma$. With $I_{CM} = \frac25 mR^2$ its energy is
$KE = \frac12 mv^2+\frac12 I_{CM}\omega^2 = \frac{%s}{10}mv^2$."""


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [(("", "7"), "T T !"), (("2", "7"), "E T !"), (("", "9"), "T T E")],
)
def test_what_rolls_down_a_slope_spins_about_no_other_axis(pieces, expected: str) -> None:
    assert marks(DOWN % pieces, sphere()) == expected

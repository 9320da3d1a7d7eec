r"""Texts of first-year courses: KE and PE, sums of forces, E_i = E_f, parts that refer to (a).

A rod of length l on its end: \ddot\theta = -3g sin θ/2l, and ½ (ml²/3) ω² = mgl cos θ/2 from rest
at a right angle (Young and Freedman, University Physics, ch. 10).
"""

from functools import cache

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE

MARKS = {"T": "true", "E": "first-error", "F": "follows", "!": "needs", "-": "not-judged"}


@cache
def rod() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y")
    body = ph.rod("rod", mass=m, length=l, axes=axes, axis="z")
    pivot = ph.Pivot(body, at=axes["z"] * (l / 2), name="pivot")
    return ph.derive(ph.System(pivot, ph.Hinge(body, axis="y"), ph.Gravity(g), name="rod"))


@cache
def disk() -> ph.Equations:
    return ph.derive(CATALOGUE["rolling-disk"].build())


def marks(text: str, equations: ph.Equations) -> str:
    signs = {mark: sign for sign, mark in MARKS.items()}
    lines = ph.review(text, equations, format=".md", seconds=0.0).lines
    return " ".join(signs[line.mark.value] for line in lines)


SWING = r"""
(a) The moment of inertia about the end is $I = I_{cm} + m(l/2)^2 = \frac13 ml^2$.

(b) The only force with a torque about the pivot is gravity, so $\sum\tau = %s\frac l2\sin\theta =
I\alpha$. For small angles $\ddot\theta \approx -\frac{3g}{2l}\theta$.

(c) Conservation of energy from rest at $\theta = 90^\circ$: $KE_i + PE_i = KE_f %s PE_f$ gives
$$\tfrac12 I\omega^2 = %s mg\tfrac l2\cos\theta,$$
so at the bottom the speed of the tip is $v = l\omega = \sqrt{3gl}$.
"""


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        (("-mg", "+", ""), "T T T - T T T"),
        (("mg", "+", ""), "T E T - T T T"),
        (("-mg", "+", "2"), "T T T - T E T"),
    ],
)
def test_a_rod_swings(pieces: tuple[str, str, str], expected: str) -> None:
    assert marks(SWING % pieces, rod()) == expected


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

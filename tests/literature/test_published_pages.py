"""Equations of pages that people learn from, judged, refuted and repaired in their own letters.

The rolling disc of SymPy's documentation, in angles q₁, q₂, q₃ about z, x, y. The page "A rolling
disc using Lagrange's Method" (as of commit 07941f60) puts the rolling condition, which cannot be
integrated, into the Lagrangian, and takes -m g r cos q₂ for the potential energy. So gravity has
the wrong sign in its second equation, and one term of the first and the third a wrong factor; see
H. Goldstein, C. Poole and J. Safko, Classical Mechanics, 3rd edition, § 2.4, on constraints that
may not be put into a Lagrangian. The formulas are restated here.

The rattleback is that of T. R. Kane and D. A. Levinson, Int. J. Non-Linear Mechanics 17 (1982) 175.
"""

from functools import cache

import pytest

import polhode as ph
from literature.test_rattleback import stone
from polhode.claims import Answer
from polhode.derive import Equations


@cache
def disc() -> Equations:
    q_1, q_2 = ph.coordinates("q_1 q_2")
    m, r, g = ph.symbols("m r g", positive=True)
    lab = ph.Frame("N")
    lean = lab.rotated(q_1, "z").rotated(q_2, "x")
    across = m * r**2 / 4
    body = ph.Body(
        "disc",
        mass=m,
        inertia=(across, 2 * across, across),
        axes=lean,
        spin=ph.About("y", "q_3"),
        rim=r,
    )
    return ph.derive(
        ph.System(ph.Rolling(body, on=ph.Plane(lab)), ph.Gravity(g), name="rolling disc")
    )


@cache
def rattleback() -> Equations:
    return ph.derive(stone())


#: What the page has, and what it should have.
LAGRANGE = {
    r"6\sin q_2\,\ddot q_3 + 5\sin(2q_2)\dot q_1\dot q_2 + 6\cos q_2\,\dot q_2\dot q_3"
    r" - \frac52\cos(2q_2)\ddot q_1 + \frac72\ddot q_1 = 0": r"2\cos q_2\,\dot q_2",
    r"\ddot q_2 = -\frac{4g\sin q_2}{5r} + \frac12\sin(2q_2)\dot q_1^2"
    r" + \frac65\cos q_2\,\dot q_1\dot q_3": r"= \frac{4g\sin q_2}{5r}",
    r"\sin q_2\,\ddot q_1 + \cos q_2\,\dot q_1\dot q_2 + \ddot q_3 = 0": r"\frac{5 \cos q_2",
}


@pytest.mark.parametrize("printed", LAGRANGE)
def test_the_disc_of_the_lagrangian_page_is_refuted_and_repaired(printed: str) -> None:
    verdict = ph.check(printed, disc())
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None
    assert verdict.confirmation is not None
    assert verdict.confirmation.agrees
    assert verdict.correction is not None
    assert LAGRANGE[printed] in verdict.correction.latex
    corrected = ph.check(verdict.correction.latex, disc())
    assert corrected.answer is Answer.HOLDS


@pytest.mark.parametrize(
    "true",
    [
        r"5r\ddot q_2 = 4g\sin q_2 + 5r\dot q_1^2\sin q_2\cos q_2 + 6r\dot q_1\dot q_3\cos q_2",
        r"\ddot q_1\cos q_2 + 2\dot q_2\dot q_3 = 0",
        r"v_x = r\cos q_1(\dot q_3 + \dot q_1\sin q_2) + r\dot q_2\sin q_1\cos q_2",
        r"\dot E = 0",
    ],
)
def test_true_equations_of_the_disc_hold(true: str) -> None:
    assert ph.check(true, disc()).answer is Answer.HOLDS


@pytest.mark.parametrize(
    "true",
    [
        r"\dot E = 0",
        r"\mathbf v_{\rm contact} = 0",
        r"m\dot{\mathbf v}_{\rm cm} = \mathbf F - mg\hat{\mathbf z}",
        r"\dot{\mathbf L} = \boldsymbol\tau",
    ],
)
def test_laws_of_the_rattleback_hold(true: str) -> None:
    verdict = ph.check(true, rattleback())
    assert verdict.answer is Answer.HOLDS
    assert verdict.error_bound is not None
    assert 0 < verdict.error_bound < 1e-20


def test_a_slip_about_the_rattleback_is_refuted_at_a_state_and_repaired() -> None:
    verdict = ph.check(r"m\dot{\mathbf v}_{\rm cm} = \mathbf F + mg\hat{\mathbf z}", rattleback())
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None
    assert verdict.confirmation is not None
    assert verdict.confirmation.agrees
    assert verdict.correction is not None
    assert verdict.correction.what == "wrong sign"

"""Equations of pages that people learn from, judged, refuted and repaired in their own letters.

The rolling disc of SymPy's documentation, in angles q₁, q₂, q₃ about z, x, y. The page "A rolling
disc using Lagrange's Method" (as of commit 07941f60) puts the rolling condition, which cannot be
integrated, into the Lagrangian, and takes -m g r cos q₂ for the potential energy. So gravity has
the wrong sign in its second equation, and one term of the first and the third a wrong factor; see
H. Goldstein, C. Poole and J. Safko, Classical Mechanics, 3rd edition, § 2.4, on constraints that
may not be put into a Lagrangian. The formulas are restated here.

The rattleback is that of T. R. Kane and D. A. Levinson, Int. J. Non-Linear Mechanics 17 (1982) 175.
PyDy's example of it (pydy/pydy, examples/rattleback/cpp/reproduceKane1982.cc, as of commit
d4e0616e) has v₂ for v₃ in the first term of ζ₁, which is that part of the acceleration of the
centre of mass along axis 1 that has no rate of a component of ω. With r = -x from the contact to
the centre of mass, v = ω × r and its acceleration is ω̇ × r + ω × (v - ẋ), so ζ = ω × (v - ẋ). The
centre of mass is taken at the centre of the ellipsoid (their h = 0), which ζ₁ does not contain.
"""

from functools import cache

import pytest

import polhode as ph
from literature.test_rattleback import stone
from polhode.derive import Equations
from polhode.judge import Answer


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


# -- the auxiliary quantity ζ of Kane and Levinson, in their letters ------------------------------


@cache
def kane_levinson() -> Equations:
    lab = ph.Frame("N")
    gamma, alpha, beta = ph.coordinates("gamma alpha beta")
    g, M, A, B, C, D = ph.symbols("g M A B C D")
    axes = lab.rotated(gamma, "z").rotated(alpha, "x").rotated(beta, "y", labels="1 2 3")
    body = ph.ellipsoid(
        "stone",
        mass=M,
        half_axes=ph.symbols("a b c", positive=True),
        axes=axes,
        inertia=((A, D, 0), (D, B, 0), (0, 0, C)),
    )
    return ph.derive(
        ph.System(ph.Rolling(body, on=ph.Plane(lab)), ph.Gravity(g), name="rattleback")
    )


DOWNWARD = [rf"\mu_{i} = -\hat{{\mathbf z}}\cdot\hat{{\mathbf {i}}}" for i in (1, 2, 3)]
TO_CONTACT = [
    rf"x_{i} = \frac{{{b}^2\mu_{i}}}{{\epsilon}}" for i, b in ((1, "a"), (2, "b"), (3, "c"))
]
AUXILIARY = [
    *DOWNWARD,
    r"\epsilon = \sqrt{a^2\mu_1^2 + b^2\mu_2^2 + c^2\mu_3^2}",
    *TO_CONTACT,
    r"\zeta_1 = \dot{\mathbf v}_{\rm cm}\cdot\hat{\mathbf 1} + \dot\omega_2 x_3 - \dot\omega_3 x_2",
]


@pytest.mark.parametrize(
    "true",
    [
        r"v_1 = \omega_3 x_2 - \omega_2 x_3",
        r"\zeta_1 = \omega_2(v_3 - \dot x_3) - \omega_3(v_2 - \dot x_2)",
    ],
)
def test_auxiliary_quantities_of_the_rattleback_hold(true: str) -> None:
    assert ph.check(true, kane_levinson(), let=AUXILIARY).answer is Answer.HOLDS


def test_the_slip_in_the_rattleback_of_pydy_is_refuted_and_repaired() -> None:
    printed = r"\zeta_1 = \omega_2(v_2 - \dot x_3) - \omega_3(v_2 - \dot x_2)"
    verdict = ph.check(printed, kane_levinson(), let=AUXILIARY)
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None
    assert verdict.correction is not None
    assert verdict.correction.what == "wrong index"
    assert verdict.correction.latex == printed.replace("v_2", "v_3", 1)
    assert verdict.alternatives == ()

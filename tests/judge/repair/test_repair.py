"""Corrections: every kind of slip is found, and the corrected claim is the original."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

import polhode as ph
from catalogue.systems import equations
from judge import textbook_systems
from polhode.catalogue import problem_set
from polhode.judge import Answer, Verdict, read_document
from polhode.judge._audit import ClaimChecker

ORIGINAL = (
    r"I_1\omega_1\dot\phi\sin\theta - I_{2p}\dot\phi^2\sin\theta\cos\theta + I_{2p}\ddot\theta"
    r" = Mga\sin\theta"
)


@cache
def verdict_on(latex: str) -> Verdict:
    gyroscope = equations("gyroscope")
    return ph.check(latex, gyroscope, let=[r"I_{2p} = I_2 + Ma^2"])


SLIPS = [
    (r"- I_{2p}\dot\phi^2", r"+ I_{2p}\dot\phi^2", "wrong sign"),
    (r"Mga\sin", r"2Mga\sin", "wrong factor"),
    (r"\dot\phi^2", r"\dot\phi^3", "wrong power"),
    (r"\sin\theta\cos\theta", r"\sin\theta\sin\theta", "sin where cos is right"),
    (r"- I_{2p}\dot\phi^2", r"- I_2\dot\phi^2", "wrong index"),
    (r"\ddot\theta", r"\dot\theta", "dot lost"),
    (r"= Mga", r"= ga", "missing factor"),
    (r"I_1\omega_1\dot\phi\sin\theta - ", r"- ", "missing term"),
]


def test_the_original_holds():
    assert verdict_on(ORIGINAL).answer is Answer.HOLDS


@pytest.mark.parametrize(("right", "wrong", "slip"), SLIPS)
def test_a_slip_is_named_and_corrected(right, wrong, slip):
    assert right in ORIGINAL
    verdict = verdict_on(ORIGINAL.replace(right, wrong, 1))
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    proposed = [verdict.correction, *verdict.alternatives]
    assert slip in {correction.what for correction in proposed}
    assert all(verdict_on(c.latex).answer is Answer.HOLDS for c in proposed)


def test_two_equal_slips_are_corrected_together():
    gyroscope = equations("gyroscope/vertical-plane")
    verdict = ph.check(
        r"\frac{d\mathbf v_{\rm cm}}{dt} = a(\ddot\theta\cos\theta - 2\dot\theta^2\sin\theta)"
        r"\hat{\boldsymbol\rho}"
        r" - a(\ddot\theta\sin\theta + 2\dot\theta^2\cos\theta)\hat{\mathbf z}",
        gyroscope,
    )
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    assert verdict.correction.what == "wrong factor"


@pytest.mark.parametrize(
    ("context", "latex", "what"),
    [
        ("threshold", r"\omega_1^2 > \frac{4MgaI_{2p}\cos\theta}{I_1}", "wrong power"),
        ("number", r"\frac{4I_{2p}}{I_2} = 2.0", "wrong factor"),
    ],
)
def test_claims_judged_as_a_whole_are_corrected(context, latex, what):
    gyroscope = equations("gyroscope")
    given = [] if context == "threshold" else ["I_2 = M*a**2"]
    let = [r"I_{2p} = I_2 + Ma^2"]
    verdict = ph.check(latex, gyroscope, context=context, let=let, given=given)
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    assert what in {c.what for c in (verdict.correction, *verdict.alternatives)}
    corrected = ph.check(verdict.correction.latex, gyroscope, context=context, let=let, given=given)
    assert corrected.answer is Answer.HOLDS


def test_a_dot_lost_throughout_is_one_slip():
    coin = equations("spinning-coin")
    verdict = ph.check(
        r"P_\psi = \frac{\partial \mathcal L}{\partial \psi}"
        r" = \frac{\partial T_{\rm rot}}{\partial \psi}",
        coin,
        context="identity",
    )
    assert verdict.correction is not None
    assert verdict.correction.what == "dot lost"


def _of_the_problem_set(name: str, formula: str | None = None) -> Verdict:
    document = read_document(problem_set())
    claim = document.claim(name)
    part = document.part_of(claim)
    said = claim if formula is None else replace(claim, latex=formula, read_as="")
    return ClaimChecker(equations).verdict(part, said, {})


def test_a_vector_is_corrected_component_by_component():
    verdict = _of_the_problem_set("118")
    assert verdict.correction is not None
    assert verdict.correction.what == "dot lost"
    assert verdict.correction.latex.count(r"\ddot{\phi}") == 2


def test_a_term_that_no_small_change_corrects_is_rewritten():
    verdict = _of_the_problem_set("67")
    assert verdict.correction is not None
    assert verdict.correction.what == "wrong expression"
    assert r"+ \cos \lambda \hat{\mathbf{2}}" in verdict.correction.latex


def test_a_quantity_that_a_restriction_makes_vanish_need_not_be_positive():
    verdict = _of_the_problem_set("w61", r"\omega_p = 2Mga/I_1\omega_1")
    assert verdict.counterexample is not None
    assert verdict.correction is not None
    assert verdict.correction.what == "wrong factor"


def test_no_correction_inserts_the_other_side():
    gyroscope = equations("gyroscope")
    verdict = ph.check(r"\dot\theta = \sqrt{2Mga/I_2}", gyroscope)
    proposed = [c for c in (verdict.correction, *verdict.alternatives) if c is not None]
    assert all(r"\dot{\theta}" not in c.latex.partition("=")[2] for c in proposed)


def test_what_only_repeats_the_other_side_is_no_correction():
    gyroscope = equations("gyroscope")
    verdict = ph.check(r"L_{z} = I_1\omega_1\cos\theta", gyroscope, context="identity")
    assert verdict.correction is not None
    assert verdict.correction.latex.count("L_{z}") == 1


def test_an_angle_taken_from_the_wrong_axis_is_found_beside_another_slip():
    correction = _of_the_problem_set("4").correction
    assert correction is not None
    assert correction.what == "sin where cos is right; cos where sin is right; wrong sign"
    assert _of_the_problem_set("4", correction.latex).answer is Answer.HOLDS


REWRITTEN = [
    (
        "physical_pendulum",
        r"F_z = Mg + Mh(\ddot\theta\cos\theta+\dot\theta^2\sin\theta)",
        r"F_z = Mg + Mh(\ddot\theta\sin\theta+\dot\theta^2\cos\theta)",
    ),
    (
        "physical_pendulum",
        r"T = \frac54M(h^2+k^2)\dot\theta^2",
        r"T = \frac12M(h^2+k^2)\dot\theta^2",
    ),
    (
        "beads",
        r"V = -(m_1+m_2)gl_1\cos(\theta_1-\theta_2) - m_2gl_2\cos\theta_2",
        r"V = -(m_1+m_2)gl_1\cos(\theta_1) - m_2gl_2\cos\theta_2",
    ),
    ("wedge", r"(M+m)\dot X_w + m\dot s_b = \text{const}", None),
]


@pytest.mark.parametrize(("system", "wrong", "right"), REWRITTEN)
def test_corrections_are_what_a_referee_would_write(system, wrong, right):
    verdict = ph.check(wrong, getattr(textbook_systems, system)())
    assert verdict.answer is Answer.FAILS
    assert (verdict.correction and verdict.correction.latex) == right


def test_a_missing_term_does_not_take_back_what_is_printed() -> None:
    """Of a pendulum T = (I + m d²) ω²/2; I ω² lacks no term, but has a factor too much."""
    m, I, g, d = ph.symbols("m I g d", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "x")
    bar = ph.Body("bar", mass=m, inertia=(I, I, I), axes=axes)
    parts = (ph.Pivot(bar, at=axes["z"] * d), ph.Hinge(bar, axis="x"), ph.Gravity(g))
    pendulum = ph.derive(ph.System(*parts, name="pendulum"))
    wrong = ph.check(r"T = I\dot\theta^2", pendulum)
    assert wrong.correction is None or wrong.correction.what != "missing term"
    lost = ph.check(r"T = \frac12 I\dot\theta^2", pendulum)
    assert lost.correction is not None
    assert lost.correction.what == "missing term"


@pytest.mark.parametrize(
    "latex",
    [
        r"I_1\omega_1\dot\phi\sin\theta - I_{2p}\dot\phi^2\sin\theta\cos\theta = Mga\sin\theta",
        r"F_\rho = Ma(-\dot\theta^2\sin\theta - \dot\phi^2\sin\theta)",
        r"I_1\omega_1\dot\theta - 2I_{2p}\dot\phi\dot\theta\cos\theta = 0",
    ],
)
def test_no_correction_hides_the_residual_in_a_coefficient(latex: str) -> None:
    """Where no short term is missing, the whole residual over other factors is no correction."""
    found = verdict_on(latex)
    assert found.answer is Answer.FAILS
    assert found.correction is None


@pytest.mark.parametrize("chain", [r"\mathbf v_{\rm cm}", r"\boldsymbol\omega\times\mathbf a"])
def test_no_correction_of_a_chain_says_that_zero_is_zero(chain: str) -> None:
    disk = equations("rolling-disk")
    found = ph.check(
        rf"\mathbf v_{{\rm contact}} = 0 = {chain}", disk, let=[r"\mathbf a = -a\hat{\mathbf 2}"]
    )
    assert found.answer is Answer.FAILS
    assert found.correction is None or "0 = 0" not in found.correction.latex


@pytest.mark.parametrize(
    ("context", "latex", "right"),
    [
        ("number", r"\frac14 + \frac14 \neq 0.5", r"\frac{1}{4} + \frac{1}{4} = 0.5"),
        ("motion", r"\theta \neq 3\theta - 2\theta", r"\theta = 3 \theta - 2 \theta"),
    ],
)
def test_the_correction_of_sides_that_are_equal_says_so(context, latex, right) -> None:
    verdict = ph.check(latex, equations("gyroscope"), context=context)
    assert verdict.correction is not None
    assert verdict.correction.latex == right
    assert not verdict.alternatives


@pytest.mark.parametrize(
    ("claim", "wrong", "right"),
    [
        ("45", r"I\frac{d\omega}{dt} = m^2\mathbf a\times\frac{d\mathbf v}{dt}", "wrong power"),
        ("45", r"I^2\frac{d\omega}{dt} = m\mathbf a\times\frac{d\mathbf v}{dt}", "wrong power"),
        (
            "46",
            r"-ma^2\frac{d\mathbf v}{dt} = \mathbf a\times I^2\frac{d\omega}{dt}",
            "wrong power",
        ),
        ("97", r"\omega = \omega_{123} + \psi\hat{\mathbf 1}", "dot lost"),
        (
            "99",
            r"\omega = \omega_1\hat{\mathbf 1} + \omega_2^2\hat{\mathbf 2}"
            r" + \omega_3\hat{\mathbf 3}",
            "wrong power",
        ),
    ],
)
def test_a_slip_in_the_dimension_does_not_make_omega_another_quantity(claim, wrong, right):
    """A plain ω in a vector equation is neither a constant nor the text's own."""
    verdict = _of_the_problem_set(claim, wrong)
    assert ("\\omega", "angular velocity") in {(r.letter, r.meaning) for r in verdict.readings}
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    assert verdict.correction.what == right
    assert _of_the_problem_set(claim, verdict.correction.latex).answer is Answer.HOLDS


def test_letters_in_what_is_given_have_values_in_a_counterexample():
    """The moments of inertia of the hoop are given by its mass and radius, which no model has."""
    wrong = r"\mathbf\Omega = \Omega(2\cos\lambda\,\hat{\mathbf z} + \sin\lambda\,\hat{\mathbf N})"
    verdict = _of_the_problem_set("64", wrong)
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None
    assert {"a", "m"} <= verdict.counterexample.values.keys()

"""Approximate rates of steady precession, in every form."""

import pytest

import polhode as ph
from judge.judged import uncorrected
from judge.test_false_passes import I_1, I_3, M, equations, g, l, lab, phi, psi, theta
from polhode.judge import Answer

SPIN = r"\omega_3 = \dot\psi + \dot\phi\cos\theta"
FORMS = [
    r"\dot\phi \approx \frac{Mgl}{I_3\omega_3}",
    r"I_3\omega_3\dot\phi \approx Mgl",
    r"\frac{Mgl}{I_3\omega_3} \approx \dot\phi",
    r"\dot\phi - \frac{Mgl}{I_3\omega_3} \approx 0",
]


@pytest.fixture(scope="module")
def top():
    """A top whose speeds are the rates of Euler's angles, as Goldstein has it."""
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("top", mass=M, inertia=(I_1, I_1, I_3), axes=axes)
    return ph.derive(ph.System(ph.Pivot(body, at=axes["3"] * -l), ph.Gravity(g), name="top"))


@pytest.mark.parametrize("context", ["steady", "limit"])
@pytest.mark.parametrize("form", FORMS)
def test_a_fast_top_precesses_slowly(top, form, context):
    options = {"context": context, "let": [SPIN], "small": [r"1/\omega_3:1"]}
    assert uncorrected(form, top, **options).answer is Answer.APPROXIMATE
    wrong = form.replace("Mgl", "2Mgl")
    assert uncorrected(wrong, top, **options).answer is Answer.FAILS


@pytest.mark.parametrize("context", ["steady", "motion"])
def test_without_anything_small_nothing_is_close(context):
    said = r"\dot\phi \approx \frac{Mga}{I_1\omega_1}"
    verdict = uncorrected(said, equations("gyroscope"), context=context)
    assert verdict.answer is Answer.UNREAD
    assert verdict.option == "small"


def test_a_restriction_that_no_state_meets_is_named():
    verdict = uncorrected(r"\ddot\theta = 17", equations("plane"), given=[r"\sin\theta = 2"])
    assert "no state meets" in verdict.reason


@pytest.mark.parametrize(("moment", "answer"), [("I_1", Answer.HOLDS), ("I_3", Answer.FAILS)])
def test_angular_momentum_along_the_vertical(moment, answer):
    """Landau and Lifshitz, Mechanics, § 33: a free symmetric top precesses at L/I₁."""
    axes = lab.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("top", mass=M, inertia=(I_1, I_1, I_3), axes=axes, spin=ph.Components())
    free = ph.derive(ph.System(ph.Pivot(body, name="cm"), name="free top"))
    given = {"given": ["L_x = 0", "L_y = 0"]}
    assert uncorrected(rf"\dot\phi = \frac{{L_z}}{{{moment}}}", free, **given).answer is answer


def test_a_start_at_a_number_of_radians():
    options = {"context": "launch", "given": ["theta = 1", "theta_dot = 0"]}
    right = r"\ddot\theta = -\frac gl\sin\theta"
    assert uncorrected(right, equations("plane"), **options).answer is Answer.HOLDS
    assert uncorrected(right.replace("-", ""), equations("plane"), **options).answer is Answer.FAILS


@pytest.mark.parametrize(("bound", "answer"), [("3a", Answer.AMBIGUOUS), ("2a", Answer.FAILS)])
def test_a_threshold_of_unsaid_motions(bound, answer):
    said = rf"\omega_3^2 > \frac{{g}}{{{bound}}}"
    verdict = uncorrected(said, equations("rolling-disk"), context="threshold")
    assert verdict.answer is answer
    assert answer is Answer.FAILS or "theta = pi/2, phi_dot = 0" in verdict.reason

"""What beginners believe of spinning things: each is corrected, if that is short."""

from __future__ import annotations

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.judge import Answer

#: The system, the belief, its context, and what the textbooks have instead.
BELIEFS = [
    (
        "tennis-racquet",
        r"\dot\omega_1 = 0",
        "motion",
        r"\dot\omega_1 = \frac{\omega_3 \omega_2\left(I_2 - I_3\right)}{I_1}",
    ),
    (
        "tennis-racquet",
        r"\frac{d \mathbf L}{dt} = \boldsymbol\omega \times \mathbf L",
        "motion",
        r"\frac{d \mathbf L}{dt} = 0",
    ),
    (
        "gyroscope",
        r"\dot\phi = \frac{M g a}{I_1 \omega_1}",
        "steady",
        r"\dot\phi = \frac{M g a + \dot\phi^{2} \cos \theta\left(I_2 + M a^{2}\right)}"
        r"{I_1 \omega_1}",
    ),
    ("gyroscope", r"L_3 = I_1 \omega_1", "motion", r"L_1 = I_1 \omega_1"),
    (
        "rolling-disk",
        r"v^2 = a^2 \omega_3^2",
        "motion",
        r"v^2 = a^2 \omega_3^2 + a^2 \omega_1^2",
    ),
    (
        "rolling-disk",
        r"\dot\omega_3 = \dot\phi \dot\theta",
        "motion",
        r"\dot\omega_3 = \frac{2 \dot\theta \dot\phi \sin \theta}{3}",
    ),
    ("spinning-coin", r"\dot E = -1", "motion", r"\dot E = 0"),
    ("marble-on-turntable", r"\dot\omega_z = 1", "motion", r"\dot\omega_z = 0"),
    ("gyroscope/held", r"F_z = M g / 2", "motion", r"F_z = M g - F'_{z}"),
]

#: Beliefs that no short formula could replace, where a false friend would be easily found.
HOPELESS = [
    ("gyroscope", r"F_z = M g", "motion"),
    ("gyroscope", r"\dot\phi = 1", "steady"),
    ("gyroscope", r"2 \dot\phi = 2", "motion"),
    ("gyrocompass", r"\ddot\theta = -\Omega^2 \sin\theta", "motion"),
    ("ball-on-paper", r"\mathbf v = 0", "motion"),
    ("spinning-coin", r"E = \frac12 I_1 \omega_1^2", "motion"),
]


def judged(system, latex, context):
    return ph.check(latex, equations(system), context=context)


@pytest.mark.parametrize(("system", "belief", "context", "right"), BELIEFS)
def test_a_belief_is_replaced_by_what_the_textbooks_have(system, belief, context, right):
    verdict = judged(system, belief, context)
    assert verdict.answer is Answer.FAILS
    proposed = [c.latex for c in (verdict.correction, *verdict.alternatives) if c is not None]
    assert right in proposed
    assert all(judged(system, latex, context).answer is Answer.HOLDS for latex in proposed)


@pytest.mark.parametrize(("system", "belief", "context"), HOPELESS)
def test_what_would_say_nothing_is_no_correction(system, belief, context):
    verdict = judged(system, belief, context)
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is None


def test_a_quantity_that_a_claim_is_about_keeps_its_letter():
    verdict = judged("rolling-disk", r"T = \frac12 m v^2", "motion")
    assert verdict.correction is not None
    assert verdict.correction.latex.startswith("T = ")


def test_a_belief_about_an_undetermined_force_is_refuted_by_both_and_called_undetermined():
    verdict = judged("gyroscope/held", "F_z = M g / 2", "motion")
    assert verdict.confirmation.agrees
    assert "do not determine F_z" in " ".join(verdict.remarks)

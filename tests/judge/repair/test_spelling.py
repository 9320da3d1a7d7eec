"""Corrections are written back in the author's own spelling."""

from __future__ import annotations

from dataclasses import replace

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.catalogue import problem_set
from polhode.judge import Answer, read_document
from polhode.judge._audit import ClaimChecker

I_2P = r"I_{2p} = I_2 + Ma^2"

#: What was printed, and the correction, character by character.
CORRECTED = [
    (
        r"\tfrac12 I_1\omega_1^2 = T - \tfrac13 (I_2+Ma^2)(\dot\theta^2+\dot\phi^2\sin^2\theta)",
        r"\tfrac12 I_1\omega_1^2 = T - \tfrac12 (I_2+Ma^2)(\dot\theta^2+\dot\phi^2\sin^2\theta)",
    ),
    (
        r"I_1\omega_1\dot\phi\sin\theta + I_{2p}\dot\phi^2\sin\theta\cos\theta"
        r" + I_{2p}\ddot\theta = Mga\sin\theta",
        r"I_1\omega_1\dot\phi\sin\theta - I_{2p}\dot\phi^2\sin\theta\cos\theta"
        r" + I_{2p}\ddot\theta = Mga\sin\theta",
    ),
    (
        r"E = \frac{1}{2} I_1 \omega_1^2 + \frac12 I_{2p}(\dot\theta^2 + \dot\phi^2\cos^2\theta)"
        r" + Mga\cos\theta",
        r"E = \frac{1}{2} I_1 \omega_1^2 + \frac12 I_{2p}(\dot\theta^2 + \dot\phi^2\sin^2\theta)"
        r" + Mga\cos\theta",
    ),
    (
        r"$$ I_{2p} \dot{\theta} = Mga \sin\theta + I_{2p}\dot{\phi}^2 \sin\theta\cos\theta"
        r" - I_1\omega_1\dot\phi\sin\theta. $$",
        r"I_{2p} \ddot{\theta} = Mga \sin\theta + I_{2p}\dot{\phi}^2 \sin\theta\cos\theta"
        r" - I_1\omega_1\dot\phi\sin\theta",
    ),
]


@pytest.mark.parametrize(("printed", "right"), CORRECTED)
def test_only_what_is_wrong_is_written_anew(printed, right):
    verdict = ph.check(printed, equations("gyroscope"), let=[I_2P])
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    assert verdict.correction.latex == right
    assert ph.check(right, equations("gyroscope"), let=[I_2P]).answer is Answer.HOLDS


@pytest.mark.parametrize(
    ("printed", "right"),
    [
        (r"V = \frac{2 M g a \cos\theta}{3}", r"V = M g a \cos\theta"),
        (r"V = \frac{5 M g a \cos\theta}{2M}", r"V = M g a \cos\theta"),
        (
            r"T = \frac{2 I_1}{4}\omega_1^2"
            r" + \frac{5 (I_2+Ma^2)(\dot\theta^2+\dot\phi^2\sin^2\theta)}{16}",
            r"T = \frac{2 I_1}{4}\omega_1^2"
            r" + \frac{(I_2+Ma^2)(\dot\theta^2+\dot\phi^2\sin^2\theta)}{2}",
        ),
    ],
)
def test_a_changed_fraction_is_in_lowest_terms(printed, right):
    verdict = ph.check(printed, equations("gyroscope"))
    assert verdict.correction is not None
    assert verdict.correction.latex == right


def test_an_inequality_is_turned_round():
    verdict = ph.check(
        r"I_1^2\omega_1^2 < 4Mga(I_2+Ma^2)",
        equations("gyroscope/upright"),
        context="threshold",
        given=["alpha = 0", "beta = 0"],
    )
    assert verdict.correction is not None
    assert verdict.correction.latex == r"I_1^2\omega_1^2 > 4Mga(I_2+Ma^2)"


#: Lines for which no small change is right; what would hold is no correction.
NOTHING_TO_SAY = [
    r"\ddot\theta = 17",
    r"\dot\theta = \sqrt{\frac{2g}{a}}\cos\theta",
]


@pytest.mark.parametrize("printed", NOTHING_TO_SAY)
def test_a_fudge_is_no_correction(printed):
    verdict = ph.check(printed, equations("gyroscope"))
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is None


#: Claims of the problem set that once had no correction, or one that no referee would write.
OF_THE_PROBLEM_SET = {
    "24": [
        r"+ m a^2 \cos \theta\left(\ddot{\theta} \cos \theta - 2 \dot{\theta}^2 \sin \theta\right)"
    ],
    "59": [r"- \frac{ma^2 g \sin \alpha}{I + ma^2} \hat{\mathbf{2}}"],
    "75": [r"0 = I_3(\dot{\omega} - \Omega \dot{\theta} \sin \lambda \sin \theta) \approx I_3"],
    "126": [r"\omega_1 > \frac{2}{I_1} \sqrt{mgr I_{2p} \cos \theta_0}"],
    "138": [
        r"- a\dot{\theta}\frac{d\hat{\mathbf{3}}}{dt} = -a\ddot{\theta}",
        r"- a\dot{\theta}^2\,\hat{\mathbf{1}}",
        r"= -a\ddot{\theta}(-\cos\theta",
    ],
}


@pytest.mark.parametrize("id", OF_THE_PROBLEM_SET)
def test_the_problem_set_is_corrected_as_a_referee_would(id):
    document = read_document(problem_set())
    claim = document.claim(id)
    part, checker = document.part_of(claim), ClaimChecker(equations)
    correction = checker.verdict(part, claim, {}).correction
    assert correction is not None
    assert all(piece in correction.latex for piece in OF_THE_PROBLEM_SET[id])
    said = replace(claim, latex=correction.latex, read_as="")
    assert checker.verdict(part, said, {}).holds


@pytest.mark.parametrize(
    ("printed", "corrected"),
    [
        (r"|\dot v_y| = \frac35 g\sin\alpha", r"|\dot v_y| = \frac57 g\sin\alpha"),
        (r"|\dot v_y| = \tfrac{3}{5}g\sin\alpha", r"|\dot v_y| = \tfrac{5}{7}g\sin\alpha"),
    ],
)
def test_a_wrong_fraction_of_numbers_stays_one_fraction(printed, corrected):
    M, R, g = ph.symbols("M R g", positive=True)
    slope = ph.Plane(ph.Frame("lab"), tilt=-ph.symbol("alpha"))
    ball = ph.sphere("ball", mass=M, radius=R, axes=slope.axes)
    rolling = ph.derive(ph.System(ph.Rolling(ball, on=slope), ph.Gravity(g)))
    verdict = ph.check(printed, rolling, positive="sin(alpha)")
    assert verdict.answer is Answer.FAILS
    assert verdict.correction.latex == corrected

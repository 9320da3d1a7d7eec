"""Claims checked from their LaTeX to the verdict and the correction."""

from __future__ import annotations

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.judge import Answer

HOLDING = [
    ("gyroscope", r"F_\phi = Ma(\ddot\phi\sin\theta + 2\dot\phi\dot\theta\cos\theta)", {}),
    (
        "spinning-coin",
        r"\dot\phi = \frac{\omega_3 \pm"
        r" \sqrt{\omega_3^2 + 4g\cos^2\theta/a\sin\theta}}{\cos\theta}",
        {"context": "steady"},
    ),
    (
        "rolling-disk",
        r"\dot\phi^2\sin\theta\cos\theta - 6\omega_3\dot\phi\sin\theta"
        r" - \frac{4g}{a}\cos\theta = 0",
        {"context": "steady"},
    ),
    (
        "spinning-coin",
        r"\dot\phi > 2\sqrt{g/a}",
        {"context": "threshold", "given": ["theta = pi/2", "omega_3 = 0"]},
    ),
]


@pytest.mark.parametrize(("name", "latex", "asked"), HOLDING)
def test_true_claims_hold(name, latex, asked):
    assert ph.check(latex, equations(name), **asked).answer is Answer.HOLDS


FAILING = [
    (
        "gyroscope",
        r"F_z = Mg - a(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)",
        "missing factor",
    ),
    (
        "marble-on-turntable/tilted",
        r"\frac{d\mathbf v}{dt} = \frac{I\Omega}{I + ma^2}\hat{\mathbf 1} \times \mathbf v"
        r" + \frac{ma^2 g\sin\alpha}{I + ma^2}\hat{\mathbf 2}",
        "wrong sign",
    ),
]


@pytest.mark.parametrize(("name", "latex", "slip"), FAILING)
def test_false_claims_fail_with_evidence_and_a_correction_that_holds(name, latex, slip):
    verdict = ph.check(latex, equations(name))
    assert verdict.answer is Answer.FAILS
    assert verdict.residuals
    assert verdict.counterexample is not None
    assert verdict.counterexample.left != verdict.counterexample.right
    assert verdict.confirmation is not None
    assert verdict.confirmation.agrees
    assert verdict.correction is not None
    assert verdict.correction.what == slip
    assert ph.check(verdict.correction.latex, equations(name)).answer is Answer.HOLDS


def test_what_is_true_on_steady_motions_only_fails_on_others():
    latex = (
        r"\frac{ma^2}{4}\ddot\theta = \frac{ma^2\sin\theta}{4}"
        r"(\dot\phi^2\cos\theta - 2\omega_3\dot\phi - \frac{4g\cos\theta}{a\sin\theta})"
    )
    coin = equations("spinning-coin")
    assert ph.check(latex, coin, context="steady").answer is Answer.HOLDS
    assert ph.check(latex, coin).answer is Answer.FAILS


def test_an_approximation_gives_its_order_and_the_dropped_term():
    verdict = ph.check(
        r"\dot\phi \approx \frac{Mga}{I_1\omega_1}",
        equations("gyroscope"),
        context="limit",
        let=["eta = 1/omega_1"],
        small=["eta:1"],
    )
    assert verdict.answer is Answer.APPROXIMATE
    assert verdict.order == 2
    assert verdict.dropped is not None


def test_definitions_and_unknown_letters_are_distinguished():
    gyroscope = equations("gyroscope")
    assert ph.check(r"I_{2q} = I_2 + Ma^2", gyroscope).answer is Answer.DEFINITION
    unread = ph.check(r"F_\phi = Ma q", gyroscope)
    assert unread.answer is Answer.UNREAD
    assert "q" in unread.reason


@pytest.mark.parametrize("latex", ["hello", r"\omega_1", r"\theta + \phi"])
def test_a_formula_without_a_relation_states_nothing(latex):
    unread = ph.check(latex, equations("gyroscope"))
    assert unread.answer is Answer.UNREAD
    assert "states nothing" in unread.reason


def test_a_known_symbol_cannot_be_redefined():
    with pytest.raises(ph.ParseError):
        ph.check(r"F_z = Mg", equations("gyroscope"), let=["theta = 1"])


def test_an_unknown_context_is_refused():
    with pytest.raises(ph.ParseError, match="context"):
        ph.check(r"F_z = Mg", equations("gyroscope"), context="always")


@pytest.mark.parametrize(
    ("latex", "message"),
    [
        (r"L_z = I_1\omega_1 asin\theta", r"\mathrm{asin}"),
        (r"I_1 omega_1 \dot\phi = 0", r"\omega"),
        (r"\theta'' = 0", r"\ddot"),
        (r"\left.\dot\theta\right|_{\theta=0} = 0", "restrict the claim"),
        (r"\mathbf{L} = M", "two scalars or two vectors"),
    ],
)
def test_what_cannot_be_read_says_what_to_do(latex, message):
    verdict = ph.check(latex, equations("gyroscope"))
    assert verdict.answer is Answer.UNREAD
    assert message in verdict.reason


@pytest.mark.parametrize(
    "latex",
    [
        r"\dv{\vb{L}}{t} = \vb*{\tau}",
        r"\dv{t}(\vb L_p) = \vb*\tau_p",
        r"p_\phi = \pdv{L}{\dot\phi}",
        r"\boldsymbol\omega = \dot\phi\,\mathbf{e}_z + \dot\theta\,\mathbf{e}_\phi"
        r" + \dot\psi\,\mathbf{e}_1",
    ],
)
def test_other_ways_to_print_derivatives_and_vectors(latex):
    verdict = ph.check(latex, equations("gyroscope"))
    assert verdict.answer is Answer.HOLDS


def test_a_power_of_e_is_an_exponential_unless_e_is_a_letter():
    gyroscope = equations("gyroscope")
    latex = r"\cosh\theta = \frac{e^{\theta} + e^{-\theta}}{2}"
    assert ph.check(latex, gyroscope).answer is Answer.HOLDS
    assert ph.check(latex, gyroscope, let=["e = 2*a"]).answer is not Answer.HOLDS
    assert ph.check(r"e^2 \dot\omega_1 = 0", gyroscope).answer is Answer.UNREAD


@pytest.mark.parametrize(
    ("latex", "answer"),
    [
        (r"\kappa^2 = g/a", Answer.HOLDS),
        (r"\kappa^2 = 2 g/a", Answer.FAILS),
        (r"\lambda^2 = g/a", Answer.DEFINITION),
    ],
)
def test_a_square_that_is_defined_is_judged(latex, answer):
    verdict = ph.check(latex, equations("gyroscope"), let=[r"\kappa^2 = g/a"])
    assert verdict.answer is answer


def test_a_failure_is_reported_before_its_correction():
    failures = []
    gyroscope = equations("gyroscope")
    verdict = ph.check(r"F_z = Mg - Ma(\ddot\theta\sin\theta)", gyroscope, tell=failures.append)
    (failure,) = failures
    assert failure.answer is verdict.answer is Answer.FAILS
    assert failure.correction is None
    assert verdict.correction is not None
    ph.check(r"\dot\omega_1 = 0", gyroscope, tell=failures.append)
    assert failures == [failure]


def test_a_verdict_is_shown_in_latex():
    gyroscope = equations("gyroscope")
    verdict = ph.check(r"F_z = Mg - Ma(\ddot\theta\sin\theta)", gyroscope)
    assert verdict._repr_latex_().startswith(r"$\displaystyle \begin{array}{l} \text{fails}")


@pytest.mark.parametrize(
    "latex", [r"L_{cm,z} = I_1\omega_1", r"L_{cm,z} = \mathbf L_{cm}\cdot\hat{\mathbf z}"]
)
def test_every_verdict_says_how_letters_were_read(latex: str) -> None:
    verdict = ph.check(latex, equations("gyroscope"))
    meant = {reading.letter: reading.meaning for reading in verdict.readings}
    assert meant[r"\mathbf{L}_{\mathrm{cm}}"] == "angular momentum about cm"
    assert meant[r"\hat{\mathbf{z}}"] == "axis z of lab"

"""Claims along a motion: closed forms, starts, events, and a second opinion of their own."""

from functools import partial

import pytest

import polhode as ph
from judge.judged import before_correction
from judge.mutation import Original, document
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, Verdict
from polhode.judge._check import judged_claim


def verdict_on(
    id: str, old: str = "", new: str = "", when: str | None = None, *, corrected: bool = False
) -> Verdict:
    """On a claim of the problem set, with something else put in."""
    original = Original.of(document().claim(id))
    claim = original.claim
    assert old in claim.formula
    formula = claim.formula.replace(old, new, 1) if old else claim.formula
    moments = claim.when if when is None else when
    judge = partial(judged_claim, formula, original.notation.choosing, "launch", moments)
    return judge() if corrected else before_correction(lambda stop: judge(tell=stop))


@pytest.mark.parametrize("id", ["12", "13", "w51", "w65", "w71", "w75"])
def test_what_is_true_along_the_motion_holds(id):
    assert verdict_on(id).answer is Answer.HOLDS


@pytest.mark.parametrize(
    ("id", "old", "new"),
    [
        ("12", r"\operatorname{sech}[k", r"\operatorname{sech}[2k"),
        ("13", r"\omega_2 = ", r"\omega_2 = -"),
        ("w51", r"\omega_1 = 0", r"\omega_1 = \omega_{2,\max}"),
        ("w71", r"\ddot{\phi} > 0", r"\ddot{\phi} < 0"),
    ],
)
def test_what_is_false_along_the_motion_fails(id, old, new):
    assert verdict_on(id, old, new).answer is Answer.FAILS


@pytest.mark.parametrize(
    ("id", "old", "new", "slip"),
    [
        ("12", r"\operatorname{sech}[k", r"\operatorname{sech}[2k", "wrong factor"),
        ("13", r"\tanh", r"\operatorname{sech}", "sech where tanh is right"),
        ("14", r"\omega_3 =", r"\omega_2 =", "wrong index"),
        ("84", r"I_3 - I_2", r"I_3 + I_2", "wrong sign"),
    ],
)
def test_a_slip_in_a_closed_form_is_corrected(id, old, new, slip):
    correction = verdict_on(id, old, new, corrected=True).correction
    assert correction is not None
    assert correction.what == slip
    original = Original.of(document().claim(id))
    assert (
        judged_claim(correction.latex, original.notation.choosing, "launch").answer is Answer.HOLDS
    )


def test_letters_that_vanish_from_the_start_alone_have_a_number():
    assert verdict_on("13", r"\omega_2 = ", r"\omega_2 + m \omega_2 = ").answer is Answer.FAILS


@pytest.mark.parametrize(
    ("id", "old", "new", "what"),
    [
        ("w70", "- aF", "- 2aF", "wrong factor"),
        ("w71", r"\ddot{\phi} > 0", r"\ddot{\phi} < 0", "wrong relation sign"),
        ("w73", r"F_\rho", r"F_\rho^2", "wrong power"),
        ("w77", "Mg", "g", "missing factor"),
        ("w78", r"\ge", r"\le", "wrong relation sign"),
    ],
)
def test_a_statement_on_single_moments_is_corrected(id, old, new, what):
    verdict = verdict_on(id, old, new, corrected=True)
    assert verdict.correction is not None
    claim = Original.of(document().claim(id)).claim
    found = {c.what: c.latex for c in (verdict.correction, *verdict.alternatives)}
    assert what in found
    assert _letters(found[what]) == _letters(claim.formula)
    assert verdict_on(id, claim.formula, found[what]).answer is Answer.HOLDS


def _letters(latex: str) -> str:
    return "".join(c for c in latex if c not in "{} ")


def test_a_motion_integrated_from_the_balance_of_every_body_agrees():
    verdict = verdict_on("12", r"\operatorname{sech}[k", r"\operatorname{sech}[2k")
    assert verdict.confirmation is not None
    assert verdict.confirmation.agrees
    assert verdict.confirmation.left != pytest.approx(verdict.confirmation.right)


def test_a_printed_number_holds_within_its_digits_at_an_event():
    assert verdict_on("w65", "0.7", "0.8").answer is Answer.FAILS


def test_what_never_happens_does_not_happen_sometimes():
    assert verdict_on("w75", when="sometimes").answer is Answer.FAILS
    assert verdict_on("w77", when="never").answer is Answer.FAILS


def test_terms_of_different_dimensions_are_named():
    original = Original.of(document().claim("147"))
    verdict = judged_claim(original.claim.formula, original.notation.choosing, "motion")
    assert verdict.answer is Answer.FAILS
    assert "terms of different dimensions: kg m/s^2 and m/s^2 in member 1" in verdict.reason


def test_an_event_has_one_condition():
    """The first instant of one equality need not satisfy another: such a claim is not judged."""
    report = ph.audit(r"""
schema = 2
[document]
title = "Two conditions"
[[part]]
id = "top"
system = "gyroscope"
[[claim]]
id = "1"
part = "top"
context = "launch"
latex = '\dot\theta = 0'
start = { theta = "pi/3", omega_1 = "0", phi_dot = "0", theta_dot = "0" }
given = ['\theta = \pi/2', '\dot\phi = 1']
""")
    verdict = report.judged[0].verdict
    assert verdict.answer is Answer.UNREAD
    assert "an event at which phi_dot, theta have given values" in verdict.reason


@pytest.mark.parametrize("factor", ["1", "2"])
def test_a_branch_of_the_conserved_quantities_proves_nothing(factor):
    """Of a marble, d/dt(v + ω × c - Ω × r) = 0; its conserved quantities factor into Ω and a rest.

    With Ω = 0 both sides of the false line vanish, as they do on no turntable that turns.
    """
    claim = (
        r"\frac{d\boldsymbol\omega}{dt}\times\mathbf c = "
        rf"{factor}\boldsymbol\Omega\times\mathbf v - \frac{{d\mathbf v}}{{dt}}"
    )
    let, start = (r"\mathbf c = -a\hat{\mathbf z}",), (r"\omega_z = 0",)
    marble = ph.derive(PROBLEM_SET["marble-on-turntable"].build())
    verdict = ph.check(claim, marble, context="launch", let=let, given=start)
    assert verdict.holds == (factor == "1")

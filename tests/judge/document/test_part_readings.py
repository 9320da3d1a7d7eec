"""Each part of a document keeps one reading of a letter that has several."""

from __future__ import annotations

import json

import pytest

from catalogue.systems import equations
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, Claim, Document, Part, audit_apart, report_on
from polhode.judge._verdict import Read, Verdict, VerdictInReading
from polhode.judge.document._part_readings import part_readings, under_part_reading
from polhode.judge.latex._tree import Name

CM, PIVOT = "angular momentum about cm", "angular momentum about pivot"

# On a gyroscope whose pivot is not at its centre of mass: L about the pivot has a constant vertical
# component, that about the centre of mass has not; its component along the axle is the same.
CONSERVED = r"\dot L_z = 0"
CONSERVED_TOO = r"\mathbf L\cdot\hat{\mathbf z} = \text{const}"
OF_THE_SPIN = r"L_1 = I_1\omega_1"
ABOUT_CM = (
    r"\mathbf L = I_1\omega_1\hat{\mathbf 1} + I_2\omega_2\hat{\mathbf 2}"
    r" + I_2\omega_3\hat{\mathbf 3}"
)


def document(*latex: str, **of_part) -> Document:
    part = Part("top", "The top", "gyroscope", **of_part)
    claims = tuple(Claim(str(i), "top", latex=line) for i, line in enumerate(latex, 1))
    return Document("A text", "", (part,), claims)


def answers(report) -> list[Answer]:
    return [judged.answer for judged in report.judged]


def test_the_reading_under_which_most_lines_hold_is_that_of_the_part():
    report = report_on(document(CONSERVED, CONSERVED_TOO, OF_THE_SPIN), equations)
    assert answers(report) == [Answer.HOLDS] * 3
    (kept,) = report.readings
    assert (kept.kept.holding, kept.lines, kept.others[0].holding) == (3, 3, 1)
    said = f"Read L as {PIVOT} throughout part top: 3 of 3 lines with L hold; about cm: 1."
    assert str(kept) == said
    assert said in " ".join(report.table().split())
    for judged in report.judged:
        assert PIVOT in {read.meaning for read in judged.verdict.readings}
    assert f"letters: L as {PIVOT} (proposed for this part)" in report.table()


def test_a_line_that_is_true_only_in_another_reading_is_ambiguous():
    report = report_on(document(CONSERVED, CONSERVED_TOO, ABOUT_CM), equations)
    assert answers(report) == [Answer.HOLDS, Answer.HOLDS, Answer.AMBIGUOUS]
    reason = report.judged[2].verdict.reason
    assert reason.startswith(f"the lines of this part read L as {PIVOT}")
    assert f"holds if L is {CM}; fails if L is {PIVOT}" in reason
    assert "[part.bindings]" in report.table()


@pytest.mark.parametrize("lines", [(CONSERVED,), (CONSERVED, ABOUT_CM)])
def test_a_single_line_and_a_tie_stay_ambiguous(lines):
    report = report_on(document(*lines), equations)
    assert set(answers(report)) == {Answer.AMBIGUOUS}
    assert report.readings == ()


def test_what_the_text_states_is_not_proposed():
    text = document(CONSERVED, ABOUT_CM, bindings={r"\mathbf{L}": PIVOT})
    report = report_on(text, equations)
    assert answers(report) == [Answer.HOLDS, Answer.FAILS]
    assert report.readings == ()
    assert {r.letter: r.meaning for r in report.judged[0].verdict.readings}[r"\mathbf{L}"] == PIVOT


def test_a_binding_may_be_as_short_as_a_choice_typed_in_a_shell():
    text = document(CONSERVED, bindings={r"\mathbf{L}": "about pivot"})
    (judged,) = report_on(text, equations).judged
    assert judged.answer is Answer.HOLDS
    assert PIVOT in {read.meaning for read in judged.verdict.readings}


def test_a_letter_bound_to_two_vectors_is_refused():
    text = document(CONSERVED, bindings={"L": PIVOT, r"\mathbf{L}": CM})
    (judged,) = report_on(text, equations).judged
    assert judged.answer is Answer.UNREAD
    assert f"L bound to '{PIVOT}' and, in bold type, to '{CM}'" in judged.verdict.reason


def test_a_plain_letter_may_be_a_scalar_beside_a_bold_one():
    text = document("L = T - V", CONSERVED, bindings={"L": "lagrangian", r"\mathbf{L}": PIVOT})
    assert answers(report_on(text, equations)) == [Answer.HOLDS] * 2


def test_the_l_under_a_partial_derivative_is_the_lagrangian_and_said_to_be():
    latex = r"\frac{d}{dt}\frac{\partial L}{\partial\dot\theta} = \frac{\partial L}{\partial\theta}"
    (judged,) = report_on(document(latex), equations).judged
    assert judged.answer is Answer.HOLDS
    assert "lagrangian" in {read.meaning for read in judged.verdict.readings}


def test_a_failure_is_corrected_in_the_reading_of_its_part():
    doubled = r"L_z = 2L_{p,z}"  # false in both readings
    (alone,) = report_on(document(doubled), equations).judged
    assert alone.answer is Answer.FAILS
    report = report_on(document(doubled, CONSERVED, CONSERVED_TOO), equations)
    verdict = report.judged[0].verdict
    assert verdict.answer is Answer.FAILS
    assert PIVOT in {read.meaning for read in verdict.readings if read.proposed}
    assert verdict.correction is not None


def test_the_verdict_on_a_line_does_not_depend_on_which_others_are_selected():
    text = document(CONSERVED, CONSERVED_TOO, ABOUT_CM)
    whole = {j.claim.id: j.verdict for j in report_on(text, equations).judged}
    for id in ("1", "3"):
        report = report_on(text, equations, only=[id])
        assert [(j.claim.id, j.verdict) for j in report.judged] == [(id, whole[id])]


def test_processes_agree_and_moments_are_about_one_point():
    torque = r"\boldsymbol\tau = a\hat{\mathbf 1}\times M\mathbf g"
    text = document(CONSERVED, CONSERVED_TOO, torque)
    apart = audit_apart(text, lambda name: PROBLEM_SET[name].build())
    alone = report_on(text, equations)
    assert apart.judged == alone.judged
    assert apart.readings == alone.readings
    assert answers(apart) == [Answer.HOLDS] * 3
    (kept,) = alone.readings  # one choice for both letters
    assert "tau as torque about pivot" in str(kept)
    plain = json.loads(json.dumps(alone.to_json()))
    assert plain["readings"][0]["holding"] == 3
    assert {"letter": r"\mathbf{L}", "meaning": PIVOT} in plain["claims"][0]["readings"]


# --- without a system ---

L = Name("L", decoration="vector")


def meant(meaning: str) -> Read:
    return Read(r"\mathbf{L}", meaning, "L")


def ways(**found: Answer) -> Verdict:
    by_reading = tuple(
        VerdictInReading({L: meant(meaning)}, Verdict(answer, "motion"))
        for meaning, answer in found.items()
    )
    (answer,) = {*found.values()} if len({*found.values()}) == 1 else {Answer.AMBIGUOUS}
    return Verdict(answer, "motion", by_reading=by_reading)


def test_a_line_that_makes_sense_in_one_reading_only_has_no_say_and_keeps_its_verdict():
    energy = ways(tension=Answer.HOLDS)
    lines = [ways(tension=Answer.HOLDS, period=Answer.HOLDS)] * 2 + [energy]
    assert part_readings("p", lines) == ()
    assert under_part_reading(energy, {L: meant("period")}) == energy


def test_what_fails_in_every_reading_is_judged_anew_in_that_of_its_part():
    failing = ways(cm=Answer.FAILS, pivot=Answer.FAILS)
    assert under_part_reading(failing, {L: meant("pivot")}) is None
    kept = under_part_reading(failing, {L: meant("cm")})
    assert kept is not None
    assert kept.by_reading == failing.by_reading

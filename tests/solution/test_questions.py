"""Answers to a text's questions: derived, judged, in order, with remarks where the text errs."""

import pytest

import polhode as ph
from polhode.base import ConstraintError, DeclarationError, NumericError
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, document_of
from polhode.solution import (
    AtInstant,
    FromSection,
    Remark,
    SmallOscillation,
    TextQuestion,
    WhateverForce,
    answered_solution,
    markdown_of_solution,
    questions_of,
    remarks_of,
)
from polhode.solution._lines import SolutionLine
from polhode.solution._remarks import remark_lines, unnumbered

ASKED = [name for name in PROBLEM_SET if questions_of(name)]
PROBLEMS = {name.partition("/")[0] for name in PROBLEM_SET}


@pytest.fixture(scope="module")
def solved():
    """Solutions with answers and without remarks, each built once."""
    kept = {}

    def solution_of(name):
        if name not in kept:
            kept[name] = answered_solution(name, remarks={})
        return kept[name]

    return solution_of


@pytest.fixture(scope="module")
def remarks():
    """Remarks on a few claims: one that holds, one damaged, and some that fail."""
    return remarks_of("1", "131", "w22", "56", "62", "88", "147", "w43", "125")


def steps_about(solution, title):
    (question,) = [q for q in solution.questions if q.title == title]
    return solution.sections[question.heading]


def displayed(steps):
    return [step.latex for step in steps if step.latex]


def test_every_problem_has_questions_and_no_other_system():
    assert {name.partition("/")[0] for name in ASKED} == PROBLEMS
    assert questions_of("gyroscope/upright") == ()


def test_claims_that_questions_name_are_in_the_document_and_about_that_system():
    document = document_of(None)
    for name in ASKED:
        for question in questions_of(name):
            for id in question.claims:
                assert document.part_of(document.claim(id)).system == name


@pytest.mark.parametrize("name", ASKED)
def test_questions_are_answered_in_their_order_by_formulas_that_hold(solved, name):
    solution = solved(name)
    headings = [question.heading for question in questions_of(name)]
    assert [h for h in solution.sections if h in headings] == headings
    for heading in headings:
        first, *others = solution.sections[heading]
        assert first.words.startswith("Asked: ")
        assert displayed(others)
    answers = {step.verdict.answer for step in solution.steps if step.latex}
    assert answers <= {Answer.HOLDS, Answer.APPROXIMATE}


@pytest.mark.parametrize("name", ASKED)
def test_no_section_stands_twice(solved, name):
    solution = solved(name)
    taken = [
        answer.section
        for question in questions_of(name)
        for answer in question.answers
        if isinstance(answer, FromSection)
    ]
    assert not set(taken) & set(solution.sections)
    assert [step.number for step in solution.steps if step.number] == list(
        range(1, solution.judged + 1)
    )


@pytest.mark.parametrize(
    ("name", "title", "formula"),
    [
        ("spinning-coin", "The coin on edge", r"\dot{\phi} > 2 \sqrt{\frac{g}{a}}"),
        ("rolling-disk", "Rolling on edge", r"\omega_3 > \sqrt{\frac{g}{3 a}}"),
        (
            "gyrocompass",
            "In the frame of the Earth",
            r"\ddot{\theta} \approx -2 \Omega \theta \omega \sin\lambda",
        ),
        ("gyroscope/held", "Held fixed by a second force", r"F'_z = \frac{M g}{2}"),
        ("ball-on-paper", "The paths", r"\frac{d\mathbf F}{dt} = 0"),
    ],
)
def test_the_texts_own_result_is_reached(solved, name, title, formula):
    assert formula in displayed(steps_about(solved(name), title))


def test_the_force_at_release_agrees_with_a_simulated_start(solved):
    # M g (I₂ + M a² cos²θ)/(I₂ + M a²), with the numbers of the catalogue
    shown = displayed(steps_about(solved("gyroscope"), "Launched from rest"))
    assert r"F_z = \frac{M g \left(I_2 + M a^2 \cos^2\theta\right)}{I_2 + M a^2}" in shown
    equations = ph.derive(PROBLEM_SET["gyroscope"].build())
    values = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}
    run = ph.simulate(equations, values, {"theta": "60 deg", "omega_1": 150.0}, 0.01)
    inertia = values["M"] * values["a"] ** 2
    predicted = (
        values["M"] * values["g"] * (values["I_2"] + inertia / 4) / (values["I_2"] + inertia)
    )
    assert run.evaluate("F_z", 0.0) == pytest.approx(predicted, rel=1e-12)


def test_what_any_force_leaves_unchanged_is_judged_for_sliding_too(solved):
    steps = steps_about(solved("ball-on-paper"), "The final velocity")
    laws = [step for step in steps if step.latex.startswith(r"\frac{d}{dt}\left(\mathbf L")]
    assert len(laws) == 2
    assert "slides" in laws[1].words


def test_what_any_force_leaves_unchanged_needs_a_contact_straight_below():
    question = TextQuestion("?", "what?", (WhateverForce("ground"),))
    with pytest.raises(ConstraintError, match="straight below"):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), questions=(question,))


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        (FromSection("Tides"), "section of the solution"),
        (AtInstant({}, ("theta_dddot",), "Now"), "quantity of"),
        (SmallOscillation("theta", "0", "Gamma"), "parameter"),
    ],
)
def test_an_answer_that_the_system_does_not_have_is_a_sentence(answer, message):
    question = TextQuestion("?", "what?", (answer,))
    with pytest.raises(DeclarationError, match=message):
        ph.solution(PROBLEM_SET["gyrocompass"].build(), questions=(question,))


def test_a_false_answer_ends_the_solution():
    class Wrong:
        def lines(self, found):
            yield SolutionLine("Of course", r"\dot{\omega}_3 = 1")

    question = TextQuestion("?", "what?", (Wrong(),))
    with pytest.raises(NumericError, match="judged as fails"):
        ph.solution(PROBLEM_SET["rolling-disk"].build(), questions=(question,))


def test_a_users_system_can_be_asked_about():
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", name="axes")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    swing = ph.System(ph.Pivot(bob, at=axes["z"] * l), ph.Gravity(g), name="swing")
    question = TextQuestion(
        "At the turn",
        "what is the acceleration where it stops?",
        (AtInstant({"theta_dot": "0"}, ("theta_ddot",), "At rest"),),
        part="(a)",
    )
    text = markdown_of_solution(ph.solution(swing, questions=(question,)))
    assert "## (a) At the turn" in text
    assert r"\ddot{\theta} = -\frac{g \sin\theta}{l}" in text


# -- remarks ---------------------------------------------------------------------------------------


def test_remarks_say_what_is_printed_what_is_right_and_how_one_sees_it(remarks):
    wrong = remarks["147"]
    assert wrong.answer == "fails"
    assert wrong.correction.startswith("F_z = Mg - M a")
    (line, *_) = remark_lines([wrong])
    assert "does not hold (missing factor)" in line.words
    assert "the left side is" in line.words
    assert line.latex == wrong.correction
    assert line.verdict.answer is Answer.HOLDS


def test_what_follows_from_a_mistake_is_not_argued_again(remarks):
    first, second = list(remark_lines([remarks["56"], remarks["62"]]))[:2]
    assert "For instance" in first.words
    assert "For instance" not in second.words
    assert "derives it from equation 56" in second.words


def test_what_survives_a_mistake_is_told():
    remark = Remark("5", "equation 5", "fails", correction="a = b", surviving=("equation 7",))
    assert any("in equation 7 holds all the same" in line.words for line in remark_lines([remark]))


def test_damage_is_told_apart_from_mistakes(remarks):
    words = " ".join(line.words for line in remark_lines([remarks["131"], remarks["1"]]))
    assert "transcript is damaged at equation 131" in words
    assert "equation 1 agrees with this" in words
    assert "Remark." not in words


def test_words_that_are_wrong_are_quoted_with_what_they_say(remarks):
    (line,) = remark_lines([remarks["w43"]])
    assert "“the normal force of the turntable" in line.words
    assert "F_1 " in line.words.replace("$", " ").replace("\\", " ")
    assert line.latex == r"F_{1} = m g \cos \alpha"  # the turntable turns and tilts, no more


@pytest.mark.parametrize(
    ("printed", "plain"),
    [
        (r"a = b, \tag{12}", "a = b"),
        ("$$\na = b.\n$$\n\\n(136)", "a = b"),
        (r"a = \nu b, \quad (7)", r"a = \nu b"),
        (r"x = 2, \text{ (8)}", "x = 2"),
        (r"x = 2,\qquad(145)", "x = 2"),
        (r"y = f(1)", r"y = f(1)"),
    ],
)
def test_numbers_of_equations_are_taken_off(printed, plain):
    assert unnumbered(printed) == plain

"""How a verdict shows itself: in a Python session, as text and as LaTeX; its typed data."""

from __future__ import annotations

import pickle
from dataclasses import replace

import pytest

import polhode as ph
from catalogue.systems import equations
from judge import textbook_systems
from polhode.analyse import NoSteadyMotionError
from polhode.base import LENGTH, MASS, TIME
from polhode.judge import Answer, Read, Verdict
from polhode.judge._verdict import Decides
from polhode.judge.meaning._meaning import UnknownLetterError

HOLDS = Verdict(
    Answer.HOLDS,
    "motion",
    remarks=("taking a as positive",),
    readings=(
        Read(r"\mathbf{L}_{p}", "angular momentum about pivot", "L_p"),
        Read(r"\hat{\mathbf{3}}", "axis 3", "3"),
    ),
)


def test_a_python_session_shows_the_answer_and_what_letters_mean():
    shown = "holds\n  taking a as positive\n  read: L_p as angular momentum about pivot"
    assert str(HOLDS) == shown
    assert repr(HOLDS) == f"Verdict: {shown}"


def test_axes_of_a_body_are_listed_as_data_only():
    assert [read.plain for read in HOLDS.shown_readings] == ["L_p"]
    assert len(HOLDS.readings) == 2


def test_latex_of_a_notebook_says_it_too():
    assert r"\text{read: L\_p as angular momentum about pivot}" in HOLDS._repr_latex_()


def test_how_sure_a_decision_at_random_points_is_stands_beside_the_verdict():
    assert "probability" not in str(HOLDS)
    bounded = replace(HOLDS, error_bound=3e-17)
    sure = "decided by exact evaluation at random points, probability of error below 1e-16"
    assert sure in bounded.notes


def test_a_proposed_reading_says_that_it_is_one():
    read = replace(HOLDS.readings[0], proposed=True)
    assert str(read) == "L_p as angular momentum about pivot (proposed for this part)"
    assert read.to_json() == HOLDS.readings[0].to_json()


def test_evidence_does_not_hide_in_the_representation():
    verdict = ph.check(r"\dot\omega_1 = 1", equations("gyroscope"))
    assert repr(verdict).startswith("Verdict: fails")
    assert "Counterexample(" not in repr(verdict)


# -- what code decides on is data: no reason has to be parsed for it -------------------------------


def test_a_letter_without_a_meaning_is_named_by_the_error() -> None:
    error = ph.check(r"\ddot\theta = -k\theta", textbook_systems.turning_hoop()).error
    assert isinstance(error, UnknownLetterError)
    assert error.symbol == "k"
    assert error.__traceback__ is None  # which would keep alive all that it passed
    again = pickle.loads(pickle.dumps(error))
    assert (type(again), again.symbol, str(again)) == (UnknownLetterError, "k", str(error))


def test_a_member_names_the_dimensions_of_its_terms() -> None:
    verdict = ph.check(r"V = mgR = mg", textbook_systems.turning_hoop())
    (odd,) = verdict.at_odds
    assert odd.member == 1
    assert odd.dimensions == {MASS * LENGTH / TIME**2, MASS * LENGTH**2 / TIME**2}
    assert f"{' and '.join(odd.units)} in member 2" in verdict.reason


@pytest.mark.parametrize(
    ("latex", "answer"), [(r"\omega^2 < g/R", Answer.HOLDS), (r"\omega^2 < 2g/R", Answer.FAILS)]
)
def test_a_threshold_names_the_condition_that_it_was_compared_with(latex, answer) -> None:
    given = {"given": [r"\theta = 0"], "context": "threshold"}
    verdict = ph.check(latex, textbook_systems.turning_hoop(), **given)
    assert verdict.answer is answer
    assert verdict.compared is not None
    assert verdict.compared.decides is Decides.STABILITY
    assert verdict.compared.is_at_fixed_angles
    assert verdict.compared.words in verdict.reason


def test_conditions_that_no_steady_motion_meets_are_an_error_of_their_own() -> None:
    given = {"given": [r"\theta = 1"], "context": "steady"}
    verdict = ph.check(r"V = 0", textbook_systems.rod_pendulum(), **given)
    assert isinstance(verdict.error, NoSteadyMotionError)

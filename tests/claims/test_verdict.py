"""How a verdict shows itself: in a Python session, as text and as LaTeX."""

from __future__ import annotations

from dataclasses import replace

import polhode as ph
from catalogue.systems import equations
from polhode.claims import Answer, Read, Verdict

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

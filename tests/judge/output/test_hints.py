"""Hints: what is withheld is nowhere in the review that is left."""

import json

import pytest

from judge.solutions import solution
from polhode.judge import Correction, Hints, Mark, with_hints
from polhode.judge.output._hints import kind_of_slip
from polhode.judge.output._messages import message


def test_the_solution_has_every_mark():
    assert {line.mark for line in solution().lines} == set(Mark)


def test_with_the_correction_nothing_changes():
    assert with_hints(solution(), Hints.CORRECTION) is solution()


@pytest.mark.parametrize("hints", [Hints.WHERE, Hints.KIND])
def test_places_and_marks_stay(hints):
    for before, after in zip(solution().lines, with_hints(solution(), hints).lines, strict=True):
        assert (after.line, after.column, after.latex) == (before.line, before.column, before.latex)
        assert (after.mark, after.of) == (before.mark, before.of)
        assert after.readings == before.readings


@pytest.mark.parametrize("hints", [Hints.WHERE, Hints.KIND])
def test_the_correction_is_nowhere(hints):
    review = with_hints(solution(), hints)
    error = review.lines[1]
    told = json.dumps(review.to_json()) + message(error, review) + repr(error)
    assert r"\sin\theta" not in json.dumps(error.to_json()) + message(error, review)
    assert "sin" not in message(error, review)
    assert solution().lines[1].verdict.correction.latex not in told
    assert r"\omega_1 = 0" not in told  # the condition that is needed
    assert all(not line.verdict.residuals for line in review.lines if line.mark is not Mark.TRUE)


def test_the_kind_of_slip_is_told_from_the_second_level_on():
    kinds = {hints: with_hints(solution(), hints).lines[1].verdict.correction for hints in Hints}
    assert kinds[Hints.WHERE] is None
    assert kinds[Hints.KIND].what == "wrong function"
    assert kinds[Hints.CORRECTION].what == "cos where sin is right"


def test_a_state_that_refutes_the_line_is_told_from_the_second_level_on():
    states = [with_hints(solution(), hints).lines[1].verdict.counterexample for hints in Hints]
    assert states[0] is None
    assert states[1] is states[2] is not None


def test_why_a_line_was_not_judged_is_always_told():
    for hints in Hints:
        (line,) = (
            line for line in with_hints(solution(), hints).lines if line.mark is Mark.NOT_JUDGED
        )
        assert "l, which has no meaning" in line.reason


@pytest.mark.parametrize(
    ("what", "kind"),
    [
        ("wrong sign", "wrong sign"),
        ("sin where cos is right", "wrong function"),
        (
            "wrong sign; sin where cos is right; cos where sin is right",
            "wrong sign; wrong function",
        ),
    ],
)
def test_the_kind_does_not_say_what_is_right(what, kind):
    assert kind_of_slip(Correction(what, "x")) == kind

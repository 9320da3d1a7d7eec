"""Claims on the pages of the tour: counted, typeset, and never taken for markup."""

from pathlib import Path

import pytest

from polhode.judge import Note, Read
from polhode.tour import TourReport
from polhode.tour._claims import JudgedClaim, counted, formula, judged, verdicts
from polhode.view import Judgement


def claim_with(answer="holds", **changed):
    values = {
        "id": "12",
        "system": "gyroscope/held",
        "stated": r"a < b",
        "is_formula": True,
        "answer": answer,
        "reason": "",
        "correction": "",
        "judgement": Judgement("(12) a < b", answer),
    }
    return JudgedClaim(**{**values, **changed})


def test_a_variant_belongs_to_its_problem():
    assert claim_with().problem == "gyroscope"


def test_verdicts_are_counted():
    claims = [claim_with(), claim_with(), claim_with("fails"), claim_with("unread")]
    assert counted(claims) == "4 claims: 2 hold, 1 fails as printed, 1 could not be read"


def test_a_failure_shows_its_correction_and_why():
    text = verdicts([claim_with("fails", correction="a > b", reason="the sign is wrong")])
    assert text.count("<math") == 2
    assert "should read" in text
    assert "the sign is wrong" in text


def test_words_and_reasons_are_text():
    text = verdicts([claim_with("fails", is_formula=False, stated="<b>x", reason="<i>")])
    assert "<b>" not in text
    assert "<i>" not in text


def test_what_was_read_stands_beside_the_verdict_unfolded():
    notes = (Note("read as", "a > b", is_formula=True), Note("because", "a <sign> is lost"))
    text = verdicts([claim_with(notes=notes)])
    assert text.count("<math") == 2
    assert "read as" in text
    assert "a &lt;sign&gt; is lost" in text
    assert "holds as read" in text
    assert text.count("<details") == 1  # that of all claims


def test_what_letters_mean_stands_beside_the_verdict():
    read = Read(r"\mathbf{L}", "angular momentum about <cm>", "L")
    text = verdicts([claim_with(readings=(read,))])
    assert "𝐋" in text
    assert "as angular momentum about &lt;cm&gt;" in text
    assert "holds as read" not in text


def test_the_convention_of_a_part_stands_once_before_its_claims():
    first = claim_with(part="Statement", convention="θ from 2")
    other = claim_with(part="Solution", convention="θ from 3")
    text = verdicts([first, first, other])
    assert [text.count(c) for c in ("θ from 2", "θ from 3", "<h3>")] == [1, 1, 2]
    assert text.index("θ from 2") < text.index("<article") < text.index("θ from 3")


def test_the_terminal_shows_convention_and_reading_of_what_fails():
    notes = (Note("read as", "a > b", is_formula=True), Note("because", "lost"))
    claim = claim_with("fails", notes=notes, part="Statement", convention="θ from 2", reason="odd")
    lines = TourReport(Path("page"), (), (claim,)).audit_table().splitlines()[2:]
    assert lines[:2] == ["Statement", "  θ from 2"]
    assert [line.strip() for line in lines[3:]] == [
        "printed: a < b",
        "read as: a > b",
        "because: lost",
    ]


@pytest.mark.parametrize("id", ["80", "81", "84", "85", "86", "w22"])
def test_a_damaged_formula_is_judged_as_read_and_says_so(id):
    (claim,) = judged((id,))
    labels = [note.label for note in claim.notes]
    assert labels[:2] == ["read as", "because"]
    assert claim.notes[0].text != claim.stated


def test_two_conventions_of_an_angle_are_both_stated():
    statement, solution = judged(("w15", "w18"))
    assert statement.convention != solution.convention
    assert "angle between axis 2 and the vertical" in statement.convention
    assert "angle between axis 3 and the vertical" in solution.convention


def test_what_cannot_be_typeset_is_printed():
    assert formula(r"\left(").startswith("<")
    assert "left" not in formula(r"\alpha")


def test_nothing_is_said_where_nothing_is_claimed():
    assert verdicts([]) == ""


@pytest.mark.parametrize(("id", "system"), [("1", "spinning-coin")])
def test_judging_gives_text(id, system):
    (claim,) = judged((id,))
    assert claim.problem in (system, claim.problem)
    assert claim.answer == "holds"
    assert claim.is_formula


def test_the_closing_table_counts_by_problem_and_shows_what_fails():
    claims = (
        claim_with(),
        claim_with("fails", id="13", correction="a > b"),
        claim_with("fails", reason="odd"),
    )
    lines = TourReport(Path("page"), (), claims).audit_table().splitlines()
    assert lines[0] == "gyroscope  3 claims: 1 holds, 2 fail as printed"
    assert lines[2].split() == ["13", "fails;", "holds", "as", "a", ">", "b"]
    assert lines[3].endswith("fails; odd")

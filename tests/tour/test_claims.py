"""Claims on the pages of the tour: counted, typeset, and never taken for markup."""

from pathlib import Path

import pytest

from polhode.tour import TourReport
from polhode.tour._claims import Told, judged
from polhode.tour._verdicts import counted, formula, verdicts
from polhode.view import Judgement


def told(answer="holds", **changed):
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
    return Told(**{**values, **changed})


def test_a_variant_belongs_to_its_problem():
    assert told().problem == "gyroscope"


def test_verdicts_are_counted():
    claims = [told(), told(), told("fails"), told("unread")]
    assert counted(claims) == "4 claims: 2 hold, 1 fails as printed, 1 could not be read"


def test_a_failure_shows_its_correction_and_why():
    text = verdicts([told("fails", correction="a > b", reason="the sign is wrong")])
    assert text.count("<math") == 2
    assert "should read" in text
    assert "the sign is wrong" in text


def test_words_and_reasons_are_text():
    text = verdicts([told("fails", is_formula=False, stated="<b>x", reason="<i>")])
    assert "<b>" not in text
    assert "<i>" not in text


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
    claims = (told(), told("fails", id="13", correction="a > b"), told("fails", reason="odd"))
    lines = TourReport(Path("page"), (), claims).audit_table().splitlines()
    assert lines[0] == "gyroscope  3 claims: 1 holds, 2 fail as printed"
    assert lines[2].split() == ["13", "fails;", "holds", "as", "a", ">", "b"]
    assert lines[3].endswith("fails; odd")

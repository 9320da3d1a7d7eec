"""The report for referees: every line once, under what is said of it, and what survives."""

import re
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from judge.output.test_page import ELEMENTS, Page
from judge.solutions import NAME, TEXT, equations, hostile, solution
from polhode.base import digest
from polhode.judge import Mark, referee_html, referee_report

TABLES = {"table", "caption", "thead", "tbody", "tr", "th", "td"}


def section(title):
    """The words of a section of the report on the solution."""
    text = referee_html(solution(), equations())
    found = re.search(rf"<section><h2>{re.escape(title)}</h2>(.*?)</section>", text, re.DOTALL)
    return Page(found[1]).text


def test_every_line_stands_in_it_once():
    page = Page(referee_html(solution(), equations()))
    ids = [attrs["id"] for _, attrs in page.found if "id" in attrs]
    assert sorted(ids) == sorted(f"r{i}" for i in range(len(solution().lines)))


def test_what_survives():
    words = section("Which results survive")
    assert "2 of 4 results hold on the model." in words
    assert "The error in line 9 takes with it line 13." in words
    assert "Final answer, line 24: ? true, but does not follow" in words


def test_what_holds_is_sorted_by_where_it_does():
    words = section("Holds")
    assert words.index("For every state") < words.index("On every true motion")
    assert "line 17" in words[words.index("On every true motion") :]


def test_what_was_not_judged_is_named_with_its_reason():
    assert "no meaning" in section("Not judged")
    assert "1 could not be judged" in Page(referee_html(solution(), equations())).text


def test_it_is_tied_to_the_text_and_the_versions():
    page = Page(referee_html(solution(), equations()))
    assert digest(TEXT)[:16] in page.text
    other = replace(solution(), texts={NAME: TEXT + " "})
    assert digest(TEXT)[:16] not in Page(referee_html(other, equations())).text
    assert "polhode" in section("How it was judged")


def test_a_text_without_errors_has_no_section_for_them():
    true = tuple(line for line in solution().lines if line.mark is Mark.TRUE)
    text = referee_html(replace(solution(), lines=true), equations())
    assert "<h2>Does not hold</h2>" not in text
    assert "<h2>Holds</h2>" in text


def test_no_script_runs_and_nothing_is_fetched():
    assert "<script" not in referee_html(solution(), equations())


@settings(deadline=None)
@given(st.text(max_size=40) | st.sampled_from(["<script>alert(1)</script>", '"><img src=x>']))
def test_nothing_hostile_reaches_the_report(text):
    page = Page(referee_html(hostile(text), equations()))
    assert {tag for tag, _ in page.found} <= ELEMENTS | TABLES


def test_the_report_is_written(tmp_path):
    referee_report(solution(), equations(), tmp_path / "report.html")
    assert (tmp_path / "report.html").read_text("utf-8") == referee_html(solution(), equations())

"""Documents cut short or changed at random: always relations or an error for people."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from judge.source.texts import TEXTS
from polhode.base import PolhodeError
from polhode.judge import read_source

PIECES = [
    "$", "$$", "{", "}", "\\", "\\\\", "&", "%", "#1", "[", "]", "\\[", "\\]", "`", "```", "\n\n",
    "\\begin{align}", "\\end{align}", "\\newcommand", "\\def\\om", "\\let", "\\input{x}", "\\left(",
    "\\right.", "\\begin{cases}", "=", "\\mathfrak{a}", "\\om", "\\qv{", "\\u0041", "\x00", "é",
    "\\verb|", "/-", ".. math::", ":math:`", "\\vphantom{", "\\in", "<=",
]  # fmt: skip


@st.composite
def damaged(draw, text):
    """A text with a few pieces put in, taken out or repeated."""
    for _ in range(draw(st.integers(1, 6))):
        start = draw(st.integers(0, len(text)))
        end = draw(st.integers(start, min(len(text), start + 40)))
        piece = draw(st.one_of(st.sampled_from(PIECES), st.just(text[start:end] * 2), st.just("")))
        text = text[:start] + piece + text[end:]
    return text[: draw(st.integers(0, len(text)))] if draw(st.booleans()) else text


def read_or_refused(text, format):
    lines = text.split("\n")
    try:
        found = read_source(text, format)
    except PolhodeError:
        return
    for relation in found:
        assert relation.read == bool(relation.printed)
        assert relation.read or relation.why
        assert 1 <= relation.line <= len(lines)
        assert 1 <= relation.column <= len(lines[relation.line - 1]) + 1


@pytest.mark.parametrize("format", TEXTS)
@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_damaged_documents_are_read_or_refused(format, data):
    read_or_refused(data.draw(damaged(TEXTS[format])), format)


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([*TEXTS, ".txt"]),
    st.lists(st.one_of(st.sampled_from(PIECES), st.text(max_size=3)), max_size=25).map("".join),
)
def test_garbage_is_read_or_refused(format, text):
    read_or_refused(text, format)


def told(text, format=".tex"):
    return [(r.latex, r.read, r.why) for r in read_source(text, format)]


@pytest.mark.parametrize("format", [".tex", ".md", ".txt"])
def test_a_dollar_sign_that_nothing_closes_is_told_and_pairs_with_none_behind_it(format):
    text = "Here $V = mgh and more\n\nThen $T = 0$ holds. It costs $5 or so, if x = 5.\n\n$ y = 2 $"
    assert told(text, format) == [
        ("V = mgh and more", False, "$ that is not closed"),
        ("T = 0", True, ""),
        ("y = 2", True, ""),
    ]


def test_what_is_opened_behind_an_unclosed_dollar_sign_is_read():
    text = "Here $V = mgh \\begin{align} T &= 0 \\end{align}"
    assert told(text) == [("V = mgh", False, "$ that is not closed"), ("T &= 0", True, "")]


def test_formulas_behind_one_that_is_too_long_are_read():
    (long, *_), (last, is_read, _) = told(f"$V = {'m + ' * 20_000} 0$ and $T = 0$")
    assert long.startswith("V = m + m")
    assert (last, is_read) == ("T = 0", True)


@pytest.mark.parametrize("opener", ["\\section{", "\\newcommand{", "\\newcommand{\\a}[1][x", "$V{"])
def test_what_opens_many_times_and_never_closes_takes_no_long_time(opener):
    assert told(opener * 20_000 + "\n\n$V = m$")[-1] == ("V = m", True, "")

"""Workflow commands: parsed as GitHub's runner does, whatever stands in the text."""

import re
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from judge.solutions import hostile, solution
from polhode.judge import Mark, Review, github_annotations

COMMAND = re.compile(r"::(\w+) ([^:]*)::(.*)")
SIGNS = {"%25": "%", "%0D": "\r", "%0A": "\n", "%3A": ":", "%2C": ","}


def parsed(row):
    """A command as the runner reads it: its name, properties and message."""
    name, properties, text = COMMAND.fullmatch(row).groups()
    pairs = dict(p.split("=", 1) for p in properties.split(","))
    return name, {key: plain(value) for key, value in pairs.items()}, plain(text)


def plain(text):
    return re.sub("%25|%0D|%0A|%3A|%2C", lambda found: SIGNS[found[0]], text)


def test_the_error_stands_on_its_line():
    name, properties, text = parsed(github_annotations(solution()).split("\n")[0])
    assert (name, properties["file"], properties["line"]) == ("error", "disk.tex", "9")
    assert properties["title"] == "polhode: error"
    assert text.startswith("This does not hold on the model. Cos where sin is right; it holds as ")


def test_errors_come_first_since_only_ten_of_a_kind_are_shown():
    names = [parsed(row)[0] for row in github_annotations(solution()).split("\n")]
    assert names == ["error", *["warning"] * 2, *["notice"] * 3]


def test_what_was_not_read_is_told_behind_the_lines():
    last = github_annotations(replace(solution(), notes=("a.tex:1 includes b",))).split("\n")[-1]
    assert parsed(last) == ("warning", {"title": "polhode"}, "a.tex:1 includes b")


def test_lines_that_hold_are_not_annotated():
    true = tuple(line for line in solution().lines if line.mark is Mark.TRUE)
    assert github_annotations(Review("s", (), true)) == ""


@given(
    st.text(max_size=60) | st.sampled_from(["::error::x", "a\r\n::stop-commands::t", "50%0A,b:c"])
)
def test_a_text_can_neither_end_a_property_nor_begin_a_command(text):
    rows = github_annotations(hostile(text)).splitlines()
    assert len(rows) == len(Mark) - 1 + len(hostile(text).notes)
    for row in rows:
        _, properties, _ = parsed(row)
        assert set(properties) in ({"file", "line", "col", "title"}, {"title"})

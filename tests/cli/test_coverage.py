"""The table of the problem set's items in the documentation: every command gives its answer."""

import re
import shlex
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from catalogue.systems import equations
from polhode.catalogue import problem_set
from polhode.judge import Answer, read_document
from polhode.judge._audit import ClaimChecker

PAGE = Path(__file__).parents[2] / "docs" / "coverage.md"
ROW = re.compile(r"^\| (\d+) \|.*\| `polhode (.*?)` \| `(.*?)` \|$", re.MULTILINE)
ROWS = ROW.findall(PAGE.read_text("utf-8"))
JUDGED = [row for row in ROWS if row[1].startswith("audit ")]
OTHERS = [row for row in ROWS if not row[1].startswith("audit ")]
CHECKER = ClaimChecker(equations)


class RefutedError(Exception):
    """Ends the judging of a claim that fails, before a correction is sought: it takes longest."""


@cache
def document():
    return read_document(problem_set())


@cache
def answer_to(name):
    """The verdict on a claim of the problem set, as `polhode audit` gives it."""

    def refuted(_):
        raise RefutedError

    claim = document().claim(name)
    try:
        return CHECKER.verdict(document().part_of(claim), claim, {}, refuted).answer
    except RefutedError:
        return Answer.FAILS


@pytest.fixture(scope="module")
def printed():
    """What commands print, with white space as single blanks; several items share a command."""
    return {}


def test_every_item_is_in_the_table():
    assert list(dict.fromkeys(int(item) for item, _, _ in ROWS)) == list(range(1, 122))


@pytest.mark.parametrize(("item", "command", "answer"), JUDGED, ids=[row[0] for row in JUDGED])
def test_claims_are_judged_as_it_says(item, command, answer):
    names = re.findall(r"--only (\w+)", command)
    assert command == "audit " + " ".join(f"--only {name}" for name in names)
    counts = Counter(answer_to(name) for name in names)
    shown = ", ".join(f"{counts[kind]} {kind.value}" for kind in Answer if counts[kind])
    assert answer == f"{len(names)} claim{'s' if len(names) > 1 else ''}: {shown}", f"item {item}"


@pytest.mark.parametrize(("item", "command", "answer"), OTHERS, ids=[row[0] for row in OTHERS])
def test_an_item_is_answered(polhode, printed, tmp_path, monkeypatch, item, command, answer):
    if command not in printed:
        monkeypatch.chdir(tmp_path)  # where commands write what they draw
        _, out, err = polhode(*shlex.split(command))
        printed[command] = " ".join((out + err).split())
    assert answer in printed[command], f"item {item}"

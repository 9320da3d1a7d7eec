"""The table of the problem set's items in the documentation: every command gives its answer."""

import re
import shlex
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "coverage.md"
ROW = re.compile(r"^\| (\d+) \|.*\| `polhode (.*?)` \| `(.*?)` \|$", re.MULTILINE)
ROWS = ROW.findall(PAGE.read_text("utf-8"))


@pytest.fixture(scope="module")
def answers():
    """Outputs of commands already run, since several items share one."""
    return {}


def test_the_table_was_read():
    assert len(ROWS) > 20


@pytest.mark.parametrize(("item", "command", "answer"), ROWS, ids=[row[0] for row in ROWS])
def test_an_item_is_answered(polhode, answers, item, command, answer):
    if command not in answers:
        _, out, err = polhode(*shlex.split(command))
        answers[command] = out + err
    assert answer in answers[command], f"item {item}"

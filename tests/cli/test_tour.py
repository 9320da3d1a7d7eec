"""`polhode tour`: the report is printed, and a check that does not hold is exit code 1."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from polhode.cli import _tour


@dataclass
class Report:
    page: Path
    all_hold: bool

    def table(self):
        return "the table"

    def audit_table(self):
        return "the verdicts"


@pytest.mark.parametrize(("holds", "expected"), [(True, 0), (False, 1)])
def test_the_report_is_printed_and_decides_the_exit_code(polhode, monkeypatch, holds, expected):
    def write_tour(directory, progress, tell):
        tell("a system")
        progress.advance()
        return Report(directory / "index.html", holds)

    monkeypatch.setattr(_tour, "write_tour", write_tour)
    code, out, err = polhode("tour", "somewhere")
    assert (code, err) == (expected, "")
    assert out == "a system\nthe table\n\nthe verdicts\n\nwritten to somewhere/index.html\n"

"""A page of a run, from the command line."""

import json

from polhode.cli import main


def test_a_page_is_written_and_listed(tmp_path, capsys):
    page = tmp_path / "held.html"
    arguments = ["run", "gyroscope/held", "--duration", "0.1s", "--page", str(page), "--json"]
    assert main(arguments) == 0
    assert json.loads(capsys.readouterr().out)["files"] == [str(page)]
    assert "<title>Gyroscope held fixed</title>" in page.read_text("utf-8")


def test_a_page_that_cannot_be_written_is_refused(tmp_path, capsys):
    page = tmp_path / "nowhere" / "held.html"
    assert main(["run", "gyroscope/held", "--duration", "0.1s", "--page", str(page)]) == 2
    assert "cannot be written" in capsys.readouterr().err

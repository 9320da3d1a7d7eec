"""A page of a run, from the command line."""

import json

from pages import scene_in
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


def test_verdicts_on_what_the_text_claims_stand_on_the_page(tmp_path, capsys):
    page = tmp_path / "held.html"
    arguments = ["run", "gyroscope/held", "--duration", "0.1s", "--page", str(page), "--verdicts"]
    assert main(arguments) == 0
    text = page.read_text("utf-8")
    scene = scene_in(text)
    judged = {found["claim"]: found["verdict"] for found in scene["judgements"]}
    assert judged
    assert set(judged.values()) <= {"holds", "approximate", "definition", "fails"}
    assert all(claim.startswith("(") for claim in judged)


def test_verdicts_are_refused_without_a_page_and_where_nothing_is_claimed(tmp_path, capsys):
    assert main(["run", "gyroscope/held", "--duration", "0.1s", "--verdicts"]) == 2
    assert "--page" in capsys.readouterr().err
    own = tmp_path / "own.py"
    own.write_text(
        "import polhode as ph\n"
        "m, g = ph.symbols('m g', positive=True)\n"
        "lab = ph.Frame('lab')\n"
        "stone = ph.System(ph.point_mass('stone', mass=m, axes=lab), ph.Gravity(g))\n"
    )
    page = tmp_path / "own.html"
    arguments = ["run", f"{own}:stone", "--duration", "1s", "--page", str(page), "--verdicts"]
    assert main(arguments) == 2
    assert "says nothing" in capsys.readouterr().err
    assert not page.exists()

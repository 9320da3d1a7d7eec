"""What polhode review writes: pages, SARIF, annotations, tables; and what it refuses."""

import csv
import json

import pytest

from polhode.base import StopRequested
from polhode.cli import main

TEXT = "The potential energy is $V = m g a \\cos\\theta$ and $\\omega_1 = \\dot\\theta$.\n"
RIGHT = "The potential energy is $V = m g a \\sin\\theta$.\n"


@pytest.fixture
def text(tmp_path, monkeypatch):
    """A solution with an error in its first line, in the folder of the command."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.tex").write_text(TEXT)
    return "a.tex"


def review(*arguments):
    return main(["review", *arguments, "--system", "rolling-disk"])


def test_all_outputs_at_once(text, tmp_path, capsys):
    files = ["--html", "a.html", "--sarif", "a.sarif", "--report", "r.html"]
    assert review(text, *files, "--format", "github") == 1
    out = capsys.readouterr().out
    assert out.startswith("::error file=a.tex,line=1,col=26,title=polhode%3A error::")
    assert len(out.splitlines()) == 1
    assert "where sin is right" in (tmp_path / "a.html").read_text("utf-8")
    (result,) = json.loads((tmp_path / "a.sarif").read_text("utf-8"))["runs"][0]["results"]
    assert result["ruleId"] == "error"
    assert "Which results survive" in (tmp_path / "r.html").read_text("utf-8")


@pytest.mark.parametrize("hints", ["where", "kind"])
def test_hints_hold_for_every_output(text, tmp_path, capsys, hints):
    files = ["--html", "a.html", "--sarif", "a.sarif", "--hints", hints]
    assert review(text, *files, "--json") == 1
    told = capsys.readouterr().out + (tmp_path / "a.sarif").read_text("utf-8")
    words = (tmp_path / "a.html").read_text("utf-8").partition('id="player"')[0]
    assert "sin is right" not in told + words
    assert r"\\sin" not in told
    assert review(text, "--hints", hints, "--format", "github") == 1
    assert "sin is right" not in capsys.readouterr().out
    assert review(text, "--hints", hints) == 1
    assert "sin is right" not in capsys.readouterr().out


def test_tables_of_a_class(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "anna.tex").write_text(RIGHT)
    (tmp_path / "class" / "bob.tex").write_text(TEXT)
    assert review("class", "--marks", "marks.csv", "--workers", "1") == 1
    assert "2 of 2 submissions done: 1 with an error" in capsys.readouterr().out
    with (tmp_path / "marks.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [(row["submission"], row["error"]) for row in rows] == [
        ("class/anna.tex", "0"),
        ("class/bob.tex", "1"),
    ]
    assert review("class", "--marks", "marks.csv", "--workers", "1") == 1
    assert "2 of them in an earlier run" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--html", "a.pdf"], ".pdf files are not written there"),
        (["--sarif", "a.html"], ".html files are not written there"),
        (["--marks", "a.xlsx"], ".xlsx files are not written there"),
        (["--json", "--format", "github"], "both print to stdout"),
        (["--marks", "a.csv", "--html", "b.html"], "--marks alone"),
        (["--report", "a.html", "--hints", "where"], "a report tells all"),
        (["--html", "no/such/folder.html"], "cannot be written"),
        (["--hints", "all"], "'all' is no value of --hints; expected one of where, kind"),
    ],
)
def test_what_does_not_go_together_is_refused(text, capsys, options, says):
    assert review(text, *options) == 2
    assert says in capsys.readouterr().err


def test_a_folder_needs_tables(tmp_path, capsys):
    assert review(str(tmp_path)) == 2
    assert "--marks F.csv reviews folders" in capsys.readouterr().err


def test_tables_need_a_system(text, capsys):
    assert main(["review", text, "--marks", "a.csv"]) == 2
    assert "--system NAME" in capsys.readouterr().err


@pytest.mark.parametrize("marks", ["class/m.csv", "class/one/m.csv", "class/../class/m.csv"])
def test_submissions_cannot_bring_marks_with_them(tmp_path, monkeypatch, capsys, marks):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "class" / "one").mkdir(parents=True)
    (tmp_path / "class" / "a.tex").write_text("$V = mga$\n")
    assert review("class", "--marks", marks) == 2
    assert "outside it" in capsys.readouterr().err


def test_no_control_character_of_a_text_reaches_the_terminal(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "class"
    folder.mkdir()
    monkeypatch.chdir(folder)
    name = "\x1b[31ma\n.tex"
    (folder / name).write_text("$V = \x1b[2J mga$, $V = \\text{\x07}$, \\input{\x1b[3m}")
    (folder / "bad\x1b.tex").write_bytes(b"\xff")
    review(name)
    main(["read", name])
    review("bad\x1b.tex")
    (folder / "named.tex").write_text("% polhode: a\x1b[5mb\n$V = mga$, $V = \x1b[6m mga$\n")
    review("named.tex", "--format", "github")
    main(["review", "named.tex"])
    review(".", "--marks", "../m.csv")
    told = "".join(capsys.readouterr())
    assert "[2J" in told
    assert not set(told) & {"\x1b", "\x07"}


def test_marks_differ_where_standard_output_has_no_signs_for_them(text, monkeypatch):
    import io
    import sys

    narrow = io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="replace")
    monkeypatch.setattr(sys, "stdout", narrow)
    review(text)
    narrow.flush()
    out = narrow.buffer.getvalue().decode("ascii")
    assert "  x    1  V = m g a" in out
    assert "  +    1  \\omega_1" in out


def test_names_of_files_that_are_no_text_are_told_everywhere(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    name = "a\udcff.tex"
    (tmp_path / name).write_text(TEXT + "\\input{b}")
    files = ["--html", "a.html", "--sarif", "a.sarif", "--report", "r.html"]
    assert review(name, *files, "--json") == 1
    (result,) = json.loads((tmp_path / "a.sarif").read_text("utf-8"))["runs"][0]["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "a%FF.tex"


def test_several_final_answers_and_files_without_a_relation_are_told(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.tex").write_text(r"$\boxed{V = mga\sin\theta}$, $\boxed{V = mga\cos\theta}$")
    (tmp_path / "b.tex").write_text("Words alone.")
    assert review("a.tex", "b.tex") == 1
    out = capsys.readouterr().out
    assert "final answer, line 1: true\nfinal answer, line 1: error" in out
    assert "note: no relation was found in b.tex" in out


def test_utf_16_is_named(tmp_path, capsys):
    (tmp_path / "a.tex").write_text("$V = 0$", encoding="utf-16")
    assert review(str(tmp_path / "a.tex")) == 2
    assert "iconv -f utf-16 -t utf-8" in capsys.readouterr().err


def test_no_sign_of_alignment_stands_in_a_message(tmp_path, capsys):
    (tmp_path / "a.tex").write_text(
        r"The potential energy is \begin{align} V &= mga\cos\theta \end{align}"
    )
    assert review(str(tmp_path / "a.tex")) == 1
    assert "it holds as V = mga\\sin\\theta" in capsys.readouterr().out


def test_an_interrupt_keeps_the_parts_that_are_judged(tmp_path, monkeypatch, capsys):
    parts = (rf"\section{{{n}}} $V = mga\sin\theta$." for n in ("One", "Two"))
    (tmp_path / "a.tex").write_text("\n".join(parts))

    class Stopping:
        def begin(self, task, total=None):
            pass

        def advance(self, steps=1):
            raise StopRequested

        def finish(self):
            pass

    monkeypatch.setattr("polhode.cli._review.terminal_progress", Stopping)
    assert review(str(tmp_path / "a.tex")) == 130
    out = capsys.readouterr().out
    assert out.count("V = mga") == 1
    assert "note: interrupted: what stands behind these lines was not reviewed" in out

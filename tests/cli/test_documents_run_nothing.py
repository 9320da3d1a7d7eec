"""A document names systems of the catalogue and no files: whatever it says, no code of it runs."""

import json

import pytest

import polhode as ph

CODE = """
from pathlib import Path
Path(__file__).with_name("ran").touch()
from polhode.catalogue import CATALOGUE
s = CATALOGUE["gyroscope"].build()
"""
TEXT = "$V = Mga\\cos\\theta$\n"


@pytest.fixture
def helper(tmp_path):
    """A Python file with a system, which leaves a mark if it is run."""
    path = tmp_path / "helper.py"
    path.write_text(CODE)
    yield f"{path}:s"
    assert not (tmp_path / "ran").exists()


def notebook(source):
    cell = {"cell_type": "markdown", "metadata": {}, "source": [source, "\n", TEXT]}
    return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 5})


DOCUMENTS = {
    "comment.tex": "% polhode: {}\n" + TEXT,
    "after a section.tex": "\\section{{The end}}\n" + TEXT.replace("}", "}}") + "% polhode: {}\n",
    "comment.md": "<!-- polhode: {} -->\n" + TEXT,
    "front matter.md": "---\npolhode: {}\n---\n" + TEXT,
    "comment.typ": "// polhode: {}\n$ V = M g a cos theta $\n",
    "text.rst": "# polhode: {}\n",
}


@pytest.mark.parametrize("name", [*DOCUMENTS, "notebook.ipynb"])
@pytest.mark.parametrize("outputs", [(), ("--json",), ("--format", "github")])
def test_a_reviewed_text(polhode, tmp_path, helper, name, outputs):
    is_notebook = name.endswith(".ipynb")
    text = notebook(f"<!-- polhode: {helper} -->") if is_notebook else DOCUMENTS[name]
    (tmp_path / name).write_text(text if is_notebook else text.replace("{}", helper))
    code, out, err = polhode("review", str(tmp_path / name), *outputs)
    assert (code, out) == (2, "")
    assert "names the system" in err
    assert helper[:20] in err  # a long name is cut off
    assert "one of 'polhode list'" in err
    assert "--system FILE.py:NAME" in err


@pytest.mark.parametrize(
    "written", ["helper.py", "./helper.py:s", "helper:s", "helper.PY:s", "polhode.catalogue:s"]
)
def test_other_ways_to_write_it(polhode, tmp_path, helper, monkeypatch, written):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.tex").write_text(f"% polhode: {written}\n{TEXT}")
    code, _, err = polhode("review", "a.tex")
    assert code == 2
    assert "names the system" in err


def test_a_misspelt_name_of_the_catalogue_is_told_apart(polhode, tmp_path):
    (tmp_path / "a.tex").write_text(f"% polhode: gyroscop\n{TEXT}")
    code, _, err = polhode("review", str(tmp_path / "a.tex"))
    assert code == 2
    assert "did you mean gyroscope" in err


def test_a_text_cannot_take_the_place_of_the_system_named_by_the_command(polhode, tmp_path, helper):
    (tmp_path / "a.tex").write_text(f"% polhode: {helper}\n{TEXT}")
    code, out, _ = polhode("review", str(tmp_path / "a.tex"), "--system", "gyroscope")
    assert code == 0
    assert f"names {helper} in a comment, but was reviewed on gyroscope" in out


def test_submissions_of_a_class(polhode, tmp_path, helper):
    folder = tmp_path / "handed in"
    folder.mkdir()
    (folder / "a.tex").write_text(f"% polhode: {helper}\n{TEXT}")
    words = ("--system", "gyroscope", "--marks", str(tmp_path / "marks.csv"))
    assert polhode("review", str(folder), *words)[0] == 0


CLAIMS = """schema = 1
[document]
title = "A text"
[[part]]
id = "1"
system = "{}"
[[claim]]
id = "1"
part = "1"
latex = 'V = Mga\\cos\\theta'
"""


def test_a_document_of_claims(polhode, tmp_path, helper):
    (tmp_path / "text.toml").write_text(CLAIMS.replace("{}", helper))
    code, out, err = polhode("audit", str(tmp_path / "text.toml"))
    assert (code, out) == (2, "")
    assert "names the system" in err
    assert "--system FILE.py:NAME" in err


def test_a_document_of_claims_in_python(helper):
    (judged,) = ph.audit(CLAIMS.replace("{}", helper)).judged
    assert judged.verdict.answer.value == "unread"
    assert "names the system" in judged.verdict.reason


def test_the_key_of_an_exercise(polhode, tmp_path, helper):
    number = {"system": helper, "kind": "number", "prompt": "", "values": [1.0], "unit": ""}
    number["tolerance"] = 0.02
    key = {"sheets": [{"student": 1, "answers": {"1": number}}]}
    (tmp_path / "key.json").write_text(json.dumps(key))
    (tmp_path / "a.txt").write_text("1: 1\n")
    words = ("--key", str(tmp_path / "key.json"), "--mark", str(tmp_path / "a.txt"))
    code, out, err = polhode("exercise", *words)
    assert (code, out) == (2, "")
    assert "names the system" in err, err

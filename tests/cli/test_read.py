"""`polhode read`: its document, its words and its exit codes."""

from __future__ import annotations

import json

import pytest

KEYS = ["file", "line", "column", "latex", "read", "printed", "why", "in_scope"]


@pytest.fixture
def text(tmp_path):
    """Writes a file and gives its path."""

    def write(content, name="text.tex"):
        path = tmp_path / name
        path.write_text(content, encoding="utf-8")
        return str(path)

    return write


def test_the_document_has_the_keys_of_the_contract(document, text):
    path = text("Here $a = b$.\n\\[ G(s) = 1 \\]")
    found = document("read", path)
    assert found["schema"] == 3
    first, second = found["relations"]
    assert list(first) == KEYS
    assert first == {
        "file": path,
        "line": 1,
        "column": 7,
        "latex": "a = b",
        "read": True,
        "printed": "a = b",
        "why": None,
        "in_scope": True,
    }
    assert (second["in_scope"], second["why"]) == (False, "out of scope: control")


def test_all_that_was_read_exits_with_zero(polhode, text):
    code, out, err = polhode("read", text("$a = b$"))
    assert (code, err) == (0, "")
    assert out.splitlines()[-1] == "1 relation: 1 read, 0 unread, 0 out of scope"


def test_macros_that_are_defined_nowhere_are_named(polhode, text):
    code, out, _ = polhode("read", text("$a = \\qv$"))
    assert code == 0
    assert "text.tex:1:2: read, with \\qv as printed, defined nowhere\n    a = \\qv\n" in out


def test_a_relation_that_is_not_read_exits_with_two_and_names_the_cause(polhode, text):
    code, out, _ = polhode("read", text("$a = b$\n\n$c = d \\bowtie e$"))
    assert code == 2
    assert "text.tex:3:2: unread: the macro \\bowtie" in out
    assert out.splitlines()[-1] == "2 relations: 1 read, 1 unread, 0 out of scope"


def test_a_damaged_file_is_one_line_and_the_others_are_read(polhode, text):
    bad, good = text("{", "bad.ipynb"), text("$a = b$", "good.md")
    code, out, err = polhode("read", bad, good, "absent.tex", "--json")
    assert code == 2
    assert [relation["printed"] for relation in json.loads(out)["relations"]] == ["a = b"]
    first, second = err.splitlines()
    assert first.startswith("polhode: ")
    assert "damaged in line 1" in first
    assert "absent.tex cannot be read" in second


@pytest.mark.parametrize("name", ["absent.tex", "null\0byte.tex"])
def test_no_count_is_printed_where_no_file_could_be_read(polhode, name):
    code, out, err = polhode("read", name)
    assert (code, out) == (2, "")
    assert err.startswith("polhode: ")
    assert "cannot be read" in err


def test_a_text_without_formulas(polhode, text):
    code, out, err = polhode("read", text("words"))
    assert (code, out, err) == (0, "0 relations: 0 read, 0 unread, 0 out of scope\n", "")


def test_a_file_has_to_be_given(polhode):
    code, out, err = polhode("read")
    assert (code, out) == (2, "")
    assert "FILE" in err

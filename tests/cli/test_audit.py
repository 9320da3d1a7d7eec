"""`polhode audit`: its table, document, page and exit codes."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from polhode.cli import main

HEAD = """schema = 1
[document]
title = "A text"
[[part]]
id = "7"
system = "gyroscope"
"""
RIGHT = r"""[[claim]]
id = "1"
part = "7"
latex = '\dot\omega_1 = 0'
"""
WRONG = r"""[[claim]]
id = "2"
part = "7"
latex = 'F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)'
follows_from = ["1"]
"""
UNREAD = r"""[[claim]]
id = "3"
part = "7"
latex = 'F_z = q'
"""
KEYS = {"id", "system", "latex", "read_as", "verdict", "correction", "reason", "follows_from"}


@pytest.fixture
def audit(tmp_path, capsys):
    """Audits a document of some claims; returns exit code, output and error output."""

    def run(*claims, options=()):
        (tmp_path / "text.toml").write_text("\n".join([HEAD, *claims]))
        code = main(["audit", str(tmp_path / "text.toml"), *options])
        return code, *capsys.readouterr()

    return run


def test_the_document_has_what_the_contract_says(audit):
    code, out, _ = audit(RIGHT, WRONG, UNREAD, options=["--json"])
    document = json.loads(out)
    assert code == 1
    assert document["counts"].items() >= {"holds": 1, "fails": 1, "unread": 1}.items()
    assert document["seconds"] > 0
    assert all(claim.keys() >= KEYS for claim in document["claims"])


def test_the_page_on_the_format_lists_every_key(audit, capsys):
    page = Path(__file__).parents[2] / "docs" / "claims-format.md"
    rows = dict(
        re.findall(r"^\| `(check|audit)` \| (.*) \|$", page.read_text("utf-8"), re.MULTILINE)
    )
    listed = {
        name: set(re.findall(r"\w+", " ".join(re.findall("`(.*?)`", row))))
        for name, row in rows.items()
    }
    document = json.loads(audit(RIGHT, options=["--json"])[1])
    made_with = {"schema", "versions", "seed"}
    assert listed["audit"] == (document.keys() | document["claims"][0].keys()) - made_with
    main(["check", "gyroscope", "E = T + V", "--json"])
    assert listed["check"] == json.loads(capsys.readouterr().out).keys() - made_with


def test_several_ids_may_stand_in_one_option(audit):
    assert "2 claims: 1 holds, 1 fails" in audit(RIGHT, WRONG, UNREAD, options=["--only", "1,2"])[1]


def test_a_document_without_claims_says_so(audit):
    code, out, _ = audit()
    assert (code, out.strip()) == (0, "no claims judged")


def test_exit_code_zero_if_all_selected_claims_hold(audit):
    code, out, _ = audit(RIGHT, WRONG, options=["--only", "1"])
    assert code == 0
    assert "1 claim: 1 holds" in out


def test_unread_claims_give_exit_code_two(audit):
    assert audit(RIGHT, UNREAD)[0] == 2


def test_a_page_is_written_that_needs_nothing_else(audit, tmp_path):
    wrong = WRONG.replace('follows_from = ["1"]', "")
    assert audit(wrong, options=["--html", str(tmp_path / "page.html")])[0] == 1
    page = (tmp_path / "page.html").read_text()
    assert "<math" in page
    assert 'class="changed"' in page
    assert "<script" not in page
    assert "http://" not in page.replace("http://www.w3.org/1998/Math/MathML", "")


def test_the_page_shows_what_was_read_beside_the_verdict_and_not_folded(audit, tmp_path):
    lost = RIGHT.replace(r"'\dot\omega_1", r"'\omega_1") + (
        "read_as = '\\dot\\omega_1 = 0'\nreason = 'a dot is lost'\n"
    )
    head = 'convention = "Axis 1 is the axle."\n'
    assert audit(head, lost, options=["--html", str(tmp_path / "page.html")])[0] == 0
    page = (tmp_path / "page.html").read_text()
    seen = re.sub("<details>.*?</details>", "", page, flags=re.DOTALL)
    assert "Axis 1 is the axle." in seen
    assert "read as" in seen
    assert "a dot is lost" in seen
    assert "holds as read" in seen
    assert "˙" in seen.partition("read as")[2]


@pytest.mark.parametrize("words", [["--only", "no-such"], ["nowhere.toml"]])
def test_bad_input_is_refused(words, capsys):
    assert main(["audit", *words]) == 2
    assert capsys.readouterr().err.startswith("polhode: ")


@pytest.mark.parametrize(
    ("called", "option"), [("top", "{}"), ("wheel", "wheel={}"), ("a.py:b", "a.py:b={}")]
)
def test_a_system_of_the_command_line_is_found(tmp_path, capsys, called, option):
    (tmp_path / "top.py").write_text(
        "import polhode as ph\n"
        "from polhode.catalogue import CATALOGUE\n"
        "top = CATALOGUE['gyroscope'].build()\n"
    )
    text = HEAD.replace('"gyroscope"', f'"{called}"') + RIGHT
    (tmp_path / "text.toml").write_text(text)
    own = option.format(f"{tmp_path / 'top.py'}:top")
    assert main(["audit", str(tmp_path / "text.toml"), "--system", own]) == 0
    assert "holds" in capsys.readouterr().out

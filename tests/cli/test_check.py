"""`polhode check`: its document, its words and its exit codes."""

from __future__ import annotations

import json

import pytest

from polhode.cli._main import main

WRONG = r"F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)"
KEYS = {"verdict", "correction", "alternatives", "counterexample", "order", "dropped"}


def test_a_failure_exits_with_one_and_gives_its_evidence(capsys):
    assert main(["check", "gyroscope", WRONG, "--json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document.keys() >= KEYS | {"residual", "reason"}
    assert document["verdict"] == "fails"
    assert document["correction"]["what"] == "wrong sign"
    assert document["confirmation"]["agrees"]


@pytest.mark.parametrize(("latex", "code"), [(r"\dot\omega_1 = 0", 0), (r"F_z = q", 2)])
def test_exit_codes_of_true_and_unread_claims(latex, code, capsys):
    assert main(["check", "gyroscope", latex]) == code
    assert capsys.readouterr().out

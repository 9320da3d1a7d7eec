"""`polhode check`: its document, its words and its exit codes."""

from __future__ import annotations

import json
import signal

import pytest

from polhode.cli import _check
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


def test_what_cannot_be_decided_in_time_is_given_up(capsys, monkeypatch):
    def endless(*_, **__):
        while True:
            pass

    monkeypatch.setattr(_check, "check", endless)
    monkeypatch.setattr(_check, "_LONGEST", 0.1)
    assert main(["check", "gyroscope", "F_z = M g"]) == 2
    assert "more than 0.1 s of computing" in capsys.readouterr().err
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)

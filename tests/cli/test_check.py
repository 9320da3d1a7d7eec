"""`polhode check`: its document, its words and its exit codes."""

from __future__ import annotations

import json
import os
import signal
from collections import deque
from itertools import count

import pytest

from polhode.cli import _check
from polhode.cli._main import main
from polhode.cli._systems import entry_of
from polhode.derive import derive
from polhode.judge import Answer, CheckRequest, Verdict, check

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


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["F_z = q"], "--let"),
        ([r"\left.\dot\theta\right|_{\theta=0} = 0"], "--given"),
        ([r"\theta = 1", "--context", "limit"], "--small"),
        ([r"\theta = 1", "--context", "number"], "--given"),
    ],
)
def test_the_shell_names_the_option_that_python_and_the_lab_do_not_have(words, option, capsys):
    assert main(["check", "gyroscope", *words]) == 2
    assert capsys.readouterr().out.rstrip().endswith(f"({option})")
    context = words[2] if len(words) > 1 else "motion"
    assert (
        "--" not in check(words[0], derive(entry_of("gyroscope").build()), context=context).reason
    )


def test_an_empty_equation_is_refused_with_an_example(capsys):
    assert main(["check", "gyroscope", " "]) == 2
    assert "polhode check gyroscope 'E = T + V'" in capsys.readouterr().err


def python(*_, **__):
    while True:
        pass


def compiled(*_, **__):
    deque(count(), maxlen=0)  # never comes back to Python, and heeds no signal handler


@pytest.mark.parametrize("endless", [python, compiled])
def test_a_check_that_takes_too_long_is_abandoned(endless, capsys, monkeypatch):
    monkeypatch.setattr(CheckRequest, "judged", endless)
    monkeypatch.setattr(_check, "_LONGEST", 0.1)
    assert main(["check", "gyroscope", "F_z = M g"]) == 2
    assert "more than 0.1 s of computing" in capsys.readouterr().err


def test_a_failure_is_reported_even_if_no_correction_is_found_in_time(capsys, monkeypatch):
    def failing(enquiry, equations, tell):
        tell(Verdict(Answer.FAILS, "motion", reason="for a reason"))
        compiled()

    monkeypatch.setattr(CheckRequest, "judged", failing)
    monkeypatch.setattr(_check, "_LONGEST", 2.0)
    assert main(["check", "gyroscope", "F_z = M g"]) == 1
    printed = capsys.readouterr().out
    assert "for a reason" in printed
    assert "looking for a correction took more than 2 s" in printed


def test_a_process_that_dies_is_reported(capsys, monkeypatch):
    monkeypatch.setattr(
        CheckRequest, "judged", lambda *_, **__: os.kill(os.getpid(), signal.SIGKILL)
    )
    assert main(["check", "gyroscope", "F_z = M g"]) == 2
    assert "less memory" in capsys.readouterr().err


@pytest.fixture
def interruptible():
    """As from a terminal: what is started in the background ignores interruptions."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_an_interruption_ends_the_process_that_judges(capsys, monkeypatch):
    def interrupting(*_, **__):
        os.kill(os.getppid(), signal.SIGINT)
        compiled()

    monkeypatch.setattr(CheckRequest, "judged", interrupting)
    assert main(["check", "gyroscope", "F_z = M g"]) == 130
    assert "interrupted" in capsys.readouterr().err


def test_where_a_process_cannot_fork_it_is_interrupted(capsys, monkeypatch):
    monkeypatch.setenv("POLHODE_DEBUG", "1")
    monkeypatch.setattr(CheckRequest, "judged", python)
    monkeypatch.setattr(_check, "_LONGEST", 0.1)
    assert main(["check", "gyroscope", "F_z = M g"]) == 2
    assert "more than 0.1 s of computing" in capsys.readouterr().err
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)


def test_letters_of_the_catalogue_stand_for_constants(polhode):
    """The radius of the gyrocompass, on which its moments of inertia depend, is no acceleration."""
    words = ("check", "gyrocompass", r"I_3\dot\omega_3 = ma^2\dot\omega_3", "--given", "I_3=m*a**2")
    code, out, _ = polhode(*words)
    assert (code, out.split()[0]) == (0, "holds")


def test_a_claim_on_slipping(document, polhode):
    """Whatever the friction, the path on a surface at rest is a parabola while the ball slips."""
    at_rest = [f"{dots} {f}=0" for dots in (r"\dot", r"\ddot") for f in ("X", "Y", r"\chi")]
    given = [word for text in at_rest for word in ("--given", text)]
    parabola = r"\frac{d^2\mathbf{v}}{dt^2} = 0"
    found = document("check", "ball-on-paper", "--mu", "mu", parabola, *given)
    assert found["verdict"] == "holds"
    assert "while the contacts slip" in found["remarks"]

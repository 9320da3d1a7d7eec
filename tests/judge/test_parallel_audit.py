"""Claims judged in processes of their own: the same verdicts, and bounds that hold."""

from __future__ import annotations

import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, Claim, ClaimLimits, Document, Part, audit_apart, report_on

PART = Part("7", "Gyroscope", "gyroscope")
FREE = Part("5", "Racquet", "tennis-racquet")
WRONG = Claim("b", "7", latex=r"F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)")
RIGHT = Claim("a", "7", latex=r"\dot\omega_1 = 0")
EULER = Claim("c", "5", latex=r"I_1\dot\omega_1 = (I_2 - I_3)\omega_2\omega_3")
ENDLESS = Claim("e", "7", latex=r"(\theta + \phi + \omega_1 + M + a + g)^{300} = 0")


class Tired:
    """A listener who has heard enough after some claims."""

    def __init__(self, claims):
        self.left = claims

    def begin(self, task, total=None):
        pass

    def advance(self, steps=1):
        self.left -= steps
        if not self.left:
            raise KeyboardInterrupt

    def finish(self):
        pass


def declared(name):
    return PROBLEM_SET[name].build()


def document(*claims):
    return Document("A text", "", (PART, FREE), claims)


def test_the_verdicts_are_those_of_one_process():
    text = document(RIGHT, WRONG, EULER)
    apart = audit_apart(text, declared)
    assert apart.judged == report_on(text, lambda name: ph.derive(declared(name))).judged
    assert [j.answer for j in apart.judged] == [Answer.HOLDS, Answer.FAILS, Answer.HOLDS]


def test_a_claim_that_takes_too_long_is_given_up_and_the_others_go_on():
    bounds = ClaimLimits(seconds=20.0, memory=1 << 40)
    report = audit_apart(document(ENDLESS, RIGHT), declared, workers=1, limits=bounds)
    endless, right = report.judged
    assert endless.answer is Answer.UNREAD
    assert endless.verdict.reason
    assert right.answer is Answer.HOLDS


def test_an_interruption_keeps_what_is_judged():
    report = audit_apart(document(RIGHT, WRONG, EULER), declared, workers=1, progress=Tired(1))
    assert len(report.judged) == 1
    assert len(report.left) == 2
    assert "2 not reached" in report.total()


def test_fewer_workers_than_one_are_refused():
    with pytest.raises(ph.DeclarationError):
        audit_apart(document(RIGHT), declared, workers=0)


def test_a_system_that_is_not_there_leaves_its_claims_unread():
    report = ph.audit(Document("", "", (Part("x", "", "wheel"),), (Claim("1", "x", latex="1=1"),)))
    assert report.judged[0].answer is Answer.UNREAD
    assert "wheel" in report.judged[0].verdict.reason

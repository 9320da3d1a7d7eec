"""A small document judged whole."""

from __future__ import annotations

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.claims import Answer, Claim, Definition, Document, Part
from polhode.claims._audit import audit

PART = Part("7", "Gyroscope", "gyroscope", definitions=(Definition(r"I_{2p} = I_2 + Ma^2"),))
CLAIMS = (
    Claim("a", "7", latex=r"F_\phi = Ma(\ddot\phi\sin\theta + 2\dot\phi\dot\theta\cos\theta)"),
    Claim("b", "7", latex=r"F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)"),
    Claim("c", "7", latex=r"F_z = q", follows_from=("b",)),
)
DOCUMENT = Document("A text", "by hand", (PART,), CLAIMS)


def equations_of(name: str) -> ph.Equations:
    return ph.derive(CATALOGUE[name].build())


def test_every_claim_gets_its_verdict_and_consequences_are_told():
    report = audit(DOCUMENT, equations_of)
    answers = {j.claim.id: j.verdict.answer for j in report.judged}
    assert answers == {"a": Answer.HOLDS, "b": Answer.FAILS, "c": Answer.UNREAD}
    assert report.judged[2].fed_by == ("b",)
    assert report.counts["fails"] == 1
    assert "fails; wrong sign" in str(report)


def test_some_claims_can_be_asked_for():
    report = audit(DOCUMENT, equations_of, only=["a"])
    assert [j.claim.id for j in report.judged] == ["a"]


def test_an_unknown_claim_is_refused():
    with pytest.raises(ph.ParseError):
        audit(DOCUMENT, equations_of, only=["z"])

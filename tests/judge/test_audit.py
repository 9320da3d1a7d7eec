"""All claims of a small document judged."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.judge import Answer, Claim, Definition, Document, Part
from polhode.judge._audit import report_on

PART = Part("7", "Gyroscope", "gyroscope", definitions=(Definition(r"I_{2p} = I_2 + Ma^2"),))
CLAIMS = (
    Claim("a", "7", latex=r"F_\phi = Ma(\ddot\phi\sin\theta + 2\dot\phi\dot\theta\cos\theta)"),
    Claim("b", "7", latex=r"F_z = Mg + Ma(\ddot\theta\sin\theta + \dot\theta^2\cos\theta)"),
    Claim("c", "7", latex=r"F_z = q", follows_from=("b",)),
)
DOCUMENT = Document("A text", "by hand", (PART,), CLAIMS)


def test_every_claim_gets_its_verdict_and_consequences_are_listed():
    report = report_on(DOCUMENT, equations)
    answers = {j.claim.id: j.verdict.answer for j in report.judged}
    assert answers == {"a": Answer.HOLDS, "b": Answer.FAILS, "c": Answer.UNREAD}
    assert report.judged[2].fed_by == ("b",)
    assert report.counts["fails"] == 1
    assert "fails       wrong sign" in str(report)


def test_the_consequences_of_a_failure_are_listed():
    (drawn,) = report_on(DOCUMENT, equations).consequences
    assert (drawn.failed, drawn.feeds, drawn.results, drawn.surviving) == ("b", ("c",), ("c",), ())
    assert "(b) feeds (c); results that do not: (c)" in str(drawn)


def test_a_result_that_holds_survives_the_failure_it_was_derived_from():
    wrong = Claim("1", "7", latex=r"F_z = 2Mg")
    right = Claim("2", "7", latex=r"\dot\omega_1 = 0", follows_from=("1",))
    report = report_on(Document("A text", "", (PART,), (wrong, right)), equations)
    assert report.consequences[0].surviving == ("2",)
    assert "results that survive: (2)" in report.table()


def test_the_document_of_a_report_is_plain():
    document = json.loads(json.dumps(report_on(DOCUMENT, equations).to_json()))
    assert document["counts"]["fails"] == 1
    claim = document["claims"][1]
    assert claim["verdict"] == "fails"
    assert claim["correction"]["what"] == "wrong sign"
    assert document["claims"][2]["follows_from"] == ["b"]


def test_the_short_table_counts_by_part_and_shows_what_fails():
    short = report_on(DOCUMENT, equations).short_table()
    assert "Gyroscope  1 holds, 1 fails, 1 unread" in short
    assert "wrong sign" in short


def test_the_table_shows_what_was_read_and_by_which_convention():
    part = Part("7", "Gyroscope", "gyroscope", convention="Axis 1 is the axle.")
    claims = (
        Claim("1", "7", latex=r"\omega_1 = 0", read_as=r"\dot\omega_1 = 0", reason="a dot is lost"),
        Claim("2", "7", words="the spin stays", means=r"\dot\omega_1 = 0"),
        Claim("3", "7", latex=r"\dot\phi = 0", given=(r"\dot\phi = 0",)),
    )
    table = report_on(Document("A text", "", (part,), claims), equations).table()
    lines = [line.strip() for line in table.splitlines()]
    assert lines[:2] == ["Gyroscope", "Axis 1 is the axle."]
    assert lines[3:6] == [
        r"printed: \omega_1 = 0",
        r"read as: \dot\omega_1 = 0",
        "because: a dot is lost",
    ]
    assert lines[7:9] == ["in words: the spin stays", r"read as: \dot\omega_1 = 0"]
    assert lines[10:12] == [r"printed: \dot\phi = 0", r"given: \dot\phi = 0"]


def test_how_sure_all_identities_together_are_is_said_once():
    report = report_on(DOCUMENT, equations)
    unbounded = replace(
        report,
        judged=tuple(
            replace(j, verdict=replace(j.verdict, error_bound=None)) for j in report.judged
        ),
    )
    assert "probability" not in unbounded.table()
    bounded = replace(
        report,
        judged=tuple(
            replace(j, verdict=replace(j.verdict, error_bound=2e-18)) for j in report.judged
        ),
    )
    assert bounded.table().count("probability of error below 1e-17") == 1


def test_single_claims_can_be_judged():
    report = report_on(DOCUMENT, equations, only=["a"])
    assert [j.claim.id for j in report.judged] == ["a"]


def test_an_unknown_claim_is_refused():
    with pytest.raises(ph.ParseError):
        report_on(DOCUMENT, equations, only=["z"])

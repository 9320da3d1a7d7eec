"""SARIF: properties and values that the standard demands, places, and fixes to apply.

Section numbers are those of the OASIS standard, SARIF Version 2.1.0.
"""

import json
from dataclasses import replace
from urllib.parse import urlparse

import pytest
from hypothesis import given
from hypothesis import strategies as st

from judge.solutions import NAME, TEXT, hostile, solution
from polhode.judge import Hints, Mark, Review, sarif, with_hints, write_sarif

KINDS = {"pass", "open", "informational", "notApplicable", "review", "fail"}  # 3.27.9
LEVELS = {"none", "note", "warning", "error"}  # 3.27.10


def check_log(log):
    """What the standard demands of the objects that are used."""
    assert set(log) == {"$schema", "version", "runs"}
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    assert set(run) == {
        "tool", "columnKind", "artifacts", "results", "invocations", "properties"
    }  # fmt: skip
    (invocation,) = run["invocations"]
    assert isinstance(invocation["executionSuccessful"], bool)  # 3.20.14
    for notification in invocation["toolExecutionNotifications"]:  # 3.58
        assert notification["level"] in LEVELS
        assert isinstance(notification["message"]["text"], str)
    assert run["columnKind"] in ("utf16CodeUnits", "unicodeCodePoints")
    driver = run["tool"]["driver"]
    assert set(driver) == {"name", "version", "rules"}
    ids = [rule["id"] for rule in driver["rules"]]
    assert len(set(ids)) == len(ids)
    for result in run["results"]:
        assert set(result) <= {
            "ruleId", "ruleIndex", "kind", "level", "message", "locations", "partialFingerprints",
            "relatedLocations", "fixes",
        }  # fmt: skip
        assert ids[result["ruleIndex"]] == result["ruleId"]
        assert result["kind"] in KINDS
        assert result["level"] in LEVELS
        # 3.27.10: a level other than "none" demands the kind "fail", and "fail" such a level.
        assert (result["kind"] == "fail") == (result["level"] != "none")
        assert isinstance(result["message"]["text"], str)
        for location in (*result["locations"], *result.get("relatedLocations", [])):
            place = location["physicalLocation"]
            urlparse(place["artifactLocation"]["uri"])
            check_region(place["region"])
        for fix in result.get("fixes", []):
            assert fix["description"]["text"]
            for change in fix["artifactChanges"]:
                assert change["replacements"]
                for replacement in change["replacements"]:
                    check_region(replacement["deletedRegion"])


def check_region(region):
    assert set(region) in (
        {"startLine", "startColumn"},
        {"startLine", "startColumn", "endLine", "endColumn"},
    )
    assert all(isinstance(number, int) and number >= 1 for number in region.values())
    end = (region.get("endLine", region["startLine"]), region.get("endColumn", 10**9))
    assert (region["startLine"], region["startColumn"]) <= end


def part(text, region):
    """What stands in a region of a text."""
    lines = text.split("\n")[region["startLine"] - 1 : region["endLine"]]
    lines[-1] = lines[-1][: region["endColumn"] - 1]
    lines[0] = lines[0][region["startColumn"] - 1 :]
    return "\n".join(lines)


def results(review):
    return sarif(review)["runs"][0]["results"]


def test_the_log_keeps_to_the_standard():
    check_log(sarif(solution()))
    for hints in Hints:
        check_log(sarif(with_hints(solution(), hints)))


@given(st.text(max_size=60))
def test_whatever_stands_in_the_text(text):
    log = sarif(hostile(text))
    check_log(log)
    assert json.loads(json.dumps(log)) == log


def test_every_line_that_is_not_simply_true_is_a_result():
    assert [result["ruleId"] for result in results(solution())] == [
        line.mark.value for line in solution().lines if line.mark is not Mark.TRUE
    ]


def test_a_region_holds_the_relation():
    lines = [line for line in solution().lines if line.mark is not Mark.TRUE]
    for line, result in zip(lines, results(solution()), strict=True):
        region = result["locations"][0]["physicalLocation"]["region"]
        assert part(TEXT, region) == line.latex


def test_a_relation_over_several_lines_ends_where_it_does():
    line = replace(solution().lines[1], line=3, column=5, latex="a\n  = b")
    region = results(Review("s", (), (line,)))[0]["locations"][0]["physicalLocation"]["region"]
    assert region == {"startLine": 3, "startColumn": 5, "endLine": 4, "endColumn": 6}


@pytest.mark.parametrize("name", ["a.ipynb", "a.typ"])
def test_where_lines_are_escaped_or_translated_only_the_beginning_is_known(name):
    line = replace(solution().lines[1], file=name, latex="a = b")
    (result,) = results(Review("s", (), (line,)))
    assert "endLine" not in result["locations"][0]["physicalLocation"]["region"]
    assert "fixes" not in result


def test_a_line_that_follows_names_the_wrong_one():
    (result,) = (r for r in results(solution()) if r["ruleId"] == "follows")
    (related,) = result["relatedLocations"]
    assert related["physicalLocation"]["region"]["startLine"] == solution().lines[1].line
    assert "line 9" in result["message"]["text"]


def test_a_fix_puts_the_correction_in_place_of_the_relation():
    line = replace(solution().lines[1], latex=solution().lines[1].latex.replace("&", ""))
    (result,) = results(Review("s", (), (line,)))
    (change,) = result["fixes"][0]["artifactChanges"]
    (replacement,) = change["replacements"]
    assert replacement["insertedContent"]["text"] == line.verdict.correction.latex


def test_no_fix_takes_away_the_signs_of_an_alignment():
    assert "&" in solution().lines[1].latex
    assert all("fixes" not in r for r in results(solution()) if r["ruleId"] == "error")


def test_a_fingerprint_survives_lines_added_above_and_tells_repetitions_apart():
    first = solution().lines[1]
    moved = replace(first, line=first.line + 7)
    twice = results(Review("s", (), (first, moved)))
    alone = results(Review("s", (), (moved,)))
    prints = [r["partialFingerprints"]["relation/v1"] for r in (*twice, *alone)]
    assert prints[0] == prints[2] != prints[1]


def test_names_of_files_are_addresses(tmp_path):
    line = replace(solution().lines[1], file="week 3/Ü#1.tex")
    place = results(Review("s", (), (line,)))[0]["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == "week%203/%C3%9C%231.tex"
    line = replace(line, file=str(tmp_path / "a.tex"))
    place = results(Review("s", (), (line,)))[0]["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"].startswith("file:///")


def test_the_file_is_written(tmp_path):
    write_sarif(solution(), tmp_path / "marks.sarif")
    assert json.loads((tmp_path / "marks.sarif").read_text("utf-8")) == sarif(solution())
    assert NAME in (tmp_path / "marks.sarif").read_text("utf-8")

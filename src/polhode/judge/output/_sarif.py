"""A review as SARIF 2.1.0, which editors and code-scanning services show on the source lines.

Standard: OASIS, Static Analysis Results Interchange Format (SARIF) Version 2.1.0.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from pathlib import Path, PurePath
from typing import Any
from urllib.parse import quote

from polhode.base import installed_version, write_whole
from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge.output._messages import TITLES, message

_SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)
# Formats in which the LaTeX of a relation is not what stands in the file: escaped, or translated.
_OTHERWISE = (".ipynb", ".typ")
# Lines that hold are no result. "open" says that what is known does not suffice for an answer; the
# standard then demands the level "none".
_KINDS = {
    Mark.ERROR: ("fail", "error"),
    Mark.DOUBT: ("fail", "note"),
    Mark.FOLLOWS: ("fail", "note"),
    Mark.UNLINKED: ("fail", "warning"),
    Mark.NEEDS: ("fail", "warning"),
    Mark.NOT_JUDGED: ("open", "none"),
}
_RULES = {
    Mark.ERROR: "A relation that is proved to be wrong by itself",
    Mark.DOUBT: "A relation that does not hold as it was read, without a proof that it is a slip",
    Mark.FOLLOWS: "A relation that is wrong only because an earlier one is",
    Mark.UNLINKED: "A true relation that does not follow from the wrong one it is drawn from",
    Mark.NEEDS: "A relation that is true under a condition, or in a reading, that is not stated",
    Mark.NOT_JUDGED: "A relation that could not be judged",
}


def write_sarif(review: Review, path: str | Path) -> None:
    """Write a review as a SARIF file.

    Raises:
        StoreError: where it cannot be written.
    """
    text = json.dumps(sarif(review), ensure_ascii=False, indent=2)
    write_whole(Path(path), f"{text}\n".encode("utf-8", "replace"))


def sarif(review: Review) -> dict[str, Any]:
    """A review as a SARIF log: a result for every line that is not simply true."""
    rules = list(_KINDS)
    driver = {
        "name": "polhode",
        "version": installed_version("polhode") or "0",
        "rules": [_rule(mark) for mark in rules],
    }
    results = [
        _result(line, review, rules.index(line.mark))
        for line in review.lines
        if line.mark is not Mark.TRUE
    ]
    notes = [{"level": "warning", "message": {"text": note}} for note in review.notes]
    run = {
        "tool": {"driver": driver},
        # Columns count characters, as Python does, whatever the encoding.
        "columnKind": "unicodeCodePoints",
        "artifacts": [{"location": _location(name)} for name in review.files],
        "results": results,
        "invocations": [{"executionSuccessful": True, "toolExecutionNotifications": notes}],
        "properties": {"system": review.system},
    }
    return {"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}


def _rule(mark: Mark) -> dict[str, Any]:
    _, level = _KINDS[mark]
    return {
        "id": mark.value,
        "name": "".join(word.capitalize() for word in mark.value.split("-")),
        "shortDescription": {"text": TITLES[mark]},
        "fullDescription": {"text": _RULES[mark]},
        "defaultConfiguration": {"level": level},
    }


def _result(line: ReviewedLine, review: Review, rule: int) -> dict[str, Any]:
    kind, level = _KINDS[line.mark]
    result: dict[str, Any] = {
        "ruleId": line.mark.value,
        "ruleIndex": rule,
        "kind": kind,
        "level": level,
        "message": {"text": message(line, review)},
        "locations": [{"physicalLocation": _place(line)}],
        "partialFingerprints": {"relation/v1": _fingerprint(line, review)},
    }
    if line.of is not None:
        related = {
            "id": 1,
            "physicalLocation": _place(review.lines[line.of]),
            "message": {"text": "the wrong line that this refers to"},
        }
        result["relatedLocations"] = [related]
    if fixes := list(_fixes(line)):
        result["fixes"] = fixes
    return result


def _place(line: ReviewedLine) -> dict[str, Any]:
    return {"artifactLocation": _location(line.file), "region": _region(line)}


def _region(line: ReviewedLine) -> dict[str, int]:
    """Where it begins, and where it ends if the file has it character by character."""
    begin = {"startLine": line.line, "startColumn": line.column}
    if PurePath(line.file).suffix.lower() in _OTHERWISE:
        return begin
    *before, last = line.latex.split("\n")
    column = len(last) + (1 if before else line.column)
    return {**begin, "endLine": line.line + len(before), "endColumn": column}


def _location(name: str) -> dict[str, str]:
    """The URI of a file: relative to the folder in which the command was run, unless absolute."""
    path = PurePath(name)
    return {"uri": path.as_uri() if path.is_absolute() else quote(os.fsencode(path.as_posix()))}


def _fingerprint(line: ReviewedLine, review: Review) -> str:
    """What stays the same while lines are added above: the relation, and which one of several."""
    same = [other for other in review.lines if (other.file, other.latex) == (line.file, line.latex)]
    number = next(i for i, other in enumerate(same) if other is line)
    text = "\0".join([line.file, line.mark.value, line.latex, str(number)])
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:32]


def _fixes(line: ReviewedLine) -> Iterator[dict[str, Any]]:
    """The correction in place of the relation, if no sign of alignment would be lost with it."""
    region = _region(line)
    verdict = line.verdict
    if verdict is None or "endLine" not in region or "&" in line.latex or r"\\" in line.latex:
        return
    for correction in filter(None, [verdict.correction, *verdict.alternatives]):
        if correction.latex:
            text = {"text": correction.latex}
            change = {
                "artifactLocation": _location(line.file),
                "replacements": [{"deletedRegion": region, "insertedContent": text}],
            }
            yield {"description": {"text": correction.what}, "artifactChanges": [change]}

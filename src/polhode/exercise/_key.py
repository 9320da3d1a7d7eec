"""Keys: what the answers to sheets are marked by, and answers of students marked."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from polhode.base import ParseError, StoreError, provenance, read_whole
from polhode.derive import Equations
from polhode.exercise._answers import (
    ExpectedAnswer,
    MarkedPart,
    PartMark,
    expected_from,
    marked_part,
)
from polhode.exercise._sheet import ExerciseSheet

_ANSWER = re.compile(r"^[\s>*-]*\**(?P<id>\d+(?:\.\d+)?[a-h]?)\**\s*:\s?(?P<text>.*)$")
_STUDENT = re.compile(
    r"\(sheet\s+-?\d+\.(?P<student>\d+)\)|^\W*student\s*:\s*(?P<own>\d+)",
    re.IGNORECASE | re.MULTILINE,
)
_HEADING = re.compile(r"^\s*#")
_MOST_DIGITS = 9  # Python refuses to read a number of thousands
_SUBMITTED = "a text, a Markdown file or a notebook"


@dataclass(frozen=True)
class KeyEntry:
    """What one answer is marked by.

    Attributes:
        system: name of the system that it is about.
        expected: the answer.
    """

    system: str
    expected: ExpectedAnswer


#: The entries of a key, by student and id.
Key = Mapping[int, Mapping[str, KeyEntry]]


def key_document(sheets: Sequence[ExerciseSheet]) -> dict[str, Any]:
    """The key of sheets as a JSON document."""
    return {
        **provenance(sheets[0].seed),
        "sheets": [
            {
                "student": sheet.student,
                "systems": {one.system: dict(one.texts) for one in sheet.exercises},
                "answers": {
                    name: {"system": one.system, **answer.to_json()}
                    for name, (one, answer) in sheet.answers.items()
                },
            }
            for sheet in sheets
        ],
    }


def read_key(path: str | Path) -> Key:
    """A key from its file.

    Raises:
        StoreError: for a file that is missing or no key.
    """
    try:
        content = json.loads(read_whole(Path(path), "the key of an exercise").decode("utf-8"))
        return {
            int(sheet["student"]): {
                str(name): KeyEntry(str(entry["system"]), expected_from(entry))
                for name, entry in sheet["answers"].items()
            }
            for sheet in content["sheets"]
        }
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise StoreError(
            f"the key {path}: {error}",
            expected="a file of JSON that was written with an exercise",
            advice="make it again from the same seed",
        ) from error


# -- answers of students ---------------------------------------------------------------------------


@dataclass(frozen=True)
class HandedIn:
    """What a student handed in.

    Attributes:
        name: of the file.
        student: number.
        answers: by id.
    """

    name: str
    student: int
    answers: Mapping[str, str]


def read_submission(path: str | Path, key: Key) -> HandedIn:
    """The answers in a text, a Markdown file or a notebook: lines such as "2a: 3.2 rad/s".

    The student is named by a line "student: 7", by the heading of the sheet, or by the last number
    in the name of the file; with a single sheet there is no need.

    Raises:
        ParseError: where it is not known whose sheet it is.
        StoreError: for a file that cannot be read.
    """
    source = Path(path)
    try:
        text = read_whole(source, _SUBMITTED).decode("utf-8")
        if source.suffix.lower() == ".ipynb":
            cells = json.loads(text)["cells"]
            text = "\n\n".join("".join(cell["source"]) for cell in cells)
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise StoreError(f"answers in {source}: {error}", expected=_SUBMITTED) from error
    student = _student(text, source, key)
    return HandedIn(source.name, student, dict(_answers(text, key[student])))


def _student(text: str, source: Path, key: Key) -> int:
    found = _STUDENT.search(text)
    numerals = [found["student"] or found["own"]] if found else re.findall(r"\d+", source.stem)
    number = _number(numerals[-1]) if numerals else 0
    if number not in key and len(key) == 1 and not found:
        return next(iter(key))
    if number not in key:
        raise ParseError(
            f"the answers in {source}, which belong to no sheet of the key",
            expected=f"a student from {min(key)} to {max(key)}",
            advice="begin the file with a line such as: student: 7",
        )
    return number


def _number(digits: str) -> int:
    """Of a student; 0, which no student has, for more digits than any number of one has."""
    return int(digits) if len(digits) <= _MOST_DIGITS else 0


def _answers(text: str, entries: Mapping[str, KeyEntry]) -> Iterator[tuple[str, str]]:
    """Answers by id; what follows up to the next answer or heading belongs to one."""
    current, lines = "", list[str]()
    for line in [*text.splitlines(), "#"]:
        found = _ANSWER.match(line)
        begins = found is not None and found["id"] in entries
        if begins or _HEADING.match(line):
            if current:
                yield current, _without_prompt("\n".join(lines).strip(), entries[current])
            current, lines = "", []
        if begins and found is not None:
            current, line = found["id"], found["text"]
        if current:
            lines.append(line)


def _without_prompt(text: str, entry: KeyEntry) -> str:
    """An answer written behind the prompt of a sheet."""
    prompt = entry.expected.prompt
    plain = text.removeprefix(prompt).strip() if text.startswith(prompt) else text
    if entry.expected.unit:  # the blank with its unit behind it, as it is printed
        plain = re.sub(r"_{3,}\s*\S*( \S+)*$", "", plain).strip() if "___" in plain else plain
    return plain.strip("_ \t")


def marked_submission(
    submission: HandedIn, key: Key, equations_of: Callable[[str], Equations]
) -> dict[str, MarkedPart]:
    """The marks of all parts of a sheet, by id; what is missing was left blank.

    Args:
        submission: what was handed in.
        key: of the sheets.
        equations_of: the equations of a system by its name.
    """
    return {
        name: marked_part(
            entry.expected, submission.answers.get(name, ""), equations_of(entry.system)
        )
        for name, entry in key[submission.student].items()
    }


def counts(marks: Mapping[str, MarkedPart]) -> dict[str, int]:
    """How many parts have each mark."""
    return {m.value: sum(part.mark is m for part in marks.values()) for m in PartMark}

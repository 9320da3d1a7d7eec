"""The one reading that each part of a text keeps for a letter of several meanings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from polhode.derive import Equations
from polhode.judge._check import OpenVerdict
from polhode.judge._verdict import Answer
from polhode.judge.document._part_readings import (
    Choice,
    choices_by_part,
    part_readings,
    proposed,
    under_part_reading,
)
from polhode.judge.lines._judge_line import judged_line
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.text._in_force import Section


def choices_of(lines: Iterable[JudgedLine]) -> dict[Section, Choice]:
    """The readings under which most lines of a part hold, by the part."""
    by_section: dict[Section, list[JudgedLine]] = {}
    for line in lines:
        by_section.setdefault(line.line.section.whole, []).append(line)
    found: dict[Section, Choice] = {}
    for section, members in by_section.items():
        readings = part_readings(section.name, (line.verdict for line in members))
        for choice in choices_by_part(readings).values():
            found[section] = choice
    return found


def under_choice(judged: JudgedLine, choice: Choice, equations: Equations) -> JudgedLine:
    """A line with letters read as its part reads them."""
    if len(judged.verdict.by_reading) < 2:
        return judged
    verdict = under_part_reading(judged.verdict, choice)
    if verdict is judged.verdict:
        return judged
    if verdict is not None and verdict.answer is Answer.AMBIGUOUS:
        return replace(judged, judgement=OpenVerdict(verdict))
    chosen = {node: read.meaning for node, read in choice.items()}
    found = judged_line(judged.line, equations, chosen)
    said = replace(found.judgement, verdict=proposed(found.verdict, choice))
    return replace(found, judgement=said, stated=judged.stated)
